/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * --noise over many seeds: is the mean that of a fixed number of samples, is the error as large as is said, and as
 * small as was asked for? In one process, as a picture of these takes less time than a program to start.
 *
 * seeds [-n NOISE | -s SEEDS | -t POINTS | -m | SCENE] ...
 *
 * -t: how far from 68 and 95 of 100 the share of values within 1 and 1.96 errors may be. Of scenes behind -m only the
 * mean is looked at: what comes seldom is found by few of the pictures, and an error that is told by those that did
 * not find it is too small.
 *
 * What is right is the mean over as many pictures of FIXED samples in a single set, which shares no rule with what is
 * tested, and whose own error is known from its spread. The numbers are always the same, as the seeds are: a test that
 * passes goes on to pass.
 */
#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/image.h"
#include "read/limits.h"
#include "read/read.h"
#include "render/render.h"

#define WIDTH 24
#define HEIGHT 18
#define PIXELS (WIDTH * HEIGHT)
#define VALUES (3 * PIXELS)
#define FIXED 128
#define ALIKE 1e-6 /* values that differ by less over the seeds are not random */

struct stage {
	struct mem_book book;
	struct diag diag;
	struct scene scene;
	struct read_job job;
	struct pool *pool;
	struct geometry *geometry;
	int tests, failed;
};

/* Over the seeds, of each value. */
struct spread {
	double mean[VALUES], variance[VALUES]; /* of the mean */
};

struct judged {
	double one, two; /* share of values within 1 and 1.96 errors */
	double rmse, told; /* as it is seen: measured, and said, root of the mean square over seeds */
	double asked, samples;
	double bias, z; /* of the whole picture: relative, and in standard errors */
	double chi; /* mean of squared z of the values */
	uint32_t values;
};

static void hear(void *arg, enum diag_level level, const struct diag_pos *pos, const char *text)
{
	char line[1024];

	(void)arg;
	if (level > DIAG_WARNING)
		return;
	diag_format(line, sizeof(line), level, pos, text);
	printf("# %s\n", line);
}

static void ok(struct stage *st, bool good, const char *scene, const char *what)
{
	const char *slash = strrchr(scene, '/');

	st->failed += !good;
	printf("%sok %d - %s: %s\n", good ? "" : "not ", ++st->tests, slash ? slash + 1 : scene, what);
	fflush(stdout);
}

static bool load(struct stage *st, const char *name)
{
	struct read_options options;

	memset(&options, 0, sizeof(options));
	options.width = WIDTH;
	options.height = HEIGHT;
	scene_init(&st->scene, &st->book);
	memset(&st->job, 0, sizeof(st->job));
	return !read_scene(name, &options, &st->scene, &st->job, &st->diag) &&
	       !geometry_build(&st->geometry, &st->scene, NULL, st->pool, &st->book, false, &st->diag);
}

static void unload(struct stage *st)
{
	geometry_free(st->geometry);
	st->geometry = NULL;
	scene_release(&st->scene);
}

static bool draw(struct stage *st, const struct render_options *o, struct image *out, struct render_counts *c)
{
	enum status s = render_scene(&st->scene, st->geometry, o, st->pool, &st->book, out, c, &st->diag);

	return !s || s == STATUS_BUDGET;
}

static double value(const struct image *p, uint32_t i)
{
	return (double)p->pixel[i / 3 * p->channels + i % 3];
}

static double told(const struct image *p, uint32_t i)
{
	return (double)p->pixel[i / 3 * p->channels + 4 + i % 3];
}

static void spread_add(struct spread *s, const struct image *p)
{
	for (uint32_t i = 0; i < VALUES; i++) {
		s->mean[i] += value(p, i);
		s->variance[i] += value(p, i) * value(p, i);
	}
}

static void spread_end(struct spread *s, uint32_t n)
{
	for (uint32_t i = 0; i < VALUES; i++) {
		s->mean[i] /= n;
		s->variance[i] = fmax(0, s->variance[i] / n - s->mean[i] * s->mean[i]) / (n - 1);
	}
}

static bool find_truth(struct stage *st, uint32_t seeds, struct spread *truth)
{
	struct render_options o = { .width = WIDTH, .height = HEIGHT, .spp = FIXED, .indirect = INDIRECT_EXACT };
	struct render_counts c;
	struct image p;

	memset(truth, 0, sizeof(*truth));
	for (o.seed = 1000001; o.seed < 1000001 + seeds; o.seed++) {
		if (!draw(st, &o, &p, &c))
			return false;
		spread_add(truth, &p);
		image_release(&p);
	}
	spread_end(truth, seeds);
	return true;
}

static double squared(double x)
{
	return x * x;
}

static void look(const struct image *p, const struct spread *truth, const bool *random, struct judged *j)
{
	for (uint32_t i = 0; i < VALUES; i++) {
		double off = fabs(value(p, i) - truth->mean[i]), e = told(p, i);

		j->rmse += squared(srgb_encode(value(p, i)) - srgb_encode(truth->mean[i])) / VALUES;
		if (!random[i])
			continue;
		j->one += off <= e;
		j->two += off <= 1.96 * e;
	}
}

static void compare(const struct spread *seen, const struct spread *truth, const bool *random, struct judged *j)
{
	double sum = 0, variance = 0, all = 0, n = 0;

	for (uint32_t i = 0; i < VALUES; i++) {
		double v = seen->variance[i] + truth->variance[i], d = seen->mean[i] - truth->mean[i];

		all += truth->mean[i];
		if (!random[i] || i % 3 != 1) /* the channels of a pixel are not independent */
			continue;
		sum += d;
		variance += v;
		j->chi += d * d / v;
		n++;
	}
	j->bias = 3 * sum / all;
	j->z = variance > 0 ? sum / sqrt(variance) : 0;
	j->chi /= fmax(1, n);
}

static bool judge(struct stage *st, double noise, uint32_t seeds, struct judged *j)
{
	struct render_options o = { .width = WIDTH, .height = HEIGHT, .budget = true, .noise = noise, .error = true,
				    .clips = true, .indirect = INDIRECT_EXACT };
	static struct spread truth, seen;
	static bool random[VALUES];
	struct render_counts c;
	struct image *p = calloc(seeds, sizeof(*p));

	memset(j, 0, sizeof(*j));
	memset(&seen, 0, sizeof(seen));
	if (!p || !find_truth(st, seeds, &truth))
		return false;
	for (uint32_t i = 0; i < seeds; i++) {
		o.seed = i;
		if (!draw(st, &o, &p[i], &c))
			return false;
		spread_add(&seen, &p[i]);
		j->told += squared(c.reached.noise) / seeds;
		j->samples += c.reached.mean / seeds;
	}
	spread_end(&seen, seeds);
	for (uint32_t i = 0; i < VALUES; i++) {
		random[i] = truth.variance[i] > ALIKE * ALIKE / seeds || seen.variance[i] > ALIKE * ALIKE / seeds;
		j->values += random[i];
	}
	for (uint32_t i = 0; i < seeds; i++) {
		look(&p[i], &truth, random, j);
		image_release(&p[i]);
	}
	compare(&seen, &truth, random, j);
	free(p);
	j->one /= (double)seeds * fmax(1, j->values);
	j->two /= (double)seeds * fmax(1, j->values);
	j->rmse = sqrt(j->rmse / seeds);
	j->told = sqrt(j->told);
	return true;
}

/* What is asked for, of the scenes that follow. */
struct wish {
	double noise, points;
	uint32_t seeds;
	bool mean_only;
};

static void look_at(struct stage *st, const char *scene, const struct wish *w)
{
	char text[128];
	struct judged j;
	bool good = load(st, scene) && judge(st, w->noise, w->seeds, &j);

	unload(st);
	if (!good) {
		ok(st, false, scene, "could not be drawn");
		return;
	}
	printf("# %u values, %.1f samples a pixel; z %.2f, bias %.2g, chi %.3f; within 1: %.2f %%, "
	       "within 1.96: %.2f %%; error %.4f, told %.4f, asked %.4f\n", j.values, j.samples, j.z, j.bias, j.chi,
	       100 * j.one, 100 * j.two, j.rmse, j.told, w->noise);
	ok(st, fabs(j.z) < 3.3 && j.chi < 1 + 4 * sqrt(2 / fmax(1, j.values / 3.0)), scene,
	   "the mean is that of a fixed number of samples");
	if (w->mean_only)
		return;
	snprintf(text, sizeof(text), "68 and 95 of 100 are within 1 and 1.96 errors, give or take %g", w->points);
	ok(st, fabs(100 * j.one - 68.27) < w->points && fabs(100 * j.two - 95) < w->points, scene, text);
	ok(st, j.rmse <= w->noise && fabs(j.told / j.rmse - 1) < 0.15, scene,
	   "the error is as small as asked, and as large as told");
}

int main(int argc, char **argv)
{
	struct wish w = { 0.01, 3, 200, false };
	static struct stage st;

	st.diag = (struct diag){ hear, &st, 0, 0 };
	mem_book_init(&st.book, 0);
	st.pool = pool_new(pool_cores());
	if (!st.pool)
		return 2;
	for (int i = 1; i < argc; i++) {
		const char *value = i + 1 < argc ? argv[i + 1] : "0";

		if (!strcmp(argv[i], "-m"))
			w.mean_only = true;
		else if (!strcmp(argv[i], "-n"))
			w.noise = atof(value), i++;
		else if (!strcmp(argv[i], "-s"))
			w.seeds = (uint32_t)atoi(value), i++;
		else if (!strcmp(argv[i], "-t"))
			w.points = atof(value), i++;
		else if (w.noise > 0 && w.seeds > 1)
			look_at(&st, argv[i], &w);
	}
	printf("1..%d\n", st.tests);
	pool_free(st.pool);
	return st.failed != 0;
}
