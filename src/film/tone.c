/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "film/tone.h"

#include <math.h>

#include "image/image.h"

double tone_linear(double value, double assumed_gamma)
{
	if (assumed_gamma == 1)
		return value;
	if (assumed_gamma == 0)
		return srgb_decode(value);
	return value < 0 ? -pow(-value, assumed_gamma) : pow(value, assumed_gamma);
}
