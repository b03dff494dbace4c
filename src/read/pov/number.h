/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Decimal numbers: correctly rounded whatever the locale, as strtod() in the C locale.
 */
#ifndef ALIDADE_READ_POV_NUMBER_H
#define ALIDADE_READ_POV_NUMBER_H

#include <stddef.h>

/* Reads digits[.digits][e[+-]digits] or .digits... from at, without a sign, not beyond end. Returns
 * what follows it, or NULL if there is no number at at. A number too large for a double gives infinity,
 * which the caller reports. */
const char *number_parse(const char *at, const char *end, double *out);

/* printf's %f: value with that many digits after the point (negative: 6), at least width wide, filled
 * with zeros if width is negative, whatever the locale. Returns the length, as snprintf does. */
int number_print(char *out, size_t size, int width, int digits, double value);

#endif
