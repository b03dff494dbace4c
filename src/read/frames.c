/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * All rules here were measured with POV-Ray 3.7.0.10: an animation is what names an initial or a final
 * frame; clocks are single precision, and what is declared passes through text of six digits; a cyclic
 * animation has one frame more, which is not drawn, but counts for clock_delta, final_frame and the
 * digits of names; a share as the end of a subset counts from frame 0, not from the initial frame.
 * Where an animation has one frame only POV-Ray divides by 0 and the clock is NaN; here it is the initial
 * clock.
 */
#include <config.h>

#include "read/frames.h"
#include "base/single.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *number(const char *at, uint32_t *out)
{
	uint64_t n = 0;

	if (!isdigit((unsigned char)*at))
		return NULL;
	for (; isdigit((unsigned char)*at); at++) {
		n = 10 * n + (uint64_t)(*at - '0');
		if (n > FRAME_MAX)
			return NULL;
	}
	*out = (uint32_t)n;
	return at;
}

bool frames_parse(const char *at, struct frame_span *span, uint32_t *count)
{
	for (*count = 0; *count < FRAME_SPANS; at++) {
		struct frame_span *s = &span[(*count)++];

		at = number(at, &s->first);
		if (!at)
			return false;
		s->last = s->first;
		s->step = 1;
		if (at[0] == '.' && at[1] == '.') {
			at = number(at + 2, &s->last);
			if (at && *at == ':')
				at = number(at + 1, &s->step);
		}
		if (!at || s->last < s->first || !s->step)
			return false;
		if (*at != ',')
			return !*at;
	}
	return false;
}

/* A subset's bound: 0, or 1 and more, is a frame's number, what lies between is a share. */
static double bound(double given, uint32_t initial, uint32_t final)
{
	double v = given > 0 ? as_single(given) : 0;

	return v > 0 && v < 1 ? floor(((double)final - initial + 1) * v) : floor(fmin(v, FRAME_MAX));
}

static void plan_subset(struct frame_plan *p, const struct frame_settings *s)
{
	struct frame_span *span = &p->span[0];
	double v;

	span->first = p->initial;
	span->last = s->cyclic ? p->final - 1 : p->final;
	span->step = s->set & FRAMES_STEP ? s->step : 1;
	if (s->set & FRAMES_SUBSET_START) {
		v = bound(s->subset_start, p->initial, p->final);
		span->first = v > p->initial ? (uint32_t)v : p->initial;
	}
	if (s->set & FRAMES_SUBSET_END)
		span->last = (uint32_t)bound(s->subset_end, p->initial, p->final);
	if (span->last < span->first)
		span->last = span->first;
	p->span_count = 1;
}

static void plan_range(struct frame_plan *p, const struct frame_settings *s)
{
	p->initial = s->set & FRAMES_INITIAL ? s->initial_frame : 1;
	p->final = s->set & FRAMES_FINAL ? s->final_frame : 1;
	if (p->final < p->initial)
		p->final = p->initial;
	p->final += s->cyclic;
}

/* Without a range, the frames that are drawn are taken for all there are. */
static void guess_range(struct frame_plan *p, const struct frame_span *list, uint32_t count)
{
	p->guessed = true;
	p->initial = list[0].first;
	p->final = list[0].last;
	for (uint32_t i = 1; i < count; i++) {
		if (list[i].first < p->initial)
			p->initial = list[i].first;
		if (list[i].last > p->final)
			p->final = list[i].last;
	}
}

void frames_plan(struct frame_plan *p, const struct frame_settings *s, const struct frame_span *list,
		 uint32_t count)
{
	bool range = s->set & (FRAMES_INITIAL | FRAMES_FINAL);

	memset(p, 0, sizeof(*p));
	p->animated = range || count;
	p->clock_fixed = s->set & FRAMES_CLOCK;
	p->clock = p->clock_fixed ? as_single(s->clock) : 0;
	if (!p->animated) {
		p->span[0] = (struct frame_span){ 0, 0, 1 };
		p->span_count = 1;
		return;
	}
	if (range)
		plan_range(p, s);
	else
		guess_range(p, list, count);
	p->initial_clock = s->set & FRAMES_INITIAL_CLOCK ? as_single(s->initial_clock) : 0;
	p->final_clock = s->set & FRAMES_FINAL_CLOCK ? as_single(s->final_clock) : 1;
	if (p->final > p->initial)
		p->clock_delta = (p->final_clock - p->initial_clock) / ((double)p->final - p->initial);
	if (count) {
		memcpy(p->span, list, count * sizeof(*list));
		p->span_count = count;
	} else {
		plan_subset(p, s);
	}
	p->digits = 1;
	for (uint32_t i = p->final; i >= 10; i /= 10)
		p->digits++;
}

static uint64_t span_length(const struct frame_span *s)
{
	return ((uint64_t)s->last - s->first) / s->step + 1;
}

uint64_t frames_count(const struct frame_plan *p)
{
	uint64_t n = 0;

	for (uint32_t i = 0; i < p->span_count; i++)
		n += span_length(&p->span[i]);
	return n;
}

uint32_t frames_number(const struct frame_plan *p, uint64_t i)
{
	uint32_t k = 0;

	while (k + 1 < p->span_count && i >= span_length(&p->span[k]))
		i -= span_length(&p->span[k++]);
	return (uint32_t)(p->span[k].first + i * p->span[k].step);
}

static double declared(double v)
{
	char text[32];

	snprintf(text, sizeof(text), "%g", v);
	return strtod(text, NULL);
}

void frames_now(const struct frame_plan *p, uint32_t frame, struct frame_now *n)
{
	*n = (struct frame_now){ .clock_on = p->animated || p->clock_fixed, .clock = p->clock };
	if (!p->animated)
		return;
	n->guessed = p->guessed && !p->clock_fixed;
	n->number = frame;
	n->initial = p->initial;
	n->final = p->final;
	if (!p->clock_fixed)
		n->clock = as_single(p->clock_delta * ((double)frame - p->initial) + p->initial_clock);
	n->initial_clock = declared(p->initial_clock);
	n->final_clock = declared(p->final_clock);
	n->clock_delta = declared(as_single(p->clock_delta));
}

static const char *last_place(const char *name, size_t *length)
{
	const char *end = strrchr(name, '#'), *begin = end;

	if (!end)
		return NULL;
	while (begin > name && begin[-1] == '#')
		begin--;
	*length = (size_t)(end - begin) + 1;
	return begin;
}

bool frames_has_place(const char *name)
{
	return strchr(name, '#') != NULL;
}

bool frames_name(char *out, size_t size, const char *name, uint32_t frame, uint32_t digits, bool insert)
{
	const char *slash = strrchr(name, '/'), *base = slash ? slash + 1 : name;
	size_t length = 0;
	const char *at = last_place(name, &length);
	int n;

	if (at) {
		digits = length > 9 ? 9 : (uint32_t)length;
	} else if (insert) {
		at = strrchr(base, '.');
		if (!at || at == base)
			at = base + strlen(base);
	} else {
		n = snprintf(out, size, "%s", name);
		return n >= 0 && (size_t)n < size;
	}
	n = snprintf(out, size, "%.*s%0*u%s", (int)(at - name), name, (int)digits, frame, at + length);
	return n >= 0 && (size_t)n < size;
}
