/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Clear sweeps along curves as POV-Ray shows them: with pieces of surfaces inside. Read off its pictures and
 * found to follow from what it counts along a ray, which it takes for a union of solids:
 *
 * - the balls at the knots, each entered and left;
 * - the discs that close each piece at its ends, entered or left (straight pieces are solids by this);
 * - of a piece's side not one crossing for each root (see sweep.c), but the whole ball there, entered and left.
 *
 * The last makes the count wrong inside. The first and the last crossing show, and between them those that
 * enter at a count of 0 or leave at 1, counting from 1 at the first. Balls that the ray starts behind are not
 * there, discs are; so what a ray meets depends on where it starts. Two pieces' discs at one knot are at one
 * place: here the earlier piece's comes first, in POV-Ray by chance. Seen only through clear surfaces; opaque
 * sweeps do not come here, and the solids of a CSG tree are closed.
 */
#include "prim/sweep.h"

#include "prim/poly.h"

/* A ray that starts at such a crossing may find it again: of a ball's two ends only the one that touches the
 * surface is stationary, and the other moves with the ray. */
#define AGAIN 1e-7
#define MARKS (8 + 2 * SPANS * SWEEP_TOUCHES)

/* A crossing of one of the solids. */
struct mark {
	double t, u; /* along the line; as in body_root */
	int step; /* of the count */
	uint32_t order; /* among those at one place */
};

struct marks {
	struct mark mark[MARKS];
	unsigned count;
};

static void put(struct marks *m, double t, double u, int step, uint32_t order)
{
	if (m->count < MARKS)
		m->mark[m->count++] = (struct mark){ t, u, step, order };
}

static void put_ball(struct marks *m, double a, double h, double u, double begin, uint32_t order)
{
	double half = h > 0 ? sqrt(h) : 0;

	if (!(half > 0) || a + half <= begin)
		return;
	put(m, a - half, u, 1, order);
	put(m, a + half, u, -1, order + 1);
}

/* The disc at a piece's end: the curve's way and the radius' growth there. */
static struct ball disc_slope(const struct prim_sweep *w, uint32_t piece, unsigned end)
{
	const struct curve *c = &w->curve[piece];

	if (end && piece + 1 < w->head.pieces) /* to the bit the same */
		c++, end = 0;
	if (!end)
		return (struct ball){ { c->x[1], c->y[1], c->z[1] }, c->r[1] };
	return (struct ball){ { c->x[1] + 2 * c->x[2] + 3 * c->x[3], c->y[1] + 2 * c->y[2] + 3 * c->y[3],
				c->z[1] + 2 * c->z[2] + 3 * c->z[3] },
			      c->r[1] + 2 * c->r[2] + 3 * c->r[3] };
}

static void put_disc(struct marks *m, const struct prim_sweep *w, uint32_t piece, unsigned end, vec o, vec d,
		     uint32_t order)
{
	const struct ball *k = &w->knot[piece + end];
	struct ball slope = disc_slope(w, piece, end);
	double along = vec_dot(d, slope.c), t;
	vec off;

	if (!(fabs(along) > 1e-10 * vec_length(slope.c)))
		return;
	t = -(vec_dot(vec_sub(o, k->c), slope.c) + k->r * slope.r) / along;
	off = vec_sub(vec_mad(o, d, t), k->c);
	if (vec_dot(off, off) < k->r * k->r)
		put(m, t, SWEEP_DISC + (double)end, (along > 0) == (end == 1) ? -1 : 1, order);
}

static void put_side(struct marks *m, const struct seen *whole, const struct span *span, double begin,
		     uint32_t *order)
{
	double u[SWEEP_TOUCHES], width = span->end - span->begin;
	struct seen s = *whole;
	unsigned clean, n = sweep_touches(&s, span->begin, span->end, u, &clean);

	for (unsigned i = 0; i < (clean ? clean : n); i++, *order += 2)
		put_ball(m, poly_value(s.a, s.n, u[i]), sweep_seen_h(&s, u[i]), span->begin + u[i] * width, begin,
			 *order);
}

/* All that piece i brings to the count, the knots' balls with the piece that begins there. */
static void find_marks(const struct prim_sweep *w, uint32_t i, vec o, vec d, double begin, struct marks *m)
{
	uint32_t knots = w->head.pieces + 1, order = 2 * knots + i * MARKS;
	struct span span[SPANS];
	struct seen seen;
	unsigned n;
	double a, h;

	m->count = 0;
	h = sweep_knot_h(&w->knot[i], o, d, &a);
	put_ball(m, a, h, 0, begin, 2 * i);
	if (h > 0)
		put_disc(m, w, i, 0, o, d, order);
	h = sweep_knot_h(&w->knot[i + 1], o, d, &a);
	if (i + 2 == knots)
		put_ball(m, a, h, 1, begin, 2 * i + 2);
	if (h > 0)
		put_disc(m, w, i, 1, o, d, order + 1);
	order += 2;
	n = sweep_spans(w, i, o, d, &seen, span);
	for (unsigned k = 0; k < n; k++) {
		if (span[k].end > span[k].begin)
			put_side(m, &seen, &span[k], begin, &order);
	}
}

static bool before(const struct mark *a, const struct mark *b)
{
	return a->t < b->t || (a->t == b->t && a->order < b->order);
}

/* Does it show? first: of all. */
static bool shows(const struct prim_sweep *w, vec o, vec d, double begin, const struct mark *m)
{
	const struct mark *first = m;
	struct mark least;
	bool last = true;
	int count = 1;

	for (uint32_t i = 0; i < w->head.pieces; i++) {
		struct marks other;

		find_marks(w, i, o, d, begin, &other);
		for (unsigned k = 0; k < other.count; k++) {
			const struct mark *by = &other.mark[k];

			if (before(by, m))
				count += by->step;
			else if (before(m, by))
				last = false;
			if (before(by, first)) {
				least = *by;
				first = &least;
			}
		}
	}
	if (first == m || last)
		return true;
	count -= first->step;
	return m->step > 0 ? count == 0 : count == 1;
}

bool sweep_inner_next(const struct prim *p, uint32_t piece, const struct prim_line *line, double from,
		      struct body_root *out)
{
	const struct prim_sweep *w = p->data;
	double len = vec_length(line->d), begin = -line->slide * len;
	vec d = vec_scale(line->d, 1 / len);
	const struct mark *done = NULL;
	struct marks own;

	find_marks(w, piece, line->o, d, begin, &own);
	for (;;) {
		const struct mark *best = NULL;

		for (unsigned k = 0; k < own.count; k++) {
			const struct mark *m = &own.mark[k];
			bool next = m->t > begin + AGAIN && m->t / len > from && (!done || before(done, m));

			if (next && (!best || before(m, best)))
				best = m;
		}
		if (!best)
			return false;
		done = best;
		if (shows(w, line->o, d, begin, best)) {
			*out = (struct body_root){ best->t / len, best->u };
			return true;
		}
	}
}

void sweep_inner_surface(const struct prim_sweep *w, vec at, uint32_t piece, unsigned end,
			 struct prim_point *s)
{
	const struct ball *k = &w->knot[piece + end];
	struct ball slope = disc_slope(w, piece, end);
	double l = vec_length(slope.c);
	vec n = vec_scale(slope.c, 1 / l);

	s->p = vec_mad(at, n, -(vec_dot(vec_sub(at, k->c), n) + k->r * slope.r / l));
	s->n = end ? n : vec_neg(n);
}
