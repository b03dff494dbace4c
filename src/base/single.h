/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A number as single precision keeps it. Not (double)(float)x, which gcc 12 takes to be x where it vectorises.
 */
#ifndef ALIDADE_BASE_SINGLE_H
#define ALIDADE_BASE_SINGLE_H

static inline double as_single(double x)
{
	volatile float f = (float)x;

	return (double)f;
}

#endif
