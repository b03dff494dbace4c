/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Other people's ray tracers, raced by rays.c: Embree 3, in all the ways there are to call it. Turning a batch of
 * Alidade's rays into theirs, and their hits into Alidade's, is part of the time, as it would be for whoever used
 * them.
 */
#ifndef TESTS_BENCH_PEERS_H
#define TESTS_BENCH_PEERS_H

#include <stdbool.h>

#include "alidade/accel.h"

enum { PEER_LOW, PEER_MEDIUM, PEER_HIGH };
struct peer_config { /* what a tree is built as */
	const char *isa; /* "avx2"; NULL: Embree's choice */
	bool robust, huge; /* huge: pages */
	int quality;
	uint32_t threads; /* that build */
	double splits; /* references at most, times the triangles, of PEER_HIGH; 0: Embree's own limit, 1.2 */
};

/* Rays of a call: 1, 8, 16; or all 1024 at once, as structs one after another (rtcIntersect1M) or as one struct of
 * arrays (rtcIntersectNp). */
enum { PEER_1 = 1, PEER_8 = 8, PEER_16 = 16, PEER_1M = 100, PEER_NP };
struct peer_way {
	unsigned width;
	int coherent; /* the context's flag: 0 or 1; -1: as the hints say */
};

struct peer;
struct peer_mesh;

bool peer_there(void);
/* In floats; place: many of it, each where the images of three axes and the origin are, which have to live on; NULL:
 * as it is. */
struct peer_mesh *peer_mesh_new(const ald_prims *, uint32_t vertices, const float (*place)[12], uint32_t places);
void peer_mesh_free(struct peer_mesh *);
/* Built; NULL: not on this machine. The mesh has to outlive it. */
struct peer *peer_open(const struct peer_config *, const struct peer_mesh *);
double peer_bytes(const struct peer *); /* of the tree */
double peer_peak(const struct peer *); /* while it was built */
double peer_seconds(const struct peer *); /* of building, by the clock on the wall */
void peer_close(struct peer *);
/* hidden: NULL for nearest hits. n: at most 1024. Hits come with t and prim set to the ray's tmax and ALD_NONE. */
void peer_fire(const struct peer *, struct peer_way, const ald_ray *, ald_hit *, uint8_t *hidden, uint32_t n,
	       uint32_t hints);
/* "embree16:isa=avx2:robust:high:splits=5:low:huge:coherent:incoherent", or embree1, 8, 1M, Np; false: none. */
bool peer_parse(const char *name, struct peer_config *, struct peer_way *);
void peer_name(const struct peer_config *, struct peer_way, char out[96]);

#endif
