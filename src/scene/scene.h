/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A scene as data: what a reader found in a file, with defaults filled in and every name resolved.
 *
 * Readers write it, prim/compile.c turns the objects into primitives, shade/ looks up textures and
 * lights. Nothing here knows a file format or a ray. Lengths are in scene units, angles in degrees,
 * colours in the scene's working space. All memory belongs to the scene; things refer to each other
 * by index, so arrays may grow while reading.
 */
#ifndef ALIDADE_SCENE_SCENE_H
#define ALIDADE_SCENE_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/colour.h"
#include "base/diag.h"
#include "base/mem.h"
#include "base/vec.h"
#include "scene/atmosphere.h"
#include "scene/media.h"
#include "scene/texture.h"

#define SCENE_NONE UINT32_MAX /* no texture, no interior, no object */

enum camera_kind {
	CAMERA_PERSPECTIVE,
	CAMERA_ORTHOGRAPHIC,
	CAMERA_FISHEYE,
	CAMERA_ULTRA_WIDE_ANGLE,
	CAMERA_OMNIMAX,
	CAMERA_PANORAMIC,
	CAMERA_SPHERICAL,
	CAMERA_CYLINDER_1, /* axis up, from a point */
	CAMERA_CYLINDER_2, /* axis right, from a point */
	CAMERA_CYLINDER_3, /* axis up, from the axis */
	CAMERA_CYLINDER_4 /* axis right, from the axis */
};

/* Placed for good: a ray through (x, y) in -0.5..0.5 (right, up) has, for a perspective camera, the
 * origin location and the direction direction + x right + y up; for an orthographic one the origin
 * location + x right + y up and the direction direction. */
struct camera {
	enum camera_kind kind;
	vec location, direction, right, up;
	double angle; /* degrees: fisheye, ultra_wide_angle, cylinder; spherical: across */
	double angle_up; /* degrees: spherical */
	double aperture; /* focal blur; 0: none. What is in focus is focal_distance away */
	double focal_distance;
	uint32_t blur_samples;
	struct normal *normal; /* bends its rays; NULL: none */
	struct diag_pos pos;
};

enum light_kind { LIGHT_POINT, LIGHT_SPOT, LIGHT_CYLINDER };

struct light {
	enum light_kind kind;
	bool no_media; /* media_interaction off */
	bool attenuated; /* media_attenuation: fog and the world's media take from its light */
	bool parallel; /* rays along -direction from a plane through location */
	bool shadowless;
	bool area; /* area_light: size1 x size2 points spread along axis1 and axis2 */
	bool area_illumination, jitter, circular, orient;
	uint32_t adaptive; /* levels of subdivision; LIGHT_NOT_ADAPTIVE: not given */
	uint32_t size1, size2; /* at least 1 */
	vec location;
	vec direction; /* unit, from location to point_at; spot, cylinder and parallel lights */
	double axis_length; /* from location to point_at */
	vec axis1, axis2; /* full length */
	struct rgb colour;
	double radius, falloff; /* spot: degrees; cylinder: units */
	double tightness;
	double fade_distance, fade_power; /* no fading unless both are > 0 */
	bool projected; /* it shines only where an OBJECT_PROJECTED is between, and shadows count from there */
	uint32_t group; /* of light_group; SCENE_NONE: it shines on all that is in no group */
	struct diag_pos pos;
};

/* What things in a light_group are lit by. */
struct light_set {
	uint32_t group; /* its lights */
	bool global; /* and those in no group */
};
#define LIGHT_NOT_ADAPTIVE UINT32_MAX

struct interior {
	double ior; /* 1: rays pass straight */
	double caustics; /* 0: none */
	double fade_distance, fade_power; /* no fading if fade_distance is 0, of shadows unless fade_power > 0 */
	struct rgb fade_colour;
	double dispersion; /* ior of violet to that of red; 1: none, > 0 */
	uint32_t dispersion_samples; /* bands that white light is split into, at least 2 */
	uint32_t media_count; /* of hollow objects; 0: empty */
	struct media *media; /* in the arena */
};

/* Positions in double as read; normals in float as POV-Ray keeps them. */
struct mesh {
	uint32_t vertex_count, triangle_count, normal_count;
	double *vertex; /* [3 * vertex_count] */
	uint32_t *index; /* [3 * triangle_count] */
	float *normal; /* [3 * normal_count], unit length, or NULL */
	uint32_t *normal_index; /* [3 * smooth_count]; NULL: same as index */
	uint32_t smooth_count; /* the first so many triangles have normals, the others are flat */
	uint32_t *texture; /* [triangle_count * textures_per_face] scene textures (SCENE_NONE: the
			      object's own), or NULL: all have the object's own texture */
	uint32_t empty_face; /* number in the file of the first face without area, SCENE_NONE: there is none, or
				which is not known; for messages */
	uint32_t textures_per_face; /* 0, 1, or 3: one per corner, blended */
	uint32_t uv_count;
	float *uv; /* [2 * uv_count], or NULL: no texture of the scene asks for them */
	uint32_t *uv_index; /* [3 * triangle_count]; NULL: same as index, or all 0 if there is one uv */
	bool lone; /* a triangle outside a mesh, a height_field: u and v are x and y of the scene, as for most shapes */
	bool grid; /* faces 2i and 2i + 1 are a cell, over which four normals of any length are interpolated */
	bool has_inside;
	vec inside; /* inside_vector */
	struct diag_pos pos;
};

enum sweep_kind { SWEEP_LINEAR, SWEEP_B, SWEEP_CUBIC };

/* A ball swept along a spline of these points (centre and radius): linear ones go through all of them, the
 * others lack a piece at either end. */
struct sweep {
	enum sweep_kind kind;
	uint32_t count; /* at least 2, or 4 */
	double (*point)[4]; /* x, y, z, radius; in the arena */
};

/* Textures that can meet at one point of a blob; of more, the faintest are left out. */
#define SCENE_BLOB_BLEND 8

/* Strength times (1 - d^2 / radius^2)^2, d being the distance from base, or from the segment to apex. */
struct blob_part {
	bool cylinder;
	vec base, apex;
	double radius, strength;
	struct xform *place; /* to the blob's coordinates; NULL: the same. In the arena */
	uint32_t texture; /* SCENE_NONE: the blob's */
	struct xform *texture_place; /* as an object's */
};

struct blob {
	double threshold;
	uint32_t count; /* at least 1 */
	struct blob_part *part; /* in the arena */
};

enum lathe_kind { LATHE_LINEAR, LATHE_QUADRATIC, LATHE_CUBIC, LATHE_BEZIER };

/* A spline of these points (distance from the y axis, and y) turned about that axis. */
struct lathe {
	enum lathe_kind kind;
	uint32_t count; /* at least 2, 3, 4, or a multiple of 4 */
	double (*point)[2]; /* in the arena */
};

/* Curves in the plane of x and z, swept from height lo to hi; conic: they lie at height 1 and shrink towards 0. */
struct prism {
	enum lathe_kind kind;
	bool conic, open; /* open: without its ends */
	double lo, hi;
	uint32_t count; /* four points for each piece of a curve, of which simpler kinds ignore the last */
	double (*point)[2]; /* in the arena */
};

/* Where a function of x, y and z is the threshold, within a box, or in the ball in it; less is inside. */
struct isosurface {
	const struct function *function; /* in the arena */
	double threshold;
	double accuracy, max_gradient; /* of the search, both > 0 */
	bool evaluate; /* max_gradient is the least that it can be */
	bool open; /* the container's surface is not there */
	bool sphere;
	vec lo, hi; /* lo < hi */
};

#define SCENE_ALGEBRAIC_DEGREE 35

/* Where a polynomial of x, y and z is 0; less is inside. Terms x^i y^j z^k of coordinates in units of size, by
 * falling i, then j, then k: the language's order. */
struct algebraic {
	uint32_t degree; /* at least 1 */
	double size; /* a power of two */
	double *term; /* [algebraic_terms(degree)]; in the arena */
};

static inline uint32_t algebraic_terms(uint32_t degree)
{
	return (degree + 1) * (degree + 2) * (degree + 3) / 6;
}

enum shape_kind {
	SHAPE_MESH,
	SHAPE_SPHERE,
	SHAPE_BOX,
	SHAPE_CONE, /* and cylinder */
	SHAPE_PLANE,
	SHAPE_DISC,
	SHAPE_TORUS,
	SHAPE_SUPERELLIPSOID,
	SHAPE_ALGEBRAIC,
	SHAPE_SWEEP,
	SHAPE_BLOB,
	SHAPE_LATHE,
	SHAPE_PRISM,
	SHAPE_ISOSURFACE,
	SHAPE_UNION, /* this and those below have children */
	SHAPE_MERGE,
	SHAPE_INTERSECTION, /* a difference is one with inverses */
	SHAPE_KINDS
};

enum object_flag {
	OBJECT_NO_SHADOW = 1, /* casts none */
	OBJECT_NO_IMAGE = 2, /* camera rays do not see it */
	OBJECT_NO_REFLECTION = 4, /* reflected rays do not see it */
	OBJECT_HOLLOW = 8,
	OBJECT_DOUBLE_ILLUMINATE = 16,
	/* Outside in. With children: each of them is, and the kind is already what that makes of it */
	OBJECT_INVERSE = 32,
	OBJECT_NO_RADIOSITY = 64, /* rays that gather indirect light do not see it */
	OBJECT_PROJECTED = 128 /* nobody sees it: only its light goes through it (projected_through) */
};

struct object {
	enum shape_kind kind;
	struct xform place; /* own coordinates to the parent's */
	uint32_t texture, interior_texture; /* SCENE_NONE: the parent's */
	/* From the texture's coordinates to the world, as the object's transforms after its texture
	 * statement make it; NULL: the same. In the arena. Leaves only; faces' own textures go by it too. */
	struct xform *texture_place, *interior_texture_place;
	uint32_t interior; /* SCENE_NONE: the parent's */
	uint32_t solid; /* leaves of an equal number are one solid for refraction: POV-Ray tells solids
			   apart by their interiors, and a union's is shared; SCENE_NONE: by itself */
	unsigned flags; /* enum object_flag; a parent's are added */
	uint32_t light_set; /* SCENE_NONE: lit by the lights in no group; OBJECT_PROJECTED: the light. Leaves only */
	uint32_t first_child, next_sibling; /* unions and the like; SCENE_NONE ends */
	uint32_t first_clip; /* clipped_by: chained siblings, in the parent's coordinates; only what lies in
				all of them is there */
	union {
		uint32_t mesh, sweep, blob, isosurface, algebraic;
		struct {
			vec centre;
			double radius;
		} sphere;
		struct {
			vec lo, hi; /* lo <= hi */
		} box;
		struct {
			vec base, apex;
			double base_radius, apex_radius; /* >= 0, not both 0 */
			bool open;
		} cone;
		struct {
			vec normal; /* unit */
			double distance; /* points p with p.normal = distance */
		} plane;
		struct {
			vec centre, normal; /* unit */
			double radius, hole;
		} disc;
		struct {
			double major, minor; /* about the y axis */
		} torus;
		struct {
			double a, b; /* > 0; east-west and north-south: (|x|^(2/a) + |y|^(2/a))^(a/b) +
					|z|^(2/b) = 1 */
		} superellipsoid;
		struct {
			uint32_t index, pieces; /* of scene.lathe; how many curves it is made of */
		} lathe;
		struct {
			uint32_t index; /* of scene.prism */
		} prism;
	} shape;
	struct diag_pos pos;
};

/* Indirect light as global_settings { radiosity { } } describes it (manual 3.4.4.3). What decides the light
 * itself stands first; the rest tells POV-Ray's cache how well to approximate it. */
struct radiosity {
	bool given; /* there is such a block */
	bool normal; /* light is gathered around a layer's bent normal */
	bool media; /* what is gathered shows fog, rainbows and media */
	bool subsurface;
	uint32_t recursion_limit; /* bounces, at least 1 */
	double brightness; /* factor at each bounce */
	double gray_threshold; /* 0: coloured .. 1: only its grey counts, at each bounce */
	double adc_bailout; /* replaces the scene's for gathered light */
	double max_sample; /* nothing gathered is brighter, if > 0 */

	uint32_t count, nearest_count; /* rays a sample; samples a place */
	double error_bound, low_error_factor;
	double minimum_reuse, maximum_reuse; /* shares of the distance to the camera */
	double pretrace_start, pretrace_end; /* shares of the picture's width */
	bool always_sample;
};

/* Light below surfaces whose finish says so, as global_settings { subsurface { } } describes it (manual
 * 3.4.1.12). */
struct subsurface {
	bool given; /* there is such a block; without it, what finishes say has no effect */
	bool used; /* some texture has such a finish */
	bool radiosity; /* indirect light goes below surfaces too */
	uint32_t samples, single_samples; /* POV-Ray's, of light scattered often and once */
	double mm_per_unit; /* > 0; finishes count in millimetres */
};

/* As the language calls it, or nearly. */
const char *shape_name(enum shape_kind);

/* What inside out makes of a kind with children, as POV-Ray does it: twice is not always what it was. */
static inline enum shape_kind shape_inverse(enum shape_kind k)
{
	return k == SHAPE_INTERSECTION			   ? SHAPE_MERGE :
	       k == SHAPE_UNION || k == SHAPE_MERGE ? SHAPE_INTERSECTION :
						      k;
}

struct scene {
	struct mem_book *book; /* the caller's; outlives the scene */
	struct arena arena; /* small things; file names in diag_pos too */
	char *name; /* the file it came from, "-" for standard input */

	int version; /* 100 times POV-Ray's: 370 */
	double assumed_gamma; /* 0: no gamma correction at all */
	uint32_t max_trace_level; /* at least 1 */
	double adc_bailout;
	struct rgb ambient_light;
	struct rgbft background;
	struct rgb irid_wavelength; /* of red, green and blue, to a film's thickness */
	uint32_t noise_generator; /* of patterns that name none: 1, 2, 3, or 0: by the version */
	uint32_t number_of_waves; /* of ripples and waves, at least 1 */
	struct radiosity radiosity;
	struct subsurface subsurface;
	struct camera camera;
	bool has_camera;
	uint32_t media_count; /* that fill the world, outside of what is not hollow */
	struct media *media; /* in the arena */

	struct sky_sphere *sky; /* in the arena; NULL: none */
	uint32_t fog_count, fog_room;
	struct fog *fog;
	uint32_t rainbow_count, rainbow_room;
	struct rainbow *rainbow;
	uint32_t light_count, light_room;
	struct light *light;
	uint32_t light_set_count, light_set_room;
	struct light_set *light_set;
	bool wants_uv; /* some texture is asked at (u, v, 0) */
	uint32_t texture_count, texture_room;
	struct texture *texture; /* layers are in the arena */
	/* What textures are made of, each once, behind what it is made of itself. */
	uint32_t pattern_count, pattern_room;
	struct pattern **pattern; /* in the arena */
	uint32_t map_count, map_room;
	struct map *map; /* entries are in the arena */
	uint32_t interior_count, interior_room;
	struct interior *interior;
	uint32_t picture_count, picture_room;
	struct picture **picture; /* in the arena */
	struct mip *mip; /* of every way in which a picture is used; in the arena */
	uint32_t mesh_count, mesh_room;
	struct mesh *mesh; /* arrays by mem_alloc */
	uint32_t sweep_count, sweep_room;
	struct sweep *sweep;
	uint32_t lathe_count, lathe_room;
	struct lathe *lathe;
	uint32_t prism_count, prism_room;
	struct prism *prism;
	uint32_t isosurface_count, isosurface_room;
	struct isosurface *isosurface;
	uint32_t algebraic_count, algebraic_room;
	struct algebraic *algebraic;
	uint32_t blob_count, blob_room;
	struct blob *blob;
	uint32_t object_count, object_room;
	struct object *object; /* the whole forest */
	uint32_t first_root, last_root; /* chained by next_sibling in the order of the file */
};

/* Empty scene with POV-Ray 3.7's defaults. */
void scene_init(struct scene *, struct mem_book *);
void scene_release(struct scene *);

/* Append one, cleared (object: identity place, no texture, no interior, no relations), and return its
 * index, or SCENE_NONE when out of memory. Pointers into the array change. */
uint32_t scene_add_fog(struct scene *);
uint32_t scene_add_rainbow(struct scene *, uint32_t entries);
uint32_t scene_add_light(struct scene *);
uint32_t scene_add_light_set(struct scene *);
uint32_t scene_add_texture(struct scene *, uint32_t layers);
uint32_t scene_add_interior(struct scene *);
uint32_t scene_add_mesh(struct scene *);
uint32_t scene_add_sweep(struct scene *, uint32_t points);
uint32_t scene_add_lathe(struct scene *, uint32_t points);
uint32_t scene_add_prism(struct scene *, uint32_t points);
uint32_t scene_add_isosurface(struct scene *, const struct isosurface *);
uint32_t scene_add_algebraic(struct scene *, uint32_t degree);
uint32_t scene_add_blob(struct scene *, uint32_t parts);
uint32_t scene_add_object(struct scene *);
struct picture *scene_add_picture(struct scene *);
uint32_t scene_add_pattern(struct scene *, struct pattern *);
uint32_t scene_add_map(struct scene *, const struct map *); /* NULL: no memory */
/* Put object o at the end of the roots. */
void scene_add_root(struct scene *, uint32_t o);

/* Does a light shine on things with this light_set? */
static inline bool scene_lit_by(const struct scene *s, const struct light *l, uint32_t set)
{
	if (set == SCENE_NONE)
		return l->group == SCENE_NONE;
	return l->group == SCENE_NONE ? s->light_set[set].global : l->group == s->light_set[set].group;
}

/* 64 bits over everything that decides the picture (not names and places). */
uint64_t scene_hash(const struct scene *);
/* The same over what is where: objects, meshes, and which textures light can pass. What geometry_build()
 * takes from a scene must be in it, or an animation shows an earlier frame's. */
uint64_t scene_hash_shapes(const struct scene *);

#endif
