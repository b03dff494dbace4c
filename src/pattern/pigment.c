/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pigments: a colour, or a pattern's value led through a map (manual 3.4.6.1).
 */
#include "pattern/pattern.h"

struct rgbft pigment_at(const struct scene *s, const struct pigment *pigment,
			const struct pattern_point *at)
{
	(void)s;
	(void)at;
	return pigment->colour;
}
