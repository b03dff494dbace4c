/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The words of image_map, bump_map, image_pattern and material_map (manual 3.4.6.1.5 and 3.4.7.6.1 to
 * 3.4.7.6.6), and POV-Ray's rules on a picture's gamma (3.4.1.3, 3.4.7.6.2), measured where they are silent.
 */
#include <config.h>

#include "read/pov/picture.h"

#include <math.h>
#include <string.h>

/* What the words said so far. */
struct draft {
	struct pov_picture *file;
	struct picture_place *place;
	enum pov_picture_use use;
	double *bump_size;
	bool gamma_given, gamma_srgb;
	double gamma; /* given */
	struct rgbft *entry; /* of a palette */
};

static const char *format_word(enum pov_token_kind kind)
{
	switch (kind) {
	case TOK_PNG: return "png";
	case TOK_JPEG: return "jpeg";
	case TOK_TIFF: return "tiff";
	case TOK_TGA: return "tga";
	case TOK_GIF: return "gif";
	case TOK_BMP: return "bmp";
	case TOK_EXR: return "exr";
	case TOK_HDR: return "hdr";
	case TOK_IFF: return "iff";
	case TOK_PPM: return "ppm";
	case TOK_PGM: return "pgm";
	default: return NULL;
	}
}

static bool read_file(struct pov *p, struct draft *d)
{
	const char *word = format_word(pov_token(p));

	if (pov_token(p) == TOK_POT || pov_token(p) == TOK_SYS) {
		pov_fail(p, "pictures of the format %s cannot be read: convert it to png", pov_text(p));
		return false;
	}
	if (pov_token(p) == TOK_FUNCTION) {
		struct diag_pos at = pov_pos(p);

		pov_unsupported(p, &at, "a picture made by a function", "render the function to a picture file");
		if (!pov_failed(p))
			pov_fail_at(p, &at, "and nothing can stand in its place");
		return false;
	}
	if (word)
		pov_next(p);
	d->file = pov_picture_file(p, word);
	return d->file != NULL;
}

/* gamma and premultiplied: they stand before all other words. */
static void read_overrides(struct pov *p, struct draft *d)
{
	for (;;) {
		if (pov_accept(p, TOK_GAMMA)) {
			d->gamma_given = true;
			d->gamma_srgb = pov_accept(p, TOK_SRGB);
			if (!d->gamma_srgb)
				d->gamma = pov_positive(p, "gamma");
		} else if (pov_accept(p, TOK_PREMULTIPLIED)) {
			d->place->premultiplied = pov_bool(p, true);
		} else {
			return;
		}
	}
}

/* How samples become colours in the working space. Up to version 3.6 only what files state is corrected, and
 * without assumed_gamma nothing; data (heights, patterns) only by a gamma word, and to light. */
static void find_gamma(struct pov *p, struct draft *d)
{
	const struct image_raw *raw = &d->file->raw;
	bool old = pov_version(p) < 370, off = old && pov_gamma(p) <= 0;
	double assumed = pov_gamma(p) > 0 ? pov_gamma(p) : 1;
	struct picture_place *m = d->place;
	enum image_curve curve = raw->curve;
	double gamma = raw->gamma;

	if (d->gamma_given) {
		curve = d->gamma_srgb ? IMAGE_CURVE_SRGB : IMAGE_CURVE_POWER;
		gamma = d->gamma;
	} else if (d->use == PICTURE_OF_DATA || off || (old && !raw->stated)) {
		curve = IMAGE_CURVE_NONE;
	}
	if (d->use == PICTURE_OF_DATA || off)
		assumed = 1;
	m->gamma = curve == IMAGE_CURVE_NONE ? 1 : curve == IMAGE_CURVE_SRGB ? 0 : gamma / assumed;
	m->gamma_then = curve == IMAGE_CURVE_SRGB ? 1 / assumed : 1;
}

static double decoded(const struct pov_decode *t, double v)
{
	if (t->gamma != 0)
		return pow(v, t->gamma);
	v = v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
	return pow(v, t->gamma_then);
}

/* POV-Ray keeps grey PNG pictures of up to 8 bits as light in 8 bits, rounded down, after weighing the three
 * equal colours in single precision: dark greys suffer, and its pictures show it. */
static float coarse(float v)
{
	float grey = v * 0.297f + v * 0.589f + v * 0.114f;

	return (float)(floor((double)(grey * 255.0f)) / 255.0);
}

static const float *find_table(struct pov *p, const struct draft *d)
{
	const struct picture *pic = d->file->picture;
	const struct pov_decode want = {
		.depth = pic->depth,
		.coarse = pic->depth == PICTURE_8 && pic->channels == 1 && !pic->palette_count &&
			  !strcmp(d->file->raw.format, "png"),
		.gamma = d->place->gamma,
		.gamma_then = d->place->gamma_then,
	};
	uint32_t n = pic->depth == PICTURE_8 ? 256 : 65536;
	struct pov_decode *t;

	for (t = pov_state(p)->decodes; t; t = t->next) {
		if (t->depth == want.depth && t->coarse == want.coarse && t->gamma == want.gamma &&
		    t->gamma_then == want.gamma_then)
			return t->table;
	}
	t = pov_copy(p, &want, sizeof(want));
	if (!t)
		return NULL;
	t->table = arena_alloc(&pov_scene(p)->arena, n * sizeof(*t->table));
	if (!t->table) {
		pov_no_memory(p);
		return NULL;
	}
	for (uint32_t i = 0; i < n; i++) {
		t->table[i] = (float)decoded(t, i / (n - 1.0));
		if (t->coarse)
			t->table[i] = coarse(t->table[i]);
	}
	t->next = pov_state(p)->decodes;
	pov_state(p)->decodes = t;
	return t->table;
}

static bool read_palette(struct pov *p, struct draft *d)
{
	const struct image_raw *raw = &d->file->raw;

	d->entry = arena_alloc(&pov_scene(p)->arena, raw->palette_count * sizeof(*d->entry));
	if (!d->entry)
		return pov_no_memory(p);
	for (uint32_t i = 0; i < raw->palette_count; i++) {
		const uint8_t *c = raw->palette + (size_t)4 * i;
		const float *t = d->place->decode;

		d->entry[i] = (struct rgbft){ (double)t[c[0]], (double)t[c[1]], (double)t[c[2]], 0,
					      1 - c[3] / 255.0 };
	}
	d->place->entry = d->entry;
	return true;
}

/* filter, transmit: all N, or I, N for a palette's entry I. */
static void read_clear(struct pov *p, struct draft *d, bool transmit)
{
	const char *what = transmit ? "transmit" : "filter";
	uint32_t count = d->file->raw.palette_count, from = 0, to = count;
	double v;

	pov_next(p);
	if (!pov_accept(p, TOK_ALL)) {
		struct diag_pos at = pov_here(p);

		if (!count) {
			pov_fail_at(p, &at, "%s by number is for pictures with a palette, and this one %s; use %s all",
				    what, !strcmp(d->file->raw.format, "gif") ? "is a GIF, whose palette is not kept" :
									       "has none", what);
			return;
		}
		from = pov_count(p, "the number of a palette's entry", 0, count - 1);
		to = from + 1;
		pov_comma(p);
	}
	v = pov_finite_float(p, what);
	for (uint32_t i = from; i < to; i++) {
		if (transmit)
			d->entry[i].transmit = v;
		else
			d->entry[i].filter = v;
	}
	if (count)
		return;
	if (transmit)
		d->place->transmit_all = v;
	else
		d->place->filter_all = v;
}

static void read_pair(struct pov *p, double *u, double *v, const char *what, bool positive)
{
	struct diag_pos at;

	pov_next(p);
	at = pov_here(p);
	pov_vector2(p, u, v);
	if (!isfinite(*u) || !isfinite(*v) || (positive && !(*u > 0 && *v > 0)))
		pov_fail_at(p, &at, "%s of a picture is <%g, %g>; it must be %s", what, *u, *v,
			    positive ? "above 0" : "finite");
}

static void read_number(struct pov *p, struct draft *d, bool interpolate)
{
	struct diag_pos at;
	uint32_t n;

	pov_next(p);
	at = pov_here(p);
	n = pov_count(p, interpolate ? "interpolate" : "map_type", 0, 10);
	if (pov_failed(p))
		return;
	if (interpolate) {
		if (n != 0 && n != 2 && n != 3 && n != 4)
			pov_fail_at(p, &at, "interpolate %u is none; 2 is bilinear, 3 bicubic, 4 by distance", n);
		d->place->interpolate = (enum picture_interpolation)n;
	} else {
		if (n > 2 && n != 5)
			pov_fail_at(p, &at, "map_type %u is none; 0 is planar, 1 spherical, 2 cylindrical, "
				    "5 toroidal", n);
		d->place->map_type = (enum picture_map)n;
	}
}

static bool read_word(struct pov *p, struct draft *d)
{
	struct picture_place *m = d->place;

	switch (pov_token(p)) {
	case TOK_ONCE:
		pov_next(p);
		m->once = true;
		return true;
	case TOK_INTERPOLATE:
	case TOK_MAP_TYPE:
		read_number(p, d, pov_token(p) == TOK_INTERPOLATE);
		return true;
	case TOK_USE_COLOUR:
	case TOK_USE_INDEX:
	case TOK_USE_ALPHA:
		m->use = pov_token(p) == TOK_USE_INDEX ? PICTURE_INDEX :
			 pov_token(p) == TOK_USE_ALPHA ? PICTURE_ALPHA : PICTURE_COLOUR;
		pov_next(p);
		return true;
	case TOK_REPEAT:
		read_pair(p, &m->repeat_u, &m->repeat_v, "the repetition", true);
		return true;
	case TOK_OFFSET:
		read_pair(p, &m->offset_u, &m->offset_v, "the offset", false);
		return true;
	case TOK_FILTER:
	case TOK_TRANSMIT:
		read_clear(p, d, pov_token(p) == TOK_TRANSMIT);
		return true;
	case TOK_BUMP_SIZE:
		if (!d->bump_size)
			return false;
		pov_next(p);
		*d->bump_size = pov_finite_float(p, "bump_size");
		return true;
	default:
		return false;
	}
}

static bool is_clear(const struct draft *d)
{
	const struct picture_place *m = d->place;

	for (uint32_t i = 0; i < m->picture->palette_count; i++) {
		if (m->entry[i].filter != 0 || m->entry[i].transmit != 0)
			return true;
	}
	return m->picture->clear || m->once || m->filter_all != 0 || m->transmit_all != 0;
}

/* Where smaller copies would be kept, one for each way of making colours of a picture. */
static bool find_mip(struct pov *p, struct picture_place *m)
{
	struct scene *s = pov_scene(p);
	struct mip *mip;

	for (mip = s->mip; mip; mip = mip->next) {
		const struct picture_place *o = mip->of;

		if (o->picture == m->picture && o->decode == m->decode && o->gamma == m->gamma &&
		    o->gamma_then == m->gamma_then && o->premultiplied == m->premultiplied && !m->entry)
			break;
	}
	if (!mip) {
		mip = arena_zalloc(&s->arena, sizeof(*mip));
		if (mip)
			mip->of = (void *)arena_memdup(&s->arena, m, sizeof(*m));
		if (!mip || !mip->of)
			return pov_no_memory(p);
		mip->next = s->mip;
		s->mip = mip;
	}
	m->mip = mip;
	return true;
}

bool pov_picture_read(struct pov *p, enum pov_picture_use use, struct picture_place *m, double *bump_size)
{
	struct draft d = { .place = m, .use = use, .bump_size = bump_size };

	*m = (struct picture_place){ .repeat_u = 1, .repeat_v = 1 };
	if (pov_starts_vector(p)) {
		struct diag_pos at = pov_here(p);

		pov_vector(p);
		pov_warn(p, &at, "the old vector before a picture's name has no effect, as in POV-Ray");
	}
	if (!read_file(p, &d))
		return false;
	m->picture = d.file->picture;
	m->premultiplied = d.file->raw.premultiplied;
	read_overrides(p, &d);
	if (pov_failed(p))
		return false;
	find_gamma(p, &d);
	if (m->picture->depth != PICTURE_FLOAT)
		m->decode = find_table(p, &d);
	if (m->picture->palette_count && m->decode && !read_palette(p, &d))
		return false;
	while (!pov_failed(p) && read_word(p, &d))
		;
	if (pov_failed(p))
		return false;
	m->clear = is_clear(&d);
	return bump_size ? true : find_mip(p, m); /* heights are never averaged */
}

bool pov_picture_block(struct pov *p, enum pov_picture_use use, struct picture_place *m, double *bump_size,
		       const char *block)
{
	if (!pov_expect(p, TOK_LEFT_BRACE, block))
		return false;
	return pov_nest(p) && pov_picture_read(p, use, m, bump_size) && pov_close(p, block);
}
