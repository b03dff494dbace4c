/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Analytic primitives: each is a canonical shape about the origin, of size 1, and an affine map.
 *
 * A ray is moved relative to the shape's centre first and mapped then, so that far shapes lose nothing to
 * cancellation, and its origin is slid along it to the point of closest approach before any root is
 * sought (Haines et al., Ray Tracing Gems 7, 2019). Own coordinates are the canonical ones; level
 * coordinates those of the accelerator.
 */
#ifndef ALIDADE_PRIM_PRIM_H
#define ALIDADE_PRIM_PRIM_H

#include "alidade/kernel.h"
#include "base/vec.h"
#include "scene/scene.h"

#define PRIM_ROOTS SCENE_ALGEBRAIC_DEGREE

struct prim {
	enum shape_kind kind;
	bool open; /* cone without caps */
	bool inner; /* a clear curve, whose inner surfaces show by where the ray starts */
	vec centre; /* in level coordinates */
	struct mat to; /* level to own; linear part only */
	struct mat from; /* own to level; linear part only */
	double a, b; /* cone: mean radius and half the growth; torus: minor radius; disc: hole;
			superellipsoid: its powers */
	vec half; /* box; a plane's normal, that of a cone's ends, a disc's */
	double side[6]; /* like prim_plane.d, where these are: a box's faces along the columns of to, which
			   are unit; a cone's ends; a disc */
	ald_box box; /* grown, as the accelerator sees it; a body has none */
	const void *data; /* of a body, see body.h; an algebraic surface's polynomial */
	uint32_t node; /* in constructive solid geometry, see csg.h; SCENE_NONE: all of the surface shows */
};

/* A ray in own coordinates, its origin slid to the point of closest approach: o + (t - slide) d. */
struct prim_line {
	vec o, d;
	double slide;
};

/* Where a line meets a primitive, in order; t may be infinite or NaN, which never counts. */
struct prim_roots {
	uint32_t count;
	bool begins; /* the line comes from within, which is so for infinite shapes only */
	double t[PRIM_ROOTS];
	uint32_t part[PRIM_ROOTS];
	double lo, hi; /* of a cone or disc: within, the line is in its radius */
};

/* A point on a surface in own coordinates. */
struct prim_point {
	vec p; /* exactly on the canonical surface, but for rounding */
	vec n; /* unit, outward */
	double error; /* how far p may be off the surface, beyond the usual few roundoffs */
};

/* Per kind: roots along o + t d, both in own coordinates; the surface near p; is p inside; how far the
 * shape reaches from its centre up or down level axis k. */
struct prim_ops {
	void (*roots)(const struct prim *, vec o, vec d, struct prim_roots *);
	void (*surface)(const struct prim *, vec p, uint32_t part, struct prim_point *);
	bool (*inside)(const struct prim *, vec p);
	double (*reach)(const struct prim *, unsigned k, bool up);
};

/* A box's, from level coordinates. */
void box_crossings(const struct prim *, const ald_ray *, struct prim_roots *);

extern const struct prim_ops prim_sphere_ops, prim_box_ops, prim_cone_ops, prim_disc_ops, prim_torus_ops,
	prim_plane_ops, prim_superellipsoid_ops, prim_algebraic_ops;

/* Set up from a scene object and its accumulated transform; level = (world - shift) * scale. False: it
 * has no extent, or something is not finite. Grows the box by pad and by what the map's rounding can
 * move rays that start within reach of the geometry, whose extent is size. */
bool prim_make(struct prim *, const struct object *, const struct xform *place, vec shift, double scale,
	       double size, double pad);

/* An infinite plane as a primitive, for constructive solid geometry: its box is infinite and the caller's
 * to bound. */
bool prim_make_plane(struct prim *, const struct object *, const struct xform *place, vec shift,
		     double scale);
/* The same of an algebraic surface. */
bool prim_make_algebraic(struct prim *, const struct algebraic *, const struct xform *place, vec shift,
			 double scale);

/* Where the whole line meets the primitive, by t, before the box holds them (prim_clamp()). */
void prim_crossings(const struct prim *, const ald_ray *, struct prim_roots *);
/* Rule R1 and the filters: as prims->intersect(), masks and skip apart. */
int prim_intersect(const struct prim *, uint32_t id, const ald_ray *, ald_hit *);
/* Place and unit normal in level coordinates of a hit, and a bound on the place's error. */
void prim_surface(const struct prim *, const ald_ray *, const ald_hit *, vec *p, vec *n, double *error);
bool prim_inside(const struct prim *, vec p); /* p in level coordinates */

/* Surface coordinates of a point p of the world on an object that is no mesh and has this place; part as
 * in the hit. Only for textures that ask for them. */
void prim_uv(const struct object *, const struct xform *place, vec p, uint32_t part, double *u, double *v);

/* What shape.c shares with body.c. The maps of a shape that own takes to the object's coordinates, the
 * fourth row being its centre; false: not finite or flat. */
bool prim_frame(struct prim *, const struct mat *own, const struct xform *place, vec shift, double scale);
/* The box's two sides across axis k, for a shape that reaches so far down and up from its centre. */
bool prim_side(const struct prim *, unsigned k, double down, double up, double size, double pad,
	       ald_box *);
bool prim_line(const struct prim *, const ald_ray *, struct prim_line *); /* false: no such line */
double prim_clamp(const ald_ray *, const ald_box *, double t);
void prim_leave(const struct prim *, const struct prim_point *, vec *p, vec *n, double *error);

/* How far rounding can move a ray, on its way through a map and back, along axis k; its coordinates
 * relative to the map's centre are up to size. */
double prim_map_error(const struct mat *to, const struct mat *from, unsigned k, double size);

/* |column k| of from, over the own axes x and y / x and z / all. */
static inline double prim_column(const struct prim *p, unsigned k, bool x, bool y, bool z)
{
	double a = x ? p->from.m[0][k] : 0, b = y ? p->from.m[1][k] : 0, c = z ? p->from.m[2][k] : 0;

	return sqrt(a * a + b * b + c * c);
}

/* An infinite plane, in level coordinates: points p with n.p = d. */
struct prim_plane {
	vec n; /* unit */
	double d;
};

bool plane_make(struct prim_plane *, const struct object *, const struct xform *place, vec shift,
		double scale);
/* Where the line meets the plane, if it does. */
bool plane_intersect(const struct prim_plane *, const ald_ray *, double *t);
void plane_surface(const struct prim_plane *, const ald_ray *, const ald_hit *, vec *p, vec *n,
		   double *error);
bool plane_inside(const struct prim_plane *, vec p);

#endif
