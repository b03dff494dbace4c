/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include <config.h>

#include "look/reached.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>

struct text {
	char *out;
	size_t size, length;
};

static void put(struct text *t, const char *format, ...) DIAG_PRINTF(2, 3);

static void put(struct text *t, const char *format, ...)
{
	va_list ap;
	int n;

	if (t->length >= t->size)
		return;
	va_start(ap, format);
	n = vsnprintf(t->out + t->length, t->size - t->length, format, ap);
	va_end(ap);
	t->length += n > 0 ? (size_t)n : 0;
}

static void put_noise(struct text *t, const struct render_reached *r)
{
	if (r->noise < 0) {
		put(t, "; the noise is unknown");
		return;
	}
	put(t, "; the noise is %.2g, below %.2g with 95 %% confidence", r->noise, r->bound);
	if (r->noise_asked > 0)
		put(t, ", %g asked", r->noise_asked);
}

static void put_missed(struct text *t, const struct render_reached *r)
{
	if (r->empty)
		put(t, "; %" PRIu64 " pixels had no time for a sample and show what is beside them", r->empty);
	else if (r->unfinished)
		put(t, "; %" PRIu64 " pixels are not below %g", r->unfinished, r->noise_asked);
}

/* How to have it again. */
static void put_again(struct text *t, const struct render_reached *r)
{
	if (r->cut)
		put(t, "; the last pass was cut short");
	else if (r->samples)
		put(t, "; --noise=%g --spp=%u draws the same", r->noise_asked, r->samples);
}

void reached_text(const struct render_reached *r, double seconds, char *out, size_t size)
{
	struct text t = { out, size, 0 };

	put(&t, r->missed ? "the budget was missed, and the picture is what there is: " : "budget: ");
	if (r->seconds_asked > 0)
		put(&t, "%.3g of %g s, ", seconds, r->seconds_asked);
	put(&t, "%u pass%s, ", r->passes, r->passes == 1 ? "" : "es");
	if (r->least == r->most)
		put(&t, "%u sample%s a pixel", r->most, r->most == 1 ? "" : "s");
	else
		put(&t, "%u to %u samples a pixel, %.3g in the mean", r->least, r->most, r->mean);
	put_noise(&t, r);
	put_missed(&t, r);
	put_again(&t, r);
}

void reached_json(struct json_writer *j, const struct render_reached *r)
{
	jw_object(j, "budget");
	jw_bool(j, "missed", r->missed);
	jw_double(j, "noise_asked", r->noise_asked);
	jw_double(j, "seconds_asked", r->seconds_asked);
	if (r->noise >= 0) {
		jw_double(j, "noise", r->noise);
		jw_double(j, "noise_below", r->bound);
	} else {
		jw_null(j, "noise");
		jw_null(j, "noise_below");
	}
	jw_double(j, "confidence", 0.95);
	jw_uint(j, "unfinished", r->unfinished);
	jw_uint(j, "without_sample", r->empty);
	jw_uint(j, "passes", r->passes);
	jw_bool(j, "cut", r->cut);
	jw_uint(j, "spp", r->samples);
	jw_uint(j, "samples_least", r->least);
	jw_uint(j, "samples_most", r->most);
	jw_double(j, "samples_mean", r->mean);
	jw_end(j);
}
