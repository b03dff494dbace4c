/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * mine: an accelerator to start your own from. It is whole and right: a hierarchy of boxes, each halved
 * at the middle of its primitives. It has the three functions that a plugin must have, and one more;
 * alidade-accel(3) tells of the others, and of the rules R1 to R7 that the comments here name.
 */
#include <alidade/accel.h>
#include <alidade/kernel.h>

#include <stdlib.h>

#define DEPTH 64 /* of the stack; halving 2^32 primitives needs no more than 32 */

struct node {
	ald_box box;
	uint32_t first, count; /* a leaf: its ids in id[]; count is 0 for an inner node, */
	uint32_t kid; /* whose children are kid and kid + 1 */
	uint32_t axis; /* along which it was halved: kid is on the low side */
};

struct ald_accel {
	const ald_host *host;
	const ald_prims *prims;
	ald_frame frame;
	struct node *node;
	uint32_t *id;
	uint32_t nodes;
};

static const ald_param params[] = {
	{ "leaf", "primitives that are not divided any further", ALD_INT, 4, 1, 256, NULL },
	{ NULL, NULL, 0, 0, 0, 0, NULL },
};

/* ---- [setup] ---- */

struct item {
	ald_vec centre;
	uint32_t id;
};

/* Equal centres stand in the order of their ids, so that the result depends on the input alone. */
static int compare(const struct item *a, const struct item *b, unsigned axis)
{
	double x = ald_get(&a->centre, axis), y = ald_get(&b->centre, axis);

	return x != y ? (x > y ? 1 : -1) : a->id > b->id ? 1 : -1;
}

static int by_x(const void *a, const void *b)
{
	return compare(a, b, 0);
}

static int by_y(const void *a, const void *b)
{
	return compare(a, b, 1);
}

static int by_z(const void *a, const void *b)
{
	return compare(a, b, 2);
}

/* The boxes that the host gives are grown by its pad already (R4); joining them keeps that. */
static void halve(ald_accel *a, struct item *item, uint32_t n, uint32_t leaf)
{
	static int (*const order[3])(const void *, const void *) = { by_x, by_y, by_z };

	a->node[0] = (struct node){ .count = n };
	a->nodes = 1;
	for (uint32_t i = 0; i < a->nodes; i++) {
		struct node *at = &a->node[i];
		uint32_t half = at->count / 2;
		ald_box centres = ald_box_empty(), box;
		double size[3];

		at->box = ald_box_empty();
		for (uint32_t k = at->first; k < at->first + at->count; k++) {
			a->prims->bounds(a->prims, item[k].id, &box);
			ald_box_join(&at->box, &box);
			box.lo = box.hi = item[k].centre;
			ald_box_join(&centres, &box);
		}
		if (at->count <= leaf)
			continue;
		for (unsigned k = 0; k < 3; k++)
			size[k] = ald_get(&centres.hi, k) - ald_get(&centres.lo, k);
		at->axis = size[0] > size[1] ? (size[0] > size[2] ? 0 : 2) : size[1] > size[2] ? 1 : 2;
		qsort(item + at->first, at->count, sizeof(*item), order[at->axis]);
		at->kid = a->nodes;
		a->node[a->nodes++] = (struct node){ .first = at->first, .count = half };
		a->node[a->nodes++] =
			(struct node){ .first = at->first + half, .count = at->count - half };
		at->count = 0;
	}
}

static void mine_destroy(ald_accel *a)
{
	const ald_host *host = a->host;

	host->free(host->ctx, a->node);
	host->free(host->ctx, a->id);
	host->free(host->ctx, a);
}

static int mine_build(const ald_host *host, const ald_prims *prims, const double *value, ald_accel **out,
		      ald_error *err)
{
	size_t n = prims->count;
	ald_accel *a = host->alloc(host->ctx, sizeof(*a), "mine");
	struct item *item = host->alloc(host->ctx, (n + 1) * sizeof(*item), "mine: building");
	ald_box box;

	(void)err; /* a text, where it is not the memory */
	if (a) {
		*a = (ald_accel){ .host = host, .prims = prims };
		a->node = host->alloc(host->ctx, (2 * n + 1) * sizeof(*a->node), "mine");
		a->id = host->alloc(host->ctx, (n + 1) * sizeof(*a->id), "mine");
	}
	if (!a || !item || !a->node || !a->id) {
		host->free(host->ctx, item); /* R7: nothing may stay */
		if (a)
			mine_destroy(a);
		return ALD_NO_MEMORY;
	}
	for (uint32_t i = 0; i < n; i++) {
		prims->bounds(prims, i, &box);
		item[i].centre.x = box.lo.x + (box.hi.x - box.lo.x) / 2;
		item[i].centre.y = box.lo.y + (box.hi.y - box.lo.y) / 2;
		item[i].centre.z = box.lo.z + (box.hi.z - box.lo.z) / 2;
		item[i].id = i;
	}
	if (n)
		halve(a, item, prims->count, (uint32_t)value[0]);
	for (uint32_t i = 0; i < n; i++)
		a->id[i] = item[i].id;
	if (n)
		a->frame = ald_frame_for(prims, &a->node[0].box);
	host->free(host->ctx, item);
	*out = a;
	return ALD_OK;
}

/* What mine_build() takes: optional, and then the host refuses what would not fit before it is built. The nodes that
 * are kept are those that there is room for, so nothing has to be looked at. */
static int mine_predict(const ald_host *host, const ald_prims *prims, const double *value, ald_memory *out)
{
	uint64_t n = prims->count;

	(void)host;
	(void)value;
	out->kept = sizeof(ald_accel) + (2 * n + 1) * sizeof(struct node) + (n + 1) * sizeof(uint32_t);
	out->peak = out->kept + (n + 1) * sizeof(struct item);
	out->scratch = 0;
	return ALD_OK;
}

/* ---- [render]: any thread; no locks, no allocation (R6) ---- */

static int test(const ald_accel *a, uint32_t id, const ald_prep *prep, ald_query *q, const ald_ray *ray,
		ald_hit *hit)
{
	const ald_prims *p = a->prims;
	ald_vec v[3];

	if (q->count)
		q->count[ALD_COUNT_PRIMS]++;
	if (!ald_sees(p, ray, id))
		return 0;
	if (id >= p->tri_count)
		return p->intersect(p, id, q, ray, hit);
	ald_corners(p, id, p->origin ? ald_group_of(p, id) : 0, v);
	return ald_triangle(prep, ray, v, id, hit);
}

static int mine_intersect(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit)
{
	struct {
		uint32_t node;
		double enter;
	} stack[DEPTH];
	uint32_t top = 0;
	int found = 0;
	ald_prep prep;
	double enter;

	if (!a->nodes)
		return 0;
	ald_ray_prep(&a->frame, ray, &prep);
	if (!ald_box_ray(&prep, &a->node[0].box, ray->tmin, hit->t, &enter))
		return 0;
	stack[top].node = 0;
	stack[top++].enter = enter;
	while (top) {
		const struct node *n = &a->node[stack[--top].node];
		uint32_t far;
		int better = 0;

		if (stack[top].enter > hit->t) /* R3: > and never >= */
			continue;
		for (uint32_t i = n->first; i < n->first + n->count; i++)
			better |= test(a, a->id[i], &prep, q, ray, hit);
		found |= better;
		if (q->count && better)
			q->count[ALD_COUNT_VOLUME_USEFUL]++; /* of leaves */
		if (n->count)
			continue;
		if (q->count)
			q->count[ALD_COUNT_NODES]++;
		/* The nearer child last, so that it comes first. */
		far = !prep.sign[n->axis];
		for (unsigned k = 0; k < 2; k++) {
			uint32_t kid = n->kid + (k ? !far : far);

			if (q->count)
				q->count[ALD_COUNT_VOLUME_TESTS]++;
			if (!ald_box_ray(&prep, &a->node[kid].box, ray->tmin, hit->t, &enter))
				continue;
			if (q->count)
				q->count[ALD_COUNT_VOLUME_HITS]++;
			stack[top].node = kid;
			stack[top++].enter = enter;
		}
	}
	return found;
}

const ald_accel_plugin ald_accel_entry = {
	.abi = ALD_ACCEL_ABI,
	.size = sizeof(ald_accel_plugin),
	.name = "mine", /* and the file is mine.so */
	.version = "1",
	.license = "Apache-2.0",
	.summary = "hierarchy of boxes, halved at the median",
	.params = params,
	.precisions = ALD_PRECISION_DEFAULT | ALD_PRECISION_EXACT,
	.build = mine_build,
	.intersect = mine_intersect,
	.destroy = mine_destroy,
	.predict = mine_predict,
};
