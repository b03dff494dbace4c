/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pictures laid on things. How a point becomes a place on the picture, and which pixels it takes there, was
 * measured of POV-Ray 3.7 where its manual is silent: places count from the lower left pixel's corner, and
 * interpolation takes pixels' centres.
 */
#include <config.h>

#include "pattern/image.h"

#include "base/single.h"
#include "pattern/family.h"
#include "pattern/footprint.h"

#include <math.h>

#define LOOKS_MAX 16 /* along a footprint that is longer than wide */
#define NUDGE 1e-10 /* POV-Ray's: puts what lies on a pixel's edge on one side of it */

/* In pixels from the upper left, wrapped into the picture. */
struct spot {
	double x, y;
};

/* 0 to 1, from the x axis towards z. */
static double turn(double x, double z)
{
	double length = sqrt(x * x + z * z), a;

	if (length == 0)
		return 0;
	if (z == 0)
		return x > 0 ? 0 : 0.5;
	a = acos(x / length) / (2 * M_PI);
	return z < 0 ? 1 - a : a;
}

static bool outside(double a)
{
	return a < 0 || a > 1;
}

static bool map_planar(const struct picture_place *m, vec p, struct spot *s)
{
	if (m->once && (outside(p.x) || outside(p.y)))
		return false;
	*s = (struct spot){ fmod(p.x * s->x, s->x), fmod(p.y * s->y, s->y) };
	return true;
}

static bool map_spherical(vec p, struct spot *s)
{
	double length = vec_length(p);

	if (length == 0)
		return false;
	*s = (struct spot){ turn(p.x, p.z) * s->x, (0.5 + asin(p.y / length) / M_PI) * s->y };
	return true;
}

static bool map_cylindrical(const struct picture_place *m, vec p, struct spot *s)
{
	if ((m->once && outside(p.y)) || (p.x == 0 && p.z == 0))
		return false;
	*s = (struct spot){ turn(p.x, p.z) * s->x, fmod(p.y * s->y, s->y) };
	return true;
}

/* On a torus of major radius 1 about the y axis; the way round its tube begins inside. */
static bool map_toroidal(vec p, struct spot *s)
{
	double length = sqrt(p.x * p.x + p.z * p.z), x = length - 1, r = sqrt(x * x + p.y * p.y), phi;

	if (length == 0 || r == 0)
		return false;
	phi = acos(-x / r) / (2 * M_PI);
	*s = (struct spot){ turn(p.x, p.z) * s->x, (p.y > 0 ? 1 - phi : phi) * s->y };
	return true;
}

static double wrap(double a, double top)
{
	a = fmod(a, top);
	if (a < 0)
		a += top;
	return a < top ? a : 0; /* a tiny negative one ends at the top itself; NaN at 0 */
}

/* False: the picture does not reach there. */
static bool map(const struct picture_place *m, vec p, struct spot *s)
{
	double width = m->picture->width, height = m->picture->height;
	bool good;

	*s = (struct spot){ width * m->repeat_u, height * m->repeat_v };
	switch (m->map_type) {
	case PICTURE_SPHERICAL:
		good = map_spherical(p, s);
		break;
	case PICTURE_CYLINDRICAL:
		good = map_cylindrical(m, p, s);
		break;
	case PICTURE_TOROIDAL:
		good = map_toroidal(p, s);
		break;
	default:
		good = map_planar(m, p, s);
	}
	if (!good)
		return false;
	s->x += NUDGE - m->offset_u * width;
	s->y += NUDGE - m->offset_v * height;
	if (m->once && !(s->x >= 0 && s->y >= 0 && s->x < width && s->y < height))
		return false;
	s->x = wrap(s->x, width);
	s->y = wrap(-s->y, height);
	return true;
}

/* A pixel, or several blended. */
struct texel {
	struct rgbft c;
	double index;
};

static void add(struct texel *t, const struct texel *more, double weight)
{
	t->c.r += weight * more->c.r;
	t->c.g += weight * more->c.g;
	t->c.b += weight * more->c.b;
	t->c.filter += weight * more->c.filter;
	t->c.transmit += weight * more->c.transmit;
	t->index += weight * more->index;
}

static double curve(const struct picture_place *m, double v)
{
	if (m->gamma == 1)
		return v;
	if (m->gamma == 0) {
		v = v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
		return m->gamma_then == 1 ? v : pow(fmax(v, 0), m->gamma_then);
	}
	return pow(fmax(v, 0), m->gamma);
}

static double colour_sample(const struct picture_place *m, size_t i)
{
	const struct picture *p = m->picture;

	switch (p->depth) {
	case PICTURE_8:
		return (double)m->decode[((const uint8_t *)p->sample)[i]];
	case PICTURE_16:
		return (double)m->decode[((const uint16_t *)p->sample)[i]];
	default:
		return curve(m, (double)((const float *)p->sample)[i]);
	}
}

static double alpha_sample(const struct picture *p, size_t i)
{
	switch (p->depth) {
	case PICTURE_8:
		return ((const uint8_t *)p->sample)[i] / 255.0;
	case PICTURE_16:
		return ((const uint16_t *)p->sample)[i] / 65535.0;
	default:
		return (double)((const float *)p->sample)[i];
	}
}

static struct texel pixel(const struct picture_place *m, size_t x, size_t y)
{
	const struct picture *p = m->picture;
	size_t i = (y * p->width + x) * p->channels;
	struct texel t = { .index = -1 };

	if (p->palette_count) {
		uint8_t n = ((const uint8_t *)p->sample)[i];

		return (struct texel){ m->entry[n], n };
	}
	t.c.r = colour_sample(m, i);
	t.c.g = p->channels > 2 ? colour_sample(m, i + 1) : t.c.r;
	t.c.b = p->channels > 2 ? colour_sample(m, i + 2) : t.c.r;
	t.c.filter = m->filter_all;
	t.c.transmit = m->transmit_all;
	if (p->channels == 2 || p->channels == 4)
		t.c.transmit += 1 - alpha_sample(p, i + p->channels - 1);
	return t;
}

/* Of pixels beyond an edge: those of the next copy, or where there is only one, the edge's. */
static size_t beyond(int64_t a, uint32_t size, bool once)
{
	if (a >= 0 && a < size)
		return (size_t)a;
	if (once)
		return a < 0 ? 0 : size - 1;
	a %= size;
	return (size_t)(a < 0 ? a + size : a);
}

static void weights_cubic(double p, double *w)
{
	double q = 1 - p;

	w[0] = -0.5 * p * q * q;
	w[1] = 0.5 * q * (q * (3 * p + 1) + 1);
	w[2] = 0.5 * p * (p * (3 * q + 1) + 1);
	w[3] = -0.5 * q * p * p;
}

/* By the inverse squares of distances to the four centres. */
static void weights_distance(double p, double q, double *w)
{
	double sum = 0;

	for (int i = 0; i < 4; i++) {
		double dx = i & 1 ? 1 - p : p, dy = i & 2 ? 1 - q : q, d = dx * dx + dy * dy;

		if (d == 0) {
			w[0] = w[1] = w[2] = w[3] = 0;
			w[i] = 1;
			return;
		}
		w[i] = 1 / d;
		sum += w[i];
	}
	for (int i = 0; i < 4; i++)
		w[i] /= sum;
}

/* p and q: how far the spot lies from the centre of the pixel x, y towards the next. */
static struct texel blend(const struct picture_place *m, int64_t x, int64_t y, double p, double q)
{
	const struct picture *pic = m->picture;
	struct texel t = { .index = 0 };
	double w[4];

	if (m->interpolate == PICTURE_DISTANCE) {
		weights_distance(p, q, w);
	} else {
		w[0] = (1 - p) * (1 - q);
		w[1] = p * (1 - q);
		w[2] = (1 - p) * q;
		w[3] = p * q;
	}
	for (int i = 0; i < 4; i++) {
		struct texel corner = pixel(m, beyond(x + (i & 1), pic->width, m->once),
					    beyond(y + (i >> 1), pic->height, m->once));

		add(&t, &corner, w[i]);
	}
	return t;
}

static struct texel blend_cubic(const struct picture_place *m, int64_t x, int64_t y, double p, double q)
{
	const struct picture *pic = m->picture;
	struct texel t = { .index = 0 };
	double across[4], down[4];

	weights_cubic(p, across);
	weights_cubic(q, down);
	for (int j = 0; j < 4; j++) {
		for (int i = 0; i < 4; i++) {
			struct texel corner = pixel(m, beyond(x + i - 1, pic->width, m->once),
						    beyond(y + j - 1, pic->height, m->once));

			add(&t, &corner, across[i] * down[j]);
		}
	}
	return t;
}

static struct texel look(const struct picture_place *m, struct spot s)
{
	double x = floor(s.x + 0.5), y = floor(s.y + 0.5);
	struct texel t;

	if (m->interpolate == PICTURE_NEAREST)
		return pixel(m, (size_t)s.x, (size_t)s.y);
	if (m->interpolate == PICTURE_BICUBIC)
		t = blend_cubic(m, (int64_t)x - 1, (int64_t)y - 1, s.x + 0.5 - x, s.y + 0.5 - y);
	else
		t = blend(m, (int64_t)x - 1, (int64_t)y - 1, s.x + 0.5 - x, s.y + 0.5 - y);
	if (!m->picture->palette_count)
		t.index = -1;
	return t;
}

struct rgbft image_texel(const struct picture_place *m, uint32_t x, uint32_t y)
{
	struct texel t = pixel(m, x, y);

	if (!m->picture->palette_count) {
		t.c.filter -= m->filter_all;
		t.c.transmit -= m->transmit_all;
	}
	return t.c;
}

struct rgbft image_level_texel(const struct mip *mip, uint32_t level, uint32_t x, uint32_t y)
{
	const struct mip_level *l = &mip->level[level];
	const float *t = l->texel + ((size_t)y * l->width + x) * mip->channels;
	struct rgbft c = { (double)t[0], (double)t[0], (double)t[0], 0, 0 };

	if (mip->channels > 2) {
		c.g = (double)t[1];
		c.b = (double)t[2];
	}
	if (mip->channels == 5)
		c.filter = (double)t[3];
	if (mip->channels != 1 && mip->channels != 3)
		c.transmit = (double)t[mip->channels - 1];
	return c;
}

void image_level_store(struct mip *mip, uint32_t level, uint32_t x, uint32_t y, struct rgbft c)
{
	struct mip_level *l = &mip->level[level];
	float *t = l->texel + ((size_t)y * l->width + x) * mip->channels;

	t[0] = (float)c.r;
	if (mip->channels > 2) {
		t[1] = (float)c.g;
		t[2] = (float)c.b;
	}
	if (mip->channels == 5)
		t[3] = (float)c.filter;
	if (mip->channels != 1 && mip->channels != 3)
		t[mip->channels - 1] = (float)c.transmit;
}

/* Bilinear in a smaller copy; spots are those of the whole picture. */
static struct texel look_small(const struct picture_place *m, uint32_t level, struct spot s)
{
	const struct mip_level *l = &m->mip->level[level];
	double x = s.x * l->width / m->picture->width - 0.5, y = s.y * l->height / m->picture->height - 0.5;
	double x0 = floor(x), y0 = floor(y);
	struct texel t = { .index = 0 };

	for (int i = 0; i < 4; i++) {
		size_t at_x = beyond((int64_t)x0 + (i & 1), l->width, m->once);
		size_t at_y = beyond((int64_t)y0 + (i >> 1), l->height, m->once);
		struct texel corner = { .c = image_level_texel(m->mip, level, (uint32_t)at_x, (uint32_t)at_y) };

		add(&t, &corner, (i & 1 ? x - x0 : 1 - (x - x0)) * (i >> 1 ? y - y0 : 1 - (y - y0)));
	}
	if (!m->picture->palette_count) {
		t.c.filter += m->filter_all;
		t.c.transmit += m->transmit_all;
	}
	return t;
}

/* detail: 0 is the whole picture, 1 half its size ... */
static struct texel look_between(const struct picture_place *m, struct spot s, double detail)
{
	uint32_t level = detail > 0 ? (uint32_t)detail : 0;
	double share = detail - level;
	struct texel t = { .index = 0 }, a, b;

	if (level >= m->mip->count)
		return look_small(m, m->mip->count - 1, s);
	b = look_small(m, level, s);
	a = level ? look_small(m, level - 1, s) : look(m, s);
	add(&t, &a, 1 - share);
	add(&t, &b, share);
	return t;
}

/* Pixels of the picture along an axis of the footprint: a difference over a small part of it, so that it does
 * not reach over a seam. */
static struct spot along(const struct picture_place *m, vec p, vec axis, struct spot s)
{
	const double part = 1.0 / 64, width = m->picture->width, height = m->picture->height;
	struct spot end;

	if (!map(m, vec_mad(p, axis, part), &end))
		return (struct spot){ 0, 0 };
	end.x -= s.x;
	end.y -= s.y;
	end.x -= width * round(end.x / width);
	end.y -= height * round(end.y / height);
	return (struct spot){ end.x / part, end.y / part };
}

/* Several looks along the longer axis, each as wide as the shorter (Feline: McCormack et al. 1999). */
static struct texel look_over(const struct picture_place *m, vec p, struct spot s, const struct footprint *foot)
{
	struct spot a = along(m, p, foot->axis[0], s), b = along(m, p, foot->axis[1], s), d;
	double major = hypot(a.x, a.y), minor = hypot(b.x, b.y), detail;
	struct texel sum = { .index = 0 }, t;
	uint32_t looks;

	if (major < minor) {
		double swap = major;

		major = minor;
		minor = swap;
		a = b;
	}
	minor = fmax(minor, fmax(major / LOOKS_MAX, 1));
	if (!(major > 1) || !isfinite(major))
		return look(m, s);
	looks = (uint32_t)ceil(major / minor - 1e-6);
	detail = log2(minor);
	for (uint32_t i = 0; i < looks; i++) {
		double at = (i + 0.5) / looks - 0.5;

		d.x = wrap(s.x + at * a.x, m->picture->width);
		d.y = wrap(s.y + at * a.y, m->picture->height);
		if (m->once) {
			d.x = fmax(0, fmin(s.x + at * a.x, m->picture->width - NUDGE));
			d.y = fmax(0, fmin(s.y + at * a.y, m->picture->height - NUDGE));
		}
		t = look_between(m, d, detail);
		add(&sum, &t, 1.0 / looks);
	}
	return sum;
}

static struct texel see(const struct picture_place *m, vec p, struct spot s, const struct footprint *foot)
{
	return foot && m->mip && m->mip->count ? look_over(m, p, s, foot) : look(m, s);
}

struct rgbft image_colour(const struct picture_place *m, vec p, const struct footprint *foot)
{
	struct spot s;
	struct rgbft c;
	double alpha;

	if (!map(m, p, &s))
		return (struct rgbft){ 1, 1, 1, 0, 1 };
	c = see(m, p, s, foot).c;
	if (!m->premultiplied)
		return c;
	alpha = 1 - c.transmit; /* transmit all counts, filter does not: measured */
	if (alpha > 0 && alpha != 1) {
		c.r /= alpha;
		c.g /= alpha;
		c.b /= alpha;
	}
	return c;
}

double image_value(const struct picture_place *m, vec p, const struct footprint *foot)
{
	struct spot s;
	struct texel t;
	double v;

	if (!map(m, p, &s))
		return 0;
	t = see(m, p, s, foot);
	/* use_index changes nothing here, in POV-Ray neither. */
	if (m->use == PICTURE_ALPHA)
		v = m->picture->palette_count || !(m->picture->channels & 1) ? t.c.transmit : t.c.r;
	else
		v = rgb_grey(rgbft_rgb(t.c));
	return v < 0 ? 0 : v > 1 ? 1 : v;
}

uint32_t image_material(const struct picture_place *m, vec p)
{
	struct spot s;
	struct texel t;
	double v;

	if (!map(m, p, &s))
		return 0;
	t = look(m, s);
	/* Rounded to single precision as POV-Ray's colours are: it decides which whole number is below. */
	v = t.index >= 0 ? t.index : as_single(t.c.r) * 255;
	return v >= 1 ? v < UINT32_MAX ? (uint32_t)v : UINT32_MAX : 0;
}

static double height(const struct picture_place *m, struct spot s)
{
	struct texel t;

	s.x = wrap(s.x, m->picture->width);
	s.y = wrap(s.y, m->picture->height);
	t = look(m, s);
	return m->use == PICTURE_INDEX && t.index >= 0 ? floor(t.index) : rgb_grey(rgbft_rgb(t.c));
}

/* POV-Ray takes the slope of a triangle over three pixels: the spot's own and those below it on the left and
 * right. Its normal is turned to stand on the surface with its x axis level. */
vec image_bump(const struct picture_place *m, vec p, double size, vec n)
{
	struct spot s;
	double a, b, c, length;
	vec bump, x, z;

	if (!map(m, p, &s))
		return n;
	a = size * height(m, s);
	b = size * height(m, (struct spot){ s.x - 1, s.y + 1 });
	c = size * height(m, (struct spot){ s.x + 1, s.y + 1 });
	bump = vec_unit(vec_cross(vec_make(2, c - b, 0), vec_make(1, a - b, -1)));
	x = vec_cross(n, vec_make(0, 1, 0));
	length = vec_length(x);
	if (length < NUDGE) {
		n = vec_make(0, n.y > 0 ? 1 : -1, 0);
		x = vec_make(1, 0, 0);
		length = 1;
	}
	x = vec_scale(x, 1 / length);
	z = vec_unit(vec_cross(x, n));
	return vec_sub(vec_add(vec_scale(x, bump.x), vec_scale(n, bump.y)), vec_scale(z, bump.z));
}

double picture_value(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	(void)s;
	return image_value(&q->of.image, at->p, at->foot);
}

double picture_material(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	(void)s;
	return image_material(&q->of.image, at->p);
}

struct rgbft picture_colour(const struct scene *s, const struct pattern *q, const struct pattern_point *at)
{
	(void)s;
	return image_colour(&q->of.image, at->p, at->foot);
}
