/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What a scene file's blocks are read into before they are used: the things that identifiers stand for.
 *
 * All of them live in the parser's arena and are never changed once they have been read (but for the
 * memo fields said so below), so that copying an identifier is copying a pointer. Only what is used
 * reaches the scene; what cannot be rendered is kept as a struct pov_lack and reported at that moment.
 */
#ifndef ALIDADE_READ_POV_ITEMS_H
#define ALIDADE_READ_POV_ITEMS_H

#include "base/buf.h"
#include "read/pov/parser.h"

/* The trees of textures are those of scene/texture.h, in the parser's arena; what stands in them is never
 * changed, so that identifiers share it. depth: how many maps stand in one another. */
struct pov_map { /* ITEM_COLOUR_MAP and its kin */
	struct map map;
	struct pov_lack lack; /* of any entry */
	bool subsurface;
	uint32_t depth;
};

struct pov_pigment { /* ITEM_PIGMENT */
	struct pigment pigment;
	struct pov_lack lack;
	uint32_t depth;
};

struct pov_normal { /* ITEM_NORMAL */
	struct normal *normal; /* NULL: none; without a pattern it only says how strong others are */
	struct pov_lack lack;
	uint32_t depth;
};

struct pov_finish { /* ITEM_FINISH */
	struct finish finish;
	bool opaque; /* a translucency that POV-Ray cannot draw; matters if global_settings has subsurface */
	struct diag_pos opaque_at;
	struct pov_lack lack;
};

struct pov_layer {
	struct pov_pigment pigment;
	struct pov_normal normal;
	struct pov_finish finish;
};

struct pov_texture { /* ITEM_TEXTURE */
	struct pov_lack lack; /* of the pattern */
	uint32_t count; /* of layers, at least 1; 0: a pattern of textures */
	struct pov_layer *layer; /* [0] is the topmost */
	bool uv;
	struct pattern *pattern;
	struct pov_map map;
	struct texture *made; /* memo: the tree, NULL until first asked for */
	struct pov_texture *with_uv; /* memo: the same, asked at (u, v, 0) */
	uint32_t index; /* memo: the scene's texture, SCENE_NONE until first used */
};

struct pov_media { /* ITEM_MEDIA */
	struct media media; /* its densities in the parser's arena, its place not used */
	struct pov_lack lack;
};

struct pov_interior { /* ITEM_INTERIOR */
	struct interior interior;
	bool bends; /* its ior was given */
	struct diag_pos splits; /* where its dispersion was */
	struct pov_lack lack;
	uint32_t media_count;
	struct pov_media *media; /* [media_count]; they matter only in a hollow object */
	uint32_t index; /* memo, as above */
};

struct pov_material { /* ITEM_MATERIAL; each may be NULL */
	struct pov_texture *texture, *interior_texture;
	struct pov_interior *interior;
};

struct pov_camera { /* ITEM_CAMERA */
	struct camera camera; /* its normal in the parser's arena */
	struct pov_lack lack;
};

/* A mesh is put into the scene as it is read; its textures follow when it is used. */
struct pov_mesh {
	uint32_t index; /* of the scene's mesh */
	uint32_t list_count;
	struct pov_texture **list; /* what the mesh's texture indices mean until they are resolved */
	struct pov_texture *uniform; /* not NULL: all faces have this one, and the mesh no indices */
	bool partial; /* some faces have the object's own texture */
	bool resolved; /* memo: the scene's mesh has the scene's texture indices */
};

struct pov_blob {
	uint32_t index; /* of the scene's blob */
	struct pov_texture **texture; /* by component; NULL: the blob's own */
	struct xform *texture_place; /* by component: their coordinates to the blob's */
	bool used; /* memo: the scene's blob has the scene's texture indices and places */
};

struct pov_child {
	struct pov_object *object;
	struct pov_child *next;
	struct xform before; /* clipped_by: the transforms of the object that stand before it */
};

struct pov_object { /* ITEM_OBJECT */
	struct object object; /* shape, place and flags; relations and indices are not used */
	struct light *light; /* not NULL: a light source, and nothing else */
	struct pov_object *through; /* of a light: what it is projected through, or NULL */
	struct pov_mesh *mesh; /* SHAPE_MESH */
	struct pov_blob *blob; /* SHAPE_BLOB */
	struct pov_texture *texture, *interior_texture;
	struct xform texture_place, interior_texture_place; /* transforms that came after them */
	struct pov_interior *interior;
	struct xform interior_place; /* transforms that came after it */
	bool group; /* a light_group */
	bool global_lights; /* its things are lit by the lights in no group too */
	bool lamp; /* a light and what it looks like */
	bool declared; /* it was given a name, or was made from such a thing */
	bool water; /* a height_field cut off at a water_level */
	bool uv; /* uv_mapping: all its textures are asked at (u, v, 0) */
	unsigned given; /* enum object_flag: those that were given, on or off */
	struct pov_lack lack;
	struct pov_child *first, *last; /* of a union and the like, in the order of the file */
	struct pov_child *clip; /* clipped_by, the last one first */
	uint32_t depth; /* of unions in unions below this one */
	uint64_t weight; /* objects that it puts into the scene, with all that is in it */
};

struct pov_rainbow { /* ITEM_RAINBOW; angles in degrees, whole arcs */
	struct rainbow rainbow;
	struct pov_map *map; /* NULL: none */
	struct pov_lack lack;
};

struct pov_fog { /* ITEM_FOG */
	struct fog fog;
};

struct pov_sky_pigment {
	struct pov_pigment pigment;
	struct pov_sky_pigment *next;
};

struct pov_sky { /* ITEM_SKY_SPHERE */
	struct pov_sky_pigment *first; /* the lowest */
	uint32_t count;
	struct rgb emission;
	struct xform place;
};

/* What reading must remember between items; pov_state() gives it. */
struct pov_state {
	struct pov_texture *base; /* #default's texture, always one layer */
	struct copies copies; /* of what has been put into the scene's textures */
	struct pov_texture first; /* what it is when reading begins */
	struct pov_layer first_layer;
	struct pov_camera *camera; /* the last one used */
	struct pov_lack photons, object_photons; /* global block; first object that asks for them */
	bool opaque; /* some finish used has no translucency in some colour */
	struct diag_pos opaque_at;
	uint32_t media_count;
	struct pov_media *media; /* that fill the world */
	bool gamma_given;
	struct pov_picture *pictures; /* files that were read */
	struct pov_decode *decodes;
	uint64_t picture_bytes;
	uint64_t objects, object_limit; /* put into the scene */
	struct pov_object *spare; /* memory for the next one; NULL: none */
};

/* Blocks. pov_open: the current token is a block's keyword: pass it and its {. pov_close: pass the }. */
bool pov_open(struct pov *);
bool pov_close(struct pov *, const char *block);
/* Pass tokens up to, not including, the } that ends the block we are in. */
void pov_skip_rest(struct pov *);
/* If the current token is an identifier that holds an item of this kind, pass it and return the item. */
void *pov_take(struct pov *, enum pov_item_kind);
bool pov_starts_colour(struct pov *);
struct diag_pos pov_here(struct pov *); /* where the next token stands, also if it is not yet looked at */
/* Memory in the parser's arena, cleared; reports when there is none. */
void *pov_new(struct pov *, size_t bytes);
void *pov_copy(struct pov *, const void *item, size_t bytes);

/* Numbers that have to be finite; what: how messages call them. */
double pov_finite_float(struct pov *, const char *what);
vec pov_finite_vector(struct pov *, const char *what);
struct rgbft pov_finite_colour(struct pov *, const char *what);
double pov_positive(struct pov *, const char *what); /* > 0 */

/* Readers of a block; the current token is its keyword. NULL: an error was reported. */
struct pov_pigment *pov_read_pigment(struct pov *, const struct pov_pigment *base);
struct pov_normal *pov_read_normal(struct pov *, const struct pov_normal *base);
/* The inside of the braces. */
bool pov_pigment_body(struct pov *, struct pov_pigment *);
bool pov_density_body(struct pov *, struct pov_pigment *); /* set whole */
bool pov_normal_body(struct pov *, struct pov_normal *);
struct pov_texture *pov_texture_body(struct pov *);
/* color_map, pigment_map ...: of the kind that the current token says. weights: an average's. */
struct pov_map *pov_read_map(struct pov *, bool weights);
struct pov_finish *pov_read_finish(struct pov *, const struct pov_finish *base);
struct pov_texture *pov_read_texture(struct pov *);
struct pov_interior *pov_read_interior(struct pov *, const struct pov_interior *base);
struct pov_pigment *pov_read_density(struct pov *);
struct pov_media *pov_read_media(struct pov *);
/* Read one and append it to an array in the parser's arena. */
bool pov_add_media(struct pov *, uint32_t *count, struct pov_media **);
/* Media into the scene's arena, their densities moved by place. False: an error was reported. */
bool pov_use_media(struct pov *, uint32_t count, const struct pov_media *, const struct xform *place,
		   struct media **out);
/* Changes *m. */
bool pov_read_material(struct pov *, struct pov_material *m);
struct pov_camera *pov_read_camera(struct pov *);
struct pov_object *pov_read_light(struct pov *);
/* The inside of a mesh's or triangle's braces; modifiers and } are left to the caller. at: its keyword. */
struct pov_object *pov_read_mesh(struct pov *, const struct diag_pos *at);
struct pov_object *pov_read_mesh2(struct pov *, const struct diag_pos *at);
struct pov_object *pov_read_height_field(struct pov *, const struct diag_pos *at);
struct pov_object *pov_read_triangle(struct pov *, const struct diag_pos *at, bool smooth);
/* The numbers of shapes that have a file of their own. */
void pov_read_sweep(struct pov *, struct object *);
void pov_read_lathe(struct pov *, struct object *);
/* A finite point of a plane, onto the end of a buffer of double[2]; what: of what, and at: where, for errors. */
bool pov_read_flat_point(struct pov *, struct buf *, const char *what, struct diag_pos *at);
void pov_read_prism(struct pov *, struct object *);
void pov_read_isosurface(struct pov *, struct object *);
void pov_read_quadric(struct pov *, struct object *);
void pov_read_cubic(struct pov *, struct object *);
void pov_read_quartic(struct pov *, struct object *);
void pov_read_poly(struct pov *, struct object *);
void pov_read_polynomial(struct pov *, struct object *);
struct pov_object *pov_read_blob(struct pov *, struct pov_object *);
/* Any object; not one: NULL and nothing read, or after an error. */
struct pov_object *pov_read_object(struct pov *);
bool pov_starts_object(struct pov *);
void pov_read_settings(struct pov *);
uint32_t pov_noise_generator(struct pov *); /* a number of 1 to 3 */
void pov_read_background(struct pov *);
void pov_read_radiosity(struct pov *); /* the block of global_settings */
void pov_read_importance(struct pov *); /* radiosity { } of an object or #default */
struct pov_fog *pov_read_fog(struct pov *);
struct pov_rainbow *pov_read_rainbow(struct pov *);
struct pov_sky *pov_read_sky(struct pov *);
/* Put it into the scene; NULL is nothing. */
void pov_use_fog(struct pov *, const struct pov_fog *);
void pov_use_rainbow(struct pov *, const struct pov_rainbow *);
void pov_use_sky(struct pov *, const struct pov_sky *);

/* The texture with a transform after it: the same one if it looks alike everywhere. */
struct pov_texture *pov_texture_transform(struct pov *, struct pov_texture *, const struct xform *);
/* The texture asked at (u, v, 0), with its own transforms. NULL: no memory. */
struct pov_texture *pov_texture_with_uv(struct pov *, struct pov_texture *);
/* The tree of what was read. NULL: no memory. */
struct texture *pov_texture_made(struct pov *, struct pov_texture *);
/* pigment, normal or finish as the current token: *t with its topmost layer changed, or #default's. */
bool pov_texture_part(struct pov *, struct pov_texture **t);
/* upper laid over lower; either may be NULL. */
struct pov_texture *pov_texture_over(struct pov *, struct pov_texture *upper, struct pov_texture *lower);
struct pov_texture *pov_default_texture(struct pov *);

struct pov_object *pov_object_new(struct pov *, enum shape_kind, const struct diag_pos *);
/* Its modifiers up to the }; and a transform as if it stood there. */
void pov_object_modifiers(struct pov *, struct pov_object *);
void pov_object_move(struct pov_object *, const struct xform *);
bool pov_object_add(struct pov *, struct pov_object *o, struct pov_object *child);
/* The texture as the scene's, SCENE_NONE after an error; reports what it lacks. */
uint32_t pov_use_texture(struct pov *, struct pov_texture *);
/* Put an object that stands in the scene itself, not in another, into the scene. */
void pov_use_object(struct pov *, struct pov_object *);

#endif
