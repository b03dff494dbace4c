/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The walk through an octree, included twice by octree_trace.h: FAST 0 in doubles with the pads of rule R4, FAST 1 in
 * floats without them (ALD_PRECISION_FAST). Everything else is the same, so that the two can be compared.
 */
#if FAST
#define REAL float
#define LANE int32_t
#define NAMED(name) name##_fast
#define PREP ald_fast_prep
#define PREPARE(w) (ald_fast_ray((w)->ray, &(w)->p), (w)->t0 = (float)((w)->ray->tmin * (w)->p.per))
#define NEAR(p, k) ((p)->o[k])
#define FAR(p, k) ((p)->o[k])
#define BLOCK ald_fast_triangles
#define BLOCKS fast
#define TRIANGLE_N ald_fast_triangle_n
#define LANE_BITS ald_lane_bits_single
#define SPHERE_RAY ald_fast_sphere_ray
#define PAD(p) 0
#else
#define REAL double
#define LANE int64_t
#define NAMED(name) name##_right
#define PREP ald_prep
#define PREPARE(w) (ald_ray_prep(&(w)->a->frame, (w)->ray, &(w)->p), (w)->t0 = (w)->ray->tmin)
#define NEAR(p, k) ((p)->near_o[k])
#define FAR(p, k) ((p)->far_o[k])
#define BLOCK ald_triangles
#define BLOCKS block
#define TRIANGLE_N ald_triangle_n
#define LANE_BITS ald_lane_bits
#define SPHERE_RAY ald_sphere_ray
#define PAD(p) ((p)->pad)
#endif
#define FRAME NAMED(frame)
#define WALK NAMED(walk)

struct FRAME { /* an inner cell on the way down; halves: 0 the nearer, 1 the farther along the ray */
	REAL enter[8]; /* its children: where the ray enters them */
	REAL en[2][3], ex[2][3]; /* where it enters and leaves the halves */
	REAL c[3];
	uint32_t node;
	uint8_t todo, useful; /* children still to visit, in the ray's order; was anything hit inside? */
};

struct WALK {
	const ald_accel *a;
	ald_query *q;
	const ald_ray *ray;
	ald_hit *hit;
	uint64_t *count; /* NULL: do not */
	struct seen *seen;
	PREP p;
	REAL t0, t1; /* the part of the ray that is inside of everything's box */
	uint32_t flip;
	struct FRAME frame[DEPTH_MAX];
};

/* How far the ray has to be followed. */
ALD_INLINE REAL NAMED(best)(const struct WALK *w)
{
#if FAST
	return (float)(w->hit->t * w->p.per);
#else
	return w->hit->t;
#endif
}

ALD_INLINE int NAMED(test_lane)(struct WALK *w, const BLOCK *b, unsigned i, uint32_t id)
{
#if FAST
	return ald_fast_triangle(&w->p, w->ray, b, i, id, w->hit);
#else
	ald_vec v[3];

	for (unsigned k = 0; k < 3; k++)
		v[k] = (ald_vec){ b->v[k][0][i], b->v[k][1][i], b->v[k][2][i] };
	return ald_triangle(&w->p, w->ray, v, id, w->hit);
#endif
}

static void NAMED(count_useful)(struct WALK *w, int depth)
{
	w->count[ALD_COUNT_VOLUME_USEFUL]++; /* the leaf */
	for (; depth >= 0 && !w->frame[depth].useful; depth--) {
		w->frame[depth].useful = 1;
		w->count[ALD_COUNT_VOLUME_USEFUL]++;
	}
}

ALD_INLINE int NAMED(test_leaf)(struct WALK *w, const struct leaf *leaf, int any)
{
	const ald_accel *a = w->a;
	int found = 0;

	for (uint32_t at = leaf->block; at < leaf->block + (leaf->tris + ALD_LANES - 1) / ALD_LANES;
	     at++) {
		const BLOCK *b = &a->BLOCKS[at];

		for (uint32_t m = TRIANGLE_N(&w->p, b); m; m &= m - 1) {
			unsigned i = (unsigned)__builtin_ctz(m);
			uint32_t id = a->id[at][i];

			if (id == ALD_NONE || !ald_sees(a->prims, w->ray, id))
				continue;
			found |= NAMED(test_lane)(w, b, i, id);
			if (any && found)
				return 1;
		}
	}
	for (uint32_t i = 0; i < leaf->others; i++) {
		uint32_t id = a->other[leaf->other + i];

		if (ald_sees(a->prims, w->ray, id))
			found |= a->prims->intersect(a->prims, id, w->q, w->ray, w->hit);
		if (any && found)
			return 1;
	}
	return found;
}

/* Which of the spheres around its children the ray enters, and where: ald_sphere_ray() eight times. scale: of the
 * children. */
ALD_INLINE void NAMED(open_balls)(const struct WALK *w, struct FRAME *f, REAL scale, REAL t0, REAL t1, LANE in[8])
{
	static const int64_t far[3][8] = CHILD_BITS;
	const ald_accel *a = w->a;
	REAL r = (REAL)(a->ball * (double)scale + a->ball_pad), along[8], size[8], off[3][8], pad = PAD(&w->p);

	r = (r + 2 * pad) * (REAL)(1 + 8 * ALD_U);
	EACH(i)
		along[i] = size[i] = 0;
	for (unsigned k = 0; k < 3; k++) {
		REAL h = (REAL)a->half[k] * scale, o = w->p.o[k] - f->c[k], d = w->p.d[k];
		int64_t flip = w->flip >> k & 1;

		EACH(i) {
			off[k][i] = (far[k][i] ^ flip) ? o - h : o + h;
			along[i] -= off[k][i] * d;
		}
	}
	EACH(i)
		along[i] /= w->p.dd;
	for (unsigned k = 0; k < 3; k++) {
		REAL d = w->p.d[k];

		EACH(i) {
			REAL l = off[k][i] + along[i] * d;

			size[i] += l * l;
		}
	}
	EACH(i) {
		REAL gap = r * r - size[i], half;

		half = (REAL)sqrt((double)((gap > 0 ? gap : 0) / w->p.dd)) * (REAL)(1 + 8 * ALD_U) +
		       pad * (REAL)sqrt(1 / (double)w->p.dd);
		f->enter[i] = along[i] - half > t0 ? along[i] - half : t0;
		in[i] = !(gap < 0) & !(f->enter[i] > (along[i] + half < t1 ? along[i] + half : t1));
	}
}

/* The same of the children's boxes. f has the ray's way into its nearer and out of its farther halves. */
ALD_INLINE void NAMED(open_boxes)(const struct WALK *w, struct FRAME *f, REAL t0, REAL t1, LANE in[8])
{
	static const int64_t far[3][8] = CHILD_BITS;
	REAL leave[8];

	EACH(i) {
		f->enter[i] = t0;
		leave[i] = t1;
	}
	for (unsigned k = 0; k < 3; k++) {
		REAL en0 = f->en[0][k], en1 = (f->c[k] - NEAR(&w->p, k)) * w->p.inv[k];
		REAL ex0 = (f->c[k] - FAR(&w->p, k)) * w->p.inv[k], ex1 = f->ex[1][k];

		f->en[1][k] = en1;
		f->ex[0][k] = ex0;
		EACH(i) {
			REAL en = far[k][i] ? en1 : en0, ex = far[k][i] ? ex1 : ex0;

			f->enter[i] = en > f->enter[i] ? en : f->enter[i]; /* a NaN is not kept */
			leave[i] = ex < leave[i] ? ex : leave[i];
		}
	}
	EACH(i)
		in[i] = !(f->enter[i] > leave[i]);
}

/* f has its centre, and what open_boxes() needs: the rest. */
ALD_INLINE void NAMED(open_cell)(const struct WALK *w, struct FRAME *f, uint32_t node, REAL scale)
{
	REAL best = NAMED(best)(w), t1 = best < w->t1 ? best : w->t1;
	uint32_t kids = w->a->kids[node];
	LANE in[8];

	if (w->a->ball > 0)
		NAMED(open_balls)(w, f, scale, w->t0, t1, in);
	else
		NAMED(open_boxes)(w, f, w->t0, t1, in);
	if (w->flip & 1)
		kids = (kids >> 1 & 0x55) | (kids & 0x55) << 1;
	if (w->flip & 2)
		kids = (kids >> 2 & 0x33) | (kids & 0x33) << 2;
	if (w->flip & 4)
		kids = (kids >> 4 & 0x0f) | (kids & 0x0f) << 4;
	f->node = node;
	f->useful = 0;
	f->todo = (uint8_t)(kids & LANE_BITS(in));
	if (w->count) {
		w->count[ALD_COUNT_VOLUME_TESTS] += (unsigned)__builtin_popcount(kids);
		w->count[ALD_COUNT_NODES]++;
	}
}

ALD_INLINE void NAMED(descend)(const struct WALK *w, const struct FRAME *f, struct FRAME *down, unsigned kid,
			       REAL scale)
{
	for (unsigned k = 0; k < 3; k++) {
		unsigned far = kid >> k & 1;
		REAL h = (REAL)w->a->half[k] * scale;

		down->en[0][k] = f->en[far][k];
		down->ex[1][k] = f->ex[far][k];
		down->c[k] = (far ^ (w->flip >> k)) & 1 ? f->c[k] + h : f->c[k] - h;
	}
}

ALD_INLINE uint32_t NAMED(kid_of)(const struct WALK *w, const struct FRAME *f, unsigned kid)
{
	size_t at = 8 * (size_t)f->node + (kid ^ w->flip);

	return w->a->wide ? w->a->wide[at] : w->a->narrow[at];
}

ALD_INLINE int NAMED(meet_leaf)(struct WALK *w, uint32_t index, int depth, int any)
{
	const struct leaf *leaf = &w->a->leaf[index - w->a->inner];

	if (w->count)
		count_leaf(w->a, w->seen, w->count, leaf);
	if (!NAMED(test_leaf)(w, leaf, any))
		return 0;
	if (w->count)
		NAMED(count_useful)(w, depth);
	return 1;
}

ALD_INLINE int NAMED(walk_down)(struct WALK *w, int any)
{
	const ald_accel *a = w->a;
	struct FRAME *f = w->frame;
	REAL scale = (REAL)0.5;
	int depth = 0, found = 0;

	NAMED(open_cell)(w, f, 0, scale);
	for (;;) {
		uint32_t next;
		unsigned kid;

		if (!f->todo) {
			if (!depth--)
				return found;
			f--;
			scale *= 2;
			continue;
		}
		kid = (unsigned)__builtin_ctz(f->todo);
		f->todo &= (uint8_t)(f->todo - 1);
		if (f->enter[kid] > NAMED(best)(w))
			continue;
		if (w->count)
			w->count[ALD_COUNT_VOLUME_HITS]++;
		next = NAMED(kid_of)(w, f, kid);
		if (next < a->inner) {
			NAMED(descend)(w, f, f + 1, kid, scale);
			scale /= 2;
			NAMED(open_cell)(w, ++f, next, scale);
			depth++;
			continue;
		}
		found |= NAMED(meet_leaf)(w, next, depth, any);
		if (found && any)
			return 1;
	}
}

/* The same by calling itself: what the loop saves can be measured so (walk=recursion). */
static int NAMED(walk_calls)(struct WALK *w, uint32_t node, int depth, REAL scale, int any)
{
	struct FRAME *f = &w->frame[depth];
	int found = 0;

	NAMED(open_cell)(w, f, node, scale);
	while (f->todo) {
		unsigned kid = (unsigned)__builtin_ctz(f->todo);
		uint32_t next;

		f->todo &= (uint8_t)(f->todo - 1);
		if (f->enter[kid] > NAMED(best)(w))
			continue;
		if (w->count)
			w->count[ALD_COUNT_VOLUME_HITS]++;
		next = NAMED(kid_of)(w, f, kid);
		if (next < w->a->inner) {
			NAMED(descend)(w, f, f + 1, kid, scale);
			found |= NAMED(walk_calls)(w, next, depth + 1, scale / 2, any);
		} else {
			found |= NAMED(meet_leaf)(w, next, depth, any);
		}
		if (found && any)
			break;
	}
	return found;
}

/* The ray's way through everything's box; 0: it misses it. */
ALD_INLINE int NAMED(enter_root)(struct WALK *w)
{
	const ald_accel *a = w->a;
	const double *lo = &a->box.lo.x, *hi = &a->box.hi.x;
	struct FRAME *f = w->frame;

	PREPARE(w);
	w->t1 = NAMED(best)(w);
	w->flip = w->p.sign[0] | w->p.sign[1] << 1 | w->p.sign[2] << 2;
	if (a->ball > 0) {
		ald_vec c = { a->centre[0], a->centre[1], a->centre[2] };
		double enter;

		for (unsigned k = 0; k < 3; k++)
			f->c[k] = (REAL)a->centre[k];
		return SPHERE_RAY(&w->p, &c, a->ball + a->ball_pad, w->ray->tmin, w->hit->t, &enter) &&
		       !(enter > w->hit->t);
	}
	for (unsigned k = 0; k < 3; k++) {
		REAL near_o = NEAR(&w->p, k), far_o = FAR(&w->p, k), inv = w->p.inv[k], c = (REAL)a->centre[k];
		REAL h = (REAL)(w->p.sign[k] ? -a->half[k] : a->half[k]);
		REAL in = ((REAL)(w->p.sign[k] ? hi[k] : lo[k]) - near_o) * inv;
		REAL out = ((REAL)(w->p.sign[k] ? lo[k] : hi[k]) - far_o) * inv;

		w->t0 = in > w->t0 ? in : w->t0;
		w->t1 = out < w->t1 ? out : w->t1;
		f->c[k] = c;
		f->en[0][k] = (c - h - near_o) * inv;
		f->ex[1][k] = (c + h - far_o) * inv;
	}
	return !(w->t0 > w->t1);
}

ALD_INLINE int NAMED(trace)(const ald_accel *a, ald_query *q, const ald_ray *ray, ald_hit *hit, int any,
			uint64_t *count)
{
	struct WALK w;
	int found;

	w.a = a;
	w.q = q;
	w.ray = ray;
	w.hit = hit;
	w.count = count;
	if (count) {
		count[ALD_COUNT_VOLUME_TESTS]++;
		w.seen = q->scratch;
		seen_begin(w.seen, a->prims->count);
	}
	if (!NAMED(enter_root)(&w))
		return 0;
	if (count)
		count[ALD_COUNT_VOLUME_HITS]++;
	if (!a->root_is_leaf)
		return a->calls ? NAMED(walk_calls)(&w, 0, 0, (REAL)0.5, any) : NAMED(walk_down)(&w, any);
	if (count)
		count_leaf(a, w.seen, count, &a->leaf[0]);
	found = NAMED(test_leaf)(&w, &a->leaf[0], any);
	if (count && found)
		NAMED(count_useful)(&w, -1);
	return found;
}

#undef REAL
#undef LANE
#undef NAMED
#undef PREP
#undef PREPARE
#undef NEAR
#undef FAR
#undef BLOCK
#undef BLOCKS
#undef TRIANGLE_N
#undef LANE_BITS
#undef SPHERE_RAY
#undef PAD
#undef FRAME
#undef WALK
