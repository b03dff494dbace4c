/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "shade/pov/spectrum.h"

#include <math.h>

#include "shade/pov/spectrum_table.h"

double spectrum_ior(double ratio, double dispersion, double band)
{
	return ratio * pow(dispersion, 0.5 - band);
}

/* All light from violet up to this share of the spectrum. */
static struct rgb up_to(uint32_t part, uint32_t of)
{
	uint64_t at = (uint64_t)part * SPECTRUM_STEPS;
	uint32_t step = (uint32_t)(at / of);
	double share = (double)(at % of) / of, c[3];

	if (step >= SPECTRUM_STEPS) {
		step = SPECTRUM_STEPS - 1;
		share = 1;
	}
	for (int k = 0; k < 3; k++) {
		double a = spectrum_sum[step][k], b = spectrum_sum[step + 1][k];

		c[k] = (a + share * (b - a)) / SPECTRUM_UNIT;
	}
	return rgb_make(c[0], c[1], c[2]);
}

struct rgb spectrum_colour(uint32_t from, uint32_t to, uint32_t bands)
{
	return rgb_add(up_to(to, bands), rgb_scale(up_to(from, bands), -1));
}
