/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * POV-Ray's finish block: what a surface makes of light that falls on it (manual 3.4.6.3).
 */
#ifndef ALIDADE_SHADE_POV_FINISH_H
#define ALIDADE_SHADE_POV_FINISH_H

#include "scene/scene.h"

/* How much of what the mirrored ray sees is added. cosine: between the normal and the ray that
 * arrives, both on one side. ior: of the far side relative to the near one, for fresnel. */
struct rgb finish_reflectivity(const struct finish *, double cosine, double ior, struct rgb pigment);

/*
 * A bound on the reflectivity by which the weight of a mirrored ray shrinks. A metal's tint is not in it, as
 * POV-Ray's adc_bailout shows.
 */
double finish_mirror_weight(const struct finish *, double cosine, double ior);

bool finish_is_mirror(const struct finish *);
/* beneath: what would be diffuse goes below the surface instead. */
bool finish_needs_light(const struct finish *, bool beneath);

/* Light of colour light from direction to_light (unit), seen along eye (unit, towards the surface).
 * behind: light from the far side, which only the second value of diffuse takes. */
struct finish_light {
	vec to_light, eye, normal;
	struct rgb light, pigment;
	double opacity;
	double noise; /* 0 to 1, for crand */
	bool behind, highlights, beneath;
};
struct rgb finish_shade(const struct finish *, const struct finish_light *);

/* What a thin film makes of light from direction to_light at p. */
struct rgb finish_irid(const struct scene *, const struct finish *, vec to_light, vec eye, vec normal, vec p);

#endif
