/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Constructive solid geometry: random trees against their definition, asked point by point; and no way
 * through where two surfaces meet.
 */
#include "world_fixture.h"

enum { LEAVES = 6 };

struct solid_leaf {
	int kind; /* 0 ball, 1 box, 2 half space */
	vec c, h;
	double r;
};

struct tree_node {
	bool merge, inverse;
	int left, right; /* >= 0: a node; else leaf ~left */
};

struct tree {
	struct solid_leaf leaf[LEAVES];
	struct tree_node node[LEAVES - 1]; /* [i] uses leaf i and node i + 1, or the last two leaves */
};

static bool leaf_in(const struct solid_leaf *l, vec p)
{
	vec q = vec_sub(p, l->c);

	if (l->kind == 0)
		return vec_dot(q, q) <= l->r * l->r;
	if (l->kind == 1)
		return fabs(q.x) <= l->h.x && fabs(q.y) <= l->h.y && fabs(q.z) <= l->h.z;
	return vec_dot(q, l->h) <= 0;
}

static bool tree_in(const struct tree *t, int i, vec p)
{
	const struct tree_node *n;
	bool a, b;

	if (i < 0)
		return leaf_in(&t->leaf[~i], p);
	n = &t->node[i];
	a = tree_in(t, n->left, p);
	b = tree_in(t, n->right, p);
	return (n->merge ? a || b : a && b) != n->inverse;
}

static void make_tree(struct tree *t, double size, uint64_t *seed)
{
	for (unsigned i = 0; i < LEAVES; i++) {
		struct solid_leaf *l = &t->leaf[i];

		l->kind = i == LEAVES - 1 ? 2 : (int)(2 * uniform(seed));
		l->c = vec_scale(random_vec(seed), 0.5 * size);
		l->r = size * (0.4 + 0.5 * uniform(seed));
		l->h = l->kind == 2 ? random_unit(seed) :
				      vec_scale(vec_make(0.3 + uniform(seed), 0.3 + uniform(seed), 0.5), size);
	}
	for (int i = 0; i < LEAVES - 1; i++)
		t->node[i] = (struct tree_node){ uniform(seed) < 0.5, i && uniform(seed) < 0.5, ~i,
						 i == LEAVES - 2 ? ~(i + 1) : i + 1 };
	/* The whole is within a ball. */
	t->leaf[0] = (struct solid_leaf){ .kind = 0, .c = { 0, 0, 0 }, .r = 1.3 * size };
	t->node[0].merge = false;
}

static uint32_t leaf_object(struct world *w, const struct solid_leaf *l)
{
	uint32_t i = scene_add_object(&w->scene);
	struct object *o = &w->scene.object[i];

	o->kind = l->kind == 0 ? SHAPE_SPHERE : l->kind == 1 ? SHAPE_BOX : SHAPE_PLANE;
	if (l->kind == 0) {
		o->shape.sphere.radius = l->r;
		o->place = xform_translate(l->c);
	} else if (l->kind == 1) {
		o->shape.box.lo = vec_sub(l->c, l->h);
		o->shape.box.hi = vec_add(l->c, l->h);
	} else {
		o->shape.plane.normal = l->h;
		o->shape.plane.distance = vec_dot(l->h, l->c);
	}
	return i;
}

static uint32_t tree_object(struct world *w, const struct tree *t, int i)
{
	uint32_t a, b, o;

	if (i < 0)
		return leaf_object(w, &t->leaf[~i]);
	a = tree_object(w, t, t->node[i].left);
	b = tree_object(w, t, t->node[i].right);
	o = scene_add_object(&w->scene);
	w->scene.object[a].next_sibling = b;
	w->scene.object[o].first_child = a;
	w->scene.object[o].kind = t->node[i].merge ? SHAPE_MERGE : SHAPE_INTERSECTION;
	if (t->node[i].inverse) {
		w->scene.object[o].kind = shape_inverse(w->scene.object[o].kind);
		w->scene.object[o].flags = OBJECT_INVERSE;
	}
	return o;
}

/* All hits along a line: between them the definition says in and out by turns. */
static void walk(struct world *w, const struct tree *t, vec from, vec d, double size)
{
	ald_ray r = ray(from, d);
	bool in = tree_in(t, 0, from);
	double last = 0;
	ald_hit h;

	for (unsigned n = 0; n < 60; n++) {
		struct surface s;

		h = nearest(w, &r);
		if (h.prim == ALD_NONE)
			break;
		if (h.t - last > 1e-9 * size)
			assert_int_equal(tree_in(t, 0, vec_mad(from, d, last + (h.t - last) / 2)), in);
		surface_at(w->g, &r, &h, &s);
		if (fabs(vec_dot(s.n, d)) > 1e-6)
			assert_int_equal(vec_dot(s.n, d) > 0, in);
		last = h.t;
		in = !in;
		trace_after(&r, &h);
	}
	assert_false(in); /* the far end is outside */
}

static bool holds(struct world *w, vec p)
{
	struct solid s[8];

	return geometry_inside(w->g, p, s, 8) > 0;
}

static void trees_keep_their_definition(void **state)
{
	uint64_t seed = 21;

	(void)state;
	for (unsigned n = 0; n < 60; n++) {
		double size = pow(10, (n % 5) * 3.0 - 6);
		struct tree t;
		struct world w;
		unsigned seen = 0;

		make_tree(&t, size, &seed);
		begin(&w);
		scene_add_root(&w.scene, tree_object(&w, &t, 0));
		build(&w);
		for (unsigned i = 0; i < 400; i++) {
			vec p = vec_scale(random_vec(&seed), 1.2 * size), d = random_unit(&seed);

			assert_int_equal(holds(&w, p), tree_in(&t, 0, p));
			seen += tree_in(&t, 0, p);
			walk(&w, &t, vec_mad(p, d, -5 * size), d, size);
			walk(&w, &t, p, d, size);
		}
		(void)seen;
		end(&w);
	}
}

/* Rays from inside a rounded box, aimed at the very edges between its sides, some along lattice planes. */
static void no_ray_slips_through_an_edge(void **state)
{
	struct tree t = { .leaf = { { 0, { 0, 0, 0 }, { 0, 0, 0 }, 1.25 }, { 1, { 0, 0, 0 }, { 1, 1, 1 }, 0 },
				    { 2, { 0.9, 0, 0 }, { 0.6, 0.8, 0 }, 0 },
				    { 0, { 1, 1, 1 }, { 0, 0, 0 }, 0.5 }, { 0, { 0, 0, 9 }, { 0, 0, 0 }, 1 },
				    { 2, { 0, 0, -0.9 }, { 0, 0, -1 }, 0 } },
			  .node = { { false, false, ~0, 1 }, { false, false, ~1, 2 }, { false, false, ~2, 3 },
				    { false, false, ~5, 4 }, { true, true, ~3, ~4 } } };
	uint64_t seed = 22;
	struct world w;

	(void)state;
	begin(&w);
	scene_add_root(&w.scene, tree_object(&w, &t, 0));
	build(&w);
	for (unsigned i = 0; i < 60000; i++) {
		vec from = vec_scale(random_vec(&seed), 0.2), to = random_vec(&seed);
		double l;

		if (i & 1) /* an edge of the box */
			(&to.x)[i % 3] = (&to.x)[(i + 1) % 3] = i & 2 ? 1 : -1;
		if (i & 1 && i & 4) { /* where the box meets the ball */
			(&to.x)[i % 3] = 1;
			l = sqrt(1.25 * 1.25 - 1);
			(&to.x)[(i + 1) % 3] = l * cos(to.y * 3);
			(&to.x)[(i + 2) % 3] = l * sin(to.y * 3);
		}
		if (i % 7 == 0)
			from = vec_make(0, 0, 0);
		walk(&w, &t, from, vec_sub(to, from), 1);
	}
	end(&w);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(trees_keep_their_definition),
		cmocka_unit_test(no_ray_slips_through_an_edge),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
