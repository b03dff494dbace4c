/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Blobs: where the densities of all components together reach the threshold (manual 3.4.5.1.1; Wyvill,
 * McPheeters, Wyvill: Data structure for soft objects, 1986).
 *
 * A component's density is k (1 - q)^2 within q <= 1, q being the squared distance from a point or a
 * segment in the component's own space, where its radius is 1. Along a line q is quadratic, over up to three
 * stretches for a segment with its round ends, so between the places where components begin, change and end
 * the sum is a quartic; its extrema, roots of a cubic, cut it into monotone pieces, in which a change of
 * sign brackets a root. The sign at the ends of a stretch is that of the sum taken there in order of the
 * components, the same for both stretches that meet: no root is lost between two, none is found twice.
 *
 * Each component is a primitive. A crossing is that of the first of the components that reach there, which
 * therefore has to know those whose boxes touch its own, and no others.
 */
#include "prim/body.h"
#include "prim/poly.h"

struct part {
	vec at; /* the centre, or the segment's first end */
	double to[3][3], from[3][3]; /* own coordinates from at to the component's, and back */
	double length; /* of the segment, along the component's z */
	double strength;
	uint32_t first_near, near_count; /* of blob.near: ascending, itself among them */
};

struct prim_blob {
	struct body_data head;
	double threshold;
	struct part *part; /* [pieces] */
	uint32_t *near;
};

/* A component as a line sees it. */
struct seen {
	vec o, d; /* in its space */
	double lo, hi; /* where it reaches; lo > hi: nowhere */
	double cut[2]; /* where the line passes the segment's ends */
	double length, strength;
};

static vec apply(const double m[3][3], vec p)
{
	return (vec){ p.x * m[0][0] + p.y * m[1][0] + p.z * m[2][0],
		      p.x * m[0][1] + p.y * m[1][1] + p.z * m[2][1],
		      p.x * m[0][2] + p.y * m[1][2] + p.z * m[2][2] };
}

/* From the nearest point of the segment. */
static vec nearest_off(double length, vec q)
{
	if (q.z > length)
		q.z -= length;
	else if (q.z > 0)
		q.z = 0;
	return q;
}

/* Stretch [lo, hi] over where the ball about (0, 0, z) is met. */
static void reach_ball(struct seen *s, double z)
{
	vec o = s->o;
	double dd = vec_dot(s->d, s->d), mid, gap, half;

	o.z -= z;
	mid = -vec_dot(o, s->d) / dd;
	o = vec_mad(o, s->d, mid);
	gap = 1 - vec_dot(o, o);
	if (!(gap >= 0))
		return;
	half = sqrt(gap / dd);
	s->lo = fmin(s->lo, mid - half);
	s->hi = fmax(s->hi, mid + half);
}

static void reach_cylinder(struct seen *s)
{
	double dd = s->d.x * s->d.x + s->d.y * s->d.y, mid, gap, half, x, y, z0, z1;

	if (!(dd > 0))
		return; /* the balls say it */
	mid = -(s->o.x * s->d.x + s->o.y * s->d.y) / dd;
	x = s->o.x + mid * s->d.x;
	y = s->o.y + mid * s->d.y;
	gap = 1 - (x * x + y * y);
	if (!(gap >= 0))
		return;
	half = sqrt(gap / dd);
	z0 = s->o.z + (mid - half) * s->d.z;
	z1 = s->o.z + (mid + half) * s->d.z;
	if (z0 >= 0 && z0 <= s->length)
		s->lo = fmin(s->lo, mid - half), s->hi = fmax(s->hi, mid - half);
	if (z1 >= 0 && z1 <= s->length)
		s->lo = fmin(s->lo, mid + half), s->hi = fmax(s->hi, mid + half);
}

static void see(const struct part *p, vec o, vec d, struct seen *s)
{
	double a, b;

	s->o = apply(p->to, vec_sub(o, p->at));
	s->d = apply(p->to, d);
	s->length = p->length;
	s->strength = p->strength;
	s->lo = ALD_INF;
	s->hi = -ALD_INF;
	s->cut[0] = s->cut[1] = ALD_INF;
	reach_ball(s, 0);
	if (!(p->length > 0))
		return;
	reach_ball(s, p->length);
	reach_cylinder(s);
	if (s->d.z == 0)
		return;
	a = -s->o.z / s->d.z;
	b = (p->length - s->o.z) / s->d.z;
	s->cut[0] = fmin(a, b);
	s->cut[1] = fmax(a, b);
}

static double density(const struct seen *s, double t)
{
	vec q;
	double g;

	if (!(t >= s->lo && t <= s->hi))
		return 0;
	q = nearest_off(s->length, vec_mad(s->o, s->d, t));
	g = 1 - vec_dot(q, q);
	return g > 0 ? s->strength * g * g : 0;
}

/* Add k (1 - q)^2 to the coefficients, over s0 + x w, x in 0..1. */
static void add_quartic(const struct seen *s, double s0, double w, double c[5])
{
	vec o = vec_mad(s->o, s->d, s0), d = vec_scale(s->d, w);
	double mid = o.z + d.z / 2, g0, g1, g2, k = s->strength;

	if (mid > s->length)
		o.z -= s->length;
	else if (mid > 0)
		o.z = d.z = 0;
	g0 = 1 - vec_dot(o, o);
	g1 = -2 * vec_dot(o, d);
	g2 = -vec_dot(d, d);
	c[0] += k * g0 * g0;
	c[1] += k * 2 * g0 * g1;
	c[2] += k * (2 * g0 * g2 + g1 * g1);
	c[3] += k * 2 * g1 * g2;
	c[4] += k * g2 * g2;
}

/* What a line sees of a component and its neighbours. As many as fit are kept, others seen again. */
#define KEPT 24
struct view {
	const struct prim_blob *b;
	const struct part *own;
	vec o, d;
	uint32_t kept; /* the first so many of the neighbours that the line meets ... */
	uint32_t which[KEPT];
	struct seen seen[KEPT];
	uint32_t rest; /* ... which are all before this neighbour */
};

static void look(struct view *v)
{
	v->kept = 0;
	for (v->rest = 0; v->rest < v->own->near_count && v->kept < KEPT; v->rest++) {
		uint32_t i = v->b->near[v->own->first_near + v->rest];

		see(&v->b->part[i], v->o, v->d, &v->seen[v->kept]);
		if (v->seen[v->kept].lo <= v->seen[v->kept].hi)
			v->which[v->kept++] = i;
	}
}

/* Neighbour n of those met, NULL: there are no more; s: room. */
static const struct seen *seen_at(const struct view *v, uint32_t *n, uint32_t *which, struct seen *s)
{
	uint32_t i;

	if (*n < v->kept) {
		*which = v->which[*n];
		return &v->seen[(*n)++];
	}
	for (i = v->rest + (*n - v->kept); i < v->own->near_count; i++) {
		*which = v->b->near[v->own->first_near + i];
		see(&v->b->part[*which], v->o, v->d, s);
		*n = v->kept + (i - v->rest) + 1;
		if (s->lo <= s->hi)
			return s;
	}
	return NULL;
}

/* Over the threshold at s. */
static double excess(const struct view *v, double s)
{
	const struct seen *p;
	uint32_t n = 0, which;
	double sum = -v->b->threshold;
	struct seen room;

	while ((p = seen_at(v, &n, &which, &room)))
		sum += density(p, s);
	return sum;
}

/* The next place behind s where some density changes its formula, end at most. */
static double next_change(const struct view *v, double s, double end)
{
	const struct seen *p;
	uint32_t n = 0, which;
	struct seen room;

	while ((p = seen_at(v, &n, &which, &room))) {
		const double at[4] = { p->lo, p->hi, p->cut[0], p->cut[1] };

		for (unsigned k = 0; k < 4; k++)
			end = at[k] > s && at[k] < end ? at[k] : end;
	}
	return end;
}

/* The sum over [s0, s1]; false: it belongs to another component. */
static bool stretch(const struct view *v, double s0, double s1, double c[5])
{
	uint32_t own = (uint32_t)(v->own - v->b->part), n = 0, which;
	const struct seen *p;
	struct seen room;

	c[0] = -v->b->threshold;
	c[1] = c[2] = c[3] = c[4] = 0;
	while ((p = seen_at(v, &n, &which, &room))) {
		if (!(p->lo <= s0 && p->hi >= s1))
			continue;
		if (which < own)
			return false;
		add_quartic(p, s0, s1 - s0, c);
	}
	return true;
}

static double quartic(const void *c, double x)
{
	return poly_value(c, 4, x);
}

/* Are all values over 0..1 surely of one sign? By Bernstein's coefficients. */
static bool one_sign(const double c[5])
{
	double b[5] = { c[0], c[0] + c[1] / 4, c[0] + c[1] / 2 + c[2] / 6,
			c[0] + c[1] * 0.75 + c[2] / 2 + c[3] / 4, c[0] + c[1] + c[2] + c[3] + c[4] };
	unsigned below = 0;

	for (unsigned k = 0; k < 5; k++)
		below += b[k] < 0;
	return below == 0 || below == 5;
}

/* The first root in (0, 1] behind from, of a quartic whose ends have these signs. */
static bool first_root(const double c[5], double f0, double f1, double from, double *root)
{
	double slope[4], cut[4], x = 0, fx = f0;
	unsigned cuts;

	if ((f0 < 0) == (f1 < 0) && one_sign(c))
		return false;
	poly_slope(c, 4, slope);
	cuts = poly_roots(slope, 3, 0, 1, cut);
	cut[cuts++] = 1;
	for (unsigned k = 0; k < cuts; k++) {
		double y = cut[k], fy = k + 1 == cuts ? f1 : poly_value(c, 4, y);

		if ((fx < 0) != (fy < 0)) {
			*root = poly_refine(quartic, c, x, fx, y, fy);
			if (*root > from)
				return true;
		}
		x = y;
		fx = fy;
	}
	return false;
}

static bool blob_next(const struct prim *p, uint32_t piece, const struct prim_line *line, double from,
		      struct body_root *out)
{
	const struct prim_blob *b = p->data;
	double len = vec_length(line->d), s, end, f0, f1, c[5];
	struct view v = { .b = b, .own = &b->part[piece], .o = line->o };
	struct seen own;

	v.d = vec_scale(line->d, 1 / len);
	see(v.own, v.o, v.d, &own);
	if (!(own.lo < own.hi) || own.hi / len < from)
		return false;
	look(&v);
	s = own.lo;
	f0 = excess(&v, s);
	while (s < own.hi) {
		double x, t;

		end = next_change(&v, s, own.hi);
		f1 = excess(&v, end);
		if (end / len >= from && stretch(&v, s, end, c)) {
			t = -1;
			while (first_root(c, f0, f1, t, &x)) {
				*out = (struct body_root){ (s + x * (end - s)) / len, 0 };
				if (out->t > from)
					return true;
				t = x;
			}
		}
		s = end;
		f0 = f1;
	}
	return false;
}

/* Density and its gradient, times -1, of part i; size: what rounding is measured by. */
static double field(const struct part *p, vec at, vec *slope)
{
	vec q = nearest_off(p->length, apply(p->to, vec_sub(at, p->at)));
	double g = 1 - vec_dot(q, q), f;

	if (!(g > 0))
		return 0;
	f = 4 * p->strength * g;
	for (unsigned k = 0; k < 3; k++)
		(&slope->x)[k] += f * (p->to[k][0] * q.x + p->to[k][1] * q.y + p->to[k][2] * q.z);
	return p->strength * g * g;
}

/* Onto the surface by a step of Newton's; what is left is the sum's own rounding, over its slope. */
static void blob_surface(const struct prim *p, vec at, uint32_t piece, double u, struct prim_point *s)
{
	const struct prim_blob *b = p->data;
	const struct part *own = &b->part[piece];
	double sum = -b->threshold, size = fabs(b->threshold), l;
	vec slope = { 0, 0, 0 };

	(void)u;
	for (uint32_t i = 0; i < own->near_count; i++) {
		const struct part *one = &b->part[b->near[own->first_near + i]];
		double f = field(one, at, &slope);

		sum += f;
		size += f != 0 ? fabs(one->strength) : 0;
	}
	l = vec_length(slope);
	s->n = l > 0 ? vec_scale(slope, 1 / l) : vec_make(0, 0, 1);
	s->p = vec_mad(at, s->n, l > 0 ? fmax(-1e-6, fmin(1e-6, sum / l)) : 0);
	s->error = l > 0 ? fmin(64 * ALD_U * size * (own->near_count + 4) / l, 1e-6) : 1e-6;
}

/* Do these components look the same? */
static bool alike(const struct blob *b, uint32_t i, uint32_t k)
{
	if (i == SCENE_NONE || k == SCENE_NONE)
		return i == k;
	return b->part[i].texture == b->part[k].texture &&
	       b->part[i].texture_place == b->part[k].texture_place;
}

/* As POV-Ray weighs them: by the size of the density, also where it is negative. */
uint32_t blob_blend(const struct blob *blob, const struct prim *p, uint32_t piece, vec at, uint32_t *part,
		    double *share, uint32_t room)
{
	const struct prim_blob *b = p->data;
	const struct part *q = &b->part[piece];
	double sum = 0;
	uint32_t n = 0;
	vec slope;

	at = mat_dir(&p->to, vec_sub(at, p->centre));
	for (uint32_t i = 0; i < q->near_count; i++) {
		uint32_t which = b->near[q->first_near + i], k = 0;
		double f = fabs(field(&b->part[which], at, &slope));

		if (f == 0)
			continue;
		if (blob->part[which].texture == SCENE_NONE)
			which = SCENE_NONE;
		while (k < n && !alike(blob, part[k], which))
			k++;
		if (k == room) { /* the faintest makes room, if it is fainter */
			k = 0;
			for (uint32_t j = 1; j < n; j++)
				k = share[j] < share[k] ? j : k;
			if (share[k] >= f)
				continue;
			share[k] = 0;
		} else if (k == n) {
			share[n++] = 0;
		}
		part[k] = which;
		share[k] += f;
	}
	for (uint32_t k = 0; k < n; k++)
		sum += share[k];
	for (uint32_t k = 0; k < n; k++)
		share[k] /= sum;
	if (n)
		return n;
	part[0] = SCENE_NONE;
	share[0] = 1;
	return 1;
}

static bool blob_inside(const struct prim *p, vec at)
{
	const struct prim_blob *b = p->data;
	double sum = -b->threshold;
	vec slope;

	for (uint32_t i = 0; i < b->head.pieces; i++)
		sum += field(&b->part[i], at, &slope);
	return sum >= 0;
}

static double blob_reach(const struct prim *p, uint32_t piece, vec m)
{
	const struct part *q = &((const struct prim_blob *)p->data)->part[piece];
	vec along;

	for (unsigned k = 0; k < 3; k++)
		(&along.x)[k] = q->from[k][0] * m.x + q->from[k][1] * m.y + q->from[k][2] * m.z;
	return vec_dot(q->at, m) + fmax(0, q->length * along.z) + vec_length(along);
}

/* ---- making ---- */

/* A component's space to the object's coordinates. */
static struct mat part_mat(const struct blob_part *p, double *length)
{
	vec axis = vec_sub(p->apex, p->base), x, y, z = { 0, 0, 1 };
	double l = vec_length(axis);
	struct mat m;

	*length = p->cylinder ? l / p->radius : 0;
	if (p->cylinder && l > 0)
		z = vec_scale(axis, 1 / l);
	x = fabs(z.x) <= fabs(z.y) && fabs(z.x) <= fabs(z.z) ? vec_make(1, 0, 0) :
	    fabs(z.y) <= fabs(z.z)			     ? vec_make(0, 1, 0) :
							       vec_make(0, 0, 1);
	y = vec_unit(vec_cross(z, x));
	x = vec_scale(vec_unit(vec_cross(y, z)), p->radius);
	y = vec_scale(y, p->radius);
	z = vec_scale(z, p->radius);
	m = (struct mat){ { { x.x, x.y, x.z }, { y.x, y.y, y.z }, { z.x, z.y, z.z },
			    { p->base.x, p->base.y, p->base.z } } };
	return p->place ? mat_mul(&m, &p->place->fwd) : m;
}

static ald_box part_box(const struct mat *m, double length)
{
	ald_box b;

	for (unsigned k = 0; k < 3; k++) {
		double r = sqrt(m->m[0][k] * m->m[0][k] + m->m[1][k] * m->m[1][k] + m->m[2][k] * m->m[2][k]);
		double end = length * m->m[2][k];

		r *= 1 + 16 * ALD_U;
		(&b.lo.x)[k] = m->m[3][k] + fmin(0, end) - r;
		(&b.hi.x)[k] = m->m[3][k] + fmax(0, end) + r;
	}
	return b;
}

static ald_box scene_part_box(const struct blob_part *p)
{
	double length;
	struct mat m = part_mat(p, &length);

	return part_box(&m, length);
}

static bool touch(const ald_box *a, const ald_box *b)
{
	return a->lo.x <= b->hi.x && b->lo.x <= a->hi.x && a->lo.y <= b->hi.y && b->lo.y <= a->hi.y &&
	       a->lo.z <= b->hi.z && b->lo.z <= a->hi.z;
}

static size_t count_near(const struct blob *b, uint32_t i)
{
	ald_box own = scene_part_box(&b->part[i]);
	size_t n = 0;

	for (uint32_t k = 0; k < b->count; k++) {
		ald_box other = scene_part_box(&b->part[k]);

		n += touch(&own, &other);
	}
	return n;
}

static size_t blob_bytes(const struct scene *s, const struct object *o)
{
	const struct blob *b = &s->blob[o->shape.blob];
	size_t near = 0;

	for (uint32_t i = 0; i < b->count; i++)
		near += count_near(b, i);
	return sizeof(struct prim_blob) + b->count * sizeof(struct part) + near * sizeof(uint32_t);
}

static void make_part(struct part *out, const struct blob_part *p, const struct body_data *head)
{
	struct mat m = part_mat(p, &out->length), inv;

	out->at = vec_scale(vec_sub(vec_make(m.m[3][0], m.m[3][1], m.m[3][2]), head->centre), 1 / head->size);
	out->strength = p->strength;
	for (unsigned i = 0; i < 3; i++) {
		for (unsigned k = 0; k < 3; k++)
			m.m[i][k] /= head->size;
		m.m[3][i] = 0;
	}
	if (!mat_invert(&m, &inv)) { /* nowhere */
		inv = mat_identity;
		out->strength = 0;
	}
	for (unsigned i = 0; i < 3; i++) {
		for (unsigned k = 0; k < 3; k++) {
			out->from[i][k] = m.m[i][k];
			out->to[i][k] = inv.m[i][k];
		}
	}
}

static void blob_make(const struct scene *s, const struct object *o, void *data)
{
	const struct blob *b = &s->blob[o->shape.blob];
	struct prim_blob *out = data;
	ald_box all = ald_box_empty();
	uint32_t near = 0;

	*out = (struct prim_blob){ .head.pieces = b->count, .threshold = b->threshold,
				   .part = (struct part *)(out + 1) };
	out->near = (uint32_t *)(out->part + b->count);
	for (uint32_t i = 0; i < b->count; i++) {
		ald_box one = scene_part_box(&b->part[i]);

		ald_box_join(&all, &one);
	}
	out->head.centre = vec_mad(all.lo, vec_sub(all.hi, all.lo), 0.5);
	out->head.size = fmax(all.hi.x - all.lo.x, fmax(all.hi.y - all.lo.y, all.hi.z - all.lo.z)) / 2;
	for (uint32_t i = 0; i < b->count; i++) {
		struct part *p = &out->part[i];
		ald_box own = scene_part_box(&b->part[i]);

		make_part(p, &b->part[i], &out->head);
		p->first_near = near;
		for (uint32_t k = 0; k < b->count; k++) {
			ald_box other = scene_part_box(&b->part[k]);

			if (touch(&own, &other))
				out->near[near++] = k;
		}
		p->near_count = near - p->first_near;
	}
}

static uint32_t blob_shape(const struct scene *s, const struct object *o, uint32_t *count)
{
	*count = s->blob_count;
	return o->shape.blob;
}

static uint32_t blob_pieces(const struct scene *s, const struct object *o)
{
	return s->blob[o->shape.blob].count;
}

const struct body_ops blob_ops = { blob_shape, blob_pieces, blob_bytes,	  blob_make,
				   blob_reach, blob_next,   blob_surface, blob_inside };
