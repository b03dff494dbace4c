/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The figures of a comparison, for people and for machines.
 */
#include "image/diff.h"

#include <inttypes.h>
#include <math.h>

static const char *const verdict_name[] = { "ok", "warning", "failure", "unlike" };

static const char *space_name(const struct diff_result *r)
{
	return r->encoding == IMAGE_LINEAR ? "linear" : "srgb";
}

static double percent(const struct diff_result *r, uint64_t n)
{
	return r->pixels ? 100.0 * (double)n / (double)r->pixels : 0;
}

static void print_channels(const struct diff_result *r, const char *title, const char *fmt,
			   double all, const double *value, FILE *out)
{
	fprintf(out, "  %-14s ", title);
	fprintf(out, fmt, all);
	for (uint32_t i = 0; i < r->channels && r->channels > 1; i++) {
		fprintf(out, "   %s ", r->name[i]);
		fprintf(out, fmt, value[i]);
	}
	fputc('\n', out);
}

static void print_over(const struct diff_result *r, const char *title, double threshold, uint64_t n,
		       FILE *out)
{
	fprintf(out, "  %-14s %" PRIu64 " pixels (%.4f %%) by more than %g\n", title, n,
		percent(r, n), threshold);
}

static void print_figures(const struct diff_result *r, const struct diff_options *o, FILE *out)
{
	print_channels(r, "mean error", "%+.8f", r->mean, r->channel_mean, out);
	print_channels(r, "RMS error", "%.8f", r->rms, r->channel_rms, out);
	print_channels(r, "largest", "%.8f", r->max, r->channel_max, out);
	if (r->max > 0)
		fprintf(out, "  %-14s at %" PRIu32 ",%" PRIu32 " in %s: %.8f, %.8f\n", "", r->max_x,
			r->max_y, r->name[r->max_channel], r->max_sample[0], r->max_sample[1]);
	fprintf(out, "  %-14s %.8f\n", "p99", r->p99);
	fprintf(out, "  %-14s %.2f dB\n", "PSNR", r->psnr);
	print_over(r, "differ", o->fail, r->over_fail, out);
	if (o->warn < o->fail || o->warn > o->fail)
		print_over(r, "", o->warn, r->over_warn, out);
	fprintf(out, "  %-14s %" PRIu64 " pixels, %" PRIu64 " pixels\n", "not finite",
		r->nonfinite[0], r->nonfinite[1]);
}

void diff_print(const struct diff_result *r, const struct diff_options *o, const char *a,
		const char *b, FILE *out)
{
	static const char *const word[] = { "ok", "warning", "FAILURE", "CANNOT BE COMPARED" };

	fprintf(out, "%s\n%s\n", a, b);
	if (r->verdict != DIFF_UNLIKE) {
		fprintf(out, "  %-14s %" PRIu32 " x %" PRIu32 " pixels,", "compared", r->width,
			r->height);
		for (uint32_t i = 0; i < r->channels; i++)
			fprintf(out, " %s", r->name[i]);
		fprintf(out, ", %s\n",
			r->encoding == IMAGE_LINEAR ? "linear"
						    : "along the sRGB curve, within 0..1");
		print_figures(r, o, out);
	}
	for (uint32_t i = 0; i < r->reasons; i++)
		fprintf(out, "%s: %s\n", word[r->verdict], r->reason[i]);
	if (!r->reasons)
		fprintf(out, "%s\n", word[r->verdict]);
}

static void json_threshold(struct json_writer *j, const char *key, double value)
{
	if (isfinite(value))
		jw_double(j, key, value);
}

static void json_thresholds(const struct diff_options *o, struct json_writer *j)
{
	jw_object(j, "thresholds");
	jw_double(j, "fail", o->fail);
	jw_double(j, "fail_percent", o->fail_percent);
	jw_double(j, "warn", o->warn);
	jw_double(j, "warn_percent", o->warn_percent);
	jw_uint(j, "allow_failures", o->allow_failures);
	jw_bool(j, "allow_nonfinite", o->allow_nonfinite);
	json_threshold(j, "hard_fail", o->hard_fail);
	json_threshold(j, "hard_warn", o->hard_warn);
	json_threshold(j, "max_rmse", o->max_rms);
	json_threshold(j, "max_mean", o->max_mean);
	json_threshold(j, "max_p99", o->max_p99);
	jw_end(j);
}

static void json_figures(const struct diff_result *r, struct json_writer *j)
{
	jw_uint(j, "width", r->width);
	jw_uint(j, "height", r->height);
	jw_string(j, "space", space_name(r));
	jw_double(j, "mean_error", r->mean);
	jw_double(j, "rmse", r->rms);
	jw_double(j, "psnr", r->psnr);
	jw_double(j, "p99", r->p99);
	jw_double(j, "max", r->max);
	jw_object(j, "max_at");
	jw_uint(j, "x", r->max_x);
	jw_uint(j, "y", r->max_y);
	jw_string(j, "channel", r->name[r->max_channel]);
	jw_double(j, "a", r->max_sample[0]);
	jw_double(j, "b", r->max_sample[1]);
	jw_end(j);
	jw_array(j, "channels");
	for (uint32_t i = 0; i < r->channels; i++) {
		jw_object(j, NULL);
		jw_string(j, "name", r->name[i]);
		jw_double(j, "mean_error", r->channel_mean[i]);
		jw_double(j, "rmse", r->channel_rms[i]);
		jw_double(j, "max", r->channel_max[i]);
		jw_end(j);
	}
	jw_end(j);
	jw_uint(j, "over_fail", r->over_fail);
	jw_uint(j, "over_warn", r->over_warn);
	jw_uint(j, "nonfinite_a", r->nonfinite[0]);
	jw_uint(j, "nonfinite_b", r->nonfinite[1]);
	jw_uint(j, "nonfinite_any", r->nonfinite_any);
	jw_uint(j, "nonfinite_unlike", r->nonfinite_unlike);
}

void diff_json(const struct diff_result *r, const struct diff_options *o, const char *a,
	       const char *b, struct json_writer *j)
{
	jw_object(j, NULL);
	jw_string(j, "a", a);
	jw_string(j, "b", b);
	jw_string(j, "verdict", verdict_name[r->verdict]);
	jw_array(j, "reasons");
	for (uint32_t i = 0; i < r->reasons; i++)
		jw_string(j, NULL, r->reason[i]);
	jw_end(j);
	jw_uint(j, "pixels", r->pixels);
	if (r->verdict != DIFF_UNLIKE)
		json_figures(r, j);
	json_thresholds(o, j);
	jw_end(j);
}
