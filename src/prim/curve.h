/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pieces of plane curves, as lathes and prisms are made of.
 */
#ifndef ALIDADE_PRIM_CURVE_H
#define ALIDADE_PRIM_CURVE_H

#include "scene/scene.h"

static inline unsigned curve_degree(enum lathe_kind kind)
{
	return kind == LATHE_LINEAR ? 1 : kind == LATHE_QUADRATIC ? 2 : 3;
}

/* One coordinate of a piece over 0..1 from its up to four points: the polynomial and, exactly, its ends. */
void curve_term(enum lathe_kind, const double p[4], double c[4], double end[2]);

#endif
