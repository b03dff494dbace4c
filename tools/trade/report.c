/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What was found, as text and as JSON; columns are those of columns.c.
 */
#include <config.h>

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "base/json_write.h"
#include "trade.h"

#define SPREAD_WIDE 0.2 /* of the median: times that say little */

char *trade_text(struct trade *t, const char *fmt, ...)
{
	va_list ap, again;
	char *out;
	int n;

	va_start(ap, fmt);
	va_copy(again, ap);
	n = vsnprintf(NULL, 0, fmt, ap);
	va_end(ap);
	out = n < 0 ? NULL : arena_alloc(&t->arena, (size_t)n + 1);
	if (out)
		vsnprintf(out, (size_t)n + 1, fmt, again);
	else
		diag_no_memory(&t->diag, "a text", n < 0 ? 0 : (size_t)n + 1);
	va_end(again);
	return out;
}

/* A word for a shell. */
static void put_word(FILE *out, const char *s)
{
	static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=:,+@%-";

	if (*s && strspn(s, plain) == strlen(s)) {
		fputs(s, out);
		return;
	}
	fputc('\'', out);
	for (; *s; s++) {
		if (*s == '\'')
			fputs("'\\''", out);
		else
			fputc(*s, out);
	}
	fputc('\'', out);
}

const char *trade_command(struct trade *t, const struct trade_setting *s)
{
	const char *option[TRADE_FACTORS * TRADE_LEVEL_OPTIONS + 1];
	uint32_t n = trade_options(t, s, option);
	char *text = NULL, *kept;
	size_t size;
	FILE *out = open_memstream(&text, &size);

	if (!out)
		return "";
	fputs("alidade", out);
	for (uint32_t i = 0; i < t->base_count; i++) {
		fputc(' ', out);
		put_word(out, t->base[i]);
	}
	for (uint32_t i = 0; i < n; i++) {
		fputc(' ', out);
		put_word(out, option[i]);
	}
	fputs(*t->scene == '-' ? " -- " : " ", out);
	put_word(out, t->scene);
	kept = fclose(out) ? NULL : trade_text(t, "%s", text);
	free(text);
	return kept ? kept : "";
}

static double first_time(const struct trade_setting *s, enum trade_value clock)
{
	return s->range[clock].median;
}

uint32_t trade_order(const struct trade *t, const struct trade_setting **order)
{
	uint32_t n = 0;

	for (uint32_t i = 0; i < t->settings; i++) {
		const struct trade_setting *s = &t->setting[i];
		uint32_t k = n;

		if (!trade_measured(t, s))
			continue;
		/* There are some dozens: insertion needs no way to hand the clock to a comparison. */
		for (; k && first_time(order[k - 1], t->clock) > first_time(s, t->clock); k--)
			order[k] = order[k - 1];
		order[k] = s;
		n++;
	}
	return n;
}

static void value_with_unit(enum trade_value v, double x, char *out, size_t size)
{
	char text[40];

	trade_value_text(v, x, text, sizeof(text));
	snprintf(out, size, "%s%s%s", text, *trade_column[v].unit ? " " : "", trade_column[v].unit);
}

static const char *ask_text(struct trade *t, const struct trade_ask *a)
{
	enum trade_value v = a->kind == TRADE_FASTEST ? t->error : t->clock;
	char bound[64];

	value_with_unit(v, a->bound, bound, sizeof(bound));
	if (a->own)
		return a->kind == TRADE_FASTEST ? "Fastest that is as accurate as the default" :
						  "Most accurate that is as fast as the default";
	return trade_text(t, "%s with %s of at most %s", a->kind == TRADE_FASTEST ? "Fastest" : "Most accurate",
			  trade_column[v].title, bound);
}

static const char *range_text(struct trade *t, enum trade_value v, const struct trade_range *r)
{
	char median[40], low[40], high[40];

	trade_value_text(v, r->median, median, sizeof(median));
	trade_value_text(v, r->low, low, sizeof(low));
	trade_value_text(v, r->high, high, sizeof(high));
	return trade_text(t, "%s%s%s (%s to %s)", median, *trade_column[v].unit ? " " : "", trade_column[v].unit,
			  low, high);
}

static const char *figures_text(struct trade *t, const struct trade_setting *s)
{
	const struct trade_setting *base = &t->setting[0];
	double times = base->range[t->clock].median / s->range[t->clock].median;
	const char *than = "";

	if (s != base && trade_measured(t, base))
		than = times >= 1 ? trade_text(t, ", %.3g times as fast as the default", times) :
				    trade_text(t, ", %.3g times the default's time", 1 / times);
	return trade_text(t, "%s %s, %s %s%s", trade_column[t->clock].title,
			  range_text(t, t->clock, &s->range[t->clock]), trade_column[t->error].title,
			  range_text(t, t->error, &s->range[t->error]), than);
}

const char *trade_verdict_text(struct trade *t, const struct trade_verdict *v)
{
	const char *what = ask_text(t, &v->ask);

	if (!v->pick)
		return trade_text(t, "%s: nothing was measured", what);
	if (v->outcome == TRADE_NOTHING)
		return trade_text(t, "%s: none; the nearest is %s: %s", what, v->pick->label,
				  figures_text(t, v->pick));
	return trade_text(t, "%s: %s: %s", what, v->pick->label, figures_text(t, v->pick));
}

static const char *ties_text(struct trade *t, const struct trade_verdict *v)
{
	const char *text = "No verdict: times are not told apart from those of ";

	for (uint32_t i = 0; i < v->ties && i < 4 && text; i++)
		text = trade_text(t, "%s%s%s", text, i ? ", " : "", v->tied[i]->label);
	return v->ties > 4 && text ? trade_text(t, "%s and %u more", text, v->ties - 4) : text;
}

const char *trade_outcome_text(struct trade *t, const struct trade_verdict *v)
{
	switch (v->outcome) {
	case TRADE_TIED: return ties_text(t, v);
	case TRADE_UNSURE:
		return "No verdict: too few runs to tell how times vary; give it more --budget";
	default: return NULL;
	}
}

const char *trade_confirm_text(struct trade *t, const struct trade_verdict *v)
{
	const char *held[] = { "not as found before", "as found before" };
	const char *drift = "";

	if (!v->time_again.count)
		return NULL;
	if (v->pacer)
		drift = trade_text(t, " if the machine's drift is allowed for (%s took %.3f times as long as then)",
				   v->pacer == t->setting ? "the default" : v->pacer->label, v->drift);
	return trade_text(t, "Drawn again %u times: %s %s, %s%s; %s %s, %s; the bound is %s.", v->time_again.count,
			  trade_column[t->clock].title, range_text(t, t->clock, &v->time_again),
			  held[v->time_holds], drift, trade_column[t->error].title,
			  range_text(t, t->error, &v->error_again), held[v->error_holds],
			  v->bound_holds ? "kept" : "NOT kept");
}

const char *trade_caution_text(struct trade *t, const struct trade_setting *s)
{
	char wrong[64];

	if (!s->inexact)
		return NULL;
	if (!(s->checked > 0))
		return trade_text(t, "Its hits are inexact: %s. How many are wrong here was not checked.", s->inexact);
	value_with_unit(TRADE_WRONG, s->range[TRADE_WRONG].median, wrong, sizeof(wrong));
	return trade_text(t, "Its hits are inexact: %s. Wrong here: %s.", s->inexact, wrong);
}

static const char *reference_note(struct trade *t)
{
	const struct trade_reference *r = &t->reference;

	if (!r->options)
		return r->noise > 0 ? trade_text(t, "Errors are against %s, whose rounding alone is an error of "
						    "%.2g.", r->file, r->noise) :
				      trade_text(t, "Errors are against %s.", r->file);
	if (r->pictures > 1)
		return trade_text(t, "Errors are against the mean of two pictures with %s, which is itself off by "
				     "%.2g (RMSE); errors near that are upper bounds.",
				  *r->options ? r->options : "the options given", r->noise);
	return trade_text(t, "Errors are against a picture with %s.",
			  *r->options ? r->options : "the options given");
}

static const char *sameness_note(struct trade *t)
{
	uint32_t measured = 0, equal = 0;

	for (uint32_t i = 0; i < t->settings; i++) {
		measured += trade_measured(t, &t->setting[i]);
		equal += trade_measured(t, &t->setting[i]) && t->setting[i].range[TRADE_MAX].high <= 0;
	}
	if (measured && equal == measured)
		return "All settings draw the reference to the bit: there is only time to gain.";
	if (!t->random)
		return "Pictures do not depend on random numbers here, so errors have no spread.";
	return trade_text(t, "Runs differ by their random numbers%s.",
			  t->seed ? " (none here: --seed was given)" : ", so errors have a spread too");
}

static const char *spread_note(struct trade *t)
{
	const struct trade_range *r = &t->setting[0].range[t->clock];
	double spread = (r->high - r->low) / r->median;

	if (!(spread > SPREAD_WIDE))
		return "";
	return trade_text(t, "The default's time varies by %.0f %%: the machine is busy with something else, or the "
			     "picture is too small to be timed. --clock=cpu may be steadier.", 100 * spread);
}

static bool has_wrong(const struct trade *t)
{
	for (uint32_t i = 0; i < t->settings; i++) {
		if (t->setting[i].checked > 0)
			return true;
	}
	return false;
}

const char *trade_note(struct trade *t, uint32_t i)
{
	const struct trade_range *r = &t->setting[0].range[t->clock];

	switch (i) {
	case 0: return reference_note(t);
	case 1: return sameness_note(t);
	case 2:
		return trade_text(t, "Times are medians; the interval after one holds the true median with %.0f %% "
				     "confidence (%u runs of the default) as long as the machine keeps its pace: "
				     "another hour's times may differ by more, all in about the same ratio.",
				  100 * r->confidence, r->count);
	case 3: return spread_note(t);
	case 4: return has_wrong(t) ? "" : "Nearest hits were not checked against exact arithmetic.";
	case 5:
		return t->complete ? "" : "Not all that was planned has been measured; the same command goes on.";
	default: return NULL;
	}
}

static bool has_nonfinite(const struct trade *t)
{
	for (uint32_t i = 0; i < t->settings; i++) {
		if (t->setting[i].range[TRADE_NONFINITE].high > 0)
			return true;
	}
	return false;
}

bool trade_shown(const struct trade *t, enum trade_value v, bool wide)
{
	if (v == TRADE_WRONG)
		return has_wrong(t);
	if (v == TRADE_NONFINITE)
		return has_nonfinite(t);
	return wide || trade_column[v].narrow || v == t->clock || v == t->error;
}

static void print_row(const struct trade *t, const struct trade_setting *s, FILE *out)
{
	char text[96], low[40], high[40];

	fputs(s->front ? "*" : " ", out);
	for (int v = 0; v < TRADE_VALUES; v++) {
		if (!trade_shown(t, v, false))
			continue;
		trade_value_text(v, s->range[v].median, text, sizeof(text));
		fprintf(out, " %9s", text);
		if (v != (int)t->clock)
			continue;
		trade_value_text(v, s->range[v].low, low, sizeof(low));
		trade_value_text(v, s->range[v].high, high, sizeof(high));
		snprintf(text, sizeof(text), "%s..%s", low, high);
		fprintf(out, " %-16s", text);
	}
	fprintf(out, "  %s%s\n", s->label, s->inexact ? "  (inexact)" : "");
}

static void print_table(const struct trade *t, FILE *out)
{
	const struct trade_setting *order[TRADE_SETTINGS];
	uint32_t n = trade_order(t, order);
	char title[64];

	fputc(' ', out);
	for (int v = 0; v < TRADE_VALUES; v++) {
		if (!trade_shown(t, v, false))
			continue;
		snprintf(title, sizeof(title), "%s%s%s", trade_column[v].title, *trade_column[v].unit ? " " : "",
			 trade_column[v].unit);
		fprintf(out, " %9s", title);
		if (v == (int)t->clock)
			fprintf(out, " %-16s", "between");
	}
	fputs("  setting\n", out);
	for (uint32_t i = 0; i < n; i++)
		print_row(t, order[i], out);
	fputs("* the front: nothing else is both faster and as accurate\n", out);
	for (uint32_t i = 0; i < t->settings; i++) {
		const struct trade_setting *s = &t->setting[i];

		if (!s->runs || s->failure)
			fprintf(out, "not %s: %s: %s\n", s->runs ? "repeated" : "measured", s->label,
				s->failure ? s->failure : "no time left");
	}
}

void trade_print(struct trade *t, FILE *out)
{
	const char *note;

	fprintf(out, "alidade-trade %s: %s, %u x %u\n", PACKAGE_VERSION, t->scene, t->about.width,
		t->about.height);
	print_table(t, out);
	for (uint32_t i = 0; (note = trade_note(t, i)); i++) {
		if (*note)
			fprintf(out, "%s\n", note);
	}
	for (uint32_t i = 0; i < t->verdicts; i++) {
		const struct trade_verdict *v = &t->verdict[i];
		const char *outcome = trade_outcome_text(t, v), *again = trade_confirm_text(t, v);
		const char *caution = v->pick ? trade_caution_text(t, v->pick) : NULL;

		fprintf(out, "\n%s\n", trade_verdict_text(t, v));
		if (outcome)
			fprintf(out, "  %s\n", outcome);
		if (caution)
			fprintf(out, "  %s\n", caution);
		if (again)
			fprintf(out, "  %s\n", again);
		if (v->pick)
			fprintf(out, "  %s\n", trade_command(t, v->pick));
	}
}

static void json_setting(struct trade *t, struct json_writer *j, const struct trade_setting *s)
{
	static const char *const stage[] = { "default", "alone", "parameter", "combined" };
	const char *option[TRADE_FACTORS * TRADE_LEVEL_OPTIONS + 1];
	uint32_t n = trade_options(t, s, option);

	jw_object(j, NULL);
	jw_string(j, "setting", s->label);
	jw_string(j, "stage", stage[s->stage]);
	jw_array(j, "options");
	for (uint32_t i = 0; i < n; i++)
		jw_string(j, NULL, option[i]);
	jw_end(j);
	jw_string(j, "command", trade_command(t, s));
	jw_uint(j, "runs", s->runs);
	jw_bool(j, "measured", trade_measured(t, s));
	jw_bool(j, "front", s->front);
	jw_string(j, "failure", s->failure);
	jw_string(j, "inexact", s->inexact);
	if (s->checked > 0)
		jw_double(j, "hits_checked", s->checked);
	else if (s->unverified)
		jw_string(j, "hits_unchecked", s->unverified);
	jw_object(j, "values");
	for (int v = 0; v < TRADE_VALUES; v++) {
		if (!s->range[v].count)
			continue;
		jw_object(j, trade_column[v].key);
		jw_double(j, "median", s->range[v].median);
		jw_double(j, "low", s->range[v].low);
		jw_double(j, "high", s->range[v].high);
		jw_double(j, "confidence", s->range[v].confidence);
		jw_end(j);
	}
	jw_end(j);
	jw_end(j);
}

static void json_verdict(struct trade *t, struct json_writer *j, const struct trade_verdict *v)
{
	static const char *const outcome[] = { "clear", "tied", "unsure", "none" };

	jw_object(j, NULL);
	jw_string(j, "kind", v->ask.kind == TRADE_FASTEST ? "fastest" : "most_accurate");
	jw_string(j, "of", trade_column[v->ask.kind == TRADE_FASTEST ? t->error : t->clock].key);
	jw_double(j, "bound", v->ask.bound);
	jw_bool(j, "asked", !v->ask.own);
	jw_string(j, "outcome", outcome[v->outcome]);
	jw_string(j, "setting", v->pick ? v->pick->label : NULL);
	jw_string(j, "command", v->pick ? trade_command(t, v->pick) : NULL);
	jw_string(j, "text", trade_verdict_text(t, v));
	jw_string(j, "caution", v->pick ? trade_caution_text(t, v->pick) : NULL);
	if (v->time_again.count) {
		jw_object(j, "again");
		jw_uint(j, "runs", v->time_again.count);
		jw_double(j, trade_column[t->clock].key, v->time_again.median);
		jw_double(j, "drift", v->drift);
		jw_bool(j, "time_holds", v->time_holds);
		jw_double(j, trade_column[t->error].key, v->error_again.median);
		jw_bool(j, "error_holds", v->error_holds);
		jw_bool(j, "bound_holds", v->bound_holds);
		jw_end(j);
	}
	jw_array(j, "tied");
	for (uint32_t i = 0; i < v->ties; i++)
		jw_string(j, NULL, v->tied[i]->label);
	jw_end(j);
	jw_end(j);
}

static void json_reference(const struct trade *t, struct json_writer *j)
{
	const struct trade_reference *r = &t->reference;

	jw_object(j, "reference");
	jw_string(j, "file", r->file);
	jw_string(j, "options", r->options);
	jw_uint(j, "pictures", r->pictures);
	jw_double(j, "noise", r->noise);
	jw_end(j);
}

static void json_head(struct trade *t, struct json_writer *j)
{
	char hash[24];
	const char *note;

	snprintf(hash, sizeof(hash), "%016" PRIx64, t->about.hash);
	jw_string(j, "alidade", PACKAGE_VERSION);
	jw_string(j, "scene", t->scene);
	jw_string(j, "scene_hash", hash);
	jw_uint(j, "width", t->about.width);
	jw_uint(j, "height", t->about.height);
	jw_bool(j, "complete", t->complete);
	jw_bool(j, "random", t->random);
	jw_string(j, "clock", trade_column[t->clock].key);
	jw_string(j, "error", trade_column[t->error].key);
	jw_string(j, "space", t->space == DIFF_LINEAR ? "linear" : "srgb");
	jw_double(j, "changed_above", t->changed);
	jw_uint(j, "runs_measured_now", t->made);
	jw_uint(j, "runs_kept", t->kept);
	jw_array(j, "notes");
	for (uint32_t i = 0; (note = trade_note(t, i)); i++) {
		if (*note)
			jw_string(j, NULL, note);
	}
	jw_end(j);
}

bool trade_json(struct trade *t, FILE *out)
{
	struct json_writer j;

	jw_init(&j, out, JW_INDENT);
	jw_object(&j, NULL);
	json_head(t, &j);
	json_reference(t, &j);
	jw_array(&j, "settings");
	for (uint32_t i = 0; i < t->settings; i++)
		json_setting(t, &j, &t->setting[i]);
	jw_end(&j);
	jw_array(&j, "recommendations");
	for (uint32_t i = 0; i < t->verdicts; i++)
		json_verdict(t, &j, &t->verdict[i]);
	jw_end(&j);
	jw_end(&j);
	return jw_finish(&j);
}
