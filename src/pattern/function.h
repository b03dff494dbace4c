/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The values of user functions. Like patterns: pure, no allocation, any thread.
 */
#ifndef ALIDADE_PATTERN_FUNCTION_H
#define ALIDADE_PATTERN_FUNCTION_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/function.h"
#include "scene/scene.h"

/* Calls, and turns of sum() and prod(), in one evaluation, at most; where there are more the value is NaN. */
#define FUNCTION_TURNS 10000000u

/* arg: f's params; out: its results. Returns the turns that were made, for whoever keeps an account. */
uint64_t function_eval(const struct scene *, const struct function *, const double *arg,
		       double out[FUNCTION_RESULTS]);
/* The first result at a point: of functions of x, y and z. */
double function_at(const struct scene *, const struct function *, vec p);

/* POV-Ray's internal functions by number: how many arguments they take, x, y and z among them (0: there is
 * none), what functions.inc calls them (or NULL), and whether they are known here too. */
uint32_t internal_params(uint32_t n);
const char *internal_name(uint32_t n);
bool internal_here(uint32_t n);
double internal_eval(const struct scene *, uint32_t n, const double *arg);

/* out: its terms. kind: the spline's own, or another one. */
void spline_eval(const struct spline *, enum spline_kind kind, double at, double out[FUNCTION_RESULTS]);

#endif
