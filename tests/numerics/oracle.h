/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What a ray really hits: triangles in whole numbers of any size (GMP), without rounding.
 *
 * With a = A - o, b = B - o, c = C - o: wa = d.(b x c), wb = d.(c x a), wc = d.(a x b), S their sum and
 * D = a.(b x c). The line o + t d meets the closed triangle if S is not 0 and no two of the weights have
 * strictly opposite signs; then t = D / S. So a ray in the plane of a triangle misses it, as does any ray
 * a triangle without area. A triangle or a ray with a NaN or an infinity is not there.
 */
#ifndef ALIDADE_TESTS_ORACLE_H
#define ALIDADE_TESTS_ORACLE_H

#include "base/vec.h"

struct soup { /* corners of triangles; they share what is equal */
	uint32_t vertices, triangles, vertex_room, triangle_room;
	vec *vertex;
	uint32_t (*triangle)[3];
};

enum { ORACLE_TIES = 64 };

struct truth {
	bool hit;
	double t; /* of the nearest, within an ulp */
	uint32_t ties; /* triangles hit at exactly this t, at most ORACLE_TIES, rising */
	uint32_t tie[ORACLE_TIES];
};

struct oracle;

struct oracle *oracle_new(const struct soup *); /* which has to outlive it */
void oracle_free(struct oracle *);
/* The nearest t in (tmin, tmax]; skip, mask and after are not looked at. */
void oracle_ask(struct oracle *, const ald_ray *, struct truth *);
/* The same without the sieve, which is held against it: every triangle is looked at in whole numbers. */
void oracle_ask_all(struct oracle *, const ald_ray *, struct truth *);
bool truth_same(const struct truth *, const struct truth *);
/* |t - the truth| / |the truth| of the ray last asked about, which has hit. */
double oracle_error(struct oracle *, double t);
bool truth_has(const struct truth *, uint32_t id);

#endif
