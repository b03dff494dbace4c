/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Which settings are measured. First each level alone, everything else as by default: that shows what each
 * choice costs and gains. Then those levels together that were worth something alone; see combine.c.
 */
#include <config.h>

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "accel/load.h"
#include "accel/param.h"
#include "settings.h"
#include "trade.h"

/* A factor and levels of it, of one option; what this alidade does not have is left out. */
static const struct {
	const char *factor, *levels;
	bool radiosity; /* only where the scene has it */
} default_sweep[] = {
	{ "aa", "aa=none,2,3,4,pov1,pov2,pov2:threshold=0.1", false },
	{ "aa", "spp=4,16,64", false },
	{ "aa", "spp=256", true },
	{ "aa", "noise=0.02,0.005", false },
	{ "indirect", "indirect=off,exact+indirect-samples=32,exact+indirect-samples=128,"
		      "exact+indirect-samples=2048", true },
	{ "indirect", "indirect=cache,cache+indirect-error=0.5,cache+indirect-error=2,cache+indirect-error=4,"
		      "cache+indirect-error=4+indirect-samples=32", true },
	{ "precision", "precision=exact,fast", false },
	{ "accel", "accel=all", false },
};
#define DEFAULT_SWEEPS (sizeof(default_sweep) / sizeof(*default_sweep))

/* An option of alidade that takes a value. */
static const struct option_spec *find_option(const char *name, size_t n)
{
	for (const struct option_spec *o = settings_program.option; o->name; o++) {
		if (strlen(o->name) == n && !strncmp(o->name, name, n) && o->takes == OPTION_ARG)
			return o;
	}
	return NULL;
}

/* The length of NAME in "NAME=...", 0: that is something else. */
static size_t name_length(const char *s)
{
	size_t n = 0;

	while (islower((unsigned char)s[n]) || isdigit((unsigned char)s[n]) || s[n] == '-')
		n++;
	return s[n] == '=' ? n : 0;
}

/* Where the option that begins at s ends: at a + after which another one follows. */
static size_t option_length(const char *s)
{
	size_t n = 0;

	while (s[n] && !(s[n] == '+' && find_option(s + n + 1, name_length(s + n + 1))))
		n++;
	return n;
}

enum status trade_level_parse(struct trade *t, const char *text, struct trade_level *l)
{
	memset(l, 0, sizeof(*l));
	l->text = trade_text(t, "%s", text);
	if (!l->text)
		return STATUS_FAILED;
	for (const char *s = text; *s;) {
		size_t n = option_length(s), name = name_length(s);

		if (!find_option(s, name))
			return diag_fail(&t->diag, STATUS_USAGE, NULL,
					 "\"%s\": alidade has no option --%.*s that takes a value", text,
					 (int)strcspn(s, "=+"), s);
		if (l->options == TRADE_LEVEL_OPTIONS)
			return diag_fail(&t->diag, STATUS_USAGE, NULL, "\"%s\": more than %d options", text,
					 TRADE_LEVEL_OPTIONS);
		l->option[l->options] = trade_text(t, "--%.*s", (int)n, s);
		if (!l->option[l->options])
			return STATUS_FAILED;
		if (name == 5 && !strncmp(s, "accel", 5))
			l->accel = l->option[l->options] + strlen("--accel=");
		l->options++;
		s += n + (s[n] == '+');
	}
	return STATUS_OK;
}

static enum status add_level(struct trade *t, struct trade_factor *f, const char *text)
{
	struct trade_level l;
	struct diag silent = { 0 };
	enum status st = trade_level_parse(t, text, &l);
	size_t name = strlen(f->name);

	if (!st)
		st = trade_allowed(t, l.option, l.options, f->by_default ? &silent : &t->diag);
	if (st)
		return f->by_default ? STATUS_OK : st;
	if (f->by_default && trade_changes_nothing(t, &l))
		return STATUS_OK;
	if (!strncmp(l.text, f->name, name) && l.text[name] == '=')
		l.text += name + 1;
	for (uint32_t i = 0; i < f->levels; i++) {
		if (!strcmp(f->level[i].text, l.text))
			return STATUS_OK;
	}
	if (f->levels == TRADE_LEVELS)
		return diag_fail(&t->diag, STATUS_USAGE, NULL, "--sweep=%s: more than %d levels", f->name,
				 TRADE_LEVELS);
	f->level[f->levels++] = l;
	return STATUS_OK;
}

struct adding {
	struct trade *t;
	struct trade_factor *factor;
	const char *only; /* a plugin's name, whose parameters are varied; NULL: all, as they are */
	enum status status;
};

static void add_text(struct adding *a, const char *fmt, const char *name, const char *key, const char *value)
{
	const char *text = trade_text(a->t, fmt, name, key, value);

	if (!a->status)
		a->status = text ? add_level(a->t, a->factor, text) : STATUS_FAILED;
}

/* Numbers a fourth and four times of what they are by default; of choices every other. */
static void add_parameter(struct adding *a, const char *plugin, const ald_param *p)
{
	double value[2] = { p->def / 4, p->def * 4 };
	char text[64];
	int from = 0, to = 1;

	if (p->type == ALD_BOOL || p->type == ALD_CHOICE) {
		from = (int)p->min;
		to = (int)p->max;
	} else if (p->def <= 0) {
		value[0] = p->min;
		value[1] = p->max;
	}
	for (int i = from; i <= to; i++) {
		double x = p->type == ALD_BOOL || p->type == ALD_CHOICE ? i : value[i];

		x = p->type == ALD_INT ? round(x) : x;
		x = x < p->min ? p->min : x > p->max ? p->max : x;
		param_value_text(p, x, text, sizeof(text));
		if (x < p->def || x > p->def)
			add_text(a, "accel=%s:%s=%s", plugin, p->name, text);
	}
}

static void add_plugin(void *arg, const struct accel_choice *c)
{
	struct adding *a = arg;
	const char *base = a->t->base_accel;

	if (!a->only) {
		if (strcmp(c->plugin->name, base) != 0)
			add_text(a, "accel=%s", c->plugin->name, NULL, NULL);
		return;
	}
	for (const ald_param *p = c->plugin->params; p && p->name && !strcmp(a->only, c->plugin->name); p++)
		add_parameter(a, c->plugin->name, p);
}

static enum status add_plugins(struct trade *t, struct trade_factor *f, const char *only)
{
	struct adding a = { t, f, only, STATUS_OK };
	struct diag silent = { 0 };
	enum status st = accel_list(add_plugin, &a, &silent);

	return st ? st : a.status;
}

/* "octree:leaf=1/2,depth=4/8" is four levels. */
static enum status expand(struct trade *t, struct trade_factor *f, const char *text)
{
	const char *from = strchr(text, ':'), *cut = from ? strpbrk(from, "/|") : NULL, *value = cut;
	size_t n, rest;
	enum status st = STATUS_OK;

	if (!strcmp(text, "accel=all"))
		return add_plugins(t, f, NULL);
	n = strlen(text);
	if (n > 8 && !strncmp(text, "accel=", 6) && !strcmp(text + n - 2, ":*")) {
		const char *plain = trade_text(t, "%.*s", (int)(n - 2), text);

		st = plain ? add_level(t, f, plain) : STATUS_FAILED;
		return st ? st : add_plugins(t, f, plain + 6);
	}
	if (!cut)
		return add_level(t, f, text);
	while (value > from && value[-1] != '=')
		value--;
	if (value == from)
		return add_level(t, f, text);
	rest = strcspn(cut, ",+");
	for (const char *v = value; !st; v += n + 1) {
		char *one;

		n = strcspn(v, "/|,+");
		one = trade_text(t, "%.*s%.*s%s", (int)(value - text), text, (int)n, v, cut + rest);
		st = one ? expand(t, f, one) : STATUS_FAILED;
		if (v[n] != '/' && v[n] != '|')
			break;
	}
	return st;
}

/* What comes before the comma at which a new level begins: one is no more of the level before it if a name
 * follows that is no option, as in octree:leaf=1,depth=4. */
static size_t item_length(const char *s)
{
	size_t n = strcspn(s, ",");

	while (s[n] == ',' && name_length(s + n + 1) && !find_option(s + n + 1, name_length(s + n + 1)))
		n += 1 + strcspn(s + n + 1, ",");
	return n;
}

static enum status sweep_items(struct trade *t, struct trade_factor *f, const char *text)
{
	const char *option = text;
	size_t length = name_length(text), n;
	enum status st = STATUS_OK;

	for (const char *s = text; *s && !st; s += n + (s[n] == ',')) {
		size_t name = name_length(s);
		char *item;

		n = item_length(s);
		if (find_option(s, name)) {
			option = s;
			length = name;
			item = trade_text(t, "%.*s", (int)n, s);
		} else {
			item = trade_text(t, "%.*s=%.*s", (int)length, option, (int)n, s);
		}
		st = item ? expand(t, f, item) : STATUS_FAILED;
	}
	return st;
}

/* The factor of that name, made if it is new; NULL after an error. */
static struct trade_factor *factor_named(struct trade *t, const char *name, size_t length, bool by_default)
{
	struct trade_factor *f = t->factor;

	while (f < t->factor + t->factors && (strlen(f->name) != length || strncmp(f->name, name, length) != 0))
		f++;
	if (f < t->factor + t->factors)
		return f;
	if (t->factors == TRADE_FACTORS || length >= sizeof(f->name)) {
		diag_report(&t->diag, DIAG_ERROR, NULL, "--sweep: more than %d options", TRADE_FACTORS);
		return NULL;
	}
	f->level = arena_zalloc(&t->arena, TRADE_LEVELS * sizeof(*f->level));
	if (!f->level) {
		diag_no_memory(&t->diag, "a sweep", TRADE_LEVELS * sizeof(*f->level));
		return NULL;
	}
	snprintf(f->name, sizeof(f->name), "%.*s", (int)length, name);
	f->by_default = by_default;
	t->factors++;
	return f;
}

static enum status sweep_default(struct trade *t, size_t i)
{
	const char *levels = default_sweep[i].levels, *factor = default_sweep[i].factor;
	struct trade_factor *f;

	if (!find_option(levels, name_length(levels)))
		return STATUS_OK;
	f = factor_named(t, factor, strlen(factor), true);
	return f ? sweep_items(t, f, levels) : STATUS_FAILED;
}

enum status trade_sweep(struct trade *t, const char *text)
{
	size_t name = strcspn(text, "=");
	enum status st = STATUS_OK;
	struct trade_factor *f;
	bool known = false;

	if (text[name] && !find_option(text, name))
		return diag_fail(&t->diag, STATUS_USAGE, NULL,
				 "--sweep=%s: alidade has no option --%.*s that takes a value", text, (int)name,
				 text);
	if (text[name]) {
		f = factor_named(t, text, name, false);
		return f ? sweep_items(t, f, text) : STATUS_FAILED;
	}
	for (size_t i = 0; i < DEFAULT_SWEEPS && !st; i++) {
		if (!strcmp(default_sweep[i].factor, text)) {
			known = true;
			if (!default_sweep[i].radiosity || t->about.radiosity || !strcmp(text, "indirect"))
				st = sweep_default(t, i);
		}
	}
	if (!known)
		return diag_fail(&t->diag, STATUS_USAGE, NULL,
				 "--sweep=%s: expected NAME=LEVEL,.. or one of accel, precision, aa, indirect",
				 text);
	return st;
}

enum status trade_sweep_default(struct trade *t)
{
	enum status st = STATUS_OK;

	for (size_t i = 0; i < DEFAULT_SWEEPS && !st; i++) {
		if (!default_sweep[i].radiosity || t->about.radiosity)
			st = sweep_default(t, i);
	}
	return st;
}

bool trade_sweeps(const struct trade *t, const char *option)
{
	size_t n = strlen(option);

	for (uint32_t f = 0; f < t->factors; f++) {
		for (uint32_t l = 0; l < t->factor[f].levels; l++) {
			const struct trade_level *level = &t->factor[f].level[l];

			for (uint32_t i = 0; i < level->options; i++) {
				if (!strncmp(level->option[i] + 2, option, n) && level->option[i][n + 2] == '=')
					return true;
			}
		}
	}
	return false;
}

uint32_t trade_options(const struct trade *t, const struct trade_setting *s, const char **out)
{
	uint32_t n = 0;

	for (uint32_t f = 0; f < t->factors; f++) {
		const struct trade_level *l = s->level[f] ? &t->factor[f].level[s->level[f] - 1] : NULL;

		for (uint32_t i = 0; l && i < l->options; i++)
			out[n++] = l->option[i];
	}
	out[n] = NULL;
	return n;
}

static void make_label(const struct trade *t, struct trade_setting *s)
{
	size_t n = 0;

	snprintf(s->label, sizeof(s->label), "default");
	for (uint32_t f = 0; f < t->factors; f++) {
		const struct trade_factor *of = &t->factor[f];
		const struct trade_level *l = s->level[f] ? &of->level[s->level[f] - 1] : NULL;
		bool bare = l && (!strcmp(of->name, "accel") || !strcmp(l->text, l->option[0] + 2));

		if (l && n < sizeof(s->label))
			n += (size_t)snprintf(s->label + n, sizeof(s->label) - n, "%s%s%s%s", n ? " " : "",
					      bare ? "" : of->name, bare ? "" : "=", l->text);
	}
}

/* What is there already is not added again. */
enum status trade_setting_add(struct trade *t, const uint16_t *level, enum trade_stage stage)
{
	struct trade_setting *s = &t->setting[t->settings];
	const char *option[TRADE_FACTORS * TRADE_LEVEL_OPTIONS + 1];
	uint32_t n;

	for (uint32_t i = 0; i < t->settings; i++) {
		if (!memcmp(t->setting[i].level, level, sizeof(s->level)))
			return STATUS_OK;
	}
	if (t->settings == TRADE_SETTINGS)
		return diag_fail(&t->diag, STATUS_USAGE, NULL, "more than %d settings", TRADE_SETTINGS);
	memset(s, 0, sizeof(*s));
	s->run = arena_alloc(&t->arena, TRADE_RUNS * sizeof(*s->run));
	if (!s->run)
		return diag_no_memory(&t->diag, "a setting", TRADE_RUNS * sizeof(*s->run));
	memcpy(s->level, level, sizeof(s->level));
	s->stage = stage;
	s->target = t->repeat;
	s->key = trade_setting_key(t, s);
	make_label(t, s);
	n = trade_options(t, s, option);
	s->inexact = trade_inexact(t, (char *const *)(uintptr_t)option, n);
	if (!s->inexact)
		return STATUS_FAILED;
	if (!*s->inexact)
		s->inexact = NULL;
	t->settings++;
	return STATUS_OK;
}

enum status trade_plan(struct trade *t)
{
	uint16_t level[TRADE_FACTORS] = { 0 };
	enum status st = trade_setting_add(t, level, TRADE_BASE);

	for (uint32_t f = 0; f < t->factors && !st; f++) {
		for (uint32_t l = 1; l <= t->factor[f].levels && !st; l++) {
			level[f] = (uint16_t)l;
			st = trade_setting_add(t, level, TRADE_ALONE);
		}
		level[f] = 0;
	}
	return st;
}

/* The setting that is the fastest of those that change nothing but the accelerator. */
static const struct trade_setting *fastest_alone(const struct trade *t, uint32_t accel)
{
	const struct trade_setting *best = NULL;

	for (uint32_t i = 0; i < t->settings; i++) {
		const struct trade_setting *s = &t->setting[i];
		bool alone = trade_measured(t, s);

		for (uint32_t f = 0; f < t->factors; f++)
			alone = alone && (!s->level[f] || f == accel);
		if (alone && (!best || s->range[t->clock].median < best->range[t->clock].median))
			best = s;
	}
	return best;
}

static enum status choose_accel(struct trade *t, uint32_t accel, struct trade_planned *p)
{
	const struct trade_setting *fastest;
	const char *spec = t->base_accel;

	p->key = trade_plan_key(t, "parameters");
	trade_store_find_plan(t, p);
	if (p->found)
		return STATUS_OK;
	fastest = fastest_alone(t, accel);
	if (!fastest)
		return STATUS_OK;
	if (fastest->level[accel])
		spec = t->factor[accel].level[fastest->level[accel] - 1].accel;
	snprintf(p->name, sizeof(p->name), "%.*s", (int)strcspn(spec, ":"), spec);
	return t->complete ? trade_store_plan(t, p) : STATUS_OK;
}

/* Of the accelerator that was fastest as it is. */
enum status trade_plan_parameters(struct trade *t)
{
	uint16_t level[TRADE_FACTORS] = { 0 };
	struct trade_planned p = { 0 };
	uint32_t accel = 0, from;
	enum status st;

	while (accel < t->factors && strcmp(t->factor[accel].name, "accel") != 0)
		accel++;
	if (accel == t->factors || !t->factor[accel].by_default)
		return STATUS_OK;
	st = choose_accel(t, accel, &p);
	from = t->factor[accel].levels;
	if (!st && p.name[0])
		st = add_plugins(t, &t->factor[accel], p.name);
	for (uint32_t l = from + 1; l <= t->factor[accel].levels && !st; l++) {
		level[accel] = (uint16_t)l;
		st = trade_setting_add(t, level, TRADE_PARAMETER);
	}
	return st;
}
