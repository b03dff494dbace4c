/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Other people's ray tracers, raced by tests/bench/rays.c. Turning a batch of Alidade's rays into theirs, and
 * their hits into Alidade's, is part of the time, as it would be for whoever used them.
 */
#ifndef TESTS_BENCH_PEERS_H
#define TESTS_BENCH_PEERS_H

#include <stdbool.h>

#include "alidade/accel.h"

struct peer;

/* embree1, embree8, embree16: rtcIntersect1, 8, 16; with :isa=avx2, :robust, :high, :low, :splits=N behind (N: times
 * as many references at most; Embree's own limit, which is 1.2, counts in :high). seconds: what building took. */
bool peer_is(const char *name);
struct peer *peer_open(const char *name, const ald_prims *, uint32_t threads, double *seconds); /* or exits */
double peer_bytes(const struct peer *); /* of the tree */
void peer_close(struct peer *);
/* hidden: NULL for nearest hits. */
void peer_fire(struct peer *, const ald_ray *, ald_hit *, uint8_t *hidden, uint32_t n, uint32_t hints);

#endif
