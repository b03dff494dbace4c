/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A pixel has two streams of sets of samples, one as good as the other. Where noise is asked for, each stream's length
 * is decided by the other: it ends once the other one, as long as that, says that the pixel is good enough. So
 * neither the mean nor the variance of a stream has anything to do with why it ended, both stay without bias, and
 * the pixel is the plain mean of the two streams (their lengths must not be weights: they depend on the other
 * stream's samples). Stopping by what is averaged would prefer the samples that, by chance, look alike, and lose light
 * where it comes seldom (Kirk and Arvo, Unbiased Sampling Techniques for Image Synthesis, 1991, who draw the samples
 * anew instead). The one of two streams that ends first is followed on, as the other needs its word; these samples
 * are lost.
 *
 * What a pixel's first samples do not show, its neighbours' may: their first sets have a vote in its decisions, with
 * the same stream, which each pixel has at the same length.
 *
 * Sets grow, as the larger ones are more even, but slowly, so that there are always many. A pass ends at the same
 * number of samples for all pixels that go on, so that a number of samples tells all of the picture, also of one
 * that time has ended.
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "render/budget.h"

#include <stdatomic.h>
#include <string.h>

#include "base/clock.h"
#include "render/paths.h"
#include "render/streams.h"

#define SIZE_FIRST 2 /* samples of the first sets, */
#define SIZE_PAIRS 8 /* and pairs of sets after which their size doubles, */
#define SIZE_DOUBLINGS 10 /* so often */
#define PILOT_LEAST 32 /* samples before anything is decided: */
#define PILOT 1.0 /* over the noise that is asked for: what takes such a part of a pixel should be seen */
#define STEP 2 /* pairs of a pass then */
#define VOTE 8.0 /* of the neighbours, in sets of a stream */
#define AROUND 2 /* how far off they are, in pixels */
#define COARSE 16 /* pixels between the first samples, if time is short */
#define HASTE 1.05 /* a pass takes so much longer than it should, perhaps */
#define CONFIDENCE 1.645 /* standard errors, one-sided: 95 % */

/* Where a pass ends: after so many pairs of sets, and a last pair of other sizes. */
struct target {
	uint32_t pairs, rest[STREAMS], samples;
};

struct budget {
	struct worker *worker;
	struct pool *pool;
	const struct render_options *o;
	struct streams *pixel;
	uint32_t x, y, width, height; /* of the pixels that are looked at */
	uint32_t tile, across, down;
	struct estimate_view view;
	uint32_t values; /* that are looked at: with the background's share only if it is wanted */
	struct target now, next, cap;
	uint32_t pilot; /* pairs of sets before anything is decided */
	bool last; /* time is too short for another pass */
	uint32_t step; /* of the first samples */
	bool hurry; /* tiles look at the clock */
	atomic_bool stopped, no_memory, late;
	atomic_uint_least64_t traced;
	double began, rate; /* seconds a sample */
	uint64_t left; /* pixels that are not done */
	uint32_t passes;
	bool piloted;
};

static uint32_t set_size(uint32_t pair)
{
	uint32_t n = pair / SIZE_PAIRS;

	return (uint32_t)SIZE_FIRST << (n < SIZE_DOUBLINGS ? n : SIZE_DOUBLINGS);
}

/* After that many whole pairs. */
static struct target whole(uint32_t pairs)
{
	struct target t = { .pairs = pairs };

	for (uint32_t i = 0; i < pairs; i++)
		t.samples += 2 * set_size(i);
	return t;
}

/* At so many samples. */
static struct target exactly(uint32_t samples)
{
	struct target t = { .samples = samples };
	uint32_t left = samples;

	for (; left >= 2 * set_size(t.pairs); t.pairs++)
		left -= 2 * set_size(t.pairs);
	t.rest[STREAM_A] = (left + 1) / 2;
	t.rest[STREAM_B] = left / 2;
	return t;
}

static struct streams *pixel_at(const struct budget *b, uint32_t x, uint32_t y)
{
	return &b->pixel[(size_t)y * b->width + x];
}

static uint32_t least(uint32_t a, uint32_t b)
{
	return a < b ? a : b;
}

/* Neighbours are looked at where pixels are compared with them, so that a crop is a part of the whole. */
static void place(struct budget *b)
{
	const struct render_options *o = b->o;
	uint32_t right = o->crop_x + o->crop_width, bottom = o->crop_y + o->crop_height;
	uint32_t around = o->noise > 0 ? AROUND : 0;

	b->x = o->crop_x - least(o->crop_x, around);
	b->y = o->crop_y - least(o->crop_y, around);
	b->width = right + least(o->width - right, around) - b->x;
	b->height = bottom + least(o->height - bottom, around) - b->y;
}

static bool in_picture(const struct render_options *o, uint32_t x, uint32_t y)
{
	return x - o->crop_x < o->crop_width && y - o->crop_y < o->crop_height;
}

size_t budget_bytes_a_pixel(void)
{
	return sizeof(struct streams);
}

struct budget *budget_new(struct worker *worker, struct pool *pool, struct mem_book *book)
{
	struct budget *b = mem_zalloc(book, "budget", sizeof(*b));
	const struct scene *scene = worker->shader->scene;

	if (!b)
		return NULL;
	b->worker = worker;
	b->pool = pool;
	b->o = worker->options;
	b->tile = b->o->tile;
	b->view = (struct estimate_view){ .gamma = scene->assumed_gamma, .clips = b->o->clips };
	b->values = worker->shader->alpha ? ESTIMATE_VALUES : 3;
	b->cap = exactly(b->o->spp);
	while (whole(b->pilot).samples < fmax(PILOT_LEAST, PILOT / fmax(b->o->noise, 1e-3)))
		b->pilot++;
	place(b);
	b->pixel = mem_zalloc(book, "budget", (size_t)b->width * b->height * sizeof(*b->pixel));
	if (!b->pixel) {
		mem_free(b);
		return NULL;
	}
	for (uint32_t y = 0; y < b->height; y++) {
		for (uint32_t x = 0; x < b->width; x++)
			pixel_at(b, x, y)->beside = !in_picture(b->o, b->x + x, b->y + y);
	}
	b->left = (uint64_t)b->o->crop_width * b->o->crop_height;
	return b;
}

void budget_free(struct budget *b)
{
	if (b)
		mem_free(b->pixel);
	mem_free(b);
}

/* Tiles: of places that are step pixels apart. */
struct span {
	uint32_t x, y, width, height;
};

static struct span span_at(const struct budget *b, uint32_t i)
{
	uint32_t side = b->tile * b->step, x = i % b->across * side, y = i / b->across * side;

	return (struct span){ x, y, b->width - x < side ? b->width - x : side,
			      b->height - y < side ? b->height - y : side };
}

static void over_tiles(struct budget *b, uint32_t step, pool_job *job)
{
	uint32_t side = b->tile * step;

	b->step = step;
	b->across = (b->width + side - 1) / side;
	b->down = (b->height + side - 1) / side;
	pool_run(b->pool, b->across * b->down, job, b);
}

static bool may_go_on(struct budget *b)
{
	if (b->o->stop && b->o->stop(b->o->arg))
		atomic_store(&b->stopped, true);
	if (b->hurry && clock_seconds() >= b->o->deadline)
		atomic_store(&b->late, true);
	return !atomic_load(&b->stopped) && !atomic_load(&b->no_memory) && !atomic_load(&b->late);
}

static struct path_run *push_run(struct worker *w, const struct budget *b, uint32_t x, uint32_t y)
{
	uint32_t i = tree_push(&w->tree, &w->run, 1);

	if (i == TREE_NONE)
		return NULL;
	*BUF_AT(&w->run, struct path_run, i) = (struct path_run){ .x = b->x + x, .y = b->y + y };
	return BUF_AT(&w->run, struct path_run, i);
}

static bool trace_runs(struct budget *b, struct worker *w)
{
	uint64_t n = 0;

	for (uint32_t i = 0; i < w->run.count; i++)
		n += BUF_AT(&w->run, struct path_run, i)->count;
	if (n && !paths_trace(w, w->run.data, w->run.count)) {
		atomic_store(w->stopped ? &b->stopped : &b->no_memory, true);
		return false;
	}
	atomic_fetch_add(&b->traced, n);
	return true;
}

static void sums(const struct path_run *r, double out[ESTIMATE_VALUES])
{
	out[0] = r->sum.r;
	out[1] = r->sum.g;
	out[2] = r->sum.b;
	out[3] = r->transmit;
}

/* The first sample of each pixel that a coarser grid does not have. */
static void start_tile(void *arg, uint32_t tile, uint32_t thread)
{
	struct budget *b = arg;
	struct worker *w = &b->worker[thread];
	struct span t = span_at(b, tile);
	double v[ESTIMATE_VALUES];

	if (!may_go_on(b))
		return;
	w->run.size = sizeof(struct path_run);
	w->run.count = 0;
	for (uint32_t y = t.y; y < t.y + t.height; y += b->step) {
		for (uint32_t x = t.x; x < t.x + t.width; x += b->step) {
			struct path_run *r = pixel_at(b, x, y)->started ? NULL : push_run(w, b, x, y);

			if (r)
				r->count = 1;
		}
	}
	if (w->tree.no_memory)
		atomic_store(&b->no_memory, true);
	if (w->tree.no_memory || !trace_runs(b, w))
		return;
	for (uint32_t i = 0; i < w->run.count; i++) {
		const struct path_run *r = BUF_AT(&w->run, struct path_run, i);
		struct streams *p = pixel_at(b, r->x - b->x, r->y - b->y);

		sums(r, v);
		for (int k = 0; k < ESTIMATE_VALUES; k++)
			p->origin[k] = (float)v[k];
		p->started = true;
		p->bad = !r->finite;
	}
}

static bool goes_on(const struct streams *p)
{
	return p->started && !p->done && !p->bad;
}

/* The sets of one pixel from where it stands to where the pass ends. Of the first set one sample is there. */
static void push_sets(const struct budget *b, struct worker *w, uint32_t x, uint32_t y)
{
	const struct streams *p = pixel_at(b, x, y);
	const struct target *to = &b->next;

	if (!goes_on(p))
		return;
	for (uint32_t pair = p->pairs; pair <= to->pairs; pair++) {
		for (uint32_t s = STREAM_A; s < STREAMS; s++) {
			uint32_t size = pair < to->pairs ? set_size(pair) : to->rest[s], first = !pair && s == STREAM_A;
			struct path_run *r = size ? push_run(w, b, x, y) : NULL;

			if (!r)
				continue;
			r->set = 2 * pair + s;
			r->first = first;
			r->count = size - first;
		}
	}
}

static void take_set(const struct budget *b, const struct path_run *r)
{
	struct streams *p = pixel_at(b, r->x - b->x, r->y - b->y);
	double v[ESTIMATE_VALUES];

	p->bad |= !r->finite;
	sums(r, v);
	for (int k = 0; k < ESTIMATE_VALUES; k++)
		v[k] = (v[k] - r->count * (double)p->origin[k]) / (r->first + r->count);
	moments_add(&p->run[r->set % STREAMS], r->first + r->count, v);
	p->pairs = b->next.pairs;
}

static void trace_tile(void *arg, uint32_t tile, uint32_t thread)
{
	struct budget *b = arg;
	struct worker *w = &b->worker[thread];
	struct span t = span_at(b, tile);

	if (!may_go_on(b))
		return;
	w->run.size = sizeof(struct path_run);
	w->run.count = 0;
	for (uint32_t y = t.y; y < t.y + t.height; y++) {
		for (uint32_t x = t.x; x < t.x + t.width; x++)
			push_sets(b, w, x, y);
	}
	if (w->tree.no_memory)
		atomic_store(&b->no_memory, true);
	if (w->tree.no_memory || !trace_runs(b, w))
		return;
	for (uint32_t i = 0; i < w->run.count; i++)
		take_set(b, BUF_AT(&w->run, struct path_run, i));
}

static double stream_error(const struct budget *b, const struct streams *p, int stream)
{
	return streams_error(p, stream, &b->view, b->values);
}

static void pilot_tile(void *arg, uint32_t tile, uint32_t thread)
{
	struct budget *b = arg;
	struct span t = span_at(b, tile);

	(void)thread;
	for (uint32_t y = t.y; y < t.y + t.height; y++) {
		for (uint32_t x = t.x; x < t.x + t.width; x++) {
			struct streams *p = pixel_at(b, x, y);

			for (int s = STREAM_A; s < STREAMS && !p->bad; s++)
				p->pilot[s] = (float)fmin(1e30, stream_error(b, p, s) * STREAMS * p->run[s].n);
			p->done |= p->beside;
		}
	}
}

/* What the neighbours' first samples were like, by one stream: squared error of one sample. */
static double neighbours(const struct budget *b, uint32_t x, uint32_t y, int stream)
{
	double sum = 0, n = 0;

	for (uint32_t v = y - least(y, AROUND); v <= y + AROUND && v < b->height; v++) {
		for (uint32_t u = x - least(x, AROUND); u <= x + AROUND && u < b->width; u++) {
			if (u == x && v == y)
				continue;
			sum += (double)pixel_at(b, u, v)->pilot[stream];
			n++;
		}
	}
	return n > 0 ? sum / n : 0;
}

/*
 * Is the pixel good enough by one stream's word? A variance that looks small by chance ends a stream too early,
 * and one that looks large too late, so that the error would be larger than wanted in the mean: the estimate is
 * raised by its own uncertainty.
 */
static bool good_enough(const struct budget *b, uint32_t x, uint32_t y, int stream)
{
	const struct streams *p = pixel_at(b, x, y);
	double sets = moments_sets(&p->run[stream]), n = STREAMS * p->run[stream].n, e = stream_error(b, p, stream);

	/* What comes seldom, a pixel may not have met yet. */
	e += VOTE / (sets + VOTE) * fmax(0, neighbours(b, x, y, stream) / n - e);
	return e * (1 + sqrt(2 / (sets + VOTE))) <= b->o->noise * b->o->noise;
}

static void judge_tile(void *arg, uint32_t tile, uint32_t thread)
{
	struct budget *b = arg;
	struct span t = span_at(b, tile);

	(void)thread;
	for (uint32_t y = t.y; y < t.y + t.height; y++) {
		for (uint32_t x = t.x; x < t.x + t.width; x++) {
			struct streams *p = pixel_at(b, x, y);
			bool ends[STREAMS];

			if (!goes_on(p))
				continue;
			for (int s = STREAM_A; s < STREAMS; s++)
				ends[s] = p->ended[s] || good_enough(b, x, y, 1 - s);
			p->done = ends[STREAM_A] && ends[STREAM_B];
			if (!p->done && (ends[STREAM_A] || ends[STREAM_B]) && !p->kept)
				streams_keep(p, ends[STREAM_A] ? STREAM_A : STREAM_B);
			p->ended[STREAM_A] = ends[STREAM_A];
			p->ended[STREAM_B] = ends[STREAM_B];
		}
	}
}

static void count_left(struct budget *b)
{
	b->left = 0;
	for (size_t i = 0; i < (size_t)b->width * b->height; i++)
		b->left += !b->pixel[i].beside && !b->pixel[i].done && !b->pixel[i].bad;
}

static void judge(struct budget *b)
{
	if (!(b->o->noise > 0) || b->now.samples < 2 * SIZE_FIRST)
		return;
	if (!b->piloted)
		over_tiles(b, 1, pilot_tile);
	b->piloted = true;
	over_tiles(b, 1, judge_tile);
	count_left(b);
}

static void report(const struct budget *b)
{
	const struct render_options *o = b->o;
	uint64_t pixels = (uint64_t)o->crop_width * o->crop_height, done = pixels - b->left;

	if (!o->progress)
		return;
	if (o->deadline > 0) {
		double share = (clock_seconds() - b->began) / fmax(1e-3, o->deadline - b->began);
		uint64_t passed = (uint64_t)(fmin(share, 1) * (double)pixels);

		done = passed > done ? passed : done;
	}
	o->progress(o->arg, done, pixels);
}

static bool going(const struct budget *b)
{
	return !atomic_load(&b->stopped) && !atomic_load(&b->no_memory) && !atomic_load(&b->late);
}

/* With little time first a few pixels everywhere, then those between; the first of these come in any case. */
static bool start(struct budget *b)
{
	uint32_t step = b->o->deadline > 0 ? COARSE : 1;

	for (; step && going(b); step /= 2) {
		b->hurry = b->o->deadline > 0 && step < COARSE;
		over_tiles(b, step, start_tile);
		report(b);
	}
	b->hurry = b->o->deadline > 0;
	if (going(b))
		b->now = exactly(1);
	return going(b);
}

static double pass_seconds(const struct budget *b, const struct target *t)
{
	return HASTE * b->rate * (double)b->left * (t->samples - b->now.samples);
}

/* Where the next pass ends. False: there is no more. */
static bool next_pass(struct budget *b)
{
	const struct render_options *o = b->o;
	uint32_t have = b->now.pairs, to;
	double left;

	if (b->now.samples >= b->cap.samples || !b->left || b->last)
		return false;
	if (!(o->noise > 0) && !(o->deadline > 0))
		to = b->cap.pairs + 1;
	else if (have < b->pilot)
		to = o->deadline > 0 && 2 * have < b->pilot ? (have ? 2 * have : 1) : b->pilot;
	else
		to = have + STEP;
	b->next = whole(to < b->cap.pairs + 1 ? to : b->cap.pairs + 1);
	if (b->next.samples > b->cap.samples)
		b->next = b->cap;
	if (!(o->deadline > 0))
		return true;
	left = o->deadline - clock_seconds();
	if (pass_seconds(b, &b->next) > left) {
		b->next = exactly(b->now.samples + (uint32_t)fmax(0, left / (HASTE * b->rate * (double)b->left)));
		b->last = true; /* the one after it would end where no picture without a clock has an end */
	}
	return b->next.samples > b->now.samples;
}

static void pass(struct budget *b)
{
	double began = clock_seconds();
	uint64_t before = atomic_load(&b->traced);

	over_tiles(b, 1, trace_tile);
	if (atomic_load(&b->traced) > before)
		b->rate = (clock_seconds() - began) / (double)(atomic_load(&b->traced) - before);
	if (!going(b))
		return;
	b->now = b->next;
	b->passes++;
}

bool budget_render(struct budget *b, bool *stopped)
{
	b->began = clock_seconds();
	if (start(b)) {
		b->passes = 1;
		b->rate = (clock_seconds() - b->began) / (double)atomic_load(&b->traced);
		while (going(b) && next_pass(b)) {
			pass(b);
			if (going(b) && (b->now.pairs >= b->pilot || b->now.samples == b->cap.samples))
				judge(b);
			report(b);
		}
		if (going(b) && !b->piloted)
			judge(b);
	}
	*stopped = atomic_load(&b->stopped);
	return !*stopped && !atomic_load(&b->no_memory);
}

/* Of a pixel that no sample of its own was taken of: the next one up and left of it that has one. */
static const struct streams *stand_in(const struct budget *b, uint32_t x, uint32_t y)
{
	for (uint32_t step = 1; step <= COARSE; step *= 2) {
		const struct streams *p = pixel_at(b, x - x % step, y - y % step);

		if (p->started)
			return p;
	}
	return NULL;
}

bool budget_pixel(const struct budget *b, uint32_t x, uint32_t y, struct aa_pixel *out)
{
	const struct streams *own = pixel_at(b, x - b->x, y - b->y), *p = stand_in(b, x - b->x, y - b->y);
	struct stream_mean m;
	double v[3];

	*out = (struct aa_pixel){ .finite = true };
	if (!p)
		return false;
	m = streams_mean(p, b->o->noise > 0);
	for (int k = 0; k < ESTIMATE_VALUES; k++)
		m.mean[k] += (double)p->origin[k];
	out->colour = rgb_make(m.mean[0], m.mean[1], m.mean[2]);
	out->transmit = m.mean[3];
	out->finite = !p->bad;
	out->samples = p != own ? 0 : m.n ? m.n : 1;
	for (int k = 0; k < 3; k++)
		v[k] = m.n && p == own ? m.variance[k] : -1;
	for (int k = 0; k < 3 && v[k] > 0; k++)
		v[k] *= streams_student(m.sets) * streams_student(m.sets);
	out->variance = rgb_make(v[0], v[1], v[2]);
	return true;
}

/* Squared error of a pixel as it is seen, the mean of its channels; below 0: unknown. */
static double pixel_error(const struct budget *b, const struct aa_pixel *p)
{
	const double c[] = { p->colour.r, p->colour.g, p->colour.b };
	const double v[] = { p->variance.r, p->variance.g, p->variance.b };
	double sum = 0;

	for (int k = 0; k < 3; k++) {
		double e = estimate_seen(&b->view, c[k], sqrt(fmax(0, v[k])));

		if (v[k] < 0)
			return -1;
		sum += e * e / 3;
	}
	return sum;
}

void budget_tell(const struct budget *b, struct render_reached *out)
{
	const struct render_options *o = b->o;
	double n = 0, sum = 0, squares = 0, samples = 0;
	bool known = true;

	*out = (struct render_reached){ .told = true, .passes = b->passes, .samples = b->now.samples,
					.noise_asked = o->noise, .seconds_asked = o->seconds,
					.unfinished = o->noise > 0 ? b->left : 0, .noise = -1, .bound = -1,
					.cut = atomic_load(&b->late), .least = UINT32_MAX };
	for (uint32_t y = o->crop_y; y < o->crop_y + o->crop_height; y++) {
		for (uint32_t x = o->crop_x; x < o->crop_x + o->crop_width; x++) {
			struct aa_pixel p;
			double e = budget_pixel(b, x, y, &p) && p.finite ? pixel_error(b, &p) : -1;

			out->least = p.samples < out->least ? p.samples : out->least;
			out->most = p.samples > out->most ? p.samples : out->most;
			out->empty += !p.samples;
			samples += p.samples;
			n++;
			if (!p.finite)
				continue;
			known &= e >= 0;
			sum += e;
			squares += e * e;
		}
	}
	out->mean = samples / n;
	out->missed = out->empty || out->unfinished;
	if (!known || n < 2)
		return;
	sum /= n;
	out->noise = sqrt(sum);
	out->bound = sqrt(sum + CONFIDENCE * sqrt(fmax(0, squares / n - sum * sum) / (n - 1)));
}
