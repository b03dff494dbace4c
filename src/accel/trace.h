/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The waist of the renderer: three questions about rays, asked in batches.
 *
 * A geometry is a compiled scene with its accelerator, instances and unbounded list. Rays are in world
 * coordinates; t counts in units of dir's length. Ids below geometry's count are the accelerator's;
 * unbounded primitives (planes) have those behind them, but of equal t they come first.
 */
#ifndef ALIDADE_ACCEL_TRACE_H
#define ALIDADE_ACCEL_TRACE_H

#include <math.h>

#include "alidade/accel.h"
#include "base/diag.h"
#include "base/mem.h"
#include "base/pool.h"
#include "scene/scene.h"

/* A primitive's mask: rays see it if they share a bit. */
enum trace_mask {
	TRACE_CAMERA = 1, /* not no_image */
	TRACE_REFLECTED = 2, /* not no_reflection */
	TRACE_OTHER = 4, /* refracted, transmitted */
	TRACE_SHADOW_OPAQUE = 8, /* casts shadows, lets no light through */
	TRACE_SHADOW_CLEAR = 16, /* casts shadows, lets some light through */
	TRACE_GATHER = 32, /* of indirect light: not no_radiosity */
	TRACE_GATHER_REFLECTED = 64, /* neither no_radiosity nor no_reflection */
	TRACE_PROJECTED = 128 /* what lights are projected through, and nothing else */
};

/* What asks, for reports. */
enum trace_purpose {
	TRACE_FOR_CAMERA, TRACE_FOR_SHADOW, TRACE_FOR_REFLECTED, TRACE_FOR_REFRACTED, TRACE_FOR_GATHERED,
	TRACE_FOR_SUBSURFACE, TRACE_PURPOSES
};

/* Where a ray belongs, if rays are verified (verify.h). It stands in words that are zero in the plugin
 * contract: what plugins see of them is. */
static inline void trace_mark(ald_ray *r, const uint32_t pixel[2], enum trace_purpose purpose)
{
	r->reserved[0] = pixel[0];
	r->reserved[1] = pixel[1];
	r->reserved[2] = purpose;
}

struct geometry; /* opaque; made by geometry_build() */

/* Textures that meet in one place: three at a triangle's corners; of a blob's components those with the
 * greatest shares. */
#define SURFACE_BLEND SCENE_BLOB_BLEND

/* What shading needs to know of a hit, in world coordinates. */
struct surface {
	vec p; /* on the surface */
	vec n; /* unit geometric normal of the primitive, outward; of a triangle: (c - a) x (b - a) in its
		  own coordinates, whatever the transform mirrors, as POV-Ray has it */
	vec ns; /* unit shading normal, in n's hemisphere as the mesh gives it; = n where flat */
	double bary[SURFACE_BLEND]; /* of a triangle's corners, or the textures' shares */
	uint32_t texture[SURFACE_BLEND]; /* scene textures; [1] and [2] equal [0] unless blended by bary;
					    SCENE_NONE: nobody gave one */
	uint32_t blend; /* how many of bary and texture there are, at least 3 */
	uint32_t interior_texture; /* or SCENE_NONE */
	/* Their coordinates to the world; NULL: the same. */
	const struct xform *texture_place[SURFACE_BLEND], *interior_texture_place;
	double u, v; /* texture coordinates; 0 unless the scene asks for them */
	uint32_t interior; /* or SCENE_NONE */
	uint32_t object; /* the leaf object as a volume: equal for all surfaces of one solid; leaves are
			    numbered from 0 in the order of the file */
	unsigned flags; /* enum object_flag */
	uint32_t light_set; /* as an object's */
	bool planar; /* next rays may skip this primitive by id */
	bool anew; /* what lies behind depends on a ray starting here: those that go through start anew */
	double error; /* what surface_error() returns */
};

/* Is texture[0] all there is? */
static inline bool surface_is_even(const struct surface *s)
{
	return s->blend == 3 && s->texture[0] == s->texture[1] && s->texture[0] == s->texture[2] &&
	       s->texture_place[0] == s->texture_place[1] && s->texture_place[0] == s->texture_place[2];
}

struct accel_choice; /* a loaded plugin with parameter values, of load.h; NULL: brute force */

struct geometry_counts {
	uint64_t triangles, primitives, instances, unbounded, dropped;
	uint64_t effective_triangles; /* instances counted */
	ald_box box; /* world, of the finite geometry */
	double scale; /* the exact power of two between world and the accelerator's coordinates */
	bool vertex_double;
};

/* How vertices are kept: as floats where that loses nothing, else as doubles. */
struct mesh_vertices {
	uint32_t object; /* in the scene */
	double loss; /* by how much floats would move a vertex, in world units or those of a shared mesh */
	double size, offset; /* its extent, and how far from the origin it is, along an axis */
	bool wide; /* in double: floats would move it, or what shares its level */
};

struct geometry_vertices {
	uint64_t meshes, wide; /* all, those in double */
	uint64_t demanding; /* those which floats would move; others stand beside them */
	vec shift; /* the world's origin, that vertices are relative to */
	struct mesh_vertices worst; /* by loss in relation to size; object SCENE_NONE: all are floats */
};
/* each, unless it is NULL, is told of every mesh, level by level, until it returns false. */
typedef bool mesh_told(void *data, const struct mesh_vertices *);
void geometry_get_vertices(const struct geometry *, struct geometry_vertices *, mesh_told *each, void *data);

/* Compile the scene and build its accelerators, if they are going to fit (load.h). The scene must outlive the
 * geometry. */
enum status geometry_build(struct geometry **out, const struct scene *, const struct accel_choice *,
			   struct pool *, struct mem_book *, bool count, struct diag *);
void geometry_free(struct geometry *); /* NULL is harmless */
/* Make it another scene's, of the same animation: accelerators are kept or refitted where that will do and pays, and
 * what is found is what geometry_build() would find; its old scene has to be there still. Whatever the failure, it is
 * only to be freed then; but for STATUS_SIGINT, nothing was reported and geometry_build() is to be tried. */
enum status geometry_renew(struct geometry *, const struct scene *, const struct accel_choice *, bool count,
			   struct diag *);
/* Has this scene the same shapes in the same places, so that the geometry serves it as it is (its own scene
 * has to live on)? Then the counters and the time of building begin at 0 again. */
bool geometry_reuse(struct geometry *, const struct scene *);
void geometry_get_counts(const struct geometry *, struct geometry_counts *);
/* Sum over threads of the accelerator's counters, instances' inner ones included. */
void geometry_get_counters(const struct geometry *, uint64_t count[ALD_COUNT_MAX]);
/* The plugin's own figures (nodes, depth ...); 0 at the end, as in accel.h. */
int geometry_stat(const struct geometry *, uint32_t i, const char **name, double *value);
double geometry_build_seconds(const struct geometry *);

/* One for each level: an earlier frame's as they were, refitted, and built. */
struct geometry_trees {
	uint32_t kept, refitted, built;
};
void geometry_get_trees(const struct geometry *, struct geometry_trees *);

/* What building was said to take, and what it took, in bytes of the book, with all that was booked before. */
struct geometry_memory {
	bool predicted; /* else the accelerator can't tell, and the next two are 0 */
	uint64_t predicted_most, predicted_kept; /* while building; and then */
	uint64_t most, kept;
};
void geometry_get_memory(const struct geometry *, struct geometry_memory *);

/* hits[i] is overwritten: prim is ALD_NONE for a miss. thread is the pool's. [render] */
void trace_nearest(const struct geometry *, uint32_t thread, const ald_ray *, ald_hit *, uint32_t n,
		   uint32_t hints);
/* hidden[i] = 1 if anything with a bit of the ray's mask is hit in (tmin, tmax]. [render] */
void trace_occluded(const struct geometry *, uint32_t thread, const ald_ray *, uint8_t *hidden,
		    uint32_t n, uint32_t hints);
/*
 * The same for those who make rays by the thousand and eight at a time: they put them where they are wanted, in the
 * geometry's own coordinates, in which a point is (p - shift) * scale and a direction scaled as well.
 */
struct trace_room {
	ald_ray *ray; /* TRACE_ROOM of them; what traces them changes them */
	vec shift;
	double scale;
};
#define TRACE_ROOM 1024u
/* False: this geometry has to see the rays as they are in the world. */
bool trace_room(const struct geometry *, uint32_t thread, struct trace_room *);
/* The first n rays in the room. What is not finite, has no direction or less than no length has to be a
 * trace_nothing(). [render] */
void trace_room_nearest(const struct geometry *, uint32_t thread, ald_hit *, uint32_t n, uint32_t hints);
void trace_room_occluded(const struct geometry *, uint32_t thread, uint8_t *hidden, uint32_t n, uint32_t hints);
/* Seen by nothing, and outside of every volume. */
static inline void trace_nothing(ald_ray *r)
{
	r->org = (ald_vec){ 0, 0, 0 };
	r->dir = (ald_vec){ 1, 0, 0 };
	r->tmin = HUGE_VAL;
	r->tmax = -HUGE_VAL;
	r->mask = 0;
}
/* Set ray so that the next trace_nearest() finds what lies behind hit (R2). */
void trace_after(ald_ray *, const ald_hit *);

/* The mask of the primitive that was hit: of an instance, what it and the face inside have in common. */
uint32_t trace_seen_by(const struct geometry *, const ald_hit *);

/* Normals, barycentrics, textures of a hit. [render] */
void surface_at(const struct geometry *, const ald_ray *, const ald_hit *, struct surface *);
/* By how much u and v change along a way on the surface, if the scene asks for them. */
void surface_uv_along(const struct geometry *, const ald_hit *, const struct surface *, vec way, double *u,
		      double *v);
/* How far the hit on a face with normals is below the smooth surface that these stand for, as a way to it, for
 * shadow rays: [0] on the side the normals point to, [1] on the other. Hanika: Hacking the Shadow Terminator, Ray
 * Tracing Gems II, 2021. False: the face is flat. */
bool surface_lift(const struct geometry *, const ald_hit *, const struct surface *, vec lift[2]);
/* A bound on the distance between surface.p and the true surface, in world units (R4, numerics): a
 * ray that starts at p, moved by this along n, is on that side of this surface. */
double surface_error(const struct geometry *, const ald_ray *, const ald_hit *, const struct surface *);
/* Solids that hold point p, in the order of the scene, at most room of them; returns how many there are.
 * Surfaces without an inside (meshes without inside_vector, discs) hold nothing. */
struct solid {
	uint32_t object; /* as in struct surface */
	uint32_t leaf; /* of geometry's own numbering */
	uint32_t interior; /* or SCENE_NONE */
	bool hollow;
};
uint32_t geometry_inside(const struct geometry *, vec p, struct solid *, uint32_t room);

#endif
