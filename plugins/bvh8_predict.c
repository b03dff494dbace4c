/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * How much memory a bvh8 is going to take. What building takes follows from how many references there will be room
 * for, which a sample of the primitives tells, cut in thought as bvh8_split.c does. What is kept was measured: trees
 * of scans, terrain and loose triangles that are not cut differ by 5 %, as leaves are mostly full and nodes have six
 * children. How many of the places for parts a tree uses it finds out itself: the guess below, after soup and beams, is
 * off by up to two fifths for other soups. What is kept then is little beside the places, so that of the peak this is
 * less than a tenth.
 */
#include "bvh8_fast.h"
#include "seen.h"

#define STRIDE 128u /* one primitive in so many is looked at, */
#define LEAST 1024u /* but as many as these, if there are, */
#define MOST 16384u /* and no more */

/* Bytes a reference, by how many triangles a leaf may have. */
static const double kept_sah[SEATS] = { 218, 124, 107, 58.5 };
static const double kept_fast[SEATS] = { 262, 140, 116, 80 };
#define KEPT_SPLIT 52 /* of trees with many parts */
#define KEPT_OTHER 94 /* that is no triangle */

struct sample {
	uint32_t id[MOST], n, looked;
};

/* Those that can be hit, of one primitive in each of many even stretches, anywhere in it: meshes repeat themselves. */
static void take_sample(struct sample *s, const ald_prims *p)
{
	uint32_t want = p->count / STRIDE < LEAST ? LEAST : p->count / STRIDE > MOST ? MOST : p->count / STRIDE;
	uint64_t step;

	want = want < p->count ? want : p->count;
	step = want ? ((uint64_t)p->count << 16) / want : 0;
	for (s->n = s->looked = 0; s->looked < want; s->looked++) {
		uint64_t any = (uint64_t)(s->looked + 1) * 0x9e3779b97f4a7c15u >> 32;
		uint32_t id = (uint32_t)((s->looked * step + (any * step >> 32)) >> 16);

		if (bvh8_can_be_hit(p, id))
			s->id[s->n++] = id;
	}
}

/* Parts wanted and places for them, a reference: where there are more than enough places, all are used that pay, about
 * twice as many as triangles alone make; where there are few, nearly all of them. */
static double used_of(double refs, double room, double wanted)
{
	double want, places, most;

	if (!(room > refs))
		return refs;
	want = wanted / refs - 1;
	places = room / refs - 1;
	most = places * (1 - 0.2 * pow(places / want, 0.55));
	return refs * (1 + ald_min(most, 2.1 * want * want / (want + 1.2)));
}

static void predict_sah(struct builder *b, const struct sample *s, double others, ald_memory *out)
{
	unsigned leaf = b->value[P_LEAF] < SEATS ? (unsigned)b->value[P_LEAF] : SEATS;
	uint64_t each = leaf < SEATS || others > 0 ? 2 : 1;
	double wanted, refs = b->refs, room = bvh8_room(b, s->id, s->n, &wanted), used = used_of(refs, room, wanted);
	double top = bvh8_top_twigs((uint32_t)room), twigs = (double)each * room, kept = kept_sah[leaf - 1], both, tree;

	if (room > refs && leaf == SEATS)
		kept = KEPT_SPLIT + 6.5 * refs / used;
	out->kept = sizeof(ald_accel) + (uint64_t)(used * (1 - others) * kept + used * others * KEPT_OTHER);
	both = (twigs + top + 1) * sizeof(struct twig) + top * sizeof(struct range) + (top + 1) * sizeof(struct part) +
	       (twigs / 2 + top + 1) * sizeof(struct seat) + room * sizeof(uint32_t);
	tree = room * sizeof(struct ref) + room / 4; /* bins of pieces */
	if (room > refs)
		tree += 12 * sizeof(float) * (double)b->prims->tri_count;
	out->peak = (uint64_t)(both + ald_max(tree, (double)out->kept));
	out->scratch = room > refs ? seen_size(b->prims->count) : 0;
}

static void predict_fast(const struct builder *b, double others, ald_memory *out)
{
	unsigned leaf = b->value[P_LEAF] < SEATS ? (unsigned)b->value[P_LEAF] : SEATS;
	double refs = b->refs, tips = TIPS * (1 + refs / (0.85 * CROP)); /* crops end where cells do */
	uint64_t node, block, other;

	fast_room(b, &node, &block, &other);
	out->kept = sizeof(ald_accel) +
		    (uint64_t)(refs * (1 - others) * kept_fast[leaf - 1] + refs * others * KEPT_OTHER);
	out->peak = sizeof(ald_accel) + node * sizeof(struct node) + block * sizeof(struct block) +
		    other * sizeof(uint32_t) + b->host->threads * bvh8_crop_base.desk +
		    (uint64_t)(refs * sizeof(uint64_t) + tips * (3 * sizeof(struct twig) + sizeof(struct ref) +
								 sizeof(struct sprig)));
	out->peak = b->refs && out->peak > out->kept ? out->peak : out->kept;
	out->scratch = 0;
}

int bvh8_predict(const ald_host *host, const ald_prims *prims, const double *value, ald_memory *out)
{
	struct builder b = { .host = host, .prims = prims, .value = value };
	struct sample *s;
	double others = 0;

	if (prims->size < offsetof(ald_prims, box) + sizeof(prims->box))
		return ALD_UNSUPPORTED;
	s = host->alloc(host->ctx, sizeof(*s), "bvh8: building");
	b.a = host->alloc(host->ctx, sizeof(*b.a), "bvh8: building");
	if (b.a)
		*b.a = (ald_accel){ .host = host, .prims = prims, .scale = 1 };
	if (s && b.a && prims->count) {
		bvh8_place(b.a, &prims->box);
		take_sample(s, prims);
		b.refs = (uint32_t)((double)prims->count * s->n / s->looked + 0.5);
		others = (double)(prims->count - prims->tri_count) / prims->count;
	}
	if (s && b.a && bvh8_is_fast(&b))
		predict_fast(&b, others, out);
	else if (s && b.a)
		predict_sah(&b, s, others, out);
	host->free(host->ctx, s);
	host->free(host->ctx, b.a);
	return s && b.a ? ALD_OK : ALD_NO_MEMORY;
}
