/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Media between a ray's origin and its end (manual 3.4.8.2).
 *
 * Along a segment, emission and light scattered towards the eye are summed, and what lies behind fades by
 * exp(-optical depth). The quadrature is POV-Ray's, since its result depends on it: intervals, divided
 * between lit and dark stretches by ratio; in each, samples at random (method 1), evenly spaced (2), or
 * at the ends and the middle of subintervals, which are halved while neighbours differ by more than
 * aa_threshold (3). Several media in one place are sampled together, as the one with most intervals says.
 * Where samples_max is greater than samples_min, all of them are taken; POV-Ray stops when they agree.
 *
 * Light at samples is asked for in rounds over all segments of a batch: a segment is summed anew with
 * what is known until it lacks nothing, as area lights are.
 */
#include "shade/pov/media.h"

#include <stdlib.h>

#include "base/rng.h"
#include "pattern/pattern.h"
#include "shade/light.h"
#include "shade/pov/lights.h"
#include "shade/pov/shadow.h"

#define SEGMENTS 64 /* of a batch at a time */
#define CODE_END 0xffffu /* samples between subintervals; others are numbered from 1 in their tree */

/* A stretch of a segment, all lit by some lamp or all dark. */
struct span {
	double from, to;
	bool lit;
};

/* Where along a segment a light can reach it. */
struct reach {
	uint32_t light;
	double from, to;
};

struct sample {
	uint64_t key; /* which one it is, see sample_key() */
	struct rgb colour, extinction, scattering; /* per unit of length */
	uint32_t segment, first_lit, lit_count;
	bool known;
};

struct segment {
	uint32_t node; /* for its light; TREE_NONE: only what is left is wanted */
	vec org, dir;
	double length;
	uint64_t key;
	bool world; /* what fills the world, not what list is inside of */
	uint32_t list;
	uint32_t media_count;
	const struct media *lead; /* the one with most intervals */
	double threshold; /* the least of theirs */
	bool scatters, varies; /* some of them */
	uint32_t first_reach, reach_count, first_span, span_count;
	bool done;
	struct rgb clear, glow;
};

/* All segments of a group while they are summed. */
struct run {
	const struct shader *sh;
	struct tree *t;
	bool complete;
};

static const struct rgb none = { 0, 0, 0 }, all = { 1, 1, 1 };

static struct rgb rgb_exp(struct rgb c)
{
	return rgb_make(exp(-c.r), exp(-c.g), exp(-c.b));
}

static bool rgb_zero(struct rgb c)
{
	return c.r == 0 && c.g == 0 && c.b == 0;
}

static double apart(struct rgb a, struct rgb b)
{
	return fabs(a.r - b.r) + fabs(a.g - b.g) + fabs(a.b - b.b);
}

static int by_from(const void *a, const void *b)
{
	const struct reach *x = a, *y = b;

	return x->from < y->from ? -1 : x->from > y->from;
}

static void add_span(struct tree *t, struct segment *s, double from, double to, bool lit)
{
	uint32_t i;

	if (!(to > from))
		return;
	i = tree_push(t, &t->media.span, 1);
	if (i == TREE_NONE)
		return;
	*BUF_AT(&t->media.span, struct span, i) = (struct span){ from, to, lit };
	s->span_count++;
}

static struct span span_at(const struct tree *t, const struct segment *s, uint32_t i)
{
	if (s->node == TREE_NONE)
		return (struct span){ 0, s->length, false };
	return *BUF_AT(&t->media.span, struct span, s->first_span + i);
}

/* The lights that reach the segment, and its lit and dark stretches. */
static void find_spans(const struct shader *sh, struct tree *t, struct segment *s)
{
	/* As in POV-Ray, media are lit by the lights of what the ray meets behind them. */
	uint32_t set = s->node == TREE_NONE ? SCENE_NONE : BUF_AT(&t->node, struct node, s->node)->light_set;
	double at = 0;

	s->first_reach = t->media.reach.count;
	s->first_span = t->media.span.count;
	s->reach_count = s->span_count = 0;
	for (uint32_t i = 0; s->scatters && i < sh->scene->light_count; i++) {
		const struct light *l = &sh->scene->light[i];
		struct reach r = { .light = i };
		uint32_t k;

		if (l->shadowless || l->no_media || !scene_lit_by(sh->scene, l, set) ||
		    !light_reach(l, s->org, s->dir, s->length, &r.from, &r.to))
			continue;
		k = tree_push(t, &t->media.reach, 1);
		if (k == TREE_NONE)
			return;
		*BUF_AT(&t->media.reach, struct reach, k) = r;
		s->reach_count++;
	}
	if (s->reach_count)
		qsort(BUF_AT(&t->media.reach, struct reach, s->first_reach), s->reach_count,
		      sizeof(struct reach), by_from);
	for (uint32_t i = 0; i < s->reach_count;) {
		const struct reach *r = BUF_AT(&t->media.reach, struct reach, s->first_reach + i);
		double from = r->from, to = r->to;

		for (i++; i < s->reach_count && r[1].from <= to; i++)
			to = fmax(to, (++r)->to);
		add_span(t, s, at, from, false);
		add_span(t, s, from, to, true);
		at = to;
	}
	add_span(t, s, at, s->length, false);
}

/* Where a walk over a segment's media stands: { segment's list, 0 } at first. */
struct walk {
	uint32_t list, next;
};

/* The next of the segment's media, NULL: that were all. */
static const struct media *next_media(const struct scene *sc, const struct tree *t, const struct segment *s,
				      struct walk *w)
{
	if (s->world)
		return w->next < sc->media_count ? &sc->media[w->next++] : NULL;
	while (w->list != TREE_NONE) {
		const struct inside *in = BUF_AT(&t->inside, struct inside, w->list);

		if (in->interior != SCENE_NONE && w->next < sc->interior[in->interior].media_count)
			return &sc->interior[in->interior].media[w->next++];
		w->list = in->outer;
		w->next = 0;
	}
	return NULL;
}

/* What all its media say of a segment. */
static void sum_up(const struct scene *sc, const struct tree *t, struct segment *s)
{
	struct walk w = { s->list, 0 };
	const struct media *m;

	s->threshold = HUGE_VAL;
	while ((m = next_media(sc, t, s, &w))) {
		s->media_count++;
		if (!s->lead || m->intervals > s->lead->intervals)
			s->lead = m;
		s->threshold = fmin(s->threshold, m->aa_threshold);
		s->scatters |= !rgb_zero(m->scattering);
		for (uint32_t i = 0; i < m->density_count; i++)
			s->varies |= m->density[i].pattern != NULL;
	}
}

static double phase(const struct media *m, double cosine)
{
	double g = m->eccentricity;

	switch (m->phase) {
	case MEDIA_RAYLEIGH:
		return 0.799372013 * (1 + cosine * cosine);
	case MEDIA_MIE_HAZY:
		return 0.576655375 * (1 + 9 * pow(0.5 * (1 + cosine), 8));
	case MEDIA_MIE_MURKY:
		return 0.495714547 * (1 + 50 * pow(0.5 * (1 + cosine), 32));
	case MEDIA_HENYEY_GREENSTEIN:
		return (1 - g * g) / pow(1 + g * g - 2 * g * cosine, 1.5);
	case MEDIA_ISOTROPIC:
		break;
	}
	return 1;
}

static struct rgb density_at(const struct scene *s, const struct media *m, vec p, vec dir)
{
	struct pattern_point at = { .p = m->place ? mat_point(&m->place->inv, p) : p,
				    .dir = dir,
				    .place = m->place };
	struct rgb c = all;

	for (uint32_t i = 0; i < m->density_count; i++)
		c = rgb_mul(c, rgbft_rgb(pigment_at(s, &m->density[i], &at)));
	return c;
}

/* One lamp at a sample: joins those that are asked in this round. */
static void ask_sample(struct run *r, const struct segment *s, struct sample *sample, uint32_t light,
		      vec p)
{
	uint32_t met;

	if (!sample->lit_count) {
		met = tree_push(r->t, &r->t->met, 1);
		if (met == TREE_NONE)
			return;
		*BUF_AT(&r->t->met, struct met, met) = (struct met){ .node = s->node,
								     .p = p,
								     .skip = ALD_NONE,
								     .object = SCENE_NONE,
								     .interior = SCENE_NONE,
								     .round = BUF_AT(&r->t->node, struct node,
										     s->node)->path };
		sample->first_lit = r->t->lit.count;
	}
	if (lights_ask(r->sh, r->t, r->t->met.count - 1, light))
		sample->lit_count++;
}

/* Which sample of a segment: its interval, subinterval and place in the subinterval's tree. */
static uint64_t sample_key(uint32_t segment, uint32_t interval, uint32_t sub, uint32_t code)
{
	return rng_mix(((uint64_t)segment << 48) ^ ((uint64_t)interval << 32) ^ ((uint64_t)sub << 16) ^ code) | 1;
}

static struct sample *find_sample(struct tree *t, uint64_t key, uint32_t *slot)
{
	uint32_t mask = t->media.slot.count - 1, i = (uint32_t)(key >> 20) & mask;

	for (;; i = (i + 1) & mask) {
		uint32_t index = *BUF_AT(&t->media.slot, uint32_t, i);

		*slot = i;
		if (index == TREE_NONE)
			return NULL;
		if (BUF_AT(&t->media.sample, struct sample, index)->key == key)
			return BUF_AT(&t->media.sample, struct sample, index);
	}
}

/* Twice as many places as samples, or a table of that many empty ones. */
static bool grow_slots(struct tree *t)
{
	uint32_t room = t->media.slot.count ? 2 * t->media.slot.count : 1024, slot;

	t->media.slot.count = 0;
	if (tree_push(t, &t->media.slot, room) == TREE_NONE)
		return false;
	for (uint32_t i = 0; i < room; i++)
		*BUF_AT(&t->media.slot, uint32_t, i) = TREE_NONE;
	for (uint32_t i = 0; i < t->media.sample.count; i++) {
		find_sample(t, BUF_AT(&t->media.sample, struct sample, i)->key, &slot);
		*BUF_AT(&t->media.slot, uint32_t, slot) = i;
	}
	return true;
}

/* What the media are like at a distance along the segment; light there is asked for if some reaches it. */
static void make_sample(struct run *r, const struct segment *s, struct sample *out, double at, bool lit)
{
	vec p = vec_mad(s->org, s->dir, at);
	struct walk w = { s->list, 0 };
	const struct media *m;

	out->colour = out->extinction = out->scattering = none;
	out->lit_count = 0;
	while ((m = next_media(r->sh->scene, r->t, s, &w))) {
		struct rgb d = density_at(r->sh->scene, m, p, s->dir);

		out->extinction = rgb_add(out->extinction,
					  rgb_mul(d, rgb_add(m->absorption,
							     rgb_scale(m->scattering, m->extinction))));
		out->colour = rgb_add(out->colour, rgb_mul(d, m->emission));
		out->scattering = rgb_add(out->scattering, rgb_mul(d, m->scattering));
	}
	if (lit && !rgb_zero(out->scattering)) {
		for (uint32_t i = 0; i < s->reach_count; i++) {
			const struct reach *l = BUF_AT(&r->t->media.reach, struct reach, s->first_reach + i);

			if (at >= l->from && at <= l->to)
				ask_sample(r, s, out, l->light, p);
		}
	}
	out->known = !out->lit_count;
}

struct place { /* of the samples of an interval */
	uint32_t segment, interval;
	double from, length;
	bool lit;
};

/* The sample at share d of an interval; nothing if its light is not yet known. */
static struct sample sample_at(struct run *r, const struct segment *s, const struct place *p, uint32_t sub,
			       uint32_t code, double d)
{
	static const struct sample unknown = { .known = false };
	uint64_t key = sample_key(p->segment, p->interval, sub, code);
	struct sample *found, made = { .key = key, .segment = p->segment };
	uint32_t slot, i;

	if (s->node == TREE_NONE) { /* of shadows: nothing to wait for, nothing to keep */
		make_sample(r, s, &made, p->from + d * p->length, false);
		return made;
	}
	if (r->t->media.slot.count < 2 * (r->t->media.sample.count + 1) && !grow_slots(r->t))
		return unknown;
	found = find_sample(r->t, key, &slot);
	if (!found) {
		make_sample(r, s, &made, p->from + d * p->length, p->lit);
		i = tree_push(r->t, &r->t->media.sample, 1);
		if (i == TREE_NONE)
			return unknown;
		*BUF_AT(&r->t->media.sample, struct sample, i) = made;
		*BUF_AT(&r->t->media.slot, uint32_t, slot) = i;
		found = BUF_AT(&r->t->media.sample, struct sample, i);
	}
	r->complete &= found->known;
	return *found;
}

struct sum {
	struct rgb glow, depth;
};

static double jittered(const struct segment *s, const struct place *p, uint32_t sub, uint32_t code)
{
	if (s->lead->jitter == 0)
		return 0;
	return s->lead->jitter *
	       (rng_unit(rng_child(s->key, sample_key(0, p->interval, sub, code))) - 0.5);
}

/* Between samples a and b at d1 and d2: halved while they differ from the one between. */
static struct sum adaptive(struct run *r, const struct segment *s, const struct place *p, uint32_t sub,
			   uint32_t code, double d1, double d2, const struct sample *a,
			   const struct sample *b, uint32_t levels, double threshold)
{
	struct sample m = sample_at(r, s, p, sub, code,
				    0.5 * (d1 + d2) + (d2 - d1) * jittered(s, p, sub, code));
	struct sum out, half;
	bool finer = levels > 1 && a->known && b->known && m.known;

	if (levels <= 1) {
		out.glow = rgb_scale(rgb_add(rgb_add(a->colour, m.colour), b->colour), 1.0 / 3);
		out.depth = rgb_scale(rgb_add(rgb_add(a->extinction, m.extinction), b->extinction), 1.0 / 3);
		return out;
	}
	if (finer && apart(a->colour, m.colour) * p->length > threshold) {
		half = adaptive(r, s, p, sub, 2 * code, d1, 0.5 * (d1 + d2), a, &m, levels - 1, threshold);
		out.glow = rgb_scale(half.glow, 0.5);
		out.depth = rgb_scale(half.depth, 0.5);
	} else {
		out.glow = rgb_add(rgb_scale(a->colour, 1.0 / 3), rgb_scale(m.colour, 1.0 / 6));
		out.depth = rgb_add(rgb_scale(a->extinction, 1.0 / 3), rgb_scale(m.extinction, 1.0 / 6));
	}
	if (finer && apart(m.colour, b->colour) * p->length > threshold) {
		half = adaptive(r, s, p, sub, 2 * code + 1, 0.5 * (d1 + d2), d2, &m, b, levels - 1, threshold);
		out.glow = rgb_add(out.glow, rgb_scale(half.glow, 0.5));
		out.depth = rgb_add(out.depth, rgb_scale(half.depth, 0.5));
	} else {
		out.glow = rgb_add(out.glow, rgb_add(rgb_scale(m.colour, 1.0 / 6),
						     rgb_scale(b->colour, 1.0 / 3)));
		out.depth = rgb_add(out.depth, rgb_add(rgb_scale(m.extinction, 1.0 / 6),
						       rgb_scale(b->extinction, 1.0 / 3)));
	}
	return out;
}

/* Method 3: subintervals from sample to sample, each faded by those before it. Measured: POV-Ray's are one
 * more than half the samples (at least two), leave as much again at the far end unseen, and count for
 * the whole interval. */
static struct sum sum_adaptive(struct run *r, const struct segment *s, const struct place *p)
{
	uint32_t subs = s->lead->samples_min / 2 + 1 + (s->lead->samples_min == 1);
	double step = 1.0 / (subs + 1), threshold = s->threshold;
	struct sum out = { none, none };
	struct sample a = sample_at(r, s, p, 0, CODE_END, step * jittered(s, p, 0, CODE_END)), b;

	for (uint32_t j = 1; j <= subs; j++) {
		struct sum one;

		b = sample_at(r, s, p, j, CODE_END, j * step + step * jittered(s, p, j, CODE_END));
		one = adaptive(r, s, p, j, 1, (j - 1) * step, j * step, &a, &b, s->lead->aa_level, threshold);
		one.glow = rgb_scale(one.glow, p->length);
		one.depth = rgb_scale(one.depth, p->length);
		out.glow = rgb_add(out.glow, rgb_mul(one.glow, rgb_exp(rgb_scale(out.depth, 1.0 / subs))));
		out.depth = rgb_add(out.depth, one.depth);
		a = b;
	}
	out.glow = rgb_scale(out.glow, 1.0 / subs);
	out.depth = rgb_scale(out.depth, 1.0 / subs);
	return out;
}

/* Methods 1 and 2: the mean of some samples. */
static struct sum sum_regular(struct run *r, const struct segment *s, const struct place *p, bool once)
{
	uint32_t n = s->lead->samples_min, more = n;
	struct sum out = { none, none };

	if (once)
		more = n = 1;
	else if (s->node != TREE_NONE && s->lead->samples_max > n)
		more = s->lead->samples_max;
	for (uint32_t j = 0; j < more; j++) {
		double x = rng_unit(rng_child(s->key, sample_key(1, p->interval, j, 0)));
		double d = s->lead->method == 2 && j < n ? (j + 0.5 + x * s->lead->jitter) / n : x;
		struct sample one = sample_at(r, s, p, j, 0, d);

		out.glow = rgb_add(out.glow, rgb_mul(one.colour, rgb_exp(rgb_scale(one.extinction,
										   d * p->length))));
		out.depth = rgb_add(out.depth, one.extinction);
	}
	out.glow = rgb_scale(out.glow, p->length / more);
	out.depth = rgb_scale(out.depth, p->length / more);
	return out;
}

/* How many intervals a span gets of those that there are. */
static uint32_t share(const struct tree *t, const struct segment *s, uint32_t span, uint32_t *left)
{
	uint32_t intervals = s->lead->intervals, n, most = *left - s->span_count + span + 1;
	double sum = 0, ratio = s->lead->ratio;

	if (s->span_count == 1)
		return !span_at(t, s, 0).lit && !s->lead->density_count ? 1 : intervals;
	if (intervals < s->span_count)
		intervals = s->span_count;
	for (uint32_t i = 0; i < s->span_count; i++)
		sum += span_at(t, s, i).lit ? ratio : 1 - ratio;
	n = (uint32_t)((span_at(t, s, span).lit ? ratio : 1 - ratio) / sum * intervals) + 1;
	n = n < most ? n : most;
	*left -= n;
	return n;
}

static void sum_segment(struct run *r, struct segment *s, uint32_t index)
{
	bool once = s->node == TREE_NONE && !s->varies;
	uint32_t left = s->lead->intervals > s->span_count ? s->lead->intervals : s->span_count;
	struct rgb depth = none;
	struct place p = { .segment = index };

	s->glow = none;
	for (uint32_t i = 0; i < s->span_count; i++) {
		uint32_t n = share(r->t, s, i, &left);
		struct span span = span_at(r->t, s, i);

		p.length = (span.to - span.from) / n;
		p.lit = span.lit;
		for (uint32_t j = 0; j < n; j++, p.interval++) {
			struct sum one;

			p.from = span.from + j * p.length;
			if (s->lead->method == 3 && !once)
				one = sum_adaptive(r, s, &p);
			else
				one = sum_regular(r, s, &p, once);
			s->glow = rgb_add(s->glow, rgb_mul(one.glow, rgb_exp(depth)));
			depth = rgb_add(depth, one.depth);
		}
	}
	s->clear = rgb_exp(depth);
}

/* The lamps have answered: what is scattered towards the eye joins the samples' own light. */
static void take_light(const struct scene *sc, struct tree *t, struct sample *sample)
{
	const struct segment *s = BUF_AT(&t->media.segment, struct segment, sample->segment);

	for (uint32_t i = 0; i < sample->lit_count; i++) {
		const struct lit *lit = BUF_AT(&t->lit, struct lit, sample->first_lit + i);
		struct walk w = { s->list, 0 };
		const struct media *m;
		double k = 0;

		if (shadow_dark(lit->colour))
			continue;
		while ((m = next_media(sc, t, s, &w)))
			k += phase(m, vec_dot(lit->dir, s->dir));
		sample->colour = rgb_add(sample->colour, rgb_scale(rgb_mul(sample->scattering, lit->colour),
								   k / s->media_count));
	}
	sample->known = true;
}

static void sum_group(const struct shader *sh, struct tree *t, uint32_t thread, struct shade_counts *counts)
{
	bool complete = false;

	while (!complete && !t->no_memory) {
		uint32_t asked = t->media.sample.count;

		complete = true;
		tree_reset_wave(t);
		for (uint32_t i = 0; i < t->media.segment.count; i++) {
			struct segment *s = BUF_AT(&t->media.segment, struct segment, i);
			struct run r = { sh, t, true };

			if (s->done)
				continue;
			sum_segment(&r, s, i);
			s->done = r.complete;
			complete &= r.complete;
		}
		if (complete || t->no_memory)
			return;
		lights_answer(sh, t, thread, 0, counts);
		for (; asked < t->media.sample.count && !t->no_memory; asked++)
			take_light(sh->scene, t, BUF_AT(&t->media.sample, struct sample, asked));
	}
}

/* Sums the segments and hangs them before their nodes as veils. */
static void hang_group(const struct shader *sh, struct tree *t, uint32_t thread, struct shade_counts *counts)
{
	t->media.sample.count = t->media.slot.count = 0;
	sum_group(sh, t, thread, counts);
	for (uint32_t i = 0; i < t->media.segment.count && !t->no_memory; i++) {
		const struct segment *s = BUF_AT(&t->media.segment, struct segment, i);

		tree_veil(t, s->node, s->clear, s->glow);
	}
	t->media.segment.count = t->media.span.count = t->media.reach.count = 0;
}

static bool begin_segment(const struct shader *sh, const struct tree *t, uint32_t node, bool world,
			  struct segment *s)
{
	const struct node *n = BUF_AT(&t->node, struct node, node);

	*s = (struct segment){ .node = node,
			       .world = world,
			       .list = n->inside,
			       .org = n->org,
			       .dir = n->dir,
			       .length = n->length,
			       .key = rng_child(node_key(n), 0x300000000u + world) };
	if (!shade_sees_air(sh, n) || !inside_hollow(t, n->inside))
		return false;
	if (!isfinite(n->length)) {
		if (!world)
			return false;
		s->length = SHADE_WORLD_END;
	}
	sum_up(sh->scene, t, s);
	return s->media_count > 0;
}

void shade_media(const struct shader *sh, struct tree *t, uint32_t thread, uint32_t first, uint32_t n,
		 struct shade_counts *counts)
{
	/* What fills solids hangs nearer to what was hit than what fills the world. */
	for (int world = 0; world < 2; world++) {
		if (world && !sh->scene->media_count)
			return;
		t->media.segment.count = t->media.span.count = t->media.reach.count = 0;
		for (uint32_t i = first; i < first + n && !t->no_memory; i++) {
			struct segment s;
			uint32_t k;

			if (!begin_segment(sh, t, i, world, &s))
				continue;
			find_spans(sh, t, &s);
			k = tree_push(t, &t->media.segment, 1);
			if (k == TREE_NONE)
				return;
			*BUF_AT(&t->media.segment, struct segment, k) = s;
			if (t->media.segment.count == SEGMENTS)
				hang_group(sh, t, thread, counts);
		}
		hang_group(sh, t, thread, counts);
	}
}

static struct rgb clear_along(const struct shader *sh, struct tree *t, uint32_t list, vec org, vec dir,
			      double length, uint64_t key, bool world)
{
	struct segment s = { .node = TREE_NONE,
			     .world = world,
			     .list = list,
			     .org = org,
			     .dir = dir,
			     .length = length,
			     .key = key,
			     .span_count = 1 };
	struct run r = { sh, t, true };

	if (!(length > 0) || !inside_hollow(t, list))
		return all;
	sum_up(sh->scene, t, &s);
	if (!s.media_count)
		return all;
	sum_segment(&r, &s, 0);
	return s.clear;
}

struct rgb media_clear(const struct shader *sh, struct tree *t, uint32_t list, vec org, vec dir, double length,
		       uint64_t key)
{
	return clear_along(sh, t, list, org, dir, length, key, false);
}

struct rgb media_world_clear(const struct shader *sh, struct tree *t, uint32_t list, vec org, vec dir,
			     double length, uint64_t key)
{
	return clear_along(sh, t, list, org, dir, length, key, true);
}

void media_sizes(struct tree *t)
{
	t->media.segment.size = sizeof(struct segment);
	t->media.span.size = sizeof(struct span);
	t->media.reach.size = sizeof(struct reach);
	t->media.sample.size = sizeof(struct sample);
	t->media.slot.size = sizeof(uint32_t);
}
