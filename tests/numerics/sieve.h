/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Which triangles a line can meet at all: leaves the oracle few to decide in whole numbers. In doubles, with
 * bounds on their errors: a triangle is only ever left out if the line surely misses it.
 *
 * Everything is seen from a point of reference c near the mesh. With x = X - c and m = (o - c) x d:
 *	the weight of an edge from p to q is d.(p x q) + m.(q - p),
 *	a box is missed if d_i x_j - d_j x_i + m_k has one sign on all of its corners, for some axes i, j, k.
 * m is worked out in whole numbers and rounded once. So no error grows with the way from o to the mesh.
 */
#ifndef ALIDADE_TESTS_SIEVE_H
#define ALIDADE_TESTS_SIEVE_H

#include "oracle.h"

struct sieve;

struct sieve *sieve_new(const struct soup *); /* which has to outlive it */
void sieve_free(struct sieve *);
vec sieve_reference(const struct sieve *); /* c */
/* Into id (room for all triangles), rising: those that are finite and may be met by a line of direction d and
 * moment m, each component of which is off by at most 2^-51 of itself. How many. */
uint32_t sieve_line(const struct sieve *, vec d, vec m, uint32_t *id);

#endif
