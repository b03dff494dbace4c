/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What all analytic primitives have in common: the maps, the filters, the error bounds.
 */
#include "prim/prim.h"

static const struct prim_ops *ops_of(const struct prim *p)
{
	static const struct prim_ops *const ops[SHAPE_KINDS] = {
		[SHAPE_SPHERE] = &prim_sphere_ops, [SHAPE_BOX] = &prim_box_ops,
		[SHAPE_CONE] = &prim_cone_ops,	   [SHAPE_DISC] = &prim_disc_ops,
		[SHAPE_SUPERELLIPSOID] = &prim_superellipsoid_ops,
		[SHAPE_TORUS] = &prim_torus_ops, [SHAPE_PLANE] = &prim_plane_ops,
		[SHAPE_ALGEBRAIC] = &prim_algebraic_ops,
	};

	return ops[p->kind];
}

/* Canonical to the object's own coordinates: rows are the images of the axes, the fourth the centre. */
static struct mat canonical(struct prim *p, const struct object *o)
{
	struct mat m = mat_identity;
	vec c = { 0, 0, 0 }, axis, x, y;
	double r;

	switch (o->kind) {
	case SHAPE_SPHERE:
		c = o->shape.sphere.centre;
		m.m[0][0] = m.m[1][1] = m.m[2][2] = o->shape.sphere.radius;
		break;
	case SHAPE_BOX:
		c = vec_sub(o->shape.box.hi, o->shape.box.lo);
		c = vec_mad(o->shape.box.lo, c, 0.5);
		break;
	case SHAPE_SUPERELLIPSOID:
		p->a = 2 / o->shape.superellipsoid.a;
		p->b = 2 / o->shape.superellipsoid.b;
		break;
	case SHAPE_TORUS:
		m.m[0][0] = m.m[1][1] = m.m[2][2] = o->shape.torus.major;
		p->a = o->shape.torus.minor / o->shape.torus.major;
		break;
	case SHAPE_CONE:
	case SHAPE_DISC:
		if (o->kind == SHAPE_CONE) {
			r = fmax(o->shape.cone.base_radius, o->shape.cone.apex_radius);
			axis = vec_scale(vec_sub(o->shape.cone.apex, o->shape.cone.base), 0.5);
			c = vec_add(o->shape.cone.base, axis);
			p->a = (o->shape.cone.base_radius / r + o->shape.cone.apex_radius / r) / 2;
			p->b = (o->shape.cone.apex_radius / r - o->shape.cone.base_radius / r) / 2;
			p->open = o->shape.cone.open;
		} else {
			r = o->shape.disc.radius;
			axis = vec_scale(o->shape.disc.normal, r);
			c = o->shape.disc.centre;
			p->a = o->shape.disc.hole / r;
		}
		x = fabs(axis.x) <= fabs(axis.y) && fabs(axis.x) <= fabs(axis.z) ? vec_make(1, 0, 0) :
		    fabs(axis.y) <= fabs(axis.z)				 ? vec_make(0, 1, 0) :
										   vec_make(0, 0, 1);
		y = vec_unit(vec_cross(axis, x));
		x = vec_scale(vec_unit(vec_cross(y, axis)), r);
		y = vec_scale(y, r);
		m = (struct mat){ { { x.x, x.y, x.z }, { y.x, y.y, y.z }, { axis.x, axis.y, axis.z } } };
		break;
	default:
		break;
	}
	m.m[3][0] = c.x;
	m.m[3][1] = c.y;
	m.m[3][2] = c.z;
	return m;
}

static bool finite_mat(const struct mat *m)
{
	for (unsigned i = 0; i < 4; i++) {
		if (!isfinite(m->m[i][0]) || !isfinite(m->m[i][1]) || !isfinite(m->m[i][2]))
			return false;
	}
	return true;
}

double prim_map_error(const struct mat *to, const struct mat *from, unsigned k, double size)
{
	double e = 0;

	for (unsigned j = 0; j < 3; j++) {
		double own = fabs(to->m[0][j]) + fabs(to->m[1][j]) + fabs(to->m[2][j]);

		e += fabs(from->m[j][k]) * own * size;
	}
	return 16 * ALD_U * e;
}

/* An inverse of a 3 x 3 matrix is off by as many roundoffs as its longest axis is times its shortest. A step of
 * Newton's, whose remainder is computed in pairs of doubles, leaves a few. */
static void refine_inverse(const struct mat *a, struct mat *x)
{
	double rest[3][3];
	struct mat was = *x;

	for (unsigned i = 0; i < 3; i++) {
		for (unsigned j = 0; j < 3; j++) {
			double sum[2] = { i == j, 0 };

			for (unsigned k = 0; k < 3; k++) {
				double low, high = ald_product(-a->m[i][k], was.m[k][j], &low);

				ald_pair_add(sum, high, low);
			}
			rest[i][j] = sum[0];
		}
	}
	for (unsigned i = 0; i < 3; i++) {
		for (unsigned j = 0; j < 3; j++)
			x->m[i][j] += was.m[i][0] * rest[0][j] + was.m[i][1] * rest[1][j] + was.m[i][2] * rest[2][j];
	}
	if (!finite_mat(x))
		*x = was;
}

bool prim_frame(struct prim *p, const struct mat *own, const struct xform *place, vec shift, double scale)
{
	struct mat m = *own;
	vec c = mat_point(&place->fwd, vec_make(m.m[3][0], m.m[3][1], m.m[3][2]));

	p->centre = vec_scale(vec_sub(c, shift), scale);
	m.m[3][0] = m.m[3][1] = m.m[3][2] = 0;
	p->from = mat_mul(&m, &place->fwd);
	for (unsigned i = 0; i < 3; i++) {
		for (unsigned j = 0; j < 3; j++)
			p->from.m[i][j] *= scale;
		p->from.m[3][i] = 0;
	}
	if (!finite_mat(&p->from) || !vec_finite(p->centre) || !mat_invert(&p->from, &p->to))
		return false;
	refine_inverse(&p->from, &p->to);
	return true;
}

bool prim_side(const struct prim *p, unsigned k, double down, double up, double size, double pad,
	       ald_box *box)
{
	double mid = (&p->centre.x)[k];
	double grow = pad + prim_map_error(&p->to, &p->from, k, size + fabs(mid)) +
		      8 * ALD_U * (fabs(up) + fabs(down) + fabs(mid));

	if (!isfinite(up) || !isfinite(down))
		return false;
	(&box->lo.x)[k] = mid - (down + grow);
	(&box->hi.x)[k] = mid + (up + grow);
	return true;
}

/* Make own units those of the level across the faces, and the faces what plane_make() makes of them. */
static bool box_faces(struct prim *p, const struct object *o, const struct xform *place, vec shift,
		      double scale)
{
	for (unsigned k = 0; k < 3; k++) {
		struct object face = { .kind = SHAPE_PLANE };
		struct prim_plane plane;
		double l;

		(&face.shape.plane.normal.x)[k] = 1;
		for (unsigned side = 0; side < 2; side++) {
			face.shape.plane.distance = (&(side ? &o->shape.box.hi : &o->shape.box.lo)->x)[k];
			if (!plane_make(&plane, &face, place, shift, scale))
				return false;
			p->side[2 * k + side] = plane.d;
		}
		l = vec_length(vec_make(p->to.m[0][k], p->to.m[1][k], p->to.m[2][k]));
		for (unsigned j = 0; j < 3; j++) {
			p->to.m[j][k] = (&plane.n.x)[j];
			p->from.m[k][j] *= l;
		}
		(&p->half.x)[k] = ((&o->shape.box.hi.x)[k] - (&o->shape.box.lo.x)[k]) / 2 / l;
	}
	return true;
}

/* A cone's two ends, or a disc. */
static bool flat_ends(struct prim *p, const struct object *o, const struct xform *place, vec shift,
		      double scale)
{
	struct object face = { .kind = SHAPE_PLANE };
	vec n = o->kind == SHAPE_DISC ? o->shape.disc.normal :
					vec_sub(o->shape.cone.apex, o->shape.cone.base);
	struct prim_plane plane;

	n = vec_scale(n, 1 / vec_length(n));
	face.shape.plane.normal = n;
	for (unsigned side = 0; side < 2; side++) {
		vec at = o->kind == SHAPE_DISC ? o->shape.disc.centre :
			 side			? o->shape.cone.apex :
						  o->shape.cone.base;

		face.shape.plane.distance = vec_dot(n, at);
		if (!plane_make(&plane, &face, place, shift, scale))
			return false;
		p->side[side] = plane.d;
	}
	p->half = plane.n;
	return true;
}

bool prim_make(struct prim *p, const struct object *o, const struct xform *place, vec shift,
	       double scale, double size, double pad)
{
	struct mat m;

	*p = (struct prim){ .kind = o->kind, .node = SCENE_NONE };
	m = canonical(p, o);
	if (!prim_frame(p, &m, place, shift, scale) || !isfinite(p->a) || !isfinite(p->b) ||
	    (o->kind == SHAPE_BOX && !box_faces(p, o, place, shift, scale)) ||
	    ((o->kind == SHAPE_CONE || o->kind == SHAPE_DISC) && !flat_ends(p, o, place, shift, scale)) ||
	    !vec_finite(p->half) || (o->kind == SHAPE_TORUS && p->a == 0))
		return false;
	for (unsigned k = 0; k < 3; k++) {
		double up = ops_of(p)->reach(p, k, true), down = ops_of(p)->reach(p, k, false);

		if (!prim_side(p, k, down, up, size, pad, &p->box))
			return false;
	}
	return true;
}

/* Hold t within the slabs of the box, by the same steps as ald_box_ray() without pads: then no
 * accelerator can have culled what it finds (R3). */
double prim_clamp(const ald_ray *r, const ald_box *b, double t)
{
	double t0 = -ALD_INF, t1 = ALD_INF;

	for (unsigned k = 0; k < 3; k++) {
		double d = (&r->dir.x)[k], o = (&r->org.x)[k], inv = 1 / d;
		double lo = (&b->lo.x)[k] - o, hi = (&b->hi.x)[k] - o;

		t0 = ald_max((signbit(d) ? hi : lo) * inv, t0);
		t1 = ald_min((signbit(d) ? lo : hi) * inv, t1);
	}
	t = t > t1 ? t1 : t;
	return t < t0 ? t0 : t;
}

/* o + d t, rounded at its end only: from far off o and d t all but cancel, and what is left decides whether a
 * round shape is met at all. */
static double slid(double o, double d, double t)
{
	double low, p = ald_product(d, t, &low), s = o + p, v = s - o;

	return s + (((o - (s - v)) + (p - v)) + low);
}

bool prim_line(const struct prim *p, const ald_ray *r, struct prim_line *l)
{
	vec o = mat_dir(&p->to, vec_sub(r->org, p->centre));
	double dd;

	l->d = mat_dir(&p->to, r->dir);
	dd = vec_dot(l->d, l->d);
	l->slide = -vec_dot(o, l->d) / dd;
	l->o = vec_make(slid(o.x, l->d.x, l->slide), slid(o.y, l->d.y, l->slide), slid(o.z, l->d.z, l->slide));
	return dd > 0 && isfinite(l->slide);
}

void prim_crossings(const struct prim *p, const ald_ray *r, struct prim_roots *roots)
{
	struct prim_line l;

	roots->count = 0;
	roots->begins = false;
	if (p->kind == SHAPE_BOX) {
		box_crossings(p, r, roots);
		return;
	}
	if (!prim_line(p, r, &l))
		return;
	ops_of(p)->roots(p, l.o, l.d, roots);
	for (uint32_t i = 0; i < roots->count; i++) {
		bool flat = p->kind == SHAPE_DISC || (p->kind == SHAPE_CONE && roots->part[i]);
		uint32_t side = roots->part[i] == 2;

		/* As box_crossings(): as near as a plane there, to the bit. A ray in that plane, but for rounding,
		 * might be told anything, and meets it within the radius. */
		if (flat) {
			double t = (p->side[side] - vec_dot(p->half, r->org)) / vec_dot(p->half, r->dir);

			roots->t[i] = t > roots->lo + l.slide ? fmin(t, roots->hi + l.slide) : roots->lo + l.slide;
		} else {
			roots->t[i] += l.slide;
		}
	}
}

int prim_intersect(const struct prim *p, uint32_t id, const ald_ray *r, ald_hit *hit)
{
	struct prim_roots roots;

	prim_crossings(p, r, &roots);
	for (uint32_t i = 0; i < roots.count; i++) {
		double t = prim_clamp(r, &p->box, roots.t[i]);

		if (!isfinite(t) || !ald_counts(r, t, id, hit))
			continue;
		*hit = (ald_hit){ .t = t, .prim = id, .part = roots.part[i] };
		return 1;
	}
	return 0;
}

void prim_leave(const struct prim *p, const struct prim_point *s, vec *at, vec *n, double *error)
{
	vec off = mat_dir(&p->from, s->p);
	double far = 1, l;

	*at = vec_add(p->centre, off);
	*n = mat_normal(&p->to, s->n);
	l = vec_length(*n);
	*n = vec_scale(*n, 1 / l);
	/* Own coordinates of a ray that starts here are off by a few u of these sizes; 1/l is what one
	 * own unit along the normal is in level units. */
	for (unsigned j = 0; j < 3; j++) {
		for (unsigned i = 0; i < 3; i++)
			far += fabs((&off.x)[i] * p->to.m[i][j]);
	}
	*error = (256 * ALD_U * far + s->error) / l +
		 8 * ALD_U * (fabs(at->x) + fabs(at->y) + fabs(at->z) + fabs(p->centre.x) +
			      fabs(p->centre.y) + fabs(p->centre.z));
}

void prim_surface(const struct prim *p, const ald_ray *r, const ald_hit *hit, vec *at, vec *n,
		  double *error)
{
	struct prim_point s = { .error = 0 };
	struct prim_line l;

	prim_line(p, r, &l);
	ops_of(p)->surface(p, vec_mad(l.o, l.d, hit->t - l.slide), hit->part, &s);
	prim_leave(p, &s, at, n, error);
}

bool prim_inside(const struct prim *p, vec at)
{
	const struct prim_ops *ops = ops_of(p);

	return ops->inside && ops->inside(p, mat_dir(&p->to, vec_sub(at, p->centre)));
}
