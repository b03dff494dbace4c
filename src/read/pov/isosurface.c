/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * isosurface { function { ... } contained_by { box or sphere } ... } (manual 3.4.5.1.7).
 */
#include <config.h>

#include "read/pov/items.h"

#include <math.h>

#include "read/pov/function.h"

static void read_container(struct pov *p, struct isosurface *i)
{
	bool box;

	if (!pov_expect(p, TOK_LEFT_BRACE, "after contained_by"))
		return;
	box = pov_accept(p, TOK_BOX);
	if (!box && !pov_accept(p, TOK_SPHERE)) {
		pov_fail(p, "contained_by takes a box or a sphere, not %s", pov_text(p));
		return;
	}
	pov_expect(p, TOK_LEFT_BRACE, "after the container's kind");
	if (box) {
		vec a = pov_finite_vector(p, "the container's first corner"), b;

		pov_comma(p);
		b = pov_finite_vector(p, "the container's second corner");
		i->lo = vec_make(fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z));
		i->hi = vec_make(fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z));
	} else {
		vec c = pov_finite_vector(p, "the container's centre");
		double r;

		pov_comma(p);
		r = fabs(pov_finite_float(p, "the container's radius"));
		i->lo = vec_sub(c, vec_make(r, r, r));
		i->hi = vec_add(c, vec_make(r, r, r));
	}
	i->sphere = !box;
	pov_expect(p, TOK_RIGHT_BRACE, "at the end of the container");
	pov_expect(p, TOK_RIGHT_BRACE, "at the end of contained_by");
	if (!pov_failed(p) && !(i->lo.x < i->hi.x && i->lo.y < i->hi.y && i->lo.z < i->hi.z))
		pov_fail(p, "the isosurface's container has no room in it");
}

static double positive(struct pov *p, const char *what)
{
	struct diag_pos at = pov_here(p);
	double v = pov_finite_float(p, what);

	if (!pov_failed(p) && !(v > 0))
		pov_fail_at(p, &at, "%s is %g, but has to be more than 0", what, v);
	return v;
}

/* False: something else begins. */
static bool read_word(struct pov *p, struct isosurface *i)
{
	switch (pov_token(p)) {
	case TOK_CONTAINED_BY:
		pov_next(p);
		read_container(p, i);
		return true;
	case TOK_THRESHOLD:
		pov_next(p);
		i->threshold = pov_finite_float(p, "threshold");
		return true;
	case TOK_ACCURACY:
		pov_next(p);
		i->accuracy = positive(p, "accuracy");
		return true;
	case TOK_MAX_GRADIENT:
		pov_next(p);
		i->max_gradient = positive(p, "max_gradient");
		return true;
	case TOK_EVALUATE:
		pov_next(p);
		i->evaluate = true;
		i->max_gradient = positive(p, "evaluate's least gradient");
		pov_comma(p);
		pov_finite_float(p, "evaluate's factor");
		pov_comma(p);
		pov_finite_float(p, "evaluate's share");
		return true;
	case TOK_MAX_TRACE: /* all crossings are always there */
		pov_next(p);
		pov_finite_float(p, "max_trace");
		return true;
	case TOK_ALL_INTERSECTIONS:
		pov_next(p);
		return true;
	case TOK_OPEN:
		pov_next(p);
		i->open = true;
		return true;
	default:
		return false;
	}
}

void pov_read_isosurface(struct pov *p, struct object *o)
{
	struct isosurface i = { .accuracy = 0.001, .max_gradient = 1.1, .lo = { -1, -1, -1 }, .hi = { 1, 1, 1 } };
	struct diag_pos at = pov_here(p);
	struct pov_function *f;

	if (!pov_expect(p, TOK_FUNCTION, "at the beginning of an isosurface"))
		return;
	f = function_read(p);
	if (!f || !function_of_points(p, &at, f) || !pov_lack_use(p, &f->lack))
		return;
	while (!pov_failed(p) && read_word(p, &i))
		;
	if (pov_failed(p))
		return;
	i.function = scene_adopt_function(pov_scene(p), &pov_state(p)->copies, &f->function);
	o->shape.isosurface = i.function ? scene_add_isosurface(pov_scene(p), &i) : SCENE_NONE;
	if (o->shape.isosurface == SCENE_NONE)
		pov_no_memory(p);
}
