/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What may follow a pattern (manual 3.4.7.5), in any order: its own parameters, maps, waves, turbulence,
 * warps and transforms.
 */
#include <config.h>

#include "read/pov/pattern.h"
#include "base/single.h"

static bool transform_word(struct pov *p, struct pattern_draft *d)
{
	struct xform x = xform_identity;
	bool any = false;

	while (pov_transform(p, &x))
		any = true;
	if (any && d->given && !pov_failed(p))
		pattern_move(p, &d->pattern, &x);
	return any;
}

static double count_octaves(double n)
{
	return n < 1 ? 1 : n > 10 ? 10 : trunc(n);
}

bool turbulence_word(struct pov *p, const struct turbulence_words *t)
{
	switch (pov_token(p)) {
	case TOK_TURBULENCE:
		pov_next(p);
		*t->amount = pov_finite_vector(p, "turbulence");
		return true;
	case TOK_OCTAVES:
		pov_next(p);
		*t->octaves = (uint32_t)count_octaves(pov_finite_float(p, "octaves"));
		return true;
	case TOK_LAMBDA:
		pov_next(p);
		*t->lambda = pov_finite_float(p, "lambda");
		return true;
	case TOK_OMEGA:
		pov_next(p);
		*t->omega = pov_finite_float(p, "omega");
		return true;
	default:
		return false;
	}
}

static bool wave_word(struct pov *p, struct pattern *q)
{
	switch (pov_token(p)) {
	case TOK_RAMP_WAVE:
		q->wave = WAVE_RAMP;
		break;
	case TOK_SINE_WAVE:
		q->wave = WAVE_SINE;
		break;
	case TOK_TRIANGLE_WAVE:
		q->wave = WAVE_TRIANGLE;
		break;
	case TOK_SCALLOP_WAVE:
		q->wave = WAVE_SCALLOP;
		break;
	case TOK_CUBIC_WAVE:
		q->wave = WAVE_CUBIC;
		break;
	case TOK_POLY_WAVE:
		q->wave = WAVE_POLY;
		pov_next(p);
		if (pov_starts_number(p))
			q->exponent = pov_finite_float(p, "poly_wave's exponent");
		return true;
	case TOK_FREQUENCY:
		pov_next(p);
		q->frequency = as_single(pov_finite_float(p, "frequency")); /* as POV-Ray keeps it */
		return true;
	case TOK_PHASE:
		pov_next(p);
		q->phase = as_single(pov_finite_float(p, "phase"));
		return true;
	default:
		return false;
	}
	pov_next(p);
	return true;
}

static bool wrong_pattern(struct pov *p, const char *word)
{
	pov_fail(p, "%s does not belong to this pattern", word);
	return true;
}

/* A parameter of one kind of pattern: *x is changed if it is that kind. */
static bool number_word(struct pov *p, const struct pattern_draft *d, enum pattern_kind kind, double *x)
{
	const char *text = keyword_text(pov_token(p));

	if (!d->given || d->pattern.kind != kind)
		return wrong_pattern(p, text);
	pov_next(p);
	*x = pov_finite_float(p, text);
	return true;
}

static bool brick_word(struct pov *p, struct pattern_draft *d)
{
	struct pattern *q = &d->pattern;

	if (pov_token(p) == TOK_MORTAR) {
		number_word(p, d, PATTERN_BRICK, &q->of.brick.mortar);
		q->of.brick.mortar = pattern_mortar(q->of.brick.mortar);
		return true;
	}
	if (!d->given || q->kind != PATTERN_BRICK)
		return wrong_pattern(p, "brick_size");
	pov_next(p);
	q->of.brick.size = pov_finite_vector(p, "brick_size");
	return true;
}

/* Whole numbers of pavement; it counts in bytes. */
static bool pavement_word(struct pov *p, struct pattern_draft *d, uint32_t *x)
{
	double value = 0;

	if (!number_word(p, d, PATTERN_PAVEMENT, &value))
		return false;
	*x = value > 0 && value < 256 ? (uint32_t)value : 255;
	return true;
}

static bool crackle_word(struct pov *p, struct pattern_draft *d)
{
	struct pattern *q = &d->pattern;

	if (pov_token(p) == TOK_FORM && d->given && q->kind == PATTERN_PAVEMENT)
		return pavement_word(p, d, &q->of.pavement.form);
	if (!d->given || q->kind != PATTERN_CRACKLE)
		return wrong_pattern(p, keyword_text(pov_token(p)));
	if (pov_accept(p, TOK_SOLID))
		q->of.crackle.solid = true;
	else if (pov_accept(p, TOK_FORM))
		q->of.crackle.form = pov_finite_vector(p, "form");
	else if (pov_accept(p, TOK_OFFSET))
		q->of.crackle.offset = pov_finite_float(p, "offset");
	return true;
}

static bool metric_word(struct pov *p, struct pattern_draft *d)
{
	struct pattern *q = &d->pattern;
	double x;

	if (!d->given || (q->kind != PATTERN_CRACKLE && q->kind != PATTERN_FACETS))
		return wrong_pattern(p, "metric");
	pov_next(p);
	x = pov_finite_vector(p, "metric").x; /* a vector in older scenes */
	if (q->kind == PATTERN_CRACKLE)
		q->of.crackle.metric = x;
	else
		q->of.facets.metric = x;
	return true;
}

/* exterior and interior: how a fractal's value is found, and a factor. */
static bool fractal_word(struct pov *p, struct pattern_draft *d)
{
	struct pattern *q = &d->pattern;
	bool exterior = pov_token(p) == TOK_EXTERIOR;
	struct diag_pos at;
	double type, factor;

	if (d->given && q->kind == PATTERN_PAVEMENT)
		return pavement_word(p, d, exterior ? &q->of.pavement.exterior : &q->of.pavement.interior);
	if (!d->given || q->kind != PATTERN_FRACTAL)
		return wrong_pattern(p, exterior ? "exterior" : "interior");
	pov_next(p);
	at = pov_here(p);
	type = trunc(pov_float(p));
	pov_comma(p);
	factor = pov_finite_float(p, "the factor");
	if (pov_failed(p))
		return true;
	if (!(type >= 0 && type <= (exterior ? 8 : 6))) {
		pov_fail_at(p, &at, "there is no %s type %g", exterior ? "exterior" : "interior", type);
	} else if (exterior) {
		q->of.fractal.exterior = (uint32_t)type;
		q->of.fractal.exterior_factor = factor;
	} else {
		q->of.fractal.interior = (uint32_t)type;
		q->of.fractal.interior_factor = factor;
	}
	return true;
}

static bool exponent_word(struct pov *p, struct pattern_draft *d)
{
	struct pattern *q = &d->pattern;
	double n = 2;

	if (d->given && q->kind == PATTERN_FRACTAL && q->of.fractal.magnet)
		return wrong_pattern(p, "exponent");
	number_word(p, d, PATTERN_FRACTAL, &n);
	n = trunc(n);
	/* As in POV-Ray, which warns. */
	q->of.fractal.exponent = n >= 2 && n <= 33 ? (uint32_t)n : 2;
	return true;
}

static bool parameter_word(struct pov *p, struct pattern_draft *d)
{
	struct pattern *q = &d->pattern;

	switch (pov_token(p)) {
	case TOK_AGATE_TURB:
		return number_word(p, d, PATTERN_AGATE, &q->of.agate_turb);
	case TOK_CONTROL0:
		return number_word(p, d, PATTERN_QUILTED, &q->of.quilted.control0);
	case TOK_CONTROL1:
		return number_word(p, d, PATTERN_QUILTED, &q->of.quilted.control1);
	case TOK_COORDS:
		return number_word(p, d, PATTERN_FACETS, &q->of.facets.coords);
	case TOK_SIZE:
		return number_word(p, d, PATTERN_FACETS, &q->of.facets.size);
	case TOK_BRICK_SIZE:
	case TOK_MORTAR:
		return brick_word(p, d);
	case TOK_SOLID:
	case TOK_FORM:
	case TOK_OFFSET:
		return crackle_word(p, d);
	case TOK_METRIC:
		return metric_word(p, d);
	case TOK_EXTERIOR:
	case TOK_INTERIOR:
		return fractal_word(p, d);
	case TOK_EXPONENT:
		return exponent_word(p, d);
	case TOK_NUMBER_OF_SIDES:
		return pavement_word(p, d, &q->of.pavement.sides);
	case TOK_NUMBER_OF_TILES:
		return pavement_word(p, d, &q->of.pavement.tiles);
	case TOK_PATTERN:
		return pavement_word(p, d, &q->of.pavement.number);
	case TOK_NOISE_GENERATOR:
		pov_next(p);
		q->noise = pov_noise_generator(p);
		return true;
	default:
		return false;
	}
}

static bool normal_word(struct pov *p, struct pattern_draft *d)
{
	switch (pov_token(p)) {
	case TOK_ACCURACY:
		pov_next(p);
		d->accuracy = pov_finite_float(p, "accuracy");
		return true;
	case TOK_BUMP_SIZE:
		pov_next(p);
		d->amount = pov_finite_float(p, "bump_size");
		return true;
	case TOK_NO_BUMP_SCALE:
		pov_next(p);
		d->no_bump_scale = true;
		return true;
	default:
		return false;
	}
}

static bool map_fits(struct pov *p, const struct pattern_draft *d)
{
	enum pov_token_kind t = pov_token(p);
	bool block = d->given && (d->pattern.kind < PATTERN_AVERAGE || d->pattern.kind == PATTERN_IMAGE_MAP ||
				  d->pattern.kind == PATTERN_BUMP_MAP);
	unsigned use = t == TOK_COLOUR_MAP  ? IN_PIGMENT | IN_DENSITY :
		       t == TOK_PIGMENT_MAP ? IN_PIGMENT :
		       t == TOK_DENSITY_MAP ? IN_DENSITY :
		       t == TOK_TEXTURE_MAP ? IN_TEXTURE :
					      IN_NORMAL;

	if (!(use & d->use))
		pov_fail(p, "%s does not belong into this block", keyword_text(t));
	else if (block || (t == TOK_COLOUR_MAP && d->given && d->pattern.kind == PATTERN_AVERAGE))
		pov_fail(p, "%s does not belong to this pattern", keyword_text(t));
	return !pov_failed(p);
}

/* The pattern itself may be deeper than its map: a pigment_pattern, a function. */
static void keep_map(struct pattern_draft *d, const struct pov_map *m)
{
	uint32_t depth = d->map.depth;

	d->map = *m;
	if (d->map.depth < depth)
		d->map.depth = depth;
}

static bool map_word(struct pov *p, struct pattern_draft *d)
{
	struct pov_map *m;

	switch (pov_token(p)) {
	case TOK_COLOUR_MAP:
	case TOK_PIGMENT_MAP:
	case TOK_DENSITY_MAP:
	case TOK_NORMAL_MAP:
	case TOK_TEXTURE_MAP:
	case TOK_SLOPE_MAP:
		break;
	default:
		return false;
	}
	if (!map_fits(p, d))
		return true;
	m = pov_read_map(p, d->average);
	if (m)
		keep_map(d, m);
	return true;
}

void pattern_modifiers(struct pov *p, struct pattern_draft *d)
{
	struct pattern *q = &d->pattern;
	const struct turbulence_words t = { &q->turbulence.amount, &q->turbulence.octaves,
					    &q->turbulence.lambda, &q->turbulence.omega };

	while (!pov_failed(p)) {
		if (transform_word(p, d) || map_word(p, d) || turbulence_word(p, &t) ||
		    wave_word(p, q) || parameter_word(p, d) ||
		    (d->use == IN_NORMAL && normal_word(p, d)))
			continue;
		if (pov_token(p) == TOK_WARP)
			pattern_warp_read(p, d);
		else if (pov_accept(p, TOK_QUICK_COLOUR))
			pov_finite_colour(p, "quick_color"); /* for previews only */
		else
			return;
	}
}
