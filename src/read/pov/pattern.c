/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Patterns (manual 3.4.7): the words that begin one, and their parameters. Modifiers are in modifier.c.
 *
 * To add a pattern: a row in the table, a reader of its parameters if it has any, and its function in
 * src/pattern. What src/pattern cannot evaluate is read all the same, and reported where it is used.
 */
#include <config.h>

#include "read/pov/pattern.h"

#include "read/pov/function.h"
#include "read/pov/picture.h"

#include <stdio.h>
#include <string.h>

#include "pattern/pattern.h"

static void read_gradient(struct pov *p, struct pattern_draft *d)
{
	struct diag_pos at = pov_here(p);
	vec v = pov_finite_vector(p, "the gradient's direction");
	double length = vec_length(v);

	if (!pov_failed(p) && !(length > 0 && isfinite(length)))
		pov_fail_at(p, &at, "the gradient's direction has no length");
	else
		d->pattern.of.gradient = vec_scale(v, 1 / length);
}

static void read_arms(struct pov *p, struct pattern_draft *d)
{
	struct diag_pos at = pov_here(p);
	double arms = trunc(pov_finite_float(p, "the spiral's number of arms"));

	if (!(arms >= -32768 && arms <= 32767))
		pov_fail_at(p, &at, "a spiral cannot have %g arms", arms);
	else
		d->pattern.of.arms = (int32_t)arms;
}

static void read_checker(struct pov *p, struct pattern_draft *d)
{
	pattern_blocks(p, d, 2);
}

static void read_brick(struct pov *p, struct pattern_draft *d)
{
	pattern_blocks(p, d, 2);
}

static void read_hexagon(struct pov *p, struct pattern_draft *d)
{
	pattern_blocks(p, d, 3);
}

static void read_square(struct pov *p, struct pattern_draft *d)
{
	pattern_blocks(p, d, 4);
}

static void read_triangular(struct pov *p, struct pattern_draft *d)
{
	pattern_blocks(p, d, 6);
}

static void read_pigment_pattern(struct pov *p, struct pattern_draft *d)
{
	struct pov_pigment inner = { .pigment = { .pattern = NULL } };
	struct pigment *made;

	if (!pov_expect(p, TOK_LEFT_BRACE, "after pigment_pattern") || !pov_nest(p))
		return;
	if (!pov_pigment_body(p, &inner) || !pov_close(p, "pigment_pattern"))
		return;
	made = pov_copy(p, &inner.pigment, sizeof(inner.pigment));
	d->pattern.of.pigment = made;
	d->pattern.wants_uv = inner.pigment.wants_uv;
	pov_lack_add(&d->lack, &inner.lack);
	if (d->map.depth < inner.depth + 1)
		d->map.depth = inner.depth + 1;
}

static void read_image_map(struct pov *p, struct pattern_draft *d)
{
	(void)pov_picture_block(p, PICTURE_OF_COLOUR, &d->pattern.of.image, NULL, "image_map");
}

static void read_image_pattern(struct pov *p, struct pattern_draft *d)
{
	(void)pov_picture_block(p, PICTURE_OF_DATA, &d->pattern.of.image, NULL, "image_pattern");
}

static void read_bump_map(struct pov *p, struct pattern_draft *d)
{
	(void)pov_picture_block(p, PICTURE_OF_DATA, &d->pattern.of.image, &d->amount, "bump_map");
}

/* A function brings the stack of its registers with it, so it counts as several patterns. */
#define FUNCTION_DEPTH 12

static void read_function(struct pov *p, struct pattern_draft *d)
{
	struct diag_pos pos = pov_here(p);
	struct pov_function *f = function_read(p);

	if (!f || !function_of_points(p, &pos, f))
		return;
	d->pattern.of.function = &f->function;
	pov_lack_add(&d->lack, &f->lack);
	if (d->map.depth < f->depth + FUNCTION_DEPTH)
		d->map.depth = f->depth + FUNCTION_DEPTH;
}

static uint32_t read_iterations(struct pov *p)
{
	double n = trunc(pov_finite_float(p, "the number of iterations"));

	if (pov_failed(p))
		return 1;
	if (!(n >= 0 && n <= 1e7)) {
		pov_fail(p, "a fractal cannot have %g iterations", n);
		return 1;
	}
	return (uint32_t)n;
}

static void fractal_defaults(struct pattern_draft *d)
{
	d->pattern.of.fractal.exponent = 2;
	d->pattern.of.fractal.exterior = 1;
	d->pattern.of.fractal.exterior_factor = d->pattern.of.fractal.interior_factor = 1;
}

static void read_julia_point(struct pov *p, struct pattern_draft *d)
{
	double re = 0, im = 0;

	pov_vector2(p, &re, &im);
	pov_comma(p);
	if (!isfinite(re) || !isfinite(im))
		pov_fail(p, "the julia pattern's constant is not a finite number");
	d->pattern.of.fractal.julia = true;
	d->pattern.of.fractal.re = re;
	d->pattern.of.fractal.im = im;
}

static void read_mandel(struct pov *p, struct pattern_draft *d)
{
	fractal_defaults(d);
	d->pattern.of.fractal.iterations = read_iterations(p);
}

static void read_julia(struct pov *p, struct pattern_draft *d)
{
	fractal_defaults(d);
	read_julia_point(p, d);
	d->pattern.of.fractal.iterations = read_iterations(p);
}

static void read_magnet(struct pov *p, struct pattern_draft *d)
{
	struct diag_pos at = pov_here(p);
	double type = trunc(pov_float(p));

	fractal_defaults(d);
	if (!pov_failed(p) && type != 1 && type != 2)
		pov_fail_at(p, &at, "there is no magnet pattern %g: types are 1 and 2", type);
	d->pattern.of.fractal.magnet = type == 2 ? 2 : 1;
	if (pov_accept(p, TOK_JULIA))
		read_julia_point(p, d);
	else
		pov_expect(p, TOK_MANDEL, "(or julia) after magnet and its type");
	d->pattern.of.fractal.iterations = read_iterations(p);
}

/* low and high become low and width; equal ones count as not given. */
static void read_range(struct pov *p, double *low, double *width)
{
	double high;

	*low = *width = 0;
	pov_comma(p);
	if (!pov_starts_number(p))
		return;
	*low = pov_finite_float(p, "slope's low value");
	pov_comma(p);
	high = pov_starts_number(p) ? pov_finite_float(p, "slope's high value") : 0;
	*width = high - *low;
	if (high != 0 && high == *low)
		*low = *width = 0;
}

static void read_slope_block(struct pov *p, struct pattern *q)
{
	q->of.slope.point_at = pov_accept(p, TOK_POINT_AT);
	q->of.slope.slope = pov_finite_vector(p, "slope's direction");
	read_range(p, &q->of.slope.slope_low, &q->of.slope.slope_width);
	if (pov_token(p) == TOK_ALTITUDE && q->of.slope.point_at)
		pov_fail(p, "slope cannot have both point_at and altitude");
	else if (pov_accept(p, TOK_ALTITUDE)) {
		q->of.slope.altitude = pov_finite_vector(p, "slope's altitude");
		read_range(p, &q->of.slope.altitude_low, &q->of.slope.altitude_width);
	}
}

static void read_slope(struct pov *p, struct pattern_draft *d)
{
	struct pattern *q = &d->pattern;
	struct diag_pos at = pov_here(p);
	double a, b;

	if (pov_accept(p, TOK_LEFT_BRACE)) {
		pov_nest(p);
		read_slope_block(p, q);
		pov_close(p, "slope");
	} else {
		q->of.slope.slope = pov_finite_vector(p, "slope's direction");
	}
	q->of.slope.slope_weight = 1;
	if (q->of.slope.point_at || pov_failed(p))
		return;
	a = vec_length(q->of.slope.slope);
	b = vec_length(q->of.slope.altitude);
	if (!(a + b > 0 && isfinite(a + b))) {
		pov_fail_at(p, &at, "slope's vectors have no length");
		return;
	}
	q->of.slope.slope = vec_unit(q->of.slope.slope);
	q->of.slope.altitude = vec_unit(q->of.slope.altitude);
	q->of.slope.slope_weight = a / (a + b);
}

static void read_tiling(struct pov *p, struct pattern_draft *d)
{
	struct diag_pos at = pov_here(p);
	double n = trunc(pov_float(p));

	if (!pov_failed(p) && !(n >= 1 && n <= 27))
		pov_fail_at(p, &at, "there is no tiling %g: they are numbered from 1 to 27", n);
	else
		d->pattern.of.tiling = (uint32_t)n;
}

static void defaults(struct pattern *q)
{
	if (q->kind < PATTERN_FIRST_VALUE)
		q->frequency = 0;
	switch (q->kind) {
	case PATTERN_MARBLE:
	case PATTERN_WOOD:
	case PATTERN_SPIRAL1:
	case PATTERN_SPIRAL2:
		q->wave = WAVE_TRIANGLE;
		break;
	case PATTERN_IMAGE_MAP:
	case PATTERN_BUMP_MAP:
	case PATTERN_IMAGE:
		q->frequency = 0;
		break;
	case PATTERN_QUILTED:
		q->frequency = 0;
		q->of.quilted.control0 = q->of.quilted.control1 = 1;
		break;
	case PATTERN_AGATE:
		q->of.agate_turb = 1;
		break;
	case PATTERN_BRICK:
		q->of.brick.size = vec_make(8, 3, 4.5);
		q->of.brick.mortar = pattern_mortar(0.5);
		break;
	case PATTERN_CRACKLE:
		q->of.crackle.form = vec_make(-1, 1, 0);
		q->of.crackle.metric = 2;
		break;
	case PATTERN_FACETS:
		q->of.facets.size = 0.1;
		q->of.facets.metric = 2;
		break;
	case PATTERN_PAVEMENT:
		q->of.pavement.sides = 3;
		q->of.pavement.tiles = q->of.pavement.number = 1;
		break;
	default:
		break;
	}
}

#define ANY (IN_PIGMENT | IN_NORMAL | IN_TEXTURE | IN_DENSITY)

static const struct word {
	enum pov_token_kind token;
	enum pattern_kind kind;
	unsigned use; /* enum pattern_use: where it may stand */
	bool opaque; /* its parameters cannot be read yet: a block, or all the rest, is passed over */
	void (*read)(struct pov *, struct pattern_draft *); /* parameters; NULL: none */
} word[] = {
	{ TOK_AGATE, PATTERN_AGATE, ANY, false, NULL },
	{ TOK_AOI, PATTERN_AOI, ANY, false, NULL },
	{ TOK_AVERAGE, PATTERN_AVERAGE, ANY, false, NULL },
	{ TOK_BOXED, PATTERN_BOXED, ANY, false, NULL },
	{ TOK_BOZO, PATTERN_BOZO, ANY, false, NULL },
	{ TOK_BRICK, PATTERN_BRICK, ANY, false, read_brick },
	{ TOK_BUMP_MAP, PATTERN_BUMP_MAP, IN_NORMAL, false, read_bump_map },
	{ TOK_BUMPS, PATTERN_BUMPS, ANY, false, NULL },
	{ TOK_CELLS, PATTERN_CELLS, ANY, false, NULL },
	{ TOK_CHECKER, PATTERN_CHECKER, ANY, false, read_checker },
	{ TOK_CRACKLE, PATTERN_CRACKLE, ANY, false, NULL },
	{ TOK_CUBIC, PATTERN_CUBIC, ANY, false, read_triangular },
	{ TOK_CYLINDRICAL, PATTERN_CYLINDRICAL, ANY, false, NULL },
	{ TOK_DENSITY_FILE, PATTERN_DENSITY_FILE, ANY, true, NULL },
	{ TOK_DENTS, PATTERN_DENTS, ANY, false, NULL },
	{ TOK_FACETS, PATTERN_FACETS, IN_NORMAL, false, NULL },
	{ TOK_FUNCTION, PATTERN_FUNCTION, ANY, false, read_function },
	{ TOK_GRADIENT, PATTERN_GRADIENT, ANY, false, read_gradient },
	{ TOK_GRANITE, PATTERN_GRANITE, ANY, false, NULL },
	{ TOK_HEXAGON, PATTERN_HEXAGON, ANY, false, read_hexagon },
	{ TOK_IMAGE_MAP, PATTERN_IMAGE_MAP, IN_PIGMENT, false, read_image_map },
	{ TOK_IMAGE_PATTERN, PATTERN_IMAGE, ANY, false, read_image_pattern },
	{ TOK_JULIA, PATTERN_FRACTAL, ANY, false, read_julia },
	{ TOK_LEOPARD, PATTERN_LEOPARD, ANY, false, NULL },
	{ TOK_MAGNET, PATTERN_FRACTAL, ANY, false, read_magnet },
	{ TOK_MANDEL, PATTERN_FRACTAL, ANY, false, read_mandel },
	{ TOK_MARBLE, PATTERN_MARBLE, ANY, false, NULL },
	{ TOK_OBJECT, PATTERN_OBJECT, ANY, true, NULL },
	{ TOK_ONION, PATTERN_ONION, ANY, false, NULL },
	{ TOK_PAVEMENT, PATTERN_PAVEMENT, ANY, false, NULL },
	{ TOK_PIGMENT_PATTERN, PATTERN_PIGMENT, ANY, false, read_pigment_pattern },
	{ TOK_PLANAR, PATTERN_PLANAR, ANY, false, NULL },
	{ TOK_QUILTED, PATTERN_QUILTED, ANY, false, NULL },
	{ TOK_RADIAL, PATTERN_RADIAL, ANY, false, NULL },
	{ TOK_RIPPLES, PATTERN_RIPPLES, ANY, false, NULL },
	{ TOK_SLOPE, PATTERN_SLOPE, ANY, false, read_slope },
	{ TOK_SPHERICAL, PATTERN_SPHERICAL, ANY, false, NULL },
	{ TOK_SPIRAL1, PATTERN_SPIRAL1, ANY, false, read_arms },
	{ TOK_SPIRAL2, PATTERN_SPIRAL2, ANY, false, read_arms },
	{ TOK_SPOTTED, PATTERN_SPOTTED, ANY, false, NULL },
	{ TOK_SQUARE, PATTERN_SQUARE, ANY, false, read_square },
	{ TOK_TILING, PATTERN_TILING, ANY, false, read_tiling },
	{ TOK_TRIANGULAR, PATTERN_TRIANGULAR, ANY, false, read_triangular },
	{ TOK_WAVES, PATTERN_WAVES, ANY, false, NULL },
	{ TOK_WOOD, PATTERN_WOOD, ANY, false, NULL },
	{ TOK_WRINKLES, PATTERN_WRINKLES, ANY, false, NULL },
};

static const char *use_name(enum pattern_use use)
{
	switch (use) {
	case IN_PIGMENT:
		return "pigment";
	case IN_NORMAL:
		return "normal";
	case IN_TEXTURE:
		return "texture";
	default:
		return "density";
	}
}

/* "checker in a pigment", in the parser's arena. */
static const char *lack_name(struct pov *p, enum pov_token_kind token, enum pattern_use use)
{
	char text[80];
	char *name;

	snprintf(text, sizeof(text), "%s in a %s", keyword_text(token), use_name(use));
	name = pov_copy(p, text, strlen(text) + 1);
	return name ? name : keyword_text(token);
}

static void skip_parameters(struct pov *p)
{
	while (!pov_failed(p) && pov_token(p) != TOK_LEFT_BRACE && pov_token(p) != TOK_RIGHT_BRACE &&
	       pov_token(p) != TOK_END)
		pov_next(p);
	if (pov_token(p) == TOK_LEFT_BRACE)
		pov_skip_block(p);
}

static void begin_pattern(struct pov *p, struct pattern_draft *d, const struct word *w)
{
	bool again = w->kind == PATTERN_BRICK && d->given && d->pattern.kind == PATTERN_BRICK;

	d->lack = (struct pov_lack){ .construct = NULL };
	if (w->opaque || !(d->use == IN_NORMAL ? pattern_known_slope : pattern_known)(w->kind))
		pov_lack_note(p, &d->lack, lack_name(p, w->token, d->use), NULL);
	if (again)
		return; /* its sizes stay, as in POV-Ray */
	/* One pattern after another keeps what modified the first: warps, waves and all. Measured. */
	if (!d->given) {
		d->pattern = (struct pattern){ .frequency = 1, .exponent = 1 };
		d->pattern.turbulence.octaves = 6;
		d->pattern.turbulence.lambda = 2;
		d->pattern.turbulence.omega = 0.5;
	}
	d->given = true;
	d->pattern.kind = w->kind;
	memset(&d->pattern.of, 0, sizeof(d->pattern.of));
	defaults(&d->pattern);
}

bool pattern_word(struct pov *p, struct pattern_draft *d)
{
	const struct word *w = NULL;

	for (size_t i = 0; i < sizeof(word) / sizeof(word[0]) && !w; i++) {
		if (word[i].token == pov_token(p))
			w = &word[i];
	}
	if (!w)
		return false;
	if (!(w->use & d->use)) {
		pov_fail(p, "%s cannot stand in a %s", keyword_text(w->token), use_name(d->use));
		return false;
	}
	begin_pattern(p, d, w);
	pov_next(p);
	if (w->opaque)
		skip_parameters(p);
	else if (w->read)
		w->read(p, d);
	return !pov_failed(p);
}

void pattern_draft_init(struct pattern_draft *d, enum pattern_use use, const struct pattern *from)
{
	*d = (struct pattern_draft){ .use = use };
	if (!from)
		return;
	d->given = true;
	d->pattern = *from;
}

struct pattern *pattern_finish(struct pov *p, struct pattern_draft *d)
{
	if (!d->given || pov_failed(p))
		return NULL;
	if (d->map.depth > 100) {
		pov_fail(p, "patterns stand in patterns more than 100 deep");
		return NULL;
	}
	return pov_copy(p, &d->pattern, sizeof(d->pattern));
}

struct warp *pattern_warp_push(struct pov *p, struct pattern *q)
{
	struct warp *w;

	if (q->warp_count >= 10000) {
		pov_fail(p, "a pattern has more than 10000 warps");
		return NULL;
	}
	w = pov_new(p, (q->warp_count + 1) * sizeof(*w));
	if (!w)
		return NULL;
	if (q->warp_count)
		memcpy(w + 1, q->warp, q->warp_count * sizeof(*w));
	q->warp = w;
	q->warp_count++;
	return w;
}

/* Transforms that follow one another are one. */
bool pattern_move(struct pov *p, struct pattern *q, const struct xform *x)
{
	struct warp *w;

	if (q->warp_count && q->warp[0].kind == WARP_TRANSFORM) {
		w = pov_copy(p, q->warp, q->warp_count * sizeof(*w));
		if (!w)
			return false;
		w[0].w.place = xform_mul(&w[0].w.place, x);
		q->warp = w;
		return true;
	}
	w = pattern_warp_push(p, q);
	if (!w)
		return false;
	w[0].kind = WARP_TRANSFORM;
	w[0].w.place = *x;
	return true;
}

struct pattern *pattern_transform(struct pov *p, const struct pattern *from, const struct xform *x)
{
	struct pattern *q = pov_copy(p, from, sizeof(*q));

	return q && pattern_move(p, q, x) ? q : NULL;
}
