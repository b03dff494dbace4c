/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The radiosity blocks of global_settings and of objects (manual 3.4.4.3). Which values are refused was
 * tried with POV-Ray.
 */
#include <config.h>

#include "read/pov/items.h"

#define RECURSION_MAX 20
#define NEAREST_MAX 20
#define COUNT_MAX 1e9

/* A number above 0 and at most most, for the keyword that is the current token. */
static double read_within(struct pov *p, double most)
{
	const char *what = keyword_text(pov_token(p));
	struct diag_pos at;
	double x;

	pov_next(p);
	at = pov_here(p);
	x = pov_finite_float(p, what);
	if (!pov_failed(p) && (x <= 0 || x > most)) {
		if (most < COUNT_MAX)
			pov_fail_at(p, &at, "radiosity's %s is %g, but has to be above 0 and at most %g", what,
				    x, most);
		else
			pov_fail_at(p, &at, "radiosity's %s is %g, but has to be above 0", what, x);
		return 1;
	}
	return x;
}

static uint32_t read_count(struct pov *p, double most)
{
	const char *what = keyword_text(pov_token(p));
	struct diag_pos at;
	double x;

	pov_next(p);
	at = pov_here(p);
	x = pov_finite_float(p, what);
	if (!pov_failed(p) && (x < 1 || x > most)) {
		pov_fail_at(p, &at, "radiosity's %s is %g, but has to be from 1 to %g", what, x, most);
		return 1;
	}
	/* A second value tells POV-Ray how to look for directions or samples. */
	if (pov_token(p) == TOK_COMMA) {
		pov_next(p);
		pov_finite_float(p, what);
	}
	return pov_failed(p) ? 1 : (uint32_t)x;
}

/* A cache of samples on disk: light is found anew instead, which changes nothing but time. */
static void read_file(struct pov *p)
{
	pov_next(p);
	pov_string(p);
}

static bool read_light_word(struct pov *p, struct radiosity *r)
{
	struct diag_pos at;

	switch (pov_token(p)) {
	case TOK_RECURSION_LIMIT:
		r->recursion_limit = read_count(p, RECURSION_MAX);
		return true;
	case TOK_BRIGHTNESS:
		r->brightness = read_within(p, HUGE_VAL);
		return true;
	case TOK_GRAY_THRESHOLD:
		pov_next(p);
		at = pov_here(p);
		r->gray_threshold = pov_finite_float(p, "gray_threshold");
		if (r->gray_threshold < 0 || r->gray_threshold > 1)
			pov_fail_at(p, &at, "radiosity's gray_threshold is %g, but has to be from 0 to 1",
				    r->gray_threshold);
		return true;
	case TOK_ADC_BAILOUT:
		r->adc_bailout = read_within(p, HUGE_VAL);
		return true;
	case TOK_MAX_SAMPLE:
		pov_next(p);
		r->max_sample = pov_finite_float(p, "max_sample");
		return true;
	case TOK_NORMAL:
		pov_next(p);
		r->normal = pov_bool(p, true);
		return true;
	case TOK_MEDIA:
		pov_next(p);
		r->media = pov_bool(p, true);
		return true;
	case TOK_SUBSURFACE:
		pov_next(p);
		r->subsurface = pov_bool(p, true);
		return true;
	default:
		return false;
	}
}

static bool read_cache_word(struct pov *p, struct radiosity *r)
{
	switch (pov_token(p)) {
	case TOK_COUNT:
		r->count = read_count(p, COUNT_MAX);
		return true;
	case TOK_NEAREST_COUNT:
		r->nearest_count = read_count(p, NEAREST_MAX);
		return true;
	case TOK_ERROR_BOUND:
		r->error_bound = read_within(p, HUGE_VAL);
		return true;
	case TOK_LOW_ERROR_FACTOR:
		r->low_error_factor = read_within(p, HUGE_VAL);
		return true;
	case TOK_MINIMUM_REUSE:
		pov_next(p);
		r->minimum_reuse = pov_finite_float(p, "minimum_reuse");
		return true;
	case TOK_MAXIMUM_REUSE:
		pov_next(p);
		r->maximum_reuse = pov_finite_float(p, "maximum_reuse");
		return true;
	case TOK_PRETRACE_START:
		r->pretrace_start = read_within(p, 1);
		return true;
	case TOK_PRETRACE_END:
		r->pretrace_end = read_within(p, 1);
		return true;
	case TOK_ALWAYS_SAMPLE:
		pov_next(p);
		r->always_sample = pov_bool(p, true);
		return true;
	case TOK_LOAD_FILE:
	case TOK_SAVE_FILE:
		read_file(p);
		return true;
	default:
		return false;
	}
}

void pov_read_radiosity(struct pov *p)
{
	struct radiosity *r = &pov_scene(p)->radiosity;

	if (!pov_open(p))
		return;
	r->given = true;
	while (!pov_failed(p) && (read_light_word(p, r) || read_cache_word(p, r)))
		;
	pov_close(p, "radiosity");
}

/* How many of a sample's rays an object is worth decides their noise in POV-Ray, not their mean. */
void pov_read_importance(struct pov *p)
{
	if (!pov_open(p))
		return;
	while (!pov_failed(p) && pov_token(p) == TOK_IMPORTANCE)
		read_within(p, 1);
	pov_close(p, "radiosity");
}
