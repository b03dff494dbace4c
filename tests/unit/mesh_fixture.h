/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Closed meshes with whole coordinates, and an oracle for them in whole numbers.
 */
#ifndef ALIDADE_TESTS_MESH_FIXTURE_H
#define ALIDADE_TESTS_MESH_FIXTURE_H

#include "world_fixture.h"

enum { SHELL_VERTICES = 4096, SHELL_TRIANGLES = 8192 };

struct shell {
	uint32_t vertices, triangles;
	vec v[SHELL_VERTICES];
	uint32_t t[SHELL_TRIANGLES][3];
};

/* A sphere of n rings by 2 n segments about the origin, its radius varied by bump; poles of valence 2 n.
 * Coordinates are whole numbers of at most size (1 + bump). */
static inline void shell_sphere(struct shell *s, uint32_t n, double size, double bump, uint64_t *seed)
{
	uint32_t m = 2 * n;

	s->vertices = s->triangles = 0;
	for (uint32_t i = 0; i <= n; i++) {
		for (uint32_t k = 0; k < (i == 0 || i == n ? 1 : m); k++) {
			double a = 3.14159265358979323846 * i / n, b = 2 * 3.14159265358979323846 * k / m;
			double r = size * (1 + bump * signed_uniform(seed));

			s->v[s->vertices++] = vec_make(rint(r * sin(a) * cos(b)), rint(r * cos(a)),
						       rint(r * sin(a) * sin(b)));
		}
	}
	for (uint32_t i = 0; i < n; i++) {
		uint32_t up = i ? 1 + (i - 1) * m : 0, down = 1 + i * m;

		for (uint32_t k = 0; k < m; k++) {
			uint32_t l = (k + 1) % m;
			uint32_t a = i ? up + k : 0, b = i ? up + l : 0;
			uint32_t c = i < n - 1 ? down + k : down, d = i < n - 1 ? down + l : down;

			if (i < n - 1) {
				uint32_t *t = s->t[s->triangles++];

				t[0] = a, t[1] = c, t[2] = d;
			}
			if (i) {
				uint32_t *t = s->t[s->triangles++];

				t[0] = a, t[1] = d, t[2] = b;
			}
		}
	}
}

static inline void shell_corners(const struct shell *s, uint32_t i, vec v[3])
{
	for (unsigned k = 0; k < 3; k++)
		v[k] = s->v[s->t[i][k]];
}

typedef __int128 big;

/* d . (b x c) for whole numbers up to 2^40: exact. */
static inline big volume(vec d, vec b, vec c)
{
	return (big)d.x * ((big)b.y * (big)c.z - (big)b.z * (big)c.y) +
	       (big)d.y * ((big)b.z * (big)c.x - (big)b.x * (big)c.z) +
	       (big)d.z * ((big)b.x * (big)c.y - (big)b.y * (big)c.x);
}

/* Does the line o + t d meet the closed triangle? *t, correctly rounded but for the last bits. */
static inline int oracle(vec o, vec d, const vec v[3], double *t)
{
	vec a = vec_sub(v[0], o), b = vec_sub(v[1], o), c = vec_sub(v[2], o);
	big wa = volume(d, b, c), wb = volume(d, c, a), wc = volume(d, a, b), all = wa + wb + wc;

	if (!all || ((wa < 0 || wb < 0 || wc < 0) && (wa > 0 || wb > 0 || wc > 0)))
		return 0;
	*t = (double)((long double)volume(a, b, c) / (long double)all);
	return 1;
}

#endif
