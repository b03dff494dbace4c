/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Dispersion (manual 3.4.8.1.5): white light as bands of a spectrum, from violet (0) to red (1). As POV-Ray
 * does it, each band has a ratio of indices and a colour; a ray that was split once stays in its band.
 */
#ifndef ALIDADE_SHADE_POV_SPECTRUM_H
#define ALIDADE_SHADE_POV_SPECTRUM_H

#include <stdint.h>

#include "base/colour.h"

/* The middle of a band. */
static inline double spectrum_band(uint32_t band, uint32_t bands)
{
	return (band + 0.5) / bands;
}

/* The ratio of indices where it is ratio in the middle of the spectrum; dispersion: of the ratio at violet to
 * that at red. */
double spectrum_ior(double ratio, double dispersion, double band);

/* What bands from .. to - 1 are of white light. All of them together are not quite white, as in POV-Ray. */
struct rgb spectrum_colour(uint32_t from, uint32_t to, uint32_t bands);

#endif
