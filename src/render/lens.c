/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * POV-Ray's focal blur (manual 3.4.2.2.6) in the limit of many rays: the lens is a disc, and each ray
 * also goes through its own place in a square as large as a pixel around the sample's, so that focal
 * blur is its own anti-aliasing (both measured: what POV-Ray's picture tends to as blur_samples grows).
 *
 * The points on lens and pixel are one low-discrepancy sequence of four dimensions a sample, keyed by
 * the sample's place. Rays are added in rounds until the standard error of the mean, along the sRGB
 * curve, is small in every channel. It is estimated from the variance, as for independent rays, so the
 * true error is a good deal smaller.
 */
#include "render/lens.h"

#include <math.h>
#include <string.h>

#include "base/sobol.h"
#include "film/tone.h"
#include "image/image.h"
#include "shade/camera.h"

#define ROUND 32 /* rays of a sample's first round; later ones double what there is */
#define ROUND_MAX 128
#define LEAST_MAX 64
#define MOST 1024
#define HELD 16384 /* rays at a time */
#define GOOD_ENOUGH 0.012 /* of a pixel, by that estimate; measured, the RMSE is 0.001 to 0.004 then */
#define PI 3.14159265358979323846

/* What the rays of one sample brought so far. */
struct lens_sum {
	struct rgb sum, square;
	double transmit, transmit_square;
	struct sobol sequence;
	uint32_t count, sample;
	bool done;
};

void lens_disc(double a, double b, double *x, double *y)
{
	double r, phi;

	a = 2 * a - 1;
	b = 2 * b - 1;
	if (a == 0 && b == 0) {
		*x = *y = 0;
		return;
	}
	if (fabs(a) > fabs(b)) {
		r = a;
		phi = PI / 4 * (b / a);
	} else {
		r = b;
		phi = PI / 2 - PI / 4 * (a / b);
	}
	*x = r * cos(phi);
	*y = r * sin(phi);
}

static bool push_ray(struct worker *w, const struct lens_sum *l, uint32_t i)
{
	const struct sample *s = BUF_AT(&w->sample, struct sample, l->sample);
	struct wave_root root = { .key = wave_seeded(w, rng_child(wave_key(s), i)) };

	root.x = s->x + sobol_at(&l->sequence, i, 2) - 0.5;
	root.y = s->y + sobol_at(&l->sequence, i, 3) - 0.5;
	lens_disc(sobol_at(&l->sequence, i, 0), sobol_at(&l->sequence, i, 1), &root.lens_x, &root.lens_y);
	return wave_push(w, &root);
}

static void add_ray(struct lens_sum *l, const struct node *n)
{
	l->sum = rgb_add(l->sum, n->colour);
	l->square = rgb_add(l->square, rgb_mul(n->colour, n->colour));
	l->transmit += n->transmit;
	l->transmit_square += n->transmit * n->transmit;
	l->count++;
}

static double seen(double v, double gamma)
{
	return srgb_encode(fmin(1, fmax(0, tone_linear(v, gamma))));
}

/* How far off the mean of one channel may be, as it will be seen. Downwards more is doubted: a few highlights far
 * above white would else make a pixel white for good. */
static double error(double sum, double square, double n, double gamma)
{
	double mean = sum / n, off = sqrt(fmax(0, square / n - mean * mean) / (n - 1)), is = seen(mean, gamma);

	return fmax(seen(mean + off, gamma) - is, mean > 1 ? is - seen(mean - 4 * off, gamma) : 0);
}

static bool good_enough(const struct worker *w, const struct lens_sum *l)
{
	const struct render_options *o = w->options;
	uint32_t least = w->shader->scene->camera.blur_samples / 2;
	double n = l->count, g = w->shader->scene->assumed_gamma, e;

	if (o->blur_samples)
		return l->count >= o->blur_samples;
	least = least < ROUND ? ROUND : least > LEAST_MAX ? LEAST_MAX : least;
	if (l->count < least || l->count >= MOST)
		return l->count >= MOST;
	e = fmax(error(l->sum.r, l->square.r, n, g), error(l->sum.g, l->square.g, n, g));
	e = fmax(e, error(l->sum.b, l->square.b, n, g));
	if (w->shader->alpha)
		e = fmax(e, error(l->transmit, l->transmit_square, n, 1));
	return e <= GOOD_ENOUGH * sqrt(render_pixel_samples(o)); /* their errors average out */
}

static uint32_t round_size(const struct worker *w, uint32_t have)
{
	uint32_t n = have < ROUND ? ROUND : have < ROUND_MAX ? have : ROUND_MAX;
	uint32_t most = w->options->blur_samples;

	return most && n > most - have ? most - have : n;
}

/* k more rays through the lens for each of n samples that are not done. */
static bool trace_round(struct worker *w, struct lens_sum *sum, uint32_t n, uint32_t k)
{
	uint32_t next = 0;

	if (!wave_begin(w))
		return false;
	for (uint32_t i = 0; i < n; i++) {
		for (uint32_t j = 0; j < k && !sum[i].done; j++) {
			if (!push_ray(w, &sum[i], sum[i].count + j))
				return false;
			next++;
		}
	}
	if (!wave_follow(w, next))
		return false;
	next = 0;
	for (uint32_t i = 0; i < n; i++) {
		for (uint32_t j = 0; j < k && !sum[i].done; j++)
			add_ray(&sum[i], BUF_AT(&w->tree.node, struct node, next++));
	}
	return true;
}

/* All samples that are not done have had equally many rays. */
static bool trace_samples(struct worker *w, struct lens_sum *sum, uint32_t n)
{
	uint32_t have = 0, left = n;

	while (left) {
		uint32_t k = round_size(w, have), at_once = HELD / k;

		for (uint32_t i = 0; i < n; i += at_once) {
			if (!trace_round(w, sum + i, n - i < at_once ? n - i : at_once, k))
				return false;
		}
		have += k;
		left = 0;
		for (uint32_t i = 0; i < n; i++) {
			sum[i].done = sum[i].done || good_enough(w, &sum[i]);
			left += !sum[i].done;
		}
	}
	return true;
}

/* Of the mean; everything that is random counts. */
static struct rgb variance(const struct lens_sum *l)
{
	struct rgb mean = rgb_scale(l->sum, 1.0 / l->count);
	struct rgb v = rgb_add(rgb_scale(l->square, 1.0 / l->count), rgb_scale(rgb_mul(mean, mean), -1));

	return rgb_scale(v, 1.0 / (l->count > 1 ? l->count - 1 : 1));
}

bool lens_trace(struct worker *w, uint32_t first, uint32_t n)
{
	struct lens_sum *sum;

	w->lens.size = sizeof(struct lens_sum);
	w->lens.count = 0;
	if (tree_push(&w->tree, &w->lens, n) == TREE_NONE)
		return false;
	sum = w->lens.data;
	for (uint32_t i = 0; i < n; i++) {
		const struct sample *s = BUF_AT(&w->sample, struct sample, first + i);

		sum[i] = (struct lens_sum){ .sample = first + i,
					    .sequence = sobol_make(wave_seeded(w, wave_key(s))) };
	}
	if (!trace_samples(w, sum, n))
		return false;
	for (uint32_t i = 0; i < n; i++) {
		struct sample *s = BUF_AT(&w->sample, struct sample, first + i);

		s->colour = rgb_scale(sum[i].sum, 1.0 / sum[i].count);
		s->variance = variance(&sum[i]);
		s->transmit = sum[i].transmit / sum[i].count;
	}
	return true;
}
