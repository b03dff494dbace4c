/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * From the scene's working space to linear light.
 */
#ifndef ALIDADE_FILM_TONE_H
#define ALIDADE_FILM_TONE_H

#include "base/colour.h"

/* assumed_gamma 1: nothing to do; g: the power g (manual 3.4.1.3); 0, no gamma handling at all: the
 * value itself is what an 8-bit file shall hold, so it is decoded along the sRGB curve. */
double tone_linear(double value, double assumed_gamma);

static inline struct rgb tone_linear_rgb(struct rgb c, double assumed_gamma)
{
	if (assumed_gamma == 1)
		return c;
	return rgb_make(tone_linear(c.r, assumed_gamma), tone_linear(c.g, assumed_gamma),
			tone_linear(c.b, assumed_gamma));
}

#endif
