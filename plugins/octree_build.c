/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Building an octree, breadth first: every level is one parallel pass without recursion, and the result
 * depends on nothing but the input. Whether a triangle touches a cell is decided by separating axes
 * (Akenine-Moeller: Fast 3D Triangle-Box Overlap Testing, 2001), for all eight children at once.
 */
#include "isa.h"
#include "octree.h"

#include <stdio.h>

/* Its loops over lanes in the widest instruction set there is; the walk has files of its own for each. */
#if defined __x86_64__ && defined __GNUC__ && !defined __AVX2__ && !defined __SANITIZE_ADDRESS__
#define WIDE __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define WIDE
#endif

#define PIECE 2048 /* references that one job looks at together */

struct cell {
	double c[3]; /* its centre, where its children meet */
	uint32_t first, count; /* its references, in its level's ref[] */
	uint32_t kid, kids; /* first child, in the next level, and one bit for each there is; 0: a leaf */
	uint32_t pieces; /* 0: not to be split */
};

struct level {
	struct cell *cell;
	uint32_t *ref;
	uint32_t cells, refs;
};

struct piece {
	uint32_t cell, first, count;
	uint32_t at[8]; /* how many go to each child; then, where to */
};

struct builder {
	const ald_host *host;
	const ald_prims *prims;
	const double *value;
	ald_accel *a;
	struct level level[DEPTH_MAX + 1];
	uint32_t now; /* the level being split */
	double half[3]; /* of its cells' children */
	struct piece *piece;
	uint32_t pieces, step; /* pieces a job */
	uint8_t *mask; /* of each reference: the children that it touches */
	struct seat *seat;
};

static void *take(const ald_host *host, uint64_t n, size_t each, const char *what)
{
	if (n > SIZE_MAX / each)
		return NULL;
	return host->alloc(host->ctx, n ? (size_t)n * each : 1, what);
}

ALD_INLINE uint32_t sides(double lo, double hi, double c, double pad, uint32_t low, uint32_t high)
{
	return (lo <= c + pad ? low : 0) | (hi >= c - pad ? high : 0);
}

ALD_INLINE uint32_t box_children(const ald_box *b, const struct cell *cell, double pad)
{
	return sides(b->lo.x, b->hi.x, cell->c[0], pad, 0x55, 0xaa) &
	       sides(b->lo.y, b->hi.y, cell->c[1], pad, 0x33, 0xcc) &
	       sides(b->lo.z, b->hi.z, cell->c[2], pad, 0x0f, 0xf0);
}

/* Of eight boxes of half size h around (+-h0, +-h1, +-h2), keep those that the slab lo <= x.n <= hi
 * touches. */
ALD_INLINE void keep_touching(int64_t in[8], const double n[3], const double h[3], double lo, double hi,
			      double grow)
{
	static const double sx[8] = { -1, 1, -1, 1, -1, 1, -1, 1 };
	static const double sy[8] = { -1, -1, 1, 1, -1, -1, 1, 1 };
	static const double sz[8] = { -1, -1, -1, -1, 1, 1, 1, 1 };
	double a = n[0] * h[0], b = n[1] * h[1], c = n[2] * h[2];
	double reach = (fabs(a) + fabs(b) + fabs(c)) * (1 + 16 * ALD_U) + grow;

	lo -= reach;
	hi += reach;
	EACH(i) {
		double s = sx[i] * a + sy[i] * b + sz[i] * c;

		in[i] &= (s >= lo) & (s <= hi);
	}
}

/* The separating axes of a triangle and eight cells at once; q: corners as seen from where the cells
 * meet; pad: by how much cells are grown, which is far more than these sums can round. */
ALD_INLINE uint32_t triangle_children(const double q[3][3], const double h[3], double pad)
{
	int64_t in[8] = { 1, 1, 1, 1, 1, 1, 1, 1 };
	double e[3][3], n[3], s[3], long0, long1;

	for (unsigned k = 0; k < 3; k++) {
		unsigned j = k == 2 ? 0 : k + 1, o = k == 0 ? 2 : k - 1;

		for (unsigned i = 0; i < 3; i++)
			e[k][i] = q[j][i] - q[k][i];
		for (unsigned i = 0; i < 3; i++) { /* across the edge and axis i */
			unsigned y = i == 2 ? 0 : i + 1, z = i == 0 ? 2 : i - 1;
			double grow = pad * (fabs(e[k][y]) + fabs(e[k][z]));

			n[i] = 0;
			n[y] = -e[k][z];
			n[z] = e[k][y];
			s[0] = n[y] * q[k][y] + n[z] * q[k][z];
			s[1] = n[y] * q[o][y] + n[z] * q[o][z];
			keep_touching(in, n, h, ald_min(s[0], s[1]), ald_max(s[0], s[1]), grow);
		}
	}
	for (unsigned i = 0; i < 3; i++) {
		unsigned y = i == 2 ? 0 : i + 1, z = i == 0 ? 2 : i - 1;

		n[i] = e[0][y] * e[1][z] - e[0][z] * e[1][y];
	}
	long0 = fabs(e[0][0]) + fabs(e[0][1]) + fabs(e[0][2]);
	long1 = fabs(e[1][0]) + fabs(e[1][1]) + fabs(e[1][2]);
	s[0] = n[0] * q[0][0] + n[1] * q[0][1] + n[2] * q[0][2];
	keep_touching(in, n, h, s[0], s[0], pad * (long0 * long1 + fabs(n[0]) + fabs(n[1]) + fabs(n[2])));
	return ald_lane_bits(in);
}

ALD_INLINE uint32_t children(const struct builder *b, uint32_t id, const struct cell *cell)
{
	const ald_prims *p = b->prims;
	double q[3][3], pad = 2 * p->pad;
	ald_vec v[3];
	ald_box box = ald_box_empty();
	uint32_t m;

	if (id >= p->tri_count) {
		p->bounds(p, id, &box);
		return box_children(&box, cell, p->pad);
	}
	ald_corners(p, id, p->origin ? ald_group_of(p, id) : 0, v);
	for (unsigned k = 0; k < 3; k++) {
		ald_box point = { v[k], v[k] };

		ald_box_join(&box, &point);
	}
	m = box_children(&box, cell, pad);
	if (!(m & (m - 1)))
		return m;
	for (unsigned k = 0; k < 3; k++) {
		q[k][0] = v[k].x - cell->c[0];
		q[k][1] = v[k].y - cell->c[1];
		q[k][2] = v[k].z - cell->c[2];
	}
	return m & triangle_children(q, b->half, pad);
}

ALD_INLINE void sort_piece(const struct builder *b, struct piece *p)
{
	const struct level *l = &b->level[b->now];
	const struct cell *cell = &l->cell[p->cell];

	memset(p->at, 0, sizeof(p->at));
	for (uint32_t i = p->first; i < p->first + p->count; i++) {
		uint32_t m = children(b, l->ref[i], cell);

		b->mask[i] = (uint8_t)m;
		for (unsigned k = 0; k < 8; k++)
			p->at[k] += m >> k & 1;
	}
}

WIDE static void sort_job(void *arg, uint32_t job)
{
	struct builder *b = arg;
	uint32_t end = job + 1 < (b->pieces + b->step - 1) / b->step ? (job + 1) * b->step : b->pieces;

	for (uint32_t i = job * b->step; i < end; i++)
		sort_piece(b, &b->piece[i]);
}

static void deal_job(void *arg, uint32_t job)
{
	struct builder *b = arg;
	const uint32_t *from = b->level[b->now].ref;
	uint32_t *to = b->level[b->now + 1].ref;

	for (uint32_t i = job * b->step; i < b->pieces && i < (job + 1) * b->step; i++) {
		struct piece *p = &b->piece[i];

		if (!b->level[b->now].cell[p->cell].kids)
			continue;
		for (uint32_t j = p->first; j < p->first + p->count; j++) {
			for (uint32_t m = b->mask[j]; m; m &= m - 1)
				to[p->at[__builtin_ctz(m)]++] = from[j];
		}
	}
}

static int cut_pieces(struct builder *b)
{
	const struct level *l = &b->level[b->now];
	uint64_t n = 0;
	uint32_t k = 0;

	for (uint32_t i = 0; i < l->cells; i++) {
		struct cell *c = &l->cell[i];

		c->pieces = c->count > b->value[P_LEAF] ? (c->count + PIECE - 1) / PIECE : 0;
		n += c->pieces;
	}
	b->pieces = (uint32_t)n;
	b->step = b->pieces / 256 + 1;
	b->piece = take(b->host, n, sizeof(*b->piece), "octree: building");
	b->mask = take(b->host, l->refs, 1, "octree: building");
	if (!b->piece || !b->mask)
		return ALD_NO_MEMORY;
	for (uint32_t i = 0; i < l->cells; i++) {
		const struct cell *c = &l->cell[i];

		for (uint32_t at = 0; at < c->count && c->pieces; at += PIECE)
			b->piece[k++] = (struct piece){
				i, c->first + at, c->count - at < PIECE ? c->count - at : PIECE, { 0 }
			};
	}
	return ALD_OK;
}

/* A ray that meets a cube meets each of its eight parts with a chance of 1/4 (their share of the surface).
 * Splitting pays if the tests that it saves are worth a step. */
static int pays(const struct builder *b, const struct cell *c, const uint32_t n[8])
{
	double price = b->value[P_PRICE], sum = 0;

	for (unsigned k = 0; k < 8; k++)
		sum += n[k];
	return price == 0 || price + sum / 4 < c->count;
}

/* Decide which cells to split, and give their children and references places. */
static int place_children(struct builder *b)
{
	struct level *l = &b->level[b->now], *next = l + 1;
	struct piece *p = b->piece;
	uint64_t cells = 0, refs = 0;
	uint32_t k = 0;

	for (uint32_t i = 0; i < l->cells; p += l->cell[i++].pieces) {
		struct cell *c = &l->cell[i];
		uint32_t n[8] = { 0 };

		for (uint32_t j = 0; j < c->pieces; j++) {
			for (k = 0; k < 8; k++)
				n[k] += p[j].at[k];
		}
		if (!c->pieces || !pays(b, c, n))
			continue;
		for (k = 0; k < 8; k++) {
			c->kids |= (uint32_t)!!n[k] << k;
			refs += n[k];
		}
		c->kid = (uint32_t)cells;
		cells += (uint32_t)__builtin_popcount(c->kids);
	}
	if (refs > UINT32_MAX / 2 || cells > UINT32_MAX / 16)
		return ALD_NO_MEMORY;
	next->cells = (uint32_t)cells;
	next->refs = (uint32_t)refs;
	next->cell = take(b->host, cells, sizeof(*next->cell), "octree: building");
	next->ref = take(b->host, refs, sizeof(*next->ref), "octree: building");
	return next->cell && next->ref ? ALD_OK : ALD_NO_MEMORY;
}

static void fill_children(struct builder *b)
{
	struct level *l = &b->level[b->now], *next = l + 1;
	struct piece *p = b->piece;
	uint32_t at = 0;

	for (uint32_t i = 0; i < l->cells; p += l->cell[i++].pieces) {
		const struct cell *c = &l->cell[i];
		struct cell *kid = &next->cell[c->kid];

		for (uint32_t m = c->kids; m; m &= m - 1, kid++) {
			unsigned k = (unsigned)__builtin_ctz(m);
			uint32_t first = at;

			for (uint32_t j = 0; j < c->pieces; j++) {
				uint32_t n = p[j].at[k];

				p[j].at[k] = at;
				at += n;
			}
			*kid = (struct cell){ .first = first, .count = at - first };
			for (unsigned i3 = 0; i3 < 3; i3++)
				kid->c[i3] = k >> i3 & 1 ? c->c[i3] + b->half[i3] :
							   c->c[i3] - b->half[i3];
		}
	}
}

static int split_level(struct builder *b)
{
	int err;

	for (unsigned k = 0; k < 3; k++)
		b->half[k] = ldexp(b->a->half[k], -1 - (int)b->now);
	err = cut_pieces(b);
	if (!err) {
		uint32_t jobs = (b->pieces + b->step - 1) / b->step;

		b->host->parallel(b->host->ctx, jobs, sort_job, b);
		err = place_children(b);
		if (!err) {
			fill_children(b);
			b->host->parallel(b->host->ctx, jobs, deal_job, b);
		}
	}
	b->host->free(b->host->ctx, b->piece);
	b->host->free(b->host->ctx, b->mask);
	b->piece = NULL;
	b->mask = NULL;
	return err;
}

static int make_root(struct builder *b)
{
	const ald_prims *p = b->prims;
	struct level *l = &b->level[0];
	ald_accel *a = b->a;
	double biggest = 0;

	a->box = ald_box_empty();
	for (uint32_t i = 0; i < p->count; i++) {
		ald_box box;

		p->bounds(p, i, &box);
		ald_box_join(&a->box, &box);
	}
	if (!p->count)
		a->box = (ald_box){ { 0, 0, 0 }, { 0, 0, 0 } };
	a->frame = ald_frame_for(p, &a->box);
	for (unsigned k = 0; k < 3; k++) {
		double lo = (&a->box.lo.x)[k], hi = (&a->box.hi.x)[k];

		a->half[k] = (hi - lo) / 2 * (1 + 8 * ALD_U) + p->pad;
		a->middle[k] = lo + (hi - lo) / 2;
		a->reach[k] = (hi - lo) / 2 * (1 + 0x1p-44);
		biggest = ald_max(a->half[k], biggest);
	}
	/* A cube starts at the box's low corner: a split through the middle of what is flat costs most. */
	for (unsigned k = 0; k < 3; k++) {
		if (b->value[P_SHAPE] == SHAPE_CUBE)
			a->half[k] = biggest;
		a->centre[k] = (&a->box.lo.x)[k] - p->pad / 2 + a->half[k];
	}
	a->calls = b->value[P_WALK] > 0;
	if (b->value[P_NODE] == NODE_SPHERE) {
		a->ball = sqrt(a->half[0] * a->half[0] + a->half[1] * a->half[1] + a->half[2] * a->half[2]);
		a->ball *= 1 + 16 * ALD_U;
		a->ball_pad = 4 * p->pad;
	}
	l->cell = take(b->host, 1, sizeof(*l->cell), "octree: building");
	l->ref = take(b->host, p->count, sizeof(*l->ref), "octree: building");
	if (!l->cell || !l->ref)
		return ALD_NO_MEMORY;
	l->cells = 1;
	l->refs = p->count;
	*l->cell = (struct cell){ .count = p->count };
	memcpy(l->cell->c, a->centre, sizeof(a->centre));
	for (uint32_t i = 0; i < p->count; i++)
		l->ref[i] = i;
	return ALD_OK;
}

/* ---- from levels to what rays walk through: depth first, so that neighbours are neighbours ---- */

struct seat { /* of a leaf: where it was built */
	uint32_t level, cell;
};

struct place { /* of a cell still to be seated: the child that it is of a node */
	uint32_t level, cell, node, slot;
};

static uint32_t triangles_of(const struct builder *b, const uint32_t *ref, uint32_t n)
{
	uint32_t lo = 0, hi = n; /* references are in the order of ids, and triangles come first */

	if (!n || ref[n - 1] < b->prims->tri_count)
		return n;
	while (lo < hi) {
		uint32_t mid = lo + (hi - lo) / 2;

		if (ref[mid] < b->prims->tri_count)
			lo = mid + 1;
		else
			hi = mid;
	}
	return lo;
}

static void seat_leaf(struct builder *b, uint32_t level, uint32_t cell)
{
	const struct cell *c = &b->level[level].cell[cell];
	ald_accel *a = b->a;
	uint32_t tris = triangles_of(b, b->level[level].ref + c->first, c->count);

	a->leaf[a->leaves] = (struct leaf){ a->blocks, tris, a->others, c->count - tris };
	b->seat[a->leaves++] = (struct seat){ level, cell };
	a->blocks += (tris + ALD_LANES - 1) / ALD_LANES;
	a->others += c->count - tris;
	a->refs += c->count;
	if (level > a->depth)
		a->depth = level;
}

static void seat_all(struct builder *b)
{
	struct place stack[8 * DEPTH_MAX + 1], s;
	uint32_t top = 0, inner = 0;
	ald_accel *a = b->a;

	a->root_is_leaf = !b->level[0].cell->kids;
	stack[top++] = (struct place){ 0, 0, 0, 0 };
	while (top) {
		const struct cell *c;
		uint32_t number, kid;

		s = stack[--top];
		c = &b->level[s.level].cell[s.cell];
		number = c->kids ? inner++ : a->inner + a->leaves;
		if (s.level && a->wide)
			a->wide[8 * (size_t)s.node + s.slot] = number;
		else if (s.level)
			a->narrow[8 * (size_t)s.node + s.slot] = (uint16_t)number;
		if (c->kids)
			a->kids[number] = (uint8_t)c->kids;
		else
			seat_leaf(b, s.level, s.cell);
		kid = c->kid + (uint32_t)__builtin_popcount(c->kids);
		for (unsigned k = 8; k-- > 0;) {
			if (c->kids >> k & 1)
				stack[top++] = (struct place){ s.level + 1, --kid, number, k };
		}
	}
}

static void fill_leaf(const struct builder *b, uint32_t i)
{
	const ald_accel *a = b->a;
	const struct leaf *leaf = &a->leaf[i];
	const struct level *l = &b->level[b->seat[i].level];
	const uint32_t *ref = l->ref + l->cell[b->seat[i].cell].first;
	const double nan = ALD_NAN;

	for (uint32_t j = 0; j < (leaf->tris + ALD_LANES - 1) / ALD_LANES * ALD_LANES; j++) {
		ald_vec v[3] = { { nan, nan, nan }, { nan, nan, nan }, { nan, nan, nan } };
		uint32_t at = leaf->block + j / ALD_LANES, id = ALD_NONE;

		if (j < leaf->tris) {
			id = ref[j];
			ald_corners(b->prims, id, b->prims->origin ? ald_group_of(b->prims, id) : 0, v);
		}
		if (a->fast)
			ald_fast_triangles_set(&a->fast[at], j % ALD_LANES, v);
		else
			ald_triangles_set(&a->block[at], j % ALD_LANES, v);
		a->id[at][j % ALD_LANES] = id;
	}
	memcpy(a->other + leaf->other, ref + leaf->tris, leaf->others * sizeof(*ref));
}

#define LEAVES_A_JOB 1024

static void fill_job(void *arg, uint32_t job)
{
	const struct builder *b = arg;

	for (uint32_t i = job * LEAVES_A_JOB; i < b->a->leaves && i < (job + 1) * LEAVES_A_JOB; i++)
		fill_leaf(b, i);
}

static void *keep(struct builder *b, uint64_t n, size_t each, const char *what)
{
	void *p = take(b->host, n, each, what);

	b->a->bytes += n * each;
	return p;
}

static int finish(struct builder *b, ald_error *err)
{
	ald_accel *a = b->a;
	uint64_t blocks = 0, others = 0, inner = 0, leaves = 0;

	for (uint32_t l = 0; l <= DEPTH_MAX; l++) {
		for (uint32_t i = 0; i < b->level[l].cells; i++) {
			const struct cell *c = &b->level[l].cell[i];
			uint32_t tris;

			if (c->kids) {
				inner++;
				continue;
			}
			tris = triangles_of(b, b->level[l].ref + c->first, c->count);
			leaves++;
			blocks += (tris + ALD_LANES - 1) / ALD_LANES;
			others += c->count - tris;
		}
	}
	a->inner = (uint32_t)inner;
	if (b->value[P_INDEX] == INDEX_16 && inner + leaves > 65535) {
		snprintf(err->text, sizeof(err->text),
			 "index=16 is for fewer than 65,536 nodes and this octree has %llu: give "
			 "index=auto, or a smaller depth or larger leaf",
			 (unsigned long long)(inner + leaves));
		return ALD_BAD_PARAM;
	}
	if (b->value[P_INDEX] == INDEX_32 || inner + leaves > 65535) {
		a->wide = keep(b, 8 * inner, sizeof(*a->wide), "octree: nodes");
		if (a->wide)
			memset(a->wide, 0, 8 * inner * sizeof(*a->wide));
	} else {
		a->narrow = keep(b, 8 * inner, sizeof(*a->narrow), "octree: nodes");
		if (a->narrow)
			memset(a->narrow, 0, 8 * inner * sizeof(*a->narrow));
	}
	a->kids = keep(b, inner, 1, "octree: nodes");
	a->leaf = keep(b, leaves, sizeof(*a->leaf), "octree: nodes");
	b->seat = take(b->host, leaves, sizeof(*b->seat), "octree: building");
	if (b->prims->precision == ALD_PRECISION_FAST)
		a->fast = keep(b, blocks, sizeof(*a->fast), "octree: triangles");
	else
		a->block = keep(b, blocks, sizeof(*a->block), "octree: triangles");
	a->id = keep(b, blocks, sizeof(*a->id), "octree: triangles");
	a->other = keep(b, others, sizeof(*a->other), "octree: references");
	if ((!a->wide && !a->narrow) || !a->kids || !a->leaf || !b->seat || (!a->block && !a->fast) || !a->id ||
	    !a->other)
		return ALD_NO_MEMORY;
	seat_all(b);
	b->host->parallel(b->host->ctx, (a->leaves + LEAVES_A_JOB - 1) / LEAVES_A_JOB, fill_job, b);
	return ALD_OK;
}

void octree_destroy(ald_accel *a)
{
	const ald_host *h = a->host;

	h->free(h->ctx, a->wide);
	h->free(h->ctx, a->narrow);
	h->free(h->ctx, a->kids);
	h->free(h->ctx, a->leaf);
	h->free(h->ctx, a->block);
	h->free(h->ctx, a->fast);
	h->free(h->ctx, a->id);
	h->free(h->ctx, a->other);
	h->free(h->ctx, a);
}

static const struct octree_isa *isa_of(unsigned isa)
{
#if defined __x86_64__
	if (isa == ISA_AVX512)
		return &octree_avx512;
	if (isa == ISA_AVX2)
		return &octree_avx2;
	if (isa == ISA_SSE)
		return &octree_sse;
#endif
	(void)isa;
	return &octree_plain;
}

int octree_build(const ald_host *host, const ald_prims *prims, const double *value, ald_accel **out,
		 ald_error *err)
{
	struct builder b = { .host = host, .prims = prims, .value = value };
	unsigned isa = isa_choose((unsigned)value[P_ISA], err);
	int status;

	if (isa == ISA_AUTO)
		return ALD_BAD_PARAM;
	b.a = take(host, 1, sizeof(*b.a), "octree: nodes");
	if (!b.a)
		return ALD_NO_MEMORY;
	*b.a = (ald_accel){ .host = host, .prims = prims, .isa = isa_of(isa), .bytes = sizeof(*b.a) };
	status = make_root(&b);
	for (; !status && b.now < value[P_DEPTH] && b.level[b.now].cells; b.now++) {
		if (host->progress(host->ctx, b.now / (value[P_DEPTH] + 1)))
			status = ALD_CANCELLED;
		else
			status = split_level(&b);
	}
	if (!status)
		status = finish(&b, err);
	for (uint32_t l = 0; l <= DEPTH_MAX; l++) {
		host->free(host->ctx, b.level[l].cell);
		host->free(host->ctx, b.level[l].ref);
	}
	host->free(host->ctx, b.seat);
	if (status)
		octree_destroy(b.a);
	else
		*out = b.a;
	return status;
}

