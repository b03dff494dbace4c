/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Light that is scattered many times below a surface, as a pair of sources there: the dipole of Jensen, Marschner,
 * Levoy and Hanrahan, A Practical Model for Subsurface Light Transport (2001), with the albedo found from the
 * surface's colour as in Jensen and Buhler, A Rapid Hierarchical Rendering Technique (2002). Lengths are in
 * millimetres. As everywhere in POV-Ray, a factor of pi is the lamps'.
 */
#ifndef ALIDADE_SHADE_POV_DIPOLE_H
#define ALIDADE_SHADE_POV_DIPOLE_H

#include "base/vec.h"

/* Of one colour. */
struct dipole {
	double albedo; /* reduced; 0: black, and nothing else counts */
	double scatter, absorb, extinct; /* reduced coefficients: what happens on one millimetre */
	double decay; /* effective transport coefficient */
	double real, mirrored; /* how far the sources lie below and above the surface */
};

/* The albedo below a surface that reflects so much of even light; ior is the interior's. */
double dipole_albedo(double reflectance, double ior);
/* ior: relative to what is outside. */
struct dipole dipole_make(double translucency, double albedo, double ior);
/* Light that leaves an area of one square millimetre at this squared distance from where it fell in. */
double dipole_profile(const struct dipole *, double distance2);
/* How much light passes the surface at this cosine to its normal. */
double dipole_fresnel(double cosine, double ior);

#endif
