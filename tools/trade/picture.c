/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pictures are compared by what alidade-diff compares with, in a process of its own: a process that is
 * started inherits the most memory that its parent ever had as its own ru_maxrss, so this one has to stay
 * small for the figures to be true.
 */
#include <config.h>

#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "image/image.h"
#include "trade.h"

/* Memory that both see; out stands behind status. */
struct answer {
	enum status status;
	double out[];
};

enum status trade_apart(struct trade *t, enum status (*job)(struct trade *, void *arg, void *out), void *arg,
			void *out, size_t size)
{
	struct answer *a = mmap(NULL, sizeof(*a) + size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
	enum status st = STATUS_FAILED;
	int how = 0;
	pid_t pid;

	if (a == MAP_FAILED)
		return diag_no_memory(&t->diag, "figures of a comparison", sizeof(*a) + size);
	memcpy(a->out, out, size);
	fflush(NULL);
	pid = fork();
	if (!pid) {
		a->status = job(t, arg, a->out);
		_exit(0);
	}
	while (pid > 0 && waitpid(pid, &how, 0) < 0 && errno == EINTR)
		;
	if (pid < 0)
		st = diag_fail(&t->diag, STATUS_FAILED, NULL, "no process can be started: %s", strerror(errno));
	else if (how)
		st = diag_fail(&t->diag, STATUS_FAILED, NULL, "a process that read for this one ended by %s %d",
			       WIFSIGNALED(how) ? "signal" : "status",
			       WIFSIGNALED(how) ? WTERMSIG(how) : WEXITSTATUS(how));
	else
		st = a->status;
	if (!st)
		memcpy(out, a->out, size);
	munmap(a, sizeof(*a) + size);
	return st;
}

static enum status diff(struct trade *t, const struct image *a, const struct image *b, struct diff_result *r)
{
	struct diff_options o;
	enum status st;

	diff_options_init(&o);
	o.rgb_only = true;
	o.space = t->space;
	o.fail = o.warn = t->changed;
	st = image_diff(a, b, &o, r, NULL, &t->book, &t->diag);
	if (!st && r->verdict == DIFF_UNLIKE)
		st = diag_fail(&t->diag, STATUS_USAGE, NULL, "%s cannot be compared with: %s",
			       t->reference.file, r->reason[0]);
	return st;
}

static enum status compare(struct trade *t, void *arg, void *out)
{
	struct image image[2] = { 0 };
	struct diff_result r;
	double *value = out;
	enum status st = image_read(&image[0], t->reference.file, &t->book, NULL, &t->diag);

	if (!st)
		st = image_read(&image[1], arg, &t->book, NULL, &t->diag);
	if (!st)
		st = diff(t, &image[0], &image[1], &r);
	if (st)
		return st;
	value[TRADE_RMSE] = r.rms;
	value[TRADE_BIAS] = r.mean;
	value[TRADE_P99] = r.p99;
	value[TRADE_MAX] = r.max;
	value[TRADE_CHANGED] = (double)r.over_fail / (double)r.pixels;
	value[TRADE_NONFINITE] = (double)r.nonfinite[1];
	return STATUS_OK;
}

enum status trade_compare(struct trade *t, const char *picture, double *value)
{
	char name[TRADE_PATH + 16];

	snprintf(name, sizeof(name), "%s", picture);
	return trade_apart(t, compare, name, value, TRADE_VALUES * sizeof(*value));
}

struct averaging {
	const char *a, *b, *out;
};

static enum status average(struct trade *t, void *arg, void *out)
{
	const struct averaging *av = arg;
	struct image image[2] = { 0 };
	double *noise = out;
	struct diff_result r;
	enum status st = image_read(&image[0], av->a, &t->book, NULL, &t->diag);

	if (!st)
		st = image_read(&image[1], av->b, &t->book, NULL, &t->diag);
	if (!st)
		st = diff(t, &image[0], &image[1], &r);
	if (st)
		return st;
	/* Each is off by s, their difference by s sqrt(2), and their mean by s / sqrt(2). */
	*noise = r.rms / 2;
	for (size_t i = 0; i < (size_t)image[0].width * image[0].height * image[0].channels; i++)
		image[0].pixel[i] = 0.5f * image[0].pixel[i] + 0.5f * image[1].pixel[i];
	return image_write(&image[0], av->out, 0, NULL, 0, NULL, &t->diag);
}

enum status trade_average(struct trade *t, const char *a, const char *b, const char *out, double *noise)
{
	struct averaging av = { a, b, out };

	return trade_apart(t, average, &av, noise, sizeof(*noise));
}

static enum status look_reference(struct trade *t, void *arg, void *out)
{
	struct image image = { 0 };
	double *noise = out;
	enum status st = image_read(&image, t->reference.file, &t->book, NULL, &t->diag);

	(void)arg;
	if (st)
		return st;
	if (image.width != t->about.width || image.height != t->about.height)
		return diag_fail(&t->diag, STATUS_USAGE, NULL,
				 "%s has %u x %u pixels, and the picture of %s will have %u x %u; -s after -- "
				 "changes that", t->reference.file, image.width, image.height, t->scene,
				 t->about.width, t->about.height);
	/* Rounding to n bits is an error of its own, evenly spread over a step. */
	*noise = image.encoding == IMAGE_SRGB && image.bits && image.bits <= 16 ?
			 1 / (((1u << image.bits) - 1) * sqrt(12)) :
			 0;
	return STATUS_OK;
}

enum status trade_look_reference(struct trade *t)
{
	return trade_apart(t, look_reference, NULL, &t->reference.noise, sizeof(t->reference.noise));
}
