/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Tiles over the thread pool, and what they bring into the picture.
 */
#include <config.h>

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "film/tone.h"
#include "render/aa.h"
#include "render/budget.h"
#include "render/fill.h"
#include "render/render.h"
#include "render/short_wave.h"
#include "shade/camera.h"

#define TILE 32
#define SOFT_ROUNDS 32
#define TILE_MAX 256
#define AA_MAX 64
#define AA_DEPTH_MAX 9 /* POV-Ray's own bound */
#define INDIRECT_SAMPLES 512
#define CACHE_SAMPLES 256 /* of a record */
/* How far a record reaches at most, without slack: in pixels, and as a part of the picture's diagonal. */
#define CACHE_REACH_PIXELS 64
#define CACHE_REACH_PART 0.1
#define LENS_RAYS 32 /* of a sample, at least */
#define SUBSURFACE_RAYS 256 /* a pixel, about */
#define SUBSURFACE_PATH 32 /* a sample, which cannot do with one: a ratio is estimated (shade/pov/subsurface.c) */
#define ERROR_SETS 16 /* replications a pixel that its error is estimated from */

struct job {
	struct render_options whole; /* with defaults filled in */
	struct indirect indirect;
	struct cache cache; /* of indirect light, INDIRECT_CACHE */
	struct shader shader;
	struct worker *worker;
	struct paint *paint; /* if scene and picture go the short way */
	bool short_tiles;
	struct aa_pixel **pixel; /* a tile of them a thread */
	struct image *image;
	uint32_t across;
	atomic_bool stopped, no_memory;
	pthread_mutex_t lock; /* of what follows, and progress() */
	uint64_t done;
	struct nonfinite bad;
	struct render_counts *counts;
};

static struct aa_tile tile_at(const struct job *j, uint32_t i)
{
	const struct render_options *o = &j->whole;
	uint32_t x = i % j->across * o->tile, y = i / j->across * o->tile;
	uint32_t w = o->crop_width - x, h = o->crop_height - y;

	return (struct aa_tile){ .x = o->crop_x + x,
				 .y = o->crop_y + y,
				 .width = w < o->tile ? w : o->tile,
				 .height = h < o->tile ? h : o->tile };
}

/* The standard errors of r, g and b as they are stored: the slope of the encoding carries them over. */
static void put_error(float *out, const struct aa_pixel *p, double gamma, double more)
{
	const double c[] = { p->colour.r, p->colour.g, p->colour.b };
	const double v[] = { p->variance.r, p->variance.g, p->variance.b };

	for (int i = 0; i < 3; i++) {
		double slope = gamma > 0 && gamma != 1 && c[i] > 0 ? gamma * pow(c[i], gamma - 1) : 1;

		out[i] = v[i] < 0 ? -1 : (float)fmin(slope * sqrt(v[i]) * more, 0x1p127);
	}
}

/* False: not finite, and so black. Float has a smaller range than double: what overflows is not finite either. */
static bool put_pixel(const struct job *j, float *out, const struct aa_pixel *p)
{
	uint32_t channels = j->image->channels;
	double gamma = j->shader.scene->assumed_gamma;
	struct rgb c = tone_linear_rgb(p->colour, gamma);
	float nothing = 0; /* NaN if a channel is not finite */

	out[0] = (float)c.r;
	out[1] = (float)c.g;
	out[2] = (float)c.b;
	out[3] = (float)(1 - p->transmit);
	/* The root of a variance from n values is too small by about 1 / (4 n - 4). */
	if (channels > 4)
		put_error(out + 4, p, gamma, j->whole.budget ? 1 : 1 + 0.25 / (ERROR_SETS - 1));
	if (channels > 7)
		out[7] = (float)p->samples;
	for (uint32_t i = 0; i < channels; i++)
		nothing += out[i] * 0;
	if (nothing == 0)
		return p->finite;
	memset(out, 0, channels * sizeof(*out));
	return false;
}

static float *pixel_at(const struct job *j, uint32_t x, uint32_t y)
{
	const struct image *image = j->image;
	size_t i = (size_t)(y - j->whole.crop_y) * image->width + (x - j->whole.crop_x);

	return image->pixel + i * image->channels;
}

/* The tile is in the picture. */
static void finish_tile(struct job *j, const struct aa_tile *t, const struct nonfinite *bad)
{
	const struct render_options *o = &j->whole;

	pthread_mutex_lock(&j->lock);
	nonfinite_note(&j->bad, bad->count, bad->x, bad->y);
	j->done += (uint64_t)t->width * t->height;
	if (o->progress)
		o->progress(o->arg, j->done, (uint64_t)o->crop_width * o->crop_height);
	pthread_mutex_unlock(&j->lock);
}

static bool draw_tile(struct job *j, struct worker *w, const struct aa_tile *t, struct nonfinite *bad)
{
	const struct aa_pixel *pixel = j->pixel[w->thread];

	if (j->short_tiles)
		return short_tile(w, t, pixel_at(j, t->x, t->y), (size_t)j->image->width * j->image->channels, bad);
	if (!aa_render(w, t, j->pixel[w->thread]))
		return false;
	for (uint32_t y = 0; y < t->height; y++) {
		float *out = pixel_at(j, t->x, t->y + y);

		for (uint32_t x = 0; x < t->width; x++, pixel++, out += j->image->channels) {
			if (!put_pixel(j, out, pixel))
				nonfinite_note(bad, 1, t->x + x, t->y + y);
		}
	}
	return true;
}

static void render_tile(void *arg, uint32_t i, uint32_t thread)
{
	struct job *j = arg;
	struct aa_tile t = tile_at(j, i);
	struct nonfinite bad = { 0, 0, 0 };

	if (atomic_load(&j->stopped) || atomic_load(&j->no_memory))
		return;
	if (j->whole.stop && j->whole.stop(j->whole.arg)) {
		atomic_store(&j->stopped, true);
		return;
	}
	if (!draw_tile(j, &j->worker[thread], &t, &bad)) {
		atomic_store(j->worker[thread].stopped ? &j->stopped : &j->no_memory, true);
		return;
	}
	finish_tile(j, &t, &bad);
}

static enum status check(const struct render_options *o, struct diag *d)
{
	if (!o->width || !o->height)
		return diag_fail(d, STATUS_USAGE, NULL, "a picture of %u x %u pixels has none", o->width,
				 o->height);
	if (o->crop_width && ((uint64_t)o->crop_x + o->crop_width > o->width ||
			      (uint64_t)o->crop_y + o->crop_height > o->height || !o->crop_height))
		return diag_fail(d, STATUS_USAGE, NULL,
				 "the crop %u x %u at %u,%u is not within the picture of %u x %u",
				 o->crop_width, o->crop_height, o->crop_x, o->crop_y, o->width,
				 o->height);
	if (o->tile > TILE_MAX)
		return diag_fail(d, STATUS_USAGE, NULL, "a tile of %u pixels is over the limit of %d",
				 o->tile, TILE_MAX);
	if (o->aa != RENDER_AA_NONE && (o->aa_n < 1 || o->aa_n > AA_MAX))
		return diag_fail(d, STATUS_USAGE, NULL, "anti-aliasing %u is not within 1 to %d", o->aa_n,
				 AA_MAX);
	if ((o->aa == RENDER_AA_POV1 || o->aa == RENDER_AA_POV2) && o->aa_n > AA_DEPTH_MAX)
		return diag_fail(d, STATUS_USAGE, NULL, "anti-aliasing depth %u is over %d", o->aa_n,
				 AA_DEPTH_MAX);
	return STATUS_OK;
}

/* Where no tree is needed, and the geometry is asked by lanes. */
static bool make_short(struct job *j, uint32_t threads, struct mem_book *book)
{
	struct trace_room room;

	if (!j->shader.plain_only || j->whole.camera_only || j->shader.marks ||
	    !trace_room(j->shader.geometry, 0, &room))
		return true;
	j->paint = mem_alloc(book, "render", (j->shader.scene->texture_count + 1) * sizeof(*j->paint));
	if (!j->paint)
		return false;
	plain_paint(&j->shader, j->paint);
	for (uint32_t i = 0; i < threads; i++) {
		j->worker[i].shorts = mem_zalloc(book, "render", sizeof(*j->worker[i].shorts));
		if (!j->worker[i].shorts)
			return false;
		j->worker[i].shorts->paint = j->paint;
	}
	j->short_tiles = short_tile_can(&j->worker[0]);
	return true;
}

static bool make_workers(struct job *j, uint32_t threads, struct mem_book *book)
{
	size_t pixels = (size_t)j->whole.tile * j->whole.tile;

	j->worker = mem_zalloc(book, "render", threads * sizeof(*j->worker));
	j->pixel = mem_zalloc(book, "render", threads * sizeof(*j->pixel));
	if (!j->worker || !j->pixel)
		return false;
	for (uint32_t i = 0; i < threads; i++) {
		struct worker *w = &j->worker[i];

		w->shader = &j->shader;
		w->options = &j->whole;
		w->thread = i;
		w->sample.size = sizeof(struct sample);
		tree_init(&w->tree, book);
		j->pixel[i] = mem_alloc(book, "render", pixels * sizeof(**j->pixel));
		if (!j->pixel[i])
			return false;
	}
	return make_short(j, threads, book);
}

static void free_workers(struct job *j, uint32_t threads)
{
	for (uint32_t i = 0; i < threads && j->worker; i++) {
		tree_release(&j->worker[i].tree);
		buf_release(&j->worker[i].sample);
		buf_release(&j->worker[i].map);
		buf_release(&j->worker[i].lens);
		buf_release(&j->worker[i].run);
		buf_release(&j->worker[i].frame);
		mem_free(j->worker[i].shorts);
	}
	for (uint32_t i = 0; i < threads && j->pixel; i++)
		mem_free(j->pixel[i]);
	mem_free(j->worker);
	mem_free(j->paint);
	mem_free(j->pixel);
}

static void sum_counts(const struct job *j, uint32_t threads)
{
	for (uint32_t i = 0; i < threads; i++) {
		const struct render_counts *c = &j->worker[i].counts;

		for (int k = 0; k < RENDER_RAY_KINDS; k++) {
			j->counts->cast[k] += c->cast[k];
			j->counts->hit[k] += c->hit[k];
		}
		j->counts->samples += c->samples;
	}
	j->counts->pixels = j->done;
	j->counts->nonfinite = j->bad.count;
	j->counts->nonfinite_x = j->bad.x;
	j->counts->nonfinite_y = j->bad.y;
}

/* How many samples share a pixel's rays: where they are many, each gathers the less. Method 2's are shared by
 * four pixels, and each pixel has four. A lens casts more of its own. */
static uint32_t pixel_share(const struct scene *s, const struct render_options *o)
{
	uint32_t share = o->aa == RENDER_AA_POV2 ? 4 : render_pixel_samples(o);

	return camera_has_lens(&s->camera) ? share * LENS_RAYS : share;
}

static struct indirect indirect_options(const struct scene *scene, const struct render_options *o)
{
	const struct camera *c = &scene->camera;
	struct indirect in = { .method = o->indirect, .samples = o->indirect_samples, .replications = 1 };
	uint32_t share = pixel_share(scene, o);

	if (o->indirect == INDIRECT_CACHE) {
		in.samples = in.samples ? in.samples : CACHE_SAMPLES;
		in.slack = o->indirect_slack > 0 ? o->indirect_slack : 1;
		in.reach = fmin(CACHE_REACH_PIXELS, CACHE_REACH_PART * hypot(o->width, o->height)) * in.slack;
		if (c->kind == CAMERA_ORTHOGRAPHIC)
			in.pixel = vec_length(c->right) / o->width;
		else
			in.pixel_angle = vec_length(c->right) / vec_length(c->direction) / o->width;
		return in;
	}
	if (o->spp) {
		in.samples = 1;
		return in;
	}
	in.samples = in.samples ? in.samples : INDIRECT_SAMPLES;
	if (o->error && !camera_has_lens(c)) /* a lens's rays tell the error themselves */
		in.replications = share * 2 < ERROR_SETS ? (ERROR_SETS + share - 1) / share : 2;
	in.samples = in.samples > share ? in.samples / share : 1;
	return in;
}

static void fill_defaults(struct render_options *o)
{
	if (!o->crop_width) {
		o->crop_x = o->crop_y = 0;
		o->crop_width = o->width;
		o->crop_height = o->height;
	}
	if (!o->tile)
		o->tile = TILE;
	if (o->budget && !o->spp)
		o->spp = o->deadline > 0 ? RENDER_SPP_LIMIT : RENDER_SPP_MOST;
	if (!(o->aa_gamma > 0))
		o->aa_gamma = 2.5;
}

static uint32_t channels_of(const struct render_options *o)
{
	return !o->error ? 4 : o->budget ? 8 : 7;
}

#define THREAD_BYTES ((uint64_t)1 << 19) /* a tile, and trees of rays that are not deep */

uint64_t render_memory(const struct render_options *o, uint32_t threads)
{
	uint64_t pixels = o->crop_width ? (uint64_t)o->crop_width * o->crop_height : (uint64_t)o->width * o->height;

	return pixels * (channels_of(o) * sizeof(float) + (o->budget ? budget_bytes_a_pixel() : 0)) +
	       threads * THREAD_BYTES;
}

static enum status make_image(struct job *j, struct mem_book *book, struct diag *d)
{
	static const char *const name[] = { "R", "G", "B", "A", "Error.R", "Error.G", "Error.B", "Samples.Y" };
	const struct render_options *o = &j->whole;
	uint32_t channels = channels_of(o);
	struct image *out = j->image;
	enum status st = image_init(out, book, o->crop_width, o->crop_height, channels, d);

	if (st)
		return st;
	out->encoding = IMAGE_LINEAR;
	out->premultiplied = true;
	for (uint32_t i = 0; i < channels; i++)
		snprintf(out->name[i], sizeof(out->name[i]), "%s", name[i]);
	return STATUS_OK;
}

static double mean_error(const struct image *out)
{
	size_t pixels = (size_t)out->width * out->height;
	double sum = 0;

	if (out->channels < 5)
		return -1;
	for (size_t i = 0; i < pixels; i++) {
		for (uint32_t k = 4; k < 7; k++) {
			if (out->pixel[i * out->channels + k] < 0)
				return -1;
			sum += (double)out->pixel[i * out->channels + k];
		}
	}
	return sum / (3 * (double)pixels);
}

/* Where a pixel has many rays, each does its part. */
static uint32_t soft_rounds(const struct scene *s, const struct render_options *o)
{
	uint32_t samples = render_pixel_samples(o);

	return o->spp || camera_has_lens(&s->camera) || samples >= SOFT_ROUNDS ? 1 : SOFT_ROUNDS / samples;
}

static uint32_t subsurface_rays(const struct scene *s, const struct render_options *o)
{
	uint32_t share = pixel_share(s, o);

	if (o->spp)
		return SUBSURFACE_PATH;
	return share < SUBSURFACE_RAYS ? SUBSURFACE_RAYS / share : 1;
}

static bool fill(struct job *j, struct pool *pool)
{
	if (j->shader.indirect.method != INDIRECT_CACHE || j->whole.camera_only ||
	    fill_cache(&j->cache, &j->shader, j->worker, pool))
		return true;
	for (uint32_t i = 0; i < pool_threads(pool); i++) {
		if (j->worker[i].stopped)
			atomic_store(&j->stopped, true);
	}
	if (!atomic_load(&j->stopped))
		atomic_store(&j->no_memory, true);
	return false;
}

/* All that a budget's passes found, into the picture. */
static void put_budget(struct job *j, const struct budget *b)
{
	const struct render_options *o = &j->whole;
	float *out = j->image->pixel;

	for (uint32_t y = o->crop_y; y < o->crop_y + o->crop_height; y++) {
		for (uint32_t x = o->crop_x; x < o->crop_x + o->crop_width; x++, out += j->image->channels) {
			struct aa_pixel p;

			if (!budget_pixel(b, x, y, &p))
				continue;
			j->done++;
			if (!put_pixel(j, out, &p))
				nonfinite_note(&j->bad, 1, x, y);
		}
	}
	budget_tell(b, &j->counts->reached);
}

static void render_budget(struct job *j, struct pool *pool, struct mem_book *book)
{
	struct budget *b = budget_new(j->worker, pool, book);
	bool stopped = false;

	if (!b) {
		atomic_store(&j->no_memory, true);
		return;
	}
	if (budget_render(b, &stopped) || stopped)
		put_budget(j, b);
	else
		atomic_store(&j->no_memory, true);
	atomic_store(&j->stopped, stopped);
	budget_free(b);
}

static void render_tiles(struct job *j, struct pool *pool, struct mem_book *book)
{
	uint32_t down = (j->whole.crop_height + j->whole.tile - 1) / j->whole.tile;

	if (!fill(j, pool))
		return;
	if (j->whole.budget)
		render_budget(j, pool, book);
	else
		pool_run(pool, j->across * down, render_tile, j);
}

enum status render_scene(const struct scene *scene, const struct geometry *geometry,
			 const struct render_options *options, struct pool *pool, struct mem_book *book,
			 struct image *out, struct render_counts *counts, struct diag *d)
{
	struct job j = { .whole = *options, .image = out, .counts = counts };
	uint32_t threads = pool_threads(pool);
	double start = clock_seconds();
	enum status st = check(options, d);

	memset(out, 0, sizeof(*out));
	memset(counts, 0, sizeof(*counts));
	if (st)
		return st;
	fill_defaults(&j.whole);
	st = make_image(&j, book, d);
	if (st)
		return st;
	j.indirect = indirect_options(scene, &j.whole);
	cache_init(&j.cache, j.indirect.slack, book);
	shader_init(&j.shader, scene, geometry, options->alpha, &j.indirect);
	j.shader.footprints = options->texture_mip;
	j.shader.marks = options->verify;
	j.shader.one_path = j.whole.spp > 0;
	j.shader.lifts = options->lift;
	j.shader.soft_rounds = soft_rounds(scene, &j.whole);
	j.shader.subsurface_rays = subsurface_rays(scene, &j.whole);
	j.shader.plain = shade_plain(&j.shader);
	j.shader.plain_only = j.shader.plain && shade_plain_only(&j.shader);
	j.across = (j.whole.crop_width + j.whole.tile - 1) / j.whole.tile;
	pthread_mutex_init(&j.lock, NULL);
	if (!make_workers(&j, threads, book)) {
		st = diag_no_memory(d, "rendering", 0);
	} else {
		render_tiles(&j, pool, book);
		sum_counts(&j, threads);
		counts->seconds = clock_seconds() - start;
		counts->error = mean_error(out);
		if (atomic_load(&j.no_memory))
			st = diag_no_memory(d, "rendering", 0);
		else if (atomic_load(&j.stopped))
			st = STATUS_SIGINT;
		else if (counts->nonfinite)
			st = STATUS_NONFINITE;
		else if (counts->reached.missed)
			st = STATUS_BUDGET;
	}
	free_workers(&j, threads);
	cache_release(&j.cache);
	pthread_mutex_destroy(&j.lock);
	return st;
}
