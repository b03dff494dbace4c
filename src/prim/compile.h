/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A scene's objects laid out as numbered primitives.
 *
 * Unions are flattened to leaves. A leaf's triangles are baked into level 0, which is the world moved and
 * scaled by a power of two; a larger mesh that several leaves share gets a level of its own, in its own
 * coordinates, and stands in level 0 as instances. Ids of a level are its triangles, group by group, then
 * its analytic primitives, then the pieces of its bodies, then its instances. Infinite planes have no id in
 * a level.
 */
#ifndef ALIDADE_PRIM_COMPILE_H
#define ALIDADE_PRIM_COMPILE_H

#include "base/diag.h"
#include "prim/body.h"
#include "prim/csg.h"
#include "prim/prim.h"

/* A primitive's mask: what kinds of ray see it. Same bits as accel/trace.h's enum trace_mask. */
enum prim_mask {
	PRIM_CAMERA = 1,
	PRIM_REFLECTED = 2,
	PRIM_OTHER = 4,
	PRIM_SHADOW_OPAQUE = 8,
	PRIM_SHADOW_CLEAR = 16,
	PRIM_GATHER = 32,
	PRIM_GATHER_REFLECTED = 64,
	PRIM_PROJECTED = 128
};

struct prim_leaf { /* an object that is no union, with all that it inherits */
	uint32_t object; /* in the scene */
	uint32_t solid; /* see struct object; never SCENE_NONE */
	enum shape_kind kind;
	struct xform place; /* own coordinates to the world */
	bool mirrored; /* place turns left hands into right ones */
	uint32_t texture, interior_texture, interior, mesh;
	unsigned flags;
	uint32_t level; /* the instanced mesh's, or 0 */
	uint32_t node; /* in the set's csg, or SCENE_NONE */
	bool absurd; /* too large to be there */
	bool cut; /* clips others, and shows no surface of its own */
	uint32_t item; /* index among level 0's analytic primitives, its bodies, its instances, or the
			  unbounded ones; SCENE_NONE: baked mesh, or dropped. In constructive solid
			  geometry that is the whole solid, whatever of it shows: planes are primitives */
};

struct prim_group { /* ids of one leaf that stand together */
	uint32_t leaf; /* SCENE_NONE in the level of an instanced mesh */
	uint32_t *face; /* face of the mesh by id - first id; NULL: the same */
};

struct prim_instance {
	uint32_t leaf, level, node;
	vec centre; /* where the inner level's origin lies in level 0 */
	struct mat to; /* level 0 to inner, linear part */
	ald_box box;
};

struct prim_level {
	vec shift; /* level = (world or object coordinates - shift) * scale */
	double scale; /* a power of two */
	double size, pad; /* at least the extent D0, and 16 u of it (R4) */
	ald_box box; /* of the padded boxes */
	uint32_t count, tri_count, prim_count, piece_count, instance_count;
	uint32_t body_count;
	/* Behind the last shape and instance stand those that only cut, without ids. */
	uint32_t hidden_prims, hidden_instances;
	uint32_t group_count;
	uint32_t *group_first; /* [group_count + 1] */
	struct prim_group *group;
	uint32_t vertex_count;
	void *vertex;
	bool vertex_double;
	uint32_t *index;
	uint32_t *mask; /* [count] or NULL */
	struct prim *prim;
	struct prim_piece *piece;
	struct prim *body; /* what pieces are pieces of */
	struct prim_instance *instance;
};

/* What stands behind an id, which becomes the index among its kind. */
enum prim_id { PRIM_TRIANGLE, PRIM_SHAPE, PRIM_PIECE, PRIM_INSTANCE };

static inline enum prim_id prim_level_id(const struct prim_level *l, uint32_t *id)
{
	if (*id < l->tri_count)
		return PRIM_TRIANGLE;
	*id -= l->tri_count;
	if (*id < l->prim_count)
		return PRIM_SHAPE;
	*id -= l->prim_count;
	if (*id < l->piece_count)
		return PRIM_PIECE;
	*id -= l->piece_count;
	return PRIM_INSTANCE;
}

struct prim_unbounded {
	struct prim_plane plane;
	uint32_t prim; /* of level 0; SCENE_NONE: a plane */
	uint32_t leaf, mask, node;
};

/* What is left out of the scene, for want of area or because it is too large, by object: the first ones. */
#define PRIM_DROPPED_SHOWN 6
struct prim_dropped {
	uint32_t object;
	uint32_t face; /* of a mesh, the first one */
	uint64_t count; /* of primitives: a mesh's triangles; others' surfaces are one */
};

/* In world units; no length, but where products of three such numbers beside ordinary ones come to the end of
 * what doubles hold: what reaches further is left out. */
#define PRIM_ABSURD 0x1p300

struct prim_set {
	const struct scene *scene;
	struct mem_book *book;
	uint32_t leaf_count;
	struct prim_leaf *leaf;
	uint32_t level_count; /* at least 1 */
	struct prim_level *level;
	uint32_t unbounded_count;
	struct prim_unbounded *unbounded;
	struct csg csg;
	struct arena arena; /* data of bodies */
	void **body_data[SHAPE_KINDS]; /* by kind and the scene's number of the shape; NULL until made */
	uint64_t dropped, dropped_objects;
	uint32_t last_dropped; /* leaf */
	struct prim_dropped dropped_first[PRIM_DROPPED_SHOWN];
	ald_box world; /* of the finite geometry; empty if there is none */
};

/* Inner to level 0, linear part. */
struct mat prim_instance_from(const struct prim_set *, const struct prim_instance *);

/* All memory is booked under "geometry". On failure *out is released. */
enum status prim_compile(struct prim_set *out, const struct scene *, struct mem_book *, struct diag *);
void prim_set_release(struct prim_set *); /* once more is harmless */
/* Warn of what was left out. */
void prim_report_dropped(const struct prim_set *, struct diag *);
/* Would this scene, of the same shapes but perhaps another camera, be laid out in the same coordinates? */
bool prim_same_frame(const struct prim_set *, const struct scene *);

/* Shared by compile.c, layout.c and mesh.c. */

/* Scale and shift for this box (lo > hi: nothing). */
void prim_level_frame(struct prim_level *, const ald_box *);
static inline vec prim_level_point(const struct prim_level *l, vec p)
{
	return vec_scale(vec_sub(p, l->shift), l->scale);
}
/* The map from mesh to level coordinates: the leaf's place (NULL: none), then the level's frame. */
struct mat prim_bake_mat(const struct prim_level *, const struct xform *place);
/* No NaN, no infinity, nothing absurd; in world units. */
static inline bool prim_sane(vec p)
{
	return fabs(p.x) <= PRIM_ABSURD && fabs(p.y) <= PRIM_ABSURD && fabs(p.z) <= PRIM_ABSURD;
}
/* Note that primitives of this leaf are left out. */
void prim_drop(struct prim_set *, uint32_t leaf, uint64_t count, uint32_t face);
bool prim_join_mesh(ald_box *, const struct mesh *, const struct mat *);
/* Add the mesh's triangles to the level as one group of leaf; group arrays have room. In the level of an
 * instanced mesh the group has no leaf, and leaf is its first one. */
enum status prim_bake_mesh(struct prim_set *, struct prim_level *, const struct mesh *, uint32_t leaf,
			   const struct mat *, struct diag *);
void prim_narrow_vertices(struct prim_level *); /* to float, if that loses nothing */

static inline vec prim_vertex(const struct prim_level *l, uint32_t index)
{
	size_t i = 3 * (size_t)index;
	const double *d = (const double *)l->vertex + i;
	const float *f = (const float *)l->vertex + i;

	if (l->vertex_double)
		return vec_make(d[0], d[1], d[2]);
	return vec_make((double)f[0], (double)f[1], (double)f[2]);
}

/* The corners of a triangle. No loop: one would leave them in memory, and who needs them next would wait for that. */
static inline void prim_triangle(const struct prim_level *l, uint32_t id, vec v[3])
{
	const uint32_t *at = l->index + 3 * (size_t)id;

	v[0] = prim_vertex(l, at[0]);
	v[1] = prim_vertex(l, at[1]);
	v[2] = prim_vertex(l, at[2]);
}

unsigned prim_texture_mask(const struct scene *, uint32_t texture);
unsigned prim_leaf_mask(const struct scene *, const struct prim_leaf *);

#endif
