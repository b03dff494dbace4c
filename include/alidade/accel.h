/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * alidade/accel.h - all that an accelerator plugin and the renderer (the host) know of each other.
 * The rules R1 to R7 that every plugin keeps, and worked examples, are in alidade-accel(3).
 *
 * Tags: [setup] one call at a time; [render] any thread, no locks, no allocation, writes only to its
 * query and hit; [any] any thread, reads only.
 */
#ifndef ALIDADE_ACCEL_H
#define ALIDADE_ACCEL_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ALD_ACCEL_ABI 1u /* raised by an incompatible change only; additions go at struct ends */
#define ALD_NONE UINT32_MAX /* no primitive */

typedef struct {
	double x, y, z;
} ald_vec;
typedef struct {
	ald_vec lo, hi; /* closed, finite, lo <= hi */
} ald_box;
typedef struct ald_accel ald_accel; /* the plugin's own structure, built once, then read-only */

/* Rays and hits travel in arrays, so these two never change size within an ABI; reserved is zero. */
typedef struct {
	ald_vec org, dir; /* dir has any length; t counts in units of it, so transforms keep t */
	double tmin, tmax; /* a hit counts if (tmin, after) < (t, id) and t <= tmax */
	uint32_t mask; /* sees primitives whose mask shares a bit */
	uint32_t skip; /* never hits this id (the planar primitive it starts on), or ALD_NONE */
	uint32_t after, after_sub[2]; /* next-hit walk: (id, place in it) seen at tmin, or ALD_NONE */
	uint32_t reserved[3];
} ald_ray;

typedef struct {
	double t, u, v; /* in: t = ray->tmax; out: distance and place on the surface */
	uint32_t prim, part; /* in: ALD_NONE; out: who was hit, which piece of it */
	uint32_t sub[2]; /* the primitive's own notes: an instance keeps the inner prim and part here */
} ald_hit;

/* What the host knows of a batch; hints only. */
enum { ALD_COHERENT = 1, ALD_ONE_ORIGIN = 2, ALD_SORTED = 4 };

/* The one list of counters; the host's reports are made from it. A volume hit is useful if the ray
 * then hit a primitive inside that volume. Counting per ray (heat maps) uses intersect(), one ray a
 * call. */
enum {
	ALD_COUNT_NODES, /* inner nodes or cells visited */
	ALD_COUNT_PRIMS, /* ray/primitive intersection tests */
	ALD_COUNT_REPEATS, /* of these, repeats of a primitive already tested for the same ray */
	ALD_COUNT_VOLUME_TESTS, /* ray/bounding-volume tests */
	ALD_COUNT_VOLUME_HITS,
	ALD_COUNT_VOLUME_USEFUL,
	ALD_COUNT_MAX = 16
};

typedef struct { /* one per render thread and instance level, owned by the host, never shared */
	void *scratch; /* scratch_size() bytes, 64-aligned, zeroed once (mailboxes, stacks) */
	uint64_t *count; /* [ALD_COUNT_MAX] to add to, or NULL: do not count */
	uint32_t thread; /* 0 .. host->threads - 1 */
} ald_query;

enum { ALD_PRECISION_DEFAULT = 1, ALD_PRECISION_EXACT = 2, ALD_PRECISION_FAST = 4 };

typedef struct ald_prims ald_prims;
struct ald_prims { /* what to accelerate; owned by the host, outlives the ald_accel */
	uint32_t size, count; /* sizeof(ald_prims) in the host; ids are 0 .. count-1, none is infinite */
	uint32_t precision; /* the one wanted; EXACT: make the frame with ald_frame_for() */
	double pad; /* bounds() has grown its boxes by this (R4); volumes not made from them must too */
	void (*bounds)(const ald_prims *, uint32_t id, ald_box *out); /* [any] */
	/* If id is hit, counts, and wins by ald_wins(), store it in *hit and return 1; else touch
	 * nothing. While the host waits for occluded() or occluded_n(), any hit will do, and of one inside an
	 * instance only prim is stored. [render] */
	int (*intersect)(const ald_prims *, uint32_t id, ald_query *, const ald_ray *, ald_hit *);
	/* The same for the rays i of a batch with live[i] set; instances go down with the batch.
	 * [render] */
	void (*intersect_n)(const ald_prims *, uint32_t id, ald_query *, const ald_ray *, ald_hit *,
			    const uint8_t *live, uint32_t n);
	const uint32_t *mask; /* [count], or NULL: every primitive has all bits */
	uint32_t group_count; /* ids of one object stand together: group g is */
	const uint32_t *group_first; /* [group_count + 1] group_first[g] .. group_first[g+1]-1 */
	uint32_t tri_count; /* ids below this are triangles, for <alidade/kernel.h>: */
	int vertex_double; /* vertex holds double xyz (1) or float xyz (0), converted exactly */
	const ald_vec *origin; /* [group_count] to be added to a group's vertices, or NULL */
	const uint32_t *index; /* [3 * tri_count] */
	const void *vertex;
	/* Beyond an older host's size: there is none. */
	ald_box box; /* around all that bounds() gives; lo > hi: of no primitives, or not known */
};

/* Services, valid until the last destroy() returns; all but log and account in [setup] only. */
typedef struct {
	uint32_t abi, size; /* ALD_ACCEL_ABI and sizeof(ald_host) in the host */
	void *ctx; /* first argument of each function below */
	uint32_t threads; /* render threads there will be */
	/* 64-aligned, accounted under what; NULL: over the budget or out of memory */
	void *(*alloc)(void *ctx, size_t bytes, const char *what);
	void (*free)(void *ctx, void *p); /* p may be NULL */
	/* Run job(arg, 0..n-1) on the host's pool and wait. Not nested; the result must not depend
	 * on the order. */
	void (*parallel)(void *ctx, uint32_t n, void (*job)(void *arg, uint32_t i), void *arg);
	int (*progress)(void *ctx, double done); /* 0..1; non-zero: return ALD_CANCELLED soon */
	/* [any] level: 0 error, 1 warning, 2 info, 3 debug */
	void (*log)(void *ctx, int level, const char *text);
	/* Beyond an older host's size: there is none. Memory that a library of the plugin's takes, or below 0
	 * gives back, accounted under what; 0: over the budget, it should be given back. [any] */
	int (*account)(void *ctx, int64_t bytes, const char *what);
	/* Beyond an older host's size: 0. About how many rays will be asked of what is built, for choosing how long
	 * to build; 0: not known. What is found may not depend on it. */
	double rays;
	/* Beyond an older host's size, or NULL: there is none. Of p, of alloc(), only the first bytes have been written
	 * and will be used: the rest is not accounted any more. p stays where it is. */
	void (*trim)(void *ctx, void *p, size_t bytes);
} ald_host;

typedef struct { /* bytes of the host's, and of libraries that are accounted */
	uint64_t peak, kept; /* at most at a time while it is built, with what is kept; and from then on */
	uint64_t scratch; /* scratch_size() */
} ald_memory;

enum { ALD_OK, ALD_NO_MEMORY, ALD_BAD_PARAM, ALD_CANCELLED, ALD_UNSUPPORTED, ALD_FAILED };
typedef struct {
	char text[256]; /* the caller's buffer, UTF-8, nothing to free */
} ald_error;

enum { ALD_BOOL, ALD_INT, ALD_REAL, ALD_CHOICE };
typedef struct {
	const char *name, *help; /* "leaf-size"; one line, with the unit */
	int type;
	double def, min, max; /* inclusive and finite; ints are exact to 2^53; a choice is an index */
	const char *const *label; /* ALD_CHOICE: names, NULL-terminated; else NULL */
} ald_param;

enum { ALD_VOLUME_BOX, ALD_VOLUME_SPHERE };
typedef struct { /* one bounding volume, for overlays and for checking containment */
	int kind;
	uint32_t depth, prims; /* root is 0; prims > 0: a leaf holding as many */
	ald_box box; /* sphere: lo is the centre, hi.x the radius */
} ald_volume;
typedef int ald_visit(void *arg, const ald_volume *); /* 1: children too, 0: skip them, -1: stop */

typedef struct {
	uint32_t abi, size; /* ALD_ACCEL_ABI and sizeof(ald_accel_plugin); read before anything else */
	const char *name, *version, *license, *summary; /* name = file name less .so: [a-z][a-z0-9-]* */
	const ald_param *params; /* ends with a NULL name; NULL: none */
	uint32_t precisions; /* ALD_PRECISION_* it can serve */

	/* Required. */
	/* value[i] of params[i], in range [setup] */
	int (*build)(const ald_host *, const ald_prims *, const double *value, ald_accel **out,
		     ald_error *);
	int (*intersect)(const ald_accel *, ald_query *, const ald_ray *, ald_hit *); /* [render] */
	void (*destroy)(ald_accel *); /* [setup] */

	/* Optional: NULL, or beyond an older plugin's size, means what is said last. */
	size_t (*scratch_size)(const ald_accel *); /* [setup] 0 */
	int (*occluded)(const ald_accel *, ald_query *, const ald_ray *); /* [render] intersect */
	void (*intersect_n)(const ald_accel *, ald_query *, const ald_ray *, ald_hit *, uint32_t n,
			    uint32_t hints); /* [render] a loop */
	void (*occluded_n)(const ald_accel *, ald_query *, const ald_ray *, uint8_t *, uint32_t n,
			   uint32_t hints); /* [render] a loop */
	/* [setup] The ald_prims of build() have become others in place: count, tri_count, group_count, group_first and
	 * precision are equal, all else may differ, arrays may stand elsewhere, and so may host->rays. ALD_OK: from now
	 * on it answers for them. Else it is destroyed, and only that; after ALD_CANCELLED nothing is built, otherwise
	 * it is built anew. ALD_UNSUPPORTED: that would be better, or is needed. NULL: always built anew. */
	int (*refit)(ald_accel *, ald_error *);
	/* [any] 0 at the end; none */
	int (*stat)(const ald_accel *, uint32_t i, const char **name, double *value);
	int (*walk)(const ald_accel *, const ald_ray *only, ald_visit *, void *arg); /* [any] only:
									those it opens; none */
	const void *(*extension)(const char *id); /* "org.example.thing/1" to a struct; NULL */
	uint32_t inexact; /* bit i: with params[i] other than its default, R1 and R2 do not hold; 0 */
	/* [setup] What build() is going to take, to within a tenth, in a hundredth of its time: look at a sample.
	 * Takes little itself. Other than ALD_OK: it can't be told; that */
	int (*predict)(const ald_host *, const ald_prims *, const double *value, ald_memory *out);
} ald_accel_plugin;

/* The order that makes all accelerators agree: nearer first, then the smaller id (R2). */
static inline int ald_wins(double t, uint32_t id, const ald_hit *h)
{
	return t < h->t || (t == h->t && id < h->prim);
}

#ifdef ALD_ACCEL_BUILTIN /* the same source linked into the host: -DALD_ACCEL_BUILTIN=ald_accel_none */
#define ald_accel_entry ALD_ACCEL_BUILTIN
#endif
#ifdef __GNUC__
__attribute__((visibility("default")))
#endif
extern const ald_accel_plugin ald_accel_entry; /* the one symbol a plugin exports */

#ifdef __cplusplus
}
#endif
#endif
