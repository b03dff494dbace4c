/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Isosurfaces: where a function of a place is a number, within a box or a sphere (manual 3.4.5.1.7).
 *
 * A function with slopes of at most g has no zero between two places L apart if the sum of its values' sizes
 * there is g L or more (Kalra and Barr, SIGGRAPH 1989). A line's stretch within the container is halved until
 * its parts are clear of zeros by that, or shorter than the accuracy; a part that short has one if the signs
 * of its ends differ, and then it is found to the last digits. Halves are halves of the whole stretch, as
 * POV-Ray takes them, so that a max_gradient that is too small tears the same holes.
 *
 * The container's own surface is the body's where the function says inside, unless it is open.
 */
#include "prim/body.h"

#include "pattern/function.h"

#define DEEPEST 24 /* halvings at most, so that every search ends */
#define FIRST_FACE 1 /* u of a root: 0 on the function's surface, else this + a face of the container */

struct prim_isosurface {
	struct body_data head;
	const struct scene *scene;
	struct isosurface iso;
	double max_gradient;
	vec half; /* of the box, in own coordinates */
};

static double value(const struct prim_isosurface *i, vec p)
{
	vec at = vec_mad(i->head.centre, p, i->head.size);
	double v = function_at(i->scene, i->iso.function, at) - i->iso.threshold;

	return isnan(v) ? ALD_INF : v;
}

struct stretch {
	const struct prim_isosurface *i;
	vec o, d;
	double pace; /* how much the function changes along t at most */
	double shortest; /* in t */
	double from;
};

static double along(const struct stretch *s, double t)
{
	return value(s->i, vec_mad(s->o, s->d, t));
}

/* The zero between a and b, whose values' signs differ: false position in the Illinois way (Dowell and Jarratt
 * 1971), and plain halves where that is slow. */
static double pinpoint(const struct stretch *s, double a, double fa, double b, double fb)
{
	double t = a, f, was;
	int side = 0;

	for (unsigned n = 0; n < 90; n++) {
		was = t;
		t = n < 30 ? a + (b - a) * (fa / (fa - fb)) : a + (b - a) / 2;
		if (!(t > a && t < b))
			t = a + (b - a) / 2;
		f = along(s, t);
		if (f == 0 || fabs(t - was) <= 2 * ALD_U * fabs(t) || b - a <= 4 * ALD_U * fabs(t))
			break;
		if ((f < 0) == (fa < 0)) {
			a = t;
			fa = f;
			if (side == 1)
				fb /= 2;
			side = 1;
		} else {
			b = t;
			fb = f;
			if (side == 2)
				fa /= 2;
			side = 2;
		}
	}
	return t;
}

/* The first zero behind s->from in a..b. Depth-first, with what is left to do on a stack. */
static bool first_zero(const struct stretch *s, double a, double b, double *t)
{
	struct end {
		double t, f;
	} left[DEEPEST + 1];
	struct end lo = { a, along(s, a) };
	unsigned n = 1;

	left[0] = (struct end){ b, along(s, b) };
	while (n) {
		struct end hi = left[n - 1];
		bool changes = (lo.f < 0) != (hi.f < 0);
		double gap = hi.t - lo.t;

		if (hi.t < s->from || (!changes && !(fabs(lo.f) + fabs(hi.f) < s->pace * gap))) {
			lo = hi;
			n--;
		} else if (gap > s->shortest && n <= DEEPEST) {
			double mid = lo.t + gap / 2;

			left[n++] = (struct end){ mid, along(s, mid) };
		} else {
			if (changes) {
				*t = pinpoint(s, lo.t, lo.f, hi.t, hi.f);
				if (*t > s->from)
					return true;
			}
			lo = hi;
			n--;
		}
	}
	return false;
}

/* Where the line is in the container, and through which faces it comes and goes. */
static bool within(const struct prim_isosurface *i, vec o, vec d, double t[2], unsigned face[2])
{
	t[0] = -ALD_INF;
	t[1] = ALD_INF;
	face[0] = face[1] = 0;
	if (i->iso.sphere) {
		double dd = vec_dot(d, d), rest = 1 - vec_dot(o, o);

		if (!(rest > 0))
			return false;
		t[1] = sqrt(rest / dd);
		t[0] = -t[1];
		return true;
	}
	for (unsigned k = 0; k < 3; k++) {
		double dk = (&d.x)[k], ok = (&o.x)[k], half = (&i->half.x)[k];
		double a = (-half - ok) / dk, b = (half - ok) / dk;

		if (dk == 0) {
			if (fabs(ok) > half)
				return false;
			continue;
		}
		if (fmin(a, b) > t[0]) {
			t[0] = fmin(a, b);
			face[0] = 2 * k + (dk < 0);
		}
		if (fmax(a, b) < t[1]) {
			t[1] = fmax(a, b);
			face[1] = 2 * k + (dk > 0);
		}
	}
	return t[0] < t[1];
}

static bool iso_next(const struct prim *p, uint32_t piece, const struct prim_line *line, double from,
		     struct body_root *root)
{
	const struct prim_isosurface *i = p->data;
	struct stretch s = { .i = i, .o = line->o, .d = line->d, .from = from };
	double length = vec_length(line->d) * i->head.size, t[2], zero;
	unsigned face[2];

	(void)piece;
	if (!within(i, line->o, line->d, t, face) || !(t[1] > from))
		return false;
	s.pace = i->max_gradient * length;
	s.shortest = i->iso.accuracy / length;
	if (t[0] > from && !i->iso.open && along(&s, t[0]) < 0) {
		*root = (struct body_root){ t[0], FIRST_FACE + face[0] };
		return true;
	}
	if (first_zero(&s, t[0], t[1], &zero)) {
		*root = (struct body_root){ zero, 0 };
		return true;
	}
	if (i->iso.open || !(along(&s, t[1]) < 0))
		return false;
	*root = (struct body_root){ t[1], FIRST_FACE + face[1] };
	return true;
}

static vec slope(const struct prim_isosurface *i, vec p, double step)
{
	double here = value(i, p);
	vec n;

	for (unsigned k = 0; k < 3; k++) {
		vec q = p;

		(&q.x)[k] += step;
		(&n.x)[k] = value(i, q) - here;
	}
	return n;
}

/* The normal is made of differences one accuracy away, as POV-Ray does it. */
static void iso_surface(const struct prim *p, vec at, uint32_t piece, double u, struct prim_point *s)
{
	const struct prim_isosurface *i = p->data;
	double l;

	(void)piece;
	s->p = at;
	s->error = 16 * ALD_U;
	if (u >= FIRST_FACE) {
		unsigned face = (unsigned)u - FIRST_FACE;

		if (i->iso.sphere) {
			s->n = vec_unit(at);
			s->p = s->n;
		} else {
			s->n = vec_make(0, 0, 0);
			(&s->n.x)[face / 2] = face & 1 ? 1 : -1;
			(&s->p.x)[face / 2] = (face & 1 ? 1 : -1) * (&i->half.x)[face / 2];
		}
		return;
	}
	s->n = slope(i, at, i->iso.accuracy / i->head.size);
	l = vec_length(s->n);
	s->n = l > 0 && isfinite(l) ? vec_scale(s->n, 1 / l) : vec_make(0, 1, 0);
	s->error = 1e-9;
}

static bool iso_inside(const struct prim *p, vec at)
{
	const struct prim_isosurface *i = p->data;

	if (i->iso.sphere ? vec_dot(at, at) > 1 :
			    fabs(at.x) > i->half.x || fabs(at.y) > i->half.y || fabs(at.z) > i->half.z)
		return false;
	return value(i, at) < 0;
}

static double iso_reach(const struct prim *p, uint32_t piece, vec m)
{
	const struct prim_isosurface *i = p->data;

	(void)piece;
	if (i->iso.sphere)
		return vec_length(m);
	return fabs(m.x) * i->half.x + fabs(m.y) * i->half.y + fabs(m.z) * i->half.z;
}

/* For "evaluate": the steepest slope on a grid, and some more. POV-Ray learns it while it draws. */
static double steepest(const struct prim_isosurface *i)
{
	enum { GRID = 24 };
	double most = 0;

	for (unsigned n = 0; n < GRID * GRID * GRID; n++) {
		vec p = { ((n % GRID) + 0.5) * 2 / GRID - 1, ((n / GRID % GRID) + 0.5) * 2 / GRID - 1,
			  ((n / GRID / GRID) + 0.5) * 2 / GRID - 1 };
		double l = vec_length(slope(i, vec_make(p.x * i->half.x, p.y * i->half.y, p.z * i->half.z),
					    1e-4)) / (1e-4 * i->head.size);

		if (isfinite(l))
			most = fmax(most, l);
	}
	return 1.5 * most;
}

static void iso_make(const struct scene *s, const struct object *o, void *data)
{
	const struct isosurface *iso = &s->isosurface[o->shape.isosurface];
	struct prim_isosurface *i = data;
	vec half = vec_scale(vec_sub(iso->hi, iso->lo), 0.5);
	double size = fmax(half.x, fmax(half.y, half.z));

	*i = (struct prim_isosurface){ .head = { vec_add(iso->lo, half), size, 1 }, .scene = s, .iso = *iso,
				       .half = vec_scale(half, 1 / size) };
	i->max_gradient = iso->evaluate ? fmax(iso->max_gradient, steepest(i)) : iso->max_gradient;
}

static size_t iso_bytes(const struct scene *s, const struct object *o)
{
	(void)s;
	(void)o;
	return sizeof(struct prim_isosurface);
}

static uint32_t iso_shape(const struct scene *s, const struct object *o, uint32_t *count)
{
	*count = s->isosurface_count;
	return o->shape.isosurface;
}

static uint32_t iso_pieces(const struct scene *s, const struct object *o)
{
	(void)s;
	(void)o;
	return 1;
}

const struct body_ops isosurface_ops = { iso_shape, iso_pieces, iso_bytes,   iso_make,
					 iso_reach, iso_next,	iso_surface, iso_inside };
