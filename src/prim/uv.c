/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Surface coordinates as POV-Ray has them (manual 3.4.7.5). It knows them for spheres, boxes and tori, in
 * the object's own coordinates; any other shape but meshes has x and y of the scene: measured.
 */
#include "prim/prim.h"

#define TURN 6.28318530717958647692

/* The box cut open: -x, +z, +x, -z side by side in the middle row, -y and +y below and above +z. */
static void box_uv(const struct object *o, vec p, uint32_t face, double *u, double *v)
{
	double q[3];

	for (unsigned k = 0; k < 3; k++) {
		double lo = (&o->shape.box.lo.x)[k], hi = (&o->shape.box.hi.x)[k];

		q[k] = hi > lo ? ((&p.x)[k] - lo) / (hi - lo) : 0;
	}
	*v = (1 + q[1]) / 3;
	switch (face) {
	case 0:
		*u = q[2] / 4;
		break;
	case 1:
		*u = (3 - q[2]) / 4;
		break;
	case 2:
		*u = (1 + q[0]) / 4;
		*v = q[2] / 3;
		break;
	case 3:
		*u = (1 + q[0]) / 4;
		*v = (3 - q[2]) / 3;
		break;
	case 4:
		*u = (4 - q[0]) / 4;
		break;
	default:
		*u = (1 + q[0]) / 4;
	}
}

/* u about y from +x over +z, v from the south pole up. */
static void sphere_uv(const struct object *o, vec p, double *u, double *v)
{
	vec q = vec_unit(vec_sub(p, o->shape.sphere.centre));

	*u = atan2(q.z, q.x) / TURN;
	*u += *u < 0;
	*v = 0.5 + asin(fmax(-1, fmin(1, q.y))) / (TURN / 2);
}

static void torus_uv(const struct object *o, vec p, double *u, double *v)
{
	*u = 0.5 - atan2(p.z, p.x) / TURN;
	*v = 0.5 + atan2(p.y, sqrt(p.x * p.x + p.z * p.z) - o->shape.torus.major) / TURN;
}

void prim_uv(const struct object *o, const struct xform *place, vec p, uint32_t part, double *u, double *v)
{
	vec own = mat_point(&place->inv, p);

	switch (o->kind) {
	case SHAPE_SPHERE:
		sphere_uv(o, own, u, v);
		break;
	case SHAPE_BOX:
		box_uv(o, own, part, u, v);
		break;
	case SHAPE_TORUS:
		torus_uv(o, own, u, v);
		break;
	default:
		*u = p.x;
		*v = p.y;
	}
}
