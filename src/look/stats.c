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
#include "base/json_write.h"
#include "look/memory.h"
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

static void text_memory(const struct stats *s, FILE *out)
{
	const struct mem_book *book = s->book;
	uint32_t n = book->count;

	fprintf(out, "%-28s %15s %15s\n", "memory, MiB", "now", "most");
	for (uint32_t i = 0; i < n; i++)
		fprintf(out, "  %-26s %15.2f %15.2f\n", book->account[i].name,
			(double)book->account[i].now / 1048576, (double)book->account[i].peak / 1048576);
	fprintf(out, "  %-26s %15.2f %15.2f\n", "all", (double)book->now / 1048576,
		(double)book->peak / 1048576);
	if (s->process_most)
		fprintf(out, "  %-26s %15s %15.2f\n", "process", "", (double)s->process_most / 1048576);
	memory_building_text(s->geometry, out);
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

static void text_frame(const struct stats *s, FILE *out)
{
	struct geometry_trees t;

	geometry_get_trees(s->geometry, &t);
	fprintf(out, "frame %u, clock %g, ", s->frame, s->clock);
	if (s->reused)
		fputs("structure of an earlier frame", out);
	else
		fprintf(out, "structures kept %u, refitted %u, built %u", t.kept, t.refitted, t.built);
	fprintf(out, ", pictures kept %" PRIu64 "\n", s->pictures_kept);
}

void stats_text(const struct stats *s, FILE *out)
{
	fprintf(out, "alidade %s: %s, %s, %s, %u thread%s%s\n", s->version, s->scene, s->options, s->accel,
		s->threads, s->threads == 1 ? "" : "s", s->complete ? "" : ", interrupted");
	if (s->animated)
		text_frame(s, out);
	text_rays(s->render, out);
	if (s->render->error >= 0)
		fprintf(out, "%-28s %15.6f\n", "mean standard error", s->render->error);
	text_counters(s, out);
	text_verified(s, out);
	text_structure(s, out);
	text_memory(s, out);
	text_time(s, out);
}

static void json_rays(struct json_writer *j, const struct render_counts *r)
{
	uint64_t cast, hit;

	sum_rays(r, &cast, &hit);
	jw_object(j, "rays");
	for (int k = 0; k <= RENDER_RAY_KINDS; k++) {
		bool all = k == RENDER_RAY_KINDS;
		uint64_t c = all ? cast : r->cast[k], h = all ? hit : r->hit[k];

		jw_object(j, all ? "all" : ray_name[k]);
		jw_uint(j, "cast", c);
		jw_uint(j, "hit", h);
		jw_uint(j, "missed", c - h);
		jw_end(j);
	}
	jw_end(j);
}

static void json_counters(struct json_writer *j, const struct stats *s)
{
	uint64_t count[ALD_COUNT_MAX] = { 0 };

	geometry_get_counters(s->geometry, count);
	jw_object(j, "tests");
	for (size_t i = 0; i < COUNTERS; i++)
		jw_uint(j, counter_table[i].key, count[counter_table[i].counter]);
	jw_uint(j, "volume_misses", count[ALD_COUNT_VOLUME_TESTS] - count[ALD_COUNT_VOLUME_HITS]);
	if (count[ALD_COUNT_VOLUME_HITS])
		jw_double(j, "volume_hits_useful_percent",
			  percent(count[ALD_COUNT_VOLUME_USEFUL], count[ALD_COUNT_VOLUME_HITS]));
	else
		jw_null(j, "volume_hits_useful_percent");
	jw_end(j);
}

static void json_differences(struct json_writer *j, const char *key, const struct stats *s,
			     const struct verify_list *list)
{
	jw_array(j, key);
	for (uint32_t i = 0; i < list->count; i++) {
		const struct verify_difference *d = &list->one[i];
		char text[2048];

		verify_describe(s->geometry, d, text, sizeof(text));
		jw_object(j, NULL);
		jw_uint(j, "x", d->x);
		jw_uint(j, "y", d->y);
		jw_string(j, "question", question_name[d->question]);
		jw_string(j, "text", text);
		jw_end(j);
	}
	jw_end(j);
}

static void json_verified(struct json_writer *j, const struct stats *s)
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
	jw_object(j, "verify");
	jw_uint(j, "every", c.every);
	jw_uint(j, "checked", checked);
	jw_uint(j, "different", different);
	jw_uint(j, "inexact", inexact);
	for (int q = 0; q < VERIFY_QUESTIONS; q++) {
		jw_object(j, question_name[q]);
		jw_uint(j, "checked", c.checked[q]);
		jw_uint(j, "different", c.different[q]);
		jw_uint(j, "inexact", c.inexact[q]);
		jw_end(j);
	}
	json_differences(j, "first", s, &c.first);
	json_differences(j, "first_inexact", s, &c.first_inexact);
	jw_end(j);
}

static void json_structure(struct json_writer *j, const struct stats *s)
{
	struct geometry_counts c = { 0 };
	const char *name;
	double value;

	geometry_get_counts(s->geometry, &c);
	jw_object(j, "geometry");
	jw_uint(j, "triangles", c.triangles);
	jw_uint(j, "effective_triangles", c.effective_triangles);
	jw_uint(j, "primitives", c.primitives);
	jw_uint(j, "instances", c.instances);
	jw_uint(j, "unbounded", c.unbounded);
	jw_uint(j, "dropped", c.dropped);
	jw_end(j);
	jw_object(j, "structure");
	for (uint32_t i = 0; geometry_stat(s->geometry, i, &name, &value); i++)
		jw_double(j, name, value);
	jw_end(j);
}

static void json_memory(struct json_writer *j, const struct stats *s)
{
	const struct mem_book *book = s->book;
	uint32_t n = book->count;

	jw_object(j, "memory");
	jw_uint(j, "now", book->now);
	jw_uint(j, "most", book->peak);
	jw_array(j, "by_purpose");
	for (uint32_t i = 0; i < n; i++) {
		jw_object(j, NULL);
		jw_string(j, "purpose", book->account[i].name);
		jw_uint(j, "now", book->account[i].now);
		jw_uint(j, "most", book->account[i].peak);
		jw_end(j);
	}
	jw_end(j);
	if (s->process_most)
		jw_uint(j, "process_most", s->process_most);
	else
		jw_null(j, "process_most");
	memory_building_json(j, s->geometry);
	jw_end(j);
}

static void json_frame(struct json_writer *j, const struct stats *s)
{
	struct geometry_trees t;

	geometry_get_trees(s->geometry, &t);
	jw_uint(j, "frame", s->frame);
	jw_double(j, "clock", s->clock);
	jw_bool(j, "structure_reused", s->reused);
	jw_object(j, "structures");
	jw_uint(j, "kept", t.kept);
	jw_uint(j, "refitted", t.refitted);
	jw_uint(j, "built", t.built);
	jw_end(j);
	jw_uint(j, "pictures_kept", s->pictures_kept);
}

static void json_head(struct json_writer *j, const struct stats *s)
{
	char hash[24];

	snprintf(hash, sizeof(hash), "%016" PRIx64, s->scene_hash);
	jw_string(j, "alidade", s->version);
	jw_string(j, "scene", s->scene);
	jw_string(j, "scene_hash", hash);
	jw_string(j, "output", s->output);
	if (s->animated)
		json_frame(j, s);
	jw_string(j, "options", s->options);
	jw_string(j, "accelerator", s->accel);
	jw_uint(j, "threads", s->threads);
	jw_uint(j, "width", s->width);
	jw_uint(j, "height", s->height);
	jw_bool(j, "complete", s->complete);
	jw_uint(j, "pixels", s->render->pixels);
	jw_uint(j, "samples", s->render->samples);
	jw_uint(j, "nonfinite", s->render->nonfinite);
	if (s->render->nonfinite) {
		jw_object(j, "nonfinite_first");
		jw_uint(j, "x", s->render->nonfinite_x);
		jw_uint(j, "y", s->render->nonfinite_y);
		jw_end(j);
	}
	if (s->render->error >= 0)
		jw_double(j, "mean_error", s->render->error);
	if (s->render->reached.told)
		reached_json(j, &s->render->reached);
}

bool stats_json(const struct stats *s, FILE *out)
{
	uint64_t cast, hit;
	struct json_writer j;

	jw_init(&j, out, JW_INDENT);
	jw_object(&j, NULL);
	json_head(&j, s);
	json_rays(&j, s->render);
	json_counters(&j, s);
	json_verified(&j, s);
	json_structure(&j, s);
	json_memory(&j, s);
	jw_object(&j, "seconds");
	jw_double(&j, "read", s->read_seconds);
	jw_double(&j, "build", geometry_build_seconds(s->geometry));
	jw_double(&j, "render", s->render->seconds);
	jw_double(&j, "write", s->write_seconds);
	jw_end(&j);
	sum_rays(s->render, &cast, &hit);
	jw_double(&j, "rays_per_second", per_second(cast, s->render->seconds));
	jw_end(&j);
	return jw_finish(&j);
}
