/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * IEEE 754 binary16, which compilers offer on some machines only.
 */
#ifndef ALIDADE_IMAGE_HALF_H
#define ALIDADE_IMAGE_HALF_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#define HALF_MAX 65504.0f

/* Rounded to nearest, ties to even. A finite value beyond the range becomes the greatest finite
 * half: a bright lamp must not turn into an infinity by being saved. NaN stays NaN. */
static inline uint16_t half_from_float(float value)
{
	uint32_t bits, sign, magnitude, mantissa, shift, rest, half;

	if (isfinite(value) && fabsf(value) > HALF_MAX)
		value = copysignf(HALF_MAX, value);
	memcpy(&bits, &value, sizeof(bits));
	sign = bits >> 16 & 0x8000;
	magnitude = bits & 0x7fffffff;
	if (magnitude >= 0x7f800000)
		return (uint16_t)(sign | 0x7c00 | (magnitude > 0x7f800000 ? 0x200 : 0));
	if (magnitude >= 0x38800000) { /* 2^-14: a normal half */
		magnitude += 0xfff + (magnitude >> 13 & 1);
		return (uint16_t)(sign | ((magnitude >> 13) - (112 << 10)));
	}
	if (magnitude < 0x33000000) /* below 2^-25 */
		return (uint16_t)sign;
	mantissa = (magnitude & 0x7fffff) | 0x800000;
	shift = 126 - (magnitude >> 23);
	rest = mantissa & ((1u << shift) - 1);
	half = mantissa >> shift;
	half += rest > 1u << (shift - 1) || (rest == 1u << (shift - 1) && (half & 1));
	return (uint16_t)(sign | half);
}

#endif
