/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * prism (manual 3.4.5.1.11): closed curves one after the other in one list of points, each as long as it takes to
 * come back to where it began.
 */
#include "read/pov/internal.h"

#include <string.h>

#include "base/buf.h"
#include "read/limits.h"
#include "read/pov/items.h"

struct draft {
	struct prism prism;
	struct buf point, piece; /* two numbers; four points */
};

static bool take_kind(struct pov *p, struct prism *out)
{
	switch (pov_token(p)) {
	case TOK_LINEAR_SPLINE:
		out->kind = LATHE_LINEAR;
		break;
	case TOK_QUADRATIC_SPLINE:
		out->kind = LATHE_QUADRATIC;
		break;
	case TOK_CUBIC_SPLINE:
		out->kind = LATHE_CUBIC;
		break;
	case TOK_BEZIER_SPLINE:
		out->kind = LATHE_BEZIER;
		break;
	case TOK_LINEAR_SWEEP:
		out->conic = false;
		break;
	case TOK_CONIC_SWEEP:
		out->conic = true;
		break;
	default:
		return false;
	}
	pov_next(p);
	return true;
}

static const double *point(const struct draft *d, uint32_t i)
{
	return (const double *)d->point.data + 2 * (size_t)i;
}

static bool same(const struct draft *d, uint32_t i, uint32_t k)
{
	return point(d, i)[0] == point(d, k)[0] && point(d, i)[1] == point(d, k)[1];
}

/* A piece of n points from the i-th on, but the last is the k-th. */
static void add_piece(struct pov *p, struct draft *d, uint32_t i, uint32_t n, uint32_t k)
{
	double(*to)[2];

	if (!buf_reserve(&d->piece, pov_book(p), "scene", 1)) {
		pov_no_memory(p);
		return;
	}
	to = (double(*)[2])((char *)d->piece.data + d->piece.count++ * d->piece.size);
	for (uint32_t j = 0; j < 4; j++)
		memcpy(to[j], point(d, j < n - 1 ? i + j : k), sizeof(*to));
}

/* Curves with a control point before them and after them, by kind, each closed by its own first point. */
static void cut_curves(struct pov *p, struct draft *d, const struct diag_pos *at)
{
	bool cubic = d->prism.kind == LATHE_CUBIC, linear = d->prism.kind == LATHE_LINEAR;
	uint32_t before = !linear, after = cubic, n = d->point.count, first = 0, i = 0;

	while (!pov_failed(p) && i + before + 1 + after < n) {
		uint32_t end = i + before + 1;

		add_piece(p, d, i, end + after - i + 1, end + after);
		if (same(d, end, first + before)) {
			first = i = end + after + 1;
			continue;
		}
		i++;
	}
	if (first + before >= n || i == first)
		return;
	if (!linear) {
		pov_fail_at(p, at, "the prism's curve is not closed: a point like its first one has to follow");
		return;
	}
	pov_warn(p, at, "the prism's curve is not closed; it is closed with a straight line");
	add_piece(p, d, n - 1, 2, first);
}

static void cut_beziers(struct pov *p, struct draft *d, const struct diag_pos *at)
{
	if (d->point.count % 4) {
		pov_fail_at(p, at, "a prism of bezier_spline has four points for each piece, not %u in all",
			    d->point.count);
		return;
	}
	for (uint32_t i = 0; i < d->point.count && !pov_failed(p); i += 4)
		add_piece(p, d, i, 4, i + 3);
}

static void finish(struct pov *p, struct draft *d, struct object *o)
{
	uint32_t i = scene_add_prism(pov_scene(p), 4 * d->piece.count);
	struct prism *made;

	if (i == SCENE_NONE) {
		pov_no_memory(p);
		return;
	}
	made = &pov_scene(p)->prism[i];
	d->prism.point = made->point;
	d->prism.count = made->count;
	*made = d->prism;
	memcpy(made->point, d->piece.data, d->piece.count * d->piece.size);
	o->shape.prism.index = i;
}

static void read_prism(struct pov *p, struct object *o, struct draft *d)
{
	static const uint32_t least[] = { [LATHE_LINEAR] = 3, [LATHE_QUADRATIC] = 4, [LATHE_CUBIC] = 5,
					  [LATHE_BEZIER] = 4 };
	struct diag_pos at, point_at;
	uint32_t n;
	double h;

	while (take_kind(p, &d->prism))
		;
	d->prism.lo = pov_finite_float(p, "the prism's first height");
	pov_comma(p);
	d->prism.hi = pov_finite_float(p, "the prism's second height");
	if (d->prism.lo > d->prism.hi) {
		h = d->prism.lo;
		d->prism.lo = d->prism.hi;
		d->prism.hi = h;
	}
	pov_comma(p);
	at = pov_here(p);
	n = pov_count(p, "points in a prism", least[d->prism.kind],
		      read_limits_fill(&pov_options(p)->limits).elements);
	for (uint32_t i = 0; i < n && pov_read_flat_point(p, &d->point, "prism", &point_at); i++)
		;
	d->prism.open = pov_accept(p, TOK_OPEN);
	if (pov_failed(p))
		return;
	if (d->prism.kind == LATHE_BEZIER)
		cut_beziers(p, d, &at);
	else
		cut_curves(p, d, &at);
	if (!pov_failed(p))
		finish(p, d, o);
}

void pov_read_prism(struct pov *p, struct object *o)
{
	struct draft d = { .point.size = 2 * sizeof(double), .piece.size = 8 * sizeof(double) };

	read_prism(p, o, &d);
	buf_release(&d.point);
	buf_release(&d.piece);
}
