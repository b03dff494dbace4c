/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The top of a tree that is built fast, over the trees that crops were made: by the surface area heuristic (Garanzha,
 * Pantaleoni, McAllister: Simpler and Faster HLBVH with Work Queues, 2011).
 */
#include "bvh8_fast.h"
#include "bvh8_fold.h"
#include "bvh8_part.h"

struct crown {
	const struct twig *tip;
	struct twig *twig;
	uint32_t twigs; /* where the next two go */
	uint32_t steep; /* levels after which ranges are halved, so that no tree is deeper than LEVELS_MAX */
};

/* id: of a reference, the tip which it stands for. */
static void crown_grow(struct crown *c, struct ref *ref, struct range *r)
{
	struct range left = *r, right = *r;
	struct split s = { FAR, 3, 0 };
	struct bins bins;
	uint32_t at = 0, kid = c->twigs;

	if (r->count == 1) {
		c->twig[r->twig] = c->tip[ref->id];
		return;
	}
	if (r->depth < c->steep) {
		bins_begin(&bins, r);
		bins_add(&bins, ref, r->count);
		s = best_split(&bins);
	}
	if (s.axis < 3)
		at = part(ref, r->count, &bins, &s, &left, &right);
	if (!at || at == r->count) {
		at = r->count / 2;
		halve(ref, r->count, at, r);
		measure(ref, at, &left);
		measure(ref + at, r->count - at, &right);
	}
	set_twig(&c->twig[r->twig], r, kid, 0);
	c->twigs += 2;
	left.count = at;
	right.count = r->count - at;
	left.twig = kid;
	right.twig = kid + 1;
	left.depth = right.depth = r->depth + 1;
	crown_grow(c, ref, &left);
	crown_grow(c, ref + at, &right);
}

/* Tips together; returns how many there are. */
static uint32_t gather(struct fast *f)
{
	uint32_t n = 0;

	for (uint32_t i = 0; i < f->crops; i++) {
		for (uint32_t k = 0; k < f->crop[i].tips; k++)
			f->tip[n++] = f->tip[TIPS * i + k];
	}
	return n;
}

static void make_refs(const struct fast *f, struct ref *ref, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++) {
		ref[i].id = i;
		ref[i].zero = 0;
		for (unsigned k = 0; k < 3; k++) {
			ref[i].lo[k] = f->tip[i].lo[k];
			ref[i].minus_hi[k] = -f->tip[i].hi[k];
		}
	}
}

/* Nodes below this one. */
static uint32_t levels(const struct twig *twig, const struct sprig *sprig, uint32_t i)
{
	uint32_t most = 0;

	for (unsigned k = 0; k < WIDTH && sprig[i].kid[k] != EMPTY; k++) {
		const struct twig *t = &twig[sprig[i].kid[k]];
		uint32_t n = t->count ? t->count - 1 : 1 + levels(twig, sprig, t->kid);

		most = n > most ? n : most;
	}
	return most;
}

static void fold_top(struct fast *f, struct twig *twig, struct sprig *sprig)
{
	ald_accel *a = f->b->a;
	struct folded o = { .sprig = sprig };
	uint64_t first;

	if (twig[0].count) {
		a->root = twig[0].kid;
		a->depth = twig[0].count - 1;
		return;
	}
	fold(&o, twig, 0);
	first = atomic_fetch_add(&f->nodes, o.n);
	a->root = (uint32_t)first;
	a->depth = 1 + levels(twig, sprig, 0);
	a->cost = o.area / (double)f->b->whole;
	for (uint32_t i = 0; i < o.n && first + o.n <= f->node_room; i++)
		fold_node(&a->node[first + i], twig, &sprig[i], (uint32_t)first);
}

int bvh8_crown(struct fast *f)
{
	struct builder *b = f->b;
	const ald_host *h = b->host;
	struct crown c = { .tip = f->tip, .twigs = 1, .steep = LEVELS_MAX - DEEP };
	struct range root = { .count = gather(f) };
	struct ref *ref = bvh8_take(h, root.count, sizeof(*ref), "bvh8: building");
	struct sprig *sprig = bvh8_take(h, root.count, sizeof(*sprig), "bvh8: building");
	int status = ALD_NO_MEMORY;

	c.twig = bvh8_take(h, 2 * (uint64_t)root.count, sizeof(*c.twig), "bvh8: building");
	if (ref && sprig && c.twig) {
		make_refs(f, ref, root.count);
		for (uint32_t n = root.count; n; n /= 2)
			c.steep -= c.steep > 0;
		measure(ref, root.count, &root);
		b->whole = hull_area(root.box) > 0 ? hull_area(root.box) : 1;
		crown_grow(&c, ref, &root);
		fold_top(f, c.twig, sprig);
		status = ALD_OK;
	}
	h->free(h->ctx, ref);
	h->free(h->ctx, sprig);
	h->free(h->ctx, c.twig);
	return status;
}
