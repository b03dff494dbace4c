/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * sphere_sweep (manual 3.4.5.1.13).
 */
#include <config.h>

#include "read/pov/items.h"

#include <string.h>

#include "base/buf.h"
#include "read/limits.h"

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

static void read_points(struct pov *p, struct buf *b, uint32_t n)
{
	for (uint32_t i = 0; i < n && !pov_failed(p); i++) {
		double *point;
		vec c;

		if (!buf_reserve(b, pov_book(p), "scene", 1)) {
			pov_no_memory(p);
			return;
		}
		pov_comma(p);
		c = pov_finite_vector(p, "the sphere_sweep's centre");
		pov_comma(p);
		point = (double *)b->data + 4 * (size_t)b->count++;
		point[0] = c.x;
		point[1] = c.y;
		point[2] = c.z;
		point[3] = pov_finite_float(p, "the sphere_sweep's radius");
	}
}

void pov_read_sweep(struct pov *p, struct object *o)
{
	struct buf b = { .size = 4 * sizeof(double) };
	enum sweep_kind kind;
	struct sweep *w;
	uint32_t n;

	if (!read_kind(p, &kind))
		return;
	pov_comma(p);
	n = pov_count(p, "spheres in a sphere_sweep", kind == SWEEP_LINEAR ? 2 : 4,
		      read_limits_fill(&pov_options(p)->limits).elements);
	/* Room for what is there, not for what the number promises. */
	read_points(p, &b, n);
	pov_comma(p);
	if (pov_accept(p, TOK_TOLERANCE)) /* of POV-Ray's search for roots: ours are bracketed */
		pov_finite_float(p, "tolerance");
	if (!pov_failed(p)) {
		o->shape.sweep = scene_add_sweep(pov_scene(p), n);
		if (o->shape.sweep == SCENE_NONE) {
			pov_no_memory(p);
		} else {
			w = &pov_scene(p)->sweep[o->shape.sweep];
			w->kind = kind;
			memcpy(w->point, b.data, n * b.size);
		}
	}
	buf_release(&b);
}
