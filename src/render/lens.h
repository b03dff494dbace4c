/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Focal blur: a sample of the picture as the mean of many rays through the lens.
 */
#ifndef ALIDADE_RENDER_LENS_H
#define ALIDADE_RENDER_LENS_H

#include "render/wave.h"

/* As wave_trace(), for cameras with a lens. */
bool lens_trace(struct worker *w, uint32_t first, uint32_t n);

/* From the square 0 .. 1 to the disc of radius 1, keeping areas in proportion (Shirley and Chiu, 1997). */
void lens_disc(double a, double b, double *x, double *y);

#endif
