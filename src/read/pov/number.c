/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Most numbers in scene files have few digits: then digits and power of ten are both exact doubles, and
 * one multiplication or division rounds correctly (W. D. Clinger, How to read floating point numbers
 * accurately, 1990). The rest goes to the C library.
 */
#include <config.h>

#include "read/pov/number.h"

#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double power_of_ten[] = { 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11,
				       1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21,
				       1e22 };

static locale_t c_locale; /* written once, see slow_parse() */

static void make_locale(void)
{
	c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
}

static void c_locale_init(void)
{
	static pthread_once_t once = PTHREAD_ONCE_INIT;

	pthread_once(&once, make_locale);
}

static double slow_parse(const char *at, size_t length)
{
	char small[128], *text = small, *heap = NULL;
	double value;

	c_locale_init();
	if (length >= sizeof(small)) {
		heap = malloc(length + 1);
		if (heap)
			text = heap;
		else
			length = sizeof(small) - 1; /* more digits than any double needs to be close */
	}
	memcpy(text, at, length);
	text[length] = 0;
	value = c_locale ? strtod_l(text, NULL, c_locale) : strtod(text, NULL);
	free(heap);
	return value;
}

static inline bool is_digit(const char *p, const char *end)
{
	return p < end && *p >= '0' && *p <= '9';
}

/* The exponent after e, if there is one; *at moves past it. */
static int read_exponent(const char **at, const char *end)
{
	const char *p = *at;
	int exponent = 0;
	bool negative = false;

	if (p >= end || (*p != 'e' && *p != 'E'))
		return 0;
	p++;
	if (p < end && (*p == '+' || *p == '-'))
		negative = *p++ == '-';
	if (!is_digit(p, end))
		return 0; /* the e belongs to what follows */
	for (; is_digit(p, end); p++) {
		if (exponent < 100000)
			exponent = 10 * exponent + (*p - '0');
	}
	*at = p;
	return negative ? -exponent : exponent;
}

const char *number_parse(const char *at, const char *end, double *out)
{
	const char *p = at;
	uint64_t digits = 0;
	int count = 0, exponent = 0; /* count: of digits from the first that is not 0 */
	bool any = false;

	for (; is_digit(p, end); p++) {
		any = true;
		if (count || *p != '0')
			count++;
		if (count <= 19)
			digits = 10 * digits + (uint64_t)(*p - '0');
	}
	if (p < end && *p == '.' && (any || is_digit(p + 1, end))) {
		for (p++; is_digit(p, end); p++) {
			any = true;
			if (count || *p != '0')
				count++;
			if (count <= 19)
				digits = 10 * digits + (uint64_t)(*p - '0');
			exponent--;
		}
	}
	if (!any)
		return NULL;
	exponent += read_exponent(&p, end);
	if (count <= 19 && digits <= UINT64_C(1) << 53 && exponent >= -22 && exponent <= 22)
		*out = exponent < 0 ? (double)digits / power_of_ten[-exponent]
				    : (double)digits * power_of_ten[exponent];
	else
		*out = slow_parse(at, (size_t)(p - at));
	return p;
}

int number_print(char *out, size_t size, int width, int digits, double value)
{
	const char *format = width < 0 ? "%0*.*f" : "%*.*f";
	locale_t old = (locale_t)0;
	int n;

	c_locale_init();
	if (c_locale)
		old = uselocale(c_locale);
	n = snprintf(out, size, format, width < 0 ? -width : width, digits < 0 ? 6 : digits, value);
	if (old)
		uselocale(old);
	return n;
}
