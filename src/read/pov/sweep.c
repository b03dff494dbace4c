/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * sphere_sweep (manual 3.4.5.1.13).
 */
#include <config.h>

#include "read/pov/items.h"

static bool read_kind(struct pov *p, enum sweep_kind *kind)
{
	switch (pov_token(p)) {
	case TOK_LINEAR_SPLINE:
		*kind = SWEEP_LINEAR;
		break;
	case TOK_B_SPLINE:
		*kind = SWEEP_B;
		break;
	case TOK_CUBIC_SPLINE:
		*kind = SWEEP_CUBIC;
		break;
	default:
		pov_fail(p, "linear_spline, b_spline or cubic_spline is expected in sphere_sweep { ... }, not %s",
			 pov_text(p));
		return false;
	}
	pov_next(p);
	return true;
}

void pov_read_sweep(struct pov *p, struct object *o)
{
	enum sweep_kind kind;
	double (*point)[4];
	uint32_t n;

	if (!read_kind(p, &kind))
		return;
	pov_comma(p);
	n = pov_count(p, "the sphere_sweep's number of spheres", kind == SWEEP_LINEAR ? 2 : 4, UINT32_MAX - 1);
	if (pov_failed(p))
		return;
	o->shape.sweep = scene_add_sweep(pov_scene(p), n);
	if (o->shape.sweep == SCENE_NONE) {
		pov_no_memory(p);
		return;
	}
	pov_scene(p)->sweep[o->shape.sweep].kind = kind;
	point = pov_scene(p)->sweep[o->shape.sweep].point;
	for (uint32_t i = 0; i < n && !pov_failed(p); i++) {
		vec c;

		pov_comma(p);
		c = pov_finite_vector(p, "the sphere_sweep's centre");
		pov_comma(p);
		point[i][0] = c.x;
		point[i][1] = c.y;
		point[i][2] = c.z;
		point[i][3] = pov_finite_float(p, "the sphere_sweep's radius");
	}
	/* How exactly POV-Ray looks for hits; ours are as exact as they can be. */
	pov_comma(p);
	if (pov_accept(p, TOK_TOLERANCE))
		pov_finite_float(p, "tolerance");
}
