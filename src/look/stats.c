/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Both reports are made from the same two tables. A counter that a plugin never touches stays 0: the
 * contract leaves it free to count only what it has.
 */
#include <config.h>

#include "look/stats.h"

#include <inttypes.h>

#include "accel/verify.h"
#include "base/json.h"
#include "look/reached.h"

static const char *const ray_name[RENDER_RAY_KINDS] = {
	[RENDER_CAMERA] = "camera", [RENDER_SHADOW] = "shadow", [RENDER_REFLECTED] = "reflected",
	[RENDER_REFRACTED] = "refracted", [RENDER_GATHERED] = "gathered",
	[RENDER_SUBSURFACE] = "subsurface",
};

static const char *const question_name[VERIFY_QUESTIONS] = {
	[VERIFY_NEAREST] = "nearest", [VERIFY_OCCLUDED] = "occluded", [VERIFY_NEXT] = "next",
};

/* The list of accel.h: the key in JSON and the words in text. */
static const struct {
	int counter;
	const char *key, *label;
} counter_table[] = {
	{ ALD_COUNT_PRIMS, "intersection_tests", "intersection tests" },
	{ ALD_COUNT_REPEATS, "repeated_tests", "of these repeated" },
	{ ALD_COUNT_NODES, "nodes_visited", "nodes visited" },
	{ ALD_COUNT_VOLUME_TESTS, "volume_tests", "volume tests" },
	{ ALD_COUNT_VOLUME_HITS, "volume_hits", "volume hits" },
	{ ALD_COUNT_VOLUME_USEFUL, "volume_hits_useful", "of these useful" },
};
#define COUNTERS (sizeof(counter_table) / sizeof(*counter_table))

static void sum_rays(const struct render_counts *r, uint64_t *cast, uint64_t *hit)
{
	*cast = *hit = 0;
	for (int k = 0; k < RENDER_RAY_KINDS; k++) {
		*cast += r->cast[k];
		*hit += r->hit[k];
	}
}

static double percent(uint64_t part, uint64_t whole)
{
	return whole ? 100.0 * (double)part / (double)whole : 0;
}

static double per_second(uint64_t rays, double seconds)
{
	return seconds > 0 ? (double)rays / seconds : 0;
}

static void text_rays(const struct render_counts *r, FILE *out)
{
	uint64_t cast, hit;

	sum_rays(r, &cast, &hit);
	fprintf(out, "%-28s %15s %15s %15s\n", "rays", "cast", "hit", "missed");
	for (int k = 0; k < RENDER_RAY_KINDS; k++)
		fprintf(out, "  %-26s %15" PRIu64 " %15" PRIu64 " %15" PRIu64 "  %5.1f %% hit\n", ray_name[k],
			r->cast[k], r->hit[k], r->cast[k] - r->hit[k], percent(r->hit[k], r->cast[k]));
	fprintf(out, "  %-26s %15" PRIu64 " %15" PRIu64 " %15" PRIu64 "  %5.1f %% hit\n", "all", cast, hit,
		cast - hit, percent(hit, cast));
}

static void text_counters(const struct stats *s, FILE *out)
{
	uint64_t count[ALD_COUNT_MAX] = { 0 }, cast, hit;

	geometry_get_counters(s->geometry, count);
	sum_rays(s->render, &cast, &hit);
	fputs("accelerator\n", out);
	for (size_t i = 0; i < COUNTERS; i++)
		fprintf(out, "  %-26s %15" PRIu64 "  %.2f a ray\n", counter_table[i].label,
			count[counter_table[i].counter],
			cast ? (double)count[counter_table[i].counter] / (double)cast : 0);
	fprintf(out, "  %-26s %15" PRIu64 "\n", "volume misses",
		count[ALD_COUNT_VOLUME_TESTS] - count[ALD_COUNT_VOLUME_HITS]);
	if (count[ALD_COUNT_VOLUME_HITS])
		fprintf(out, "  %-26s %15.1f %%\n", "volume hits real",
			percent(count[ALD_COUNT_VOLUME_USEFUL], count[ALD_COUNT_VOLUME_HITS]));
}

static void text_verified(const struct stats *s, FILE *out)
{
	struct verify_counts c;

	verify_get(s->geometry, &c);
	if (!c.every)
		return;
	fprintf(out, "%-28s %15s %15s %15s\n", "verified without accelerator", "checked", "different",
		"not exact");
	for (int q = 0; q < VERIFY_QUESTIONS; q++)
		fprintf(out, "  %-26s %15" PRIu64 " %15" PRIu64 " %15" PRIu64 "\n", question_name[q],
			c.checked[q], c.different[q], c.inexact[q]);
}

static void text_structure(const struct stats *s, FILE *out)
{
	struct geometry_counts c = { 0 };
	const char *name;
	double value;

	geometry_get_counts(s->geometry, &c);
	fputs("structure\n", out);
	fprintf(out, "  %-26s %15" PRIu64 "\n", "triangles", c.triangles);
	if (c.effective_triangles != c.triangles)
		fprintf(out, "  %-26s %15" PRIu64 "\n", "with all instances", c.effective_triangles);
	fprintf(out, "  %-26s %15" PRIu64 "\n", "primitives", c.primitives);
	fprintf(out, "  %-26s %15" PRIu64 "\n", "instances", c.instances);
	fprintf(out, "  %-26s %15" PRIu64 "\n", "unbounded", c.unbounded);
	if (c.dropped)
		fprintf(out, "  %-26s %15" PRIu64 "\n", "degenerate, left out", c.dropped);
	for (uint32_t i = 0; geometry_stat(s->geometry, i, &name, &value); i++)
		fprintf(out, "  %-26s %15.10g\n", name, value);
}

static void text_memory(const struct mem_book *book, FILE *out)
{
	uint32_t n = book->count;

	fprintf(out, "%-28s %15s %15s\n", "memory, MiB", "now", "most");
	for (uint32_t i = 0; i < n; i++)
		fprintf(out, "  %-26s %15.2f %15.2f\n", book->account[i].name,
			(double)book->account[i].now / 1048576, (double)book->account[i].peak / 1048576);
	fprintf(out, "  %-26s %15.2f %15.2f\n", "all", (double)book->now / 1048576,
		(double)book->peak / 1048576);
}

static void text_time(const struct stats *s, FILE *out)
{
	double build = geometry_build_seconds(s->geometry);
	uint64_t cast, hit;

	sum_rays(s->render, &cast, &hit);
	fputs("time, s\n", out);
	fprintf(out, "  %-26s %15.3f\n  %-26s %15.3f\n", "read", s->read_seconds, "build", build);
	fprintf(out, "  %-26s %15.3f\n  %-26s %15.3f\n", "render", s->render->seconds, "write",
		s->write_seconds);
	fprintf(out, "  %-26s %15.0f\n", "rays per second", per_second(cast, s->render->seconds));
}

void stats_text(const struct stats *s, FILE *out)
{
	fprintf(out, "alidade %s: %s, %s, %s, %u thread%s%s\n", s->version, s->scene, s->options, s->accel,
		s->threads, s->threads == 1 ? "" : "s", s->complete ? "" : ", interrupted");
	if (s->animated)
		fprintf(out, "frame %u, clock %g, structure %s, pictures kept %" PRIu64 "\n", s->frame, s->clock,
			s->reused ? "of an earlier frame" : "built", s->pictures_kept);
	text_rays(s->render, out);
	if (s->render->error >= 0)
		fprintf(out, "%-28s %15.6f\n", "mean standard error", s->render->error);
	text_counters(s, out);
	text_verified(s, out);
	text_structure(s, out);
	text_memory(s->book, out);
	text_time(s, out);
}

static void json_rays(struct json *j, const struct render_counts *r)
{
	uint64_t cast, hit;

	sum_rays(r, &cast, &hit);
	json_object(j, "rays");
	for (int k = 0; k <= RENDER_RAY_KINDS; k++) {
		bool all = k == RENDER_RAY_KINDS;
		uint64_t c = all ? cast : r->cast[k], h = all ? hit : r->hit[k];

		json_object(j, all ? "all" : ray_name[k]);
		json_uint(j, "cast", c);
		json_uint(j, "hit", h);
		json_uint(j, "missed", c - h);
		json_end(j);
	}
	json_end(j);
}

static void json_counters(struct json *j, const struct stats *s)
{
	uint64_t count[ALD_COUNT_MAX] = { 0 };

	geometry_get_counters(s->geometry, count);
	json_object(j, "tests");
	for (size_t i = 0; i < COUNTERS; i++)
		json_uint(j, counter_table[i].key, count[counter_table[i].counter]);
	json_uint(j, "volume_misses", count[ALD_COUNT_VOLUME_TESTS] - count[ALD_COUNT_VOLUME_HITS]);
	if (count[ALD_COUNT_VOLUME_HITS])
		json_double(j, "volume_hits_useful_percent",
			    percent(count[ALD_COUNT_VOLUME_USEFUL], count[ALD_COUNT_VOLUME_HITS]));
	else
		json_null(j, "volume_hits_useful_percent");
	json_end(j);
}

static void json_differences(struct json *j, const char *key, const struct stats *s,
			     const struct verify_list *list)
{
	json_array(j, key);
	for (uint32_t i = 0; i < list->count; i++) {
		const struct verify_difference *d = &list->one[i];
		char text[2048];

		verify_describe(s->geometry, d, text, sizeof(text));
		json_object(j, NULL);
		json_uint(j, "x", d->x);
		json_uint(j, "y", d->y);
		json_string(j, "question", question_name[d->question]);
		json_string(j, "text", text);
		json_end(j);
	}
	json_end(j);
}

static void json_verified(struct json *j, const struct stats *s)
{
	uint64_t checked = 0, different = 0, inexact = 0;
	struct verify_counts c;

	verify_get(s->geometry, &c);
	if (!c.every)
		return;
	for (int q = 0; q < VERIFY_QUESTIONS; q++) {
		checked += c.checked[q];
		different += c.different[q];
		inexact += c.inexact[q];
	}
	json_object(j, "verify");
	json_uint(j, "every", c.every);
	json_uint(j, "checked", checked);
	json_uint(j, "different", different);
	json_uint(j, "inexact", inexact);
	for (int q = 0; q < VERIFY_QUESTIONS; q++) {
		json_object(j, question_name[q]);
		json_uint(j, "checked", c.checked[q]);
		json_uint(j, "different", c.different[q]);
		json_uint(j, "inexact", c.inexact[q]);
		json_end(j);
	}
	json_differences(j, "first", s, &c.first);
	json_differences(j, "first_inexact", s, &c.first_inexact);
	json_end(j);
}

static void json_structure(struct json *j, const struct stats *s)
{
	struct geometry_counts c = { 0 };
	const char *name;
	double value;

	geometry_get_counts(s->geometry, &c);
	json_object(j, "geometry");
	json_uint(j, "triangles", c.triangles);
	json_uint(j, "effective_triangles", c.effective_triangles);
	json_uint(j, "primitives", c.primitives);
	json_uint(j, "instances", c.instances);
	json_uint(j, "unbounded", c.unbounded);
	json_uint(j, "dropped", c.dropped);
	json_end(j);
	json_object(j, "structure");
	for (uint32_t i = 0; geometry_stat(s->geometry, i, &name, &value); i++)
		json_double(j, name, value);
	json_end(j);
}

static void json_memory(struct json *j, const struct mem_book *book)
{
	uint32_t n = book->count;

	json_object(j, "memory");
	json_uint(j, "now", book->now);
	json_uint(j, "most", book->peak);
	json_array(j, "by_purpose");
	for (uint32_t i = 0; i < n; i++) {
		json_object(j, NULL);
		json_string(j, "purpose", book->account[i].name);
		json_uint(j, "now", book->account[i].now);
		json_uint(j, "most", book->account[i].peak);
		json_end(j);
	}
	json_end(j);
	json_end(j);
}

static void json_head(struct json *j, const struct stats *s)
{
	char hash[24];

	snprintf(hash, sizeof(hash), "%016" PRIx64, s->scene_hash);
	json_string(j, "alidade", s->version);
	json_string(j, "scene", s->scene);
	json_string(j, "scene_hash", hash);
	json_string(j, "output", s->output);
	if (s->animated) {
		json_uint(j, "frame", s->frame);
		json_double(j, "clock", s->clock);
		json_bool(j, "structure_reused", s->reused);
		json_uint(j, "pictures_kept", s->pictures_kept);
	}
	json_string(j, "options", s->options);
	json_string(j, "accelerator", s->accel);
	json_uint(j, "threads", s->threads);
	json_uint(j, "width", s->width);
	json_uint(j, "height", s->height);
	json_bool(j, "complete", s->complete);
	json_uint(j, "pixels", s->render->pixels);
	json_uint(j, "samples", s->render->samples);
	json_uint(j, "nonfinite", s->render->nonfinite);
	if (s->render->nonfinite) {
		json_object(j, "nonfinite_first");
		json_uint(j, "x", s->render->nonfinite_x);
		json_uint(j, "y", s->render->nonfinite_y);
		json_end(j);
	}
	if (s->render->error >= 0)
		json_double(j, "mean_error", s->render->error);
	if (s->render->reached.told)
		reached_json(j, &s->render->reached);
}

bool stats_json(const struct stats *s, FILE *out)
{
	uint64_t cast, hit;
	struct json j;

	json_init(&j, out, JSON_INDENT);
	json_object(&j, NULL);
	json_head(&j, s);
	json_rays(&j, s->render);
	json_counters(&j, s);
	json_verified(&j, s);
	json_structure(&j, s);
	json_memory(&j, s->book);
	json_object(&j, "seconds");
	json_double(&j, "read", s->read_seconds);
	json_double(&j, "build", geometry_build_seconds(s->geometry));
	json_double(&j, "render", s->render->seconds);
	json_double(&j, "write", s->write_seconds);
	json_end(&j);
	sum_rays(s->render, &cast, &hit);
	json_double(&j, "rays_per_second", per_second(cast, s->render->seconds));
	json_end(&j);
	return json_finish(&j);
}
