/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * sphere_sweep (manual 3.4.5.1.13) and lathe (3.4.5.1.8): shapes given as a spline's points.
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

static bool read_lathe_kind(struct pov *p, enum lathe_kind *kind)
{
	*kind = LATHE_LINEAR;
	switch (pov_token(p)) {
	case TOK_LINEAR_SPLINE:
		break;
	case TOK_QUADRATIC_SPLINE:
		*kind = LATHE_QUADRATIC;
		break;
	case TOK_CUBIC_SPLINE:
		*kind = LATHE_CUBIC;
		break;
	case TOK_BEZIER_SPLINE:
		*kind = LATHE_BEZIER;
		break;
	default:
		return pov_starts_number(p);
	}
	pov_next(p);
	return true;
}

bool pov_read_flat_point(struct pov *p, struct buf *b, const char *what, struct diag_pos *at)
{
	double *point;

	if (!buf_reserve(b, pov_book(p), "scene", 1)) {
		pov_no_memory(p);
		return false;
	}
	pov_comma(p);
	*at = pov_here(p);
	point = (double *)b->data + 2 * (size_t)b->count++;
	pov_vector2(p, &point[0], &point[1]);
	if (!pov_failed(p) && !(isfinite(point[0]) && isfinite(point[1])))
		pov_fail_at(p, at, "the %s's point has a component that is not a finite number", what);
	return !pov_failed(p);
}

/* Which of them POV-Ray refuses beyond the axis was measured. */
static void read_profile(struct pov *p, struct buf *b, uint32_t n)
{
	struct diag_pos at;

	for (uint32_t i = 0; i < n && pov_read_flat_point(p, b, "lathe", &at); i++) {
		double radius = ((const double *)b->data)[2 * (size_t)i];

		if (radius < 0 && i && i + 1 < n) {
			pov_fail_at(p, &at, "the lathe's point lies at radius %g; only its first and last one "
				    "can lie beyond the axis", radius);
			return;
		}
	}
}

void pov_read_lathe(struct pov *p, struct object *o)
{
	static const uint32_t least[] = { [LATHE_LINEAR] = 2, [LATHE_QUADRATIC] = 3, [LATHE_CUBIC] = 4,
					  [LATHE_BEZIER] = 4 };
	struct buf b = { .size = 2 * sizeof(double) };
	struct diag_pos at;
	enum lathe_kind kind;
	uint32_t n, i;

	if (!read_lathe_kind(p, &kind)) {
		pov_fail(p, "a kind of spline or a number of points is expected in lathe { ... }, not %s",
			 pov_text(p));
		return;
	}
	pov_comma(p);
	at = pov_here(p);
	n = pov_count(p, "points in a lathe", least[kind], read_limits_fill(&pov_options(p)->limits).elements);
	if (!pov_failed(p) && kind == LATHE_BEZIER && n % 4)
		pov_fail_at(p, &at, "a lathe of bezier_spline has four points for each piece, not %u in all", n);
	read_profile(p, &b, n);
	if (!pov_failed(p)) {
		i = scene_add_lathe(pov_scene(p), n);
		if (i == SCENE_NONE) {
			pov_no_memory(p);
		} else {
			pov_scene(p)->lathe[i].kind = kind;
			memcpy(pov_scene(p)->lathe[i].point, b.data, n * b.size);
			o->shape.lathe.index = i;
			o->shape.lathe.pieces = kind == LATHE_BEZIER ? n / 4 : n + 1 - least[kind];
		}
	}
	buf_release(&b);
}
