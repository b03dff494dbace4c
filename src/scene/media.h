/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What fills space: media that absorb, emit and scatter light (POV-Ray's manual 3.4.8.2).
 */
#ifndef ALIDADE_SCENE_MEDIA_H
#define ALIDADE_SCENE_MEDIA_H

#include "scene/texture.h"

enum media_scattering { /* by POV-Ray's numbers */
	MEDIA_ISOTROPIC = 1,
	MEDIA_MIE_HAZY = 2,
	MEDIA_MIE_MURKY = 3,
	MEDIA_RAYLEIGH = 4,
	MEDIA_HENYEY_GREENSTEIN = 5
};

/* Colours are per unit of length; how they are sampled is part of the scene, as POV-Ray's pictures
 * depend on it. */
struct media {
	struct rgb absorption, emission, scattering;
	enum media_scattering phase;
	double extinction; /* of what is scattered, how much is lost on the way */
	double eccentricity;
	uint32_t method; /* 1: at random, 2: evenly, 3: finer where neighbours differ */
	uint32_t intervals, samples_min, samples_max; /* at least 1 */
	uint32_t aa_level;
	double aa_threshold, jitter;
	double ratio; /* share of the intervals for what is lit */
	uint32_t density_count;
	struct pigment *density; /* their product scales all; none: 1 */
	struct xform *place; /* density to world; NULL: the same */
};

struct media media_default(int version); /* 370 for 3.7 */

#endif
