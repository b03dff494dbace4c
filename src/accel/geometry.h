/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Inside of struct geometry, for the files of this folder.
 */
#ifndef ALIDADE_ACCEL_GEOMETRY_H
#define ALIDADE_ACCEL_GEOMETRY_H

#include <string.h>

#include "accel/host.h"
#include "accel/trace.h"
#include "alidade/kernel.h"
#include "base/wide.h"
#include "prim/compile.h"

#define TRACE_BATCH 1024u /* rays that go to a plugin in one call, at most */

struct view { /* a level, as a plugin sees it; the plugin is given a pointer to prims */
	ald_prims prims;
	const struct geometry *geometry;
	const struct prim_level *level;
	ald_frame frame;
	ald_accel *accel; /* NULL: nothing in it */
	size_t scratch; /* bytes per thread */
};

struct query { /* what a plugin hands back to us with each call; it sees q only */
	ald_query q;
	struct worker *worker;
};

struct worker { /* one per thread; nothing here is shared */
	struct query *query; /* [levels] */
	uint64_t count[ALD_COUNT_MAX];
	bool any; /* asked is whether rays hit anything; what is nearest need not be found */
	ald_ray ray[TRACE_BATCH], inner_ray[TRACE_BATCH];
	ald_hit hit[TRACE_BATCH], inner_hit[TRACE_BATCH];
	uint32_t plane[TRACE_BATCH], slot[TRACE_BATCH];
	uint8_t hidden[TRACE_BATCH], inner_hidden[TRACE_BATCH];
};

struct geometry {
	struct prim_set set;
	uint32_t precision; /* ALD_PRECISION_... */
	struct mem_book *book;
	const ald_accel_plugin *plugin;
	struct accel_host host;
	struct view *view; /* [set.level_count] */
	uint32_t threads;
	struct worker **worker; /* [threads] */
	double seconds;
	uint64_t hash; /* of the scene's shapes; 0: not known yet */
	uint64_t asked; /* the hash of the scene that it was last compared with, or 0 */
	struct geometry_trees trees;
	struct verify *verify; /* NULL: no ray is asked twice */
	struct geometry_memory memory;
	bool borrowed; /* set is another geometry's, which outlives this one */
};

/* prims->bounds(), intersect() and intersect_n(), of instance.c. */
void view_bounds(const ald_prims *, uint32_t id, ald_box *);
int view_intersect(const ald_prims *, uint32_t id, ald_query *, const ald_ray *, ald_hit *);
/* Round t and compute u and v of a hit that a plugin found, where it was asked for the exact order. */
void view_settle(const struct view *, const ald_ray *, ald_hit *);
void view_settle_n(const struct view *, const ald_ray *, ald_hit *, uint32_t n);
/* What the plugin finds in a level, settled. */
void view_nearest(const struct view *, struct worker *, const ald_ray *, ald_hit *);
void view_intersect_n(const ald_prims *, uint32_t id, ald_query *, const ald_ray *, ald_hit *,
		      const uint8_t *live, uint32_t n);

/* Constructive solid geometry, in csg.c. Does the crossing at t of the node's leaf show? */
bool csg_shows(const struct view *, struct worker *, uint32_t node, const ald_ray *, double t);
/* Is p, in level coordinates, in this leaf, and does the leaf count there? */
bool csg_holds(const struct geometry *, uint32_t leaf, vec p);
int csg_intersect_shape(const struct view *, struct worker *, const struct prim *, uint32_t id,
			const ald_ray *, ald_hit *);
int csg_intersect_piece(const struct view *, struct worker *, const struct prim *,
			const struct prim_piece *, uint32_t id, const ald_ray *, ald_hit *);
/* Does the leaf's mesh, which has an inside_vector, hold p of level 0? The worker's accelerator finds the
 * faces ahead; NULL: all are looked at. */
bool mesh_holds(const struct geometry *, struct worker *, const struct prim_leaf *, vec p);

/* The plugin's functions, with what is said in accel.h where it offers none. */
void accel_nearest_n(const ald_accel_plugin *, const ald_accel *, ald_query *, const ald_ray *, ald_hit *,
		     uint32_t n, uint32_t hints);
void accel_occluded_n(const ald_accel_plugin *, const ald_accel *, ald_query *, const ald_ray *,
		      uint8_t *hidden, uint32_t n, uint32_t hints);
/* Member f of the plugin's struct, or NULL if it ends before it. */
#define ACCEL_HAS(plugin, f)                                                                       \
	((plugin)->size >= offsetof(ald_accel_plugin, f) + sizeof((plugin)->f) && (plugin)->f)

/* What this plugin would need for all levels that it has not built yet, with what is booked already; false: it can't
 * tell. */
struct need {
	uint64_t most, kept; /* while building; and then */
};
bool forecast_need(const struct geometry *, const ald_accel_plugin *, const double *value, struct need *);
/* Predict, and refuse what does not fit. Views are there, but not built. */
enum status forecast_check(struct geometry *, const struct accel_choice *, struct diag *);

static inline uint32_t level_group(const struct prim_level *l, uint32_t id)
{
	return ald_group_of(&(ald_prims){ .group_count = l->group_count, .group_first = l->group_first }, id);
}

/* In parts: for geometry_build() and geometry_renew(). */
void geometry_show(struct geometry *); /* the set's levels to the plugin's views */
/* Accelerators for the levels that have none, and threads that can ask them. */
enum status geometry_complete(struct geometry *, const struct accel_choice *, bool count, struct diag *);
void geometry_dismiss(struct geometry *); /* the threads */

/* Which leaf a level's primitive belongs to, and which face of its mesh it is. */
uint32_t view_leaf(const struct prim_level *, uint32_t id, uint32_t *face);

LANED double size_of(vec p)
{
	return fabs(p.x) + fabs(p.y) + fabs(p.z);
}

/* Of a normal number: about 1 / x, with no rounding in products. */
LANED double near_inverse(double x)
{
	uint64_t bits;

	memcpy(&bits, &x, sizeof(bits));
	bits = ((uint64_t)2046 << 52) - (bits & (uint64_t)0x7ff << 52);
	memcpy(&x, &bits, sizeof(x));
	return x;
}

/* The same primitives, asked by brute force at every level, in this precision. */
enum status geometry_judge(struct geometry **out, const struct geometry *, uint32_t precision, struct pool *,
			   struct diag *);

/* Every primitive, one after the other: what is used when no plugin was chosen. */
extern const ald_accel_plugin accel_brute;

#endif
