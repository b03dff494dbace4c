/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Which levels are tried together. The full product of a dozen levels of four factors would take days; but
 * the effects of factors are nearly independent, so times multiply and errors add as squares, and what is on
 * the front of these guesses is worth measuring.
 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "trade.h"

/* How a setting of stages ALONE and PARAMETER compares to the default: ratio of times, and what it adds to
 * the squared error. */
struct effect {
	double time, square;
	uint16_t level;
};

struct guess {
	uint16_t level[TRADE_FACTORS];
	double time, error;
	bool taken, beaten;
};
#define GUESSES 8192
#define WORTH 0.98 /* less than 2 % is no gain */

static double time_of(const struct trade *t, const struct trade_setting *s)
{
	return s->range[t->clock].median;
}

static double error_of(const struct trade *t, const struct trade_setting *s)
{
	return fabs(s->range[t->error].median);
}

/* Alone it gained something, by more than times vary, and no other level of its factor gained as much. */
static bool worth(const struct trade *t, const struct trade_setting *s, uint32_t f)
{
	const struct trade_setting *base = &t->setting[0];
	double fast = fmin(WORTH * time_of(t, base), base->range[t->clock].low);

	if (s->stage == TRADE_COMBINED || !s->level[f] || !trade_measured(t, s))
		return false;
	if (!(time_of(t, s) < fast) && !(error_of(t, s) < WORTH * error_of(t, base)))
		return false;
	for (uint32_t i = 0; i < t->settings; i++) {
		const struct trade_setting *o = &t->setting[i];

		if ((o->level[f] || !i) && o->stage != TRADE_COMBINED && trade_measured(t, o) &&
		    time_of(t, o) < time_of(t, s) && error_of(t, o) <= error_of(t, s))
			return false;
	}
	return true;
}

/* The levels of a factor that were worth something alone, and the default. */
static uint32_t find_effects(const struct trade *t, uint32_t f, struct effect *out)
{
	const struct trade_setting *base = &t->setting[0];
	double square = error_of(t, base) * error_of(t, base);
	uint32_t n = 0;

	out[n++] = (struct effect){ 1, 0, 0 };
	for (uint32_t i = 1; i < t->settings && n <= TRADE_LEVELS; i++) {
		const struct trade_setting *s = &t->setting[i];

		if (worth(t, s, f))
			out[n++] = (struct effect){ time_of(t, s) / time_of(t, base),
						    error_of(t, s) * error_of(t, s) - square, s->level[f] };
	}
	return n;
}

/* Some options exclude each other, and not every accelerator serves every precision. */
static bool goes_together(const struct trade *t, const uint16_t *level, struct trade_served *known)
{
	const char *option[TRADE_FACTORS * TRADE_LEVEL_OPTIONS + 1];
	struct trade_setting s = { 0 };
	uint32_t n;

	memcpy(s.level, level, sizeof(s.level));
	n = trade_options(t, &s, option);
	return trade_goes(t, (char *const *)(uintptr_t)option, n, known);
}

/* Each combination once: times multiply, and independent errors add as squares. */
static uint32_t make_guesses(const struct trade *t, struct effect (*effect)[TRADE_LEVELS + 1], const uint32_t *n,
			     struct guess *out)
{
	const struct trade_setting *base = &t->setting[0];
	uint32_t at[TRADE_FACTORS] = { 0 }, count = 0, f = 0;
	struct trade_served known = { 0 };

	while (f < t->factors && count < GUESSES) {
		struct guess *g = &out[count];
		double square = error_of(t, base) * error_of(t, base);
		uint32_t changed = 0;

		memset(g, 0, sizeof(*g));
		g->time = time_of(t, base);
		for (uint32_t i = 0; i < t->factors; i++) {
			const struct effect *e = &effect[i][at[i]];

			g->level[i] = e->level;
			g->time *= e->time;
			square += e->square;
			changed += e->level != 0;
		}
		g->error = sqrt(square > 0 ? square : 0);
		count += changed > 1 && goes_together(t, g->level, &known);
		for (f = 0; f < t->factors && ++at[f] == n[f]; f++)
			at[f] = 0;
	}
	return count;
}

static bool beats(double time, double error, const struct guess *g)
{
	return time <= g->time && error <= g->error && (time < g->time || error < g->error);
}

/* Those that nothing beats as far as guessed; the next time it is called, the next best. */
static void find_front(const struct trade *t, struct guess *g, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++) {
		g[i].beaten = g[i].taken;
		for (uint32_t k = 0; k < t->settings && !g[i].beaten; k++)
			g[i].beaten = trade_measured(t, &t->setting[k]) &&
				      beats(time_of(t, &t->setting[k]), error_of(t, &t->setting[k]), &g[i]);
		for (uint32_t k = 0; k < n && !g[i].beaten; k++)
			g[i].beaten = !g[k].taken && beats(g[k].time, g[k].error, &g[i]);
	}
}

/* As many of the front as there is room for, evenly over it. */
static void take_front(struct guess *g, uint32_t n, struct trade_planned *p)
{
	uint32_t found = 0, seen = 0, want = p->room - p->count;

	for (uint32_t i = 0; i < n; i++)
		found += !g[i].beaten;
	for (uint32_t i = 0; i < n; i++) {
		if (g[i].beaten)
			continue;
		seen++;
		if (found > want && seen * want / found == (seen - 1) * want / found)
			continue;
		g[i].taken = true;
		memcpy(p->level[p->count++], g[i].level, sizeof(*p->level));
	}
}

static enum status guess_plan(struct trade *t, struct trade_planned *p)
{
	size_t bytes = GUESSES * sizeof(struct guess), effects = sizeof(struct effect[TRADE_FACTORS][TRADE_LEVELS + 1]);
	uint32_t n[TRADE_FACTORS], count;
	struct effect (*effect)[TRADE_LEVELS + 1] = mem_alloc(&t->book, "plan", effects);
	struct guess *guess = mem_alloc(&t->book, "plan", bytes);
	enum status st = STATUS_OK;

	if (guess && effect) {
		for (uint32_t f = 0; f < t->factors; f++)
			n[f] = find_effects(t, f, effect[f]);
		count = make_guesses(t, effect, n, guess);
		for (int layer = 0; layer < 2 && p->count < p->room; layer++) {
			find_front(t, guess, count);
			take_front(guess, count, p);
		}
		st = t->complete ? trade_store_plan(t, p) : STATUS_OK;
	} else {
		st = diag_no_memory(&t->diag, "combinations", bytes + effects);
	}
	mem_free(guess);
	mem_free(effect);
	return st;
}

enum status trade_plan_combinations(struct trade *t)
{
	struct trade_planned p = { .room = t->combinations };
	size_t bytes = (p.room + 1) * sizeof(*p.level);
	enum status st = STATUS_OK;

	if (!trade_measured(t, &t->setting[0]) || !p.room)
		return STATUS_OK;
	p.level = arena_alloc(&t->arena, bytes);
	if (!p.level)
		return diag_no_memory(&t->diag, "combinations", bytes);
	p.key = trade_plan_key(t, "combined");
	trade_store_find_plan(t, &p);
	if (!p.found)
		st = guess_plan(t, &p);
	for (uint32_t i = 0; i < p.count && !st; i++)
		st = trade_setting_add(t, p.level[i], TRADE_COMBINED);
	return st;
}
