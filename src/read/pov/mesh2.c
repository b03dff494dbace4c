/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * mesh2 (manual 3.4.5.2.4): nearly all of a large scene file's bytes are the lists of such meshes.
 *
 * Each list is read in two ways. As long as it is plain text (numbers, signs, comments), its bytes are
 * scanned directly. At the first element that is anything else (an identifier, an expression, a
 * directive) or that is wrong, scanning stops before it, and that element is read as tokens, which
 * also is where all errors are found; behind its comma, scanning begins again.
 */
#include <config.h>

#include "read/pov/mesh.h"

#include <stdatomic.h>

#include "read/limits.h"
#include "read/pov/scan.h"
#include "read/pov/share.h"

#define TINY 1e-10 /* what POV-Ray takes for 0 */

/* A list of a known number of elements. */
struct list {
	const char *name; /* the block's word */
	struct pov *p; /* for textures of faces; not to be touched where threads share */
	struct mesh_draft *d;
	struct mesh_array *to; /* where elements go */
	size_t count, done, expect;
	uint32_t below; /* indices have to be */
	const char *of; /* what indices count */
	atomic_bool zero_normal;
	bool alone; /* sharing is over, or did not work out */
	uint32_t *textured; /* while faces with numbers of textures are shared: three each, from face first on */
	size_t first;
};

struct list_kind {
	share_element *scan, *share; /* share: by one of many threads */
	bool (*take)(struct list *, size_t n); /* NULL, or what is to be done with n shared elements, in order */
	bool (*read)(struct pov *, struct list *); /* one element, as tokens */
};

/* The shortest element: "<0,0,0>". */
static size_t plausible(size_t count, const char *at, const char *end)
{
	size_t most = (size_t)(end - at) / 7 + 1;

	return count < most ? count : most;
}

static bool list_ends(struct pov *p, const struct list *l)
{
	if (pov_failed(p))
		return false;
	if (pov_token(p) == TOK_RIGHT_BRACE || pov_token(p) == TOK_END)
		return pov_close(p, l->name);
	pov_fail(p, "%s announces %zu, but more follow", l->name, l->count);
	return false;
}

static bool read_element(struct pov *p, struct list *l, const struct list_kind *k)
{
	if (pov_token(p) == TOK_END && !pov_failed(p))
		pov_fail(p, "the file ends in %s, after %zu of %zu", l->name, l->done, l->count);
	else if (pov_token(p) == TOK_RIGHT_BRACE)
		pov_fail(p, "%s announces %zu, but has only %zu", l->name, l->count, l->done);
	if (pov_failed(p) || !k->read(p, l))
		return false;
	l->done++;
	return !pov_failed(p);
}

static size_t scan_alone(struct list *l, const struct list_kind *k, size_t most, const char **at, const char *end)
{
	size_t n = 0;

	while (n < most) {
		const char *next = k->scan(l, *at, end, l->to->count + n);

		if (!next)
			break;
		*at = next;
		n++;
	}
	return n;
}

/* Elements that all threads scan, before others are scanned alone: how many. Where textures are numbered, the numbers
 * are kept apart until it is known which faces count, as they go where those before them tell. */
static size_t scan_shared(struct pov *p, struct list *l, const struct list_kind *k, size_t most, const char **at,
			  const char *end)
{
	struct pool *pool = pov_options(p)->pool;
	size_t n = 0;

	if (l->alone || !share_worth(pool, *at, end))
		return 0;
	l->first = l->to->count;
	if (k->take && l->d->list_count)
		l->textured = mem_alloc(pov_book(p), "mesh", mem_product(most, 3 * sizeof(*l->textured)));
	if (l->textured || !k->take || !l->d->list_count)
		n = share_scan(pool, k->share, l, l->first, most, at, end);
	if (l->textured && !k->take(l, n))
		n = 0;
	mem_free(l->textured);
	l->textured = NULL;
	return n;
}

/* Elements while they are plain and right; returns where the next one begins. */
static const char *scan_elements(struct pov *p, struct list *l, const struct list_kind *k, const char *at,
				 const char *end)
{
	struct mesh_array *a = l->to;
	size_t n, most;

	do {
		if (a->count == a->room && !mesh_reserve(p, a, 1, l->expect))
			break;
		most = l->count - l->done < a->room - a->count ? l->count - l->done : a->room - a->count;
		n = scan_shared(p, l, k, most, &at, end);
		if (pov_failed(p))
			break;
		l->alone = true;
		a->count += n;
		l->done += n;
		most -= n;
		n = scan_alone(l, k, most, &at, end);
		a->count += n;
		l->done += n;
	} while (n == most && l->done < l->count && !pov_failed(p));
	return at;
}

/* Between the count and the }. */
static bool read_elements(struct pov *p, struct list *l, const struct list_kind *k)
{
	const char *at, *end;

	while (l->done < l->count) {
		if (pov_accept(p, TOK_COMMA) && pov_raw(p, &at, &end)) {
			if (!l->expect)
				l->expect = plausible(l->count, at, end);
			at = scan_elements(p, l, k, at, end);
			pov_raw_done(p, at);
			if (l->done == l->count || pov_failed(p))
				break;
		}
		if (!read_element(p, l, k))
			return false;
	}
	pov_comma(p);
	return list_ends(p, l);
}

static bool read_count(struct pov *p, struct list *l, uint32_t least)
{
	uint64_t most = read_limits_fill(&pov_options(p)->limits).elements;

	if (!pov_open(p))
		return false;
	if (most > UINT32_MAX - 1)
		most = UINT32_MAX - 1;
	l->count = pov_count(p, l->name, least, most);
	return !pov_failed(p);
}

/* Vertices. */

static const char *scan_vertex(void *list, const char *at, const char *end, size_t i)
{
	const struct list *l = list;

	return scan_vector(at, end, (double *)l->to->data + 3 * i);
}

static bool read_vertex(struct pov *p, struct list *l)
{
	struct mesh_array *a = &l->d->vertex;
	vec v = pov_finite_vector(p, "a vertex");
	double *out;

	if (pov_failed(p) || !mesh_reserve(p, a, 1, l->expect))
		return false;
	out = (double *)a->data + 3 * a->count++;
	out[0] = v.x;
	out[1] = v.y;
	out[2] = v.z;
	return true;
}

static bool read_vertices(struct pov *p, struct mesh_draft *d)
{
	static const struct list_kind kind = { scan_vertex, scan_vertex, NULL, read_vertex };
	struct list l = { .name = "vertex_vectors", .d = d, .to = &d->vertex };

	if (d->vertex.count) {
		pov_fail(p, "the mesh has a second vertex_vectors");
		return false;
	}
	return read_count(p, &l, 1) && read_elements(p, &l, &kind);
}

/* Normals. */

static void put_normal(struct list *l, size_t i, vec n)
{
	bool zero = false;

	mesh_normal((float *)l->to->data + 3 * i, n, &zero);
	if (zero)
		l->zero_normal = true;
}

static const char *scan_normal(void *list, const char *at, const char *end, size_t i)
{
	double n[3];

	at = scan_vector(at, end, n);
	if (at)
		put_normal(list, i, vec_make(n[0], n[1], n[2]));
	return at;
}

static bool read_normal(struct pov *p, struct list *l)
{
	vec n = pov_finite_vector(p, "a normal");

	if (pov_failed(p) || !mesh_reserve(p, &l->d->normal, 1, l->expect))
		return false;
	put_normal(l, l->to->count++, n);
	return true;
}

static bool read_normals(struct pov *p, struct mesh_draft *d)
{
	static const struct list_kind kind = { scan_normal, scan_normal, NULL, read_normal };
	struct list l = { .name = "normal_vectors", .d = d, .to = &d->normal };
	struct diag_pos at = pov_here(p);

	if (d->normal.count) {
		pov_fail(p, "the mesh has a second normal_vectors");
		return false;
	}
	if (!read_count(p, &l, 0) || !read_elements(p, &l, &kind))
		return false;
	if (l.zero_normal)
		pov_warn(p, &at, "a normal in normal_vectors has no direction: <1,0,0> is taken, as in "
			 "POV-Ray");
	return true;
}

/* Texture coordinates: kept until it is known whether a texture of the scene asks for them. */

static void put_uv(const struct list *l, size_t i, const double uv[2])
{
	float *out = (float *)l->to->data + 2 * i;

	out[0] = (float)uv[0];
	out[1] = (float)uv[1];
}

static const char *scan_uv(void *list, const char *at, const char *end, size_t i)
{
	double uv[2];

	at = scan_vector2(at, end, uv);
	if (at)
		put_uv(list, i, uv);
	return at;
}

static bool read_uv(struct pov *p, struct list *l)
{
	struct diag_pos at = pov_here(p);
	double uv[2];

	pov_vector2(p, &uv[0], &uv[1]);
	if (!pov_failed(p) && (!isfinite(uv[0]) || !isfinite(uv[1])))
		pov_fail_at(p, &at, "a uv vector has a component that is not a finite number");
	if (pov_failed(p) || !mesh_reserve(p, l->to, 1, l->expect))
		return false;
	put_uv(l, l->to->count++, uv);
	return true;
}

static bool read_uvs(struct pov *p, struct mesh_draft *d)
{
	static const struct list_kind kind = { scan_uv, scan_uv, NULL, read_uv };
	struct list l = { .name = "uv_vectors", .d = d, .to = &d->uv };

	d->uv.count = 0; /* a second list takes the first one's place */
	return read_count(p, &l, 0) && read_elements(p, &l, &kind);
}

/* Three indices. */

static bool read_indices(struct pov *p, const struct list *l, uint32_t out[3])
{
	struct diag_pos at = pov_here(p);
	vec v = pov_vector(p);
	const double i[3] = { v.x, v.y, v.z };

	if (!l->below && !pov_failed(p))
		pov_fail_at(p, &at, "%s in a mesh without %s", l->name, l->of);
	for (int k = 0; k < 3 && !pov_failed(p); k++) {
		/* POV-Ray cuts off what stands behind the point, and so accepts -0.5. */
		double whole = trunc(i[k]);

		if (!(whole >= 0 && whole < l->below)) {
			pov_fail_at(p, &at, "index %.15g in %s is out of range: %s are counted from 0, "
				    "and the last is %u", i[k], l->name, l->of, l->below - 1);
			return false;
		}
		out[k] = (uint32_t)whole;
	}
	return !pov_failed(p);
}

static bool in_range(const uint32_t i[3], uint32_t below)
{
	return i[0] < below && i[1] < below && i[2] < below;
}

/* Faces: three indices of vertices and none, one or three numbers of textures. */

static void spread_texture(uint32_t out[3], const uint32_t t[3], int count)
{
	for (int k = 0; k < 3; k++)
		out[k] = !count ? SCENE_NONE : t[count == 1 ? 0 : k];
}

static bool face_textures(struct pov *p, struct list *l, const uint32_t t[3], int count)
{
	uint32_t each[3];

	spread_texture(each, t, count);
	return mesh_add_texture(p, l->d, each, l->expect);
}

static const char *scan_textured(const struct list *l, const char *at, const char *end, size_t i, uint32_t t[3],
				 int *count)
{
	uint32_t *out = (uint32_t *)l->to->data + 3 * i;

	at = scan_face(at, end, out, t, count);
	if (!at || *count == 2 || !in_range(out, l->below))
		return NULL;
	for (int k = 0; k < *count; k++) {
		if (t[k] >= l->d->list_count)
			return NULL;
	}
	return at;
}

/* The numbers of textures, if there may be any, are put where they go in the order of faces. */
static const char *scan_one_face(void *list, const char *at, const char *end, size_t i)
{
	struct list *l = list;
	uint32_t t[3];
	int count;

	at = scan_textured(l, at, end, i, t, &count);
	if (at && l->d->list_count && !face_textures(l->p, l, t, count))
		return NULL;
	return at;
}

static const char *share_face(void *list, const char *at, const char *end, size_t i)
{
	const struct list *l = list;
	uint32_t t[3];
	int count;

	at = scan_textured(l, at, end, i, t, &count);
	if (at && l->textured)
		spread_texture(l->textured + 3 * (i - l->first), t, count);
	return at;
}

static bool take_textures(struct list *l, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		if (!mesh_add_texture(l->p, l->d, l->textured + 3 * i, l->expect))
			return false;
	}
	return true;
}

static bool read_texture_number(struct pov *p, struct list *l, uint32_t *out)
{
	struct diag_pos at = pov_here(p);
	double x = pov_float(p), whole = trunc(x);

	if (pov_failed(p))
		return false;
	if (!(whole >= 0 && whole < l->d->list_count)) {
		if (!l->d->list_count)
			pov_fail_at(p, &at, "a face has texture number %.15g, but the mesh has no "
				    "textures in a texture_list", x);
		else
			pov_fail_at(p, &at, "texture number %.15g is out of range: the textures of "
				    "texture_list are counted from 0, and the last is %u", x,
				    l->d->list_count - 1);
		return false;
	}
	*out = (uint32_t)whole;
	return true;
}

/* The comma behind a face may belong to the list or stand before a texture number. */
static bool read_face(struct pov *p, struct list *l)
{
	struct mesh_array *a = &l->d->index;
	struct diag_pos at = pov_here(p);
	uint32_t t[3], v[3];
	int count = 0;

	if (!read_indices(p, l, v) || !mesh_reserve(p, a, 1, l->expect))
		return false;
	for (int i = 0; i < 3; i++)
		((uint32_t *)a->data)[3 * a->count + (size_t)i] = v[i];
	a->count++;
	pov_comma(p);
	while (count < 3 && !pov_starts_vector(p) && pov_starts_number(p)) {
		if (!read_texture_number(p, l, &t[count++]))
			return false;
		pov_comma(p);
	}
	if (count == 2) {
		pov_fail_at(p, &at, "a face has two texture numbers: give one, or one for each corner");
		return false;
	}
	return !l->d->list_count || face_textures(p, l, t, count);
}

static bool read_faces(struct pov *p, struct mesh_draft *d)
{
	static const struct list_kind kind = { scan_one_face, share_face, take_textures, read_face };
	struct list l = { .name = "face_indices",
			  .p = p,
			  .d = d,
			  .to = &d->index,
			  .below = (uint32_t)d->vertex.count,
			  .of = "vertices" };

	if (pov_token(p) == TOK_END && !pov_failed(p))
		pov_fail(p, "the file ends in mesh2 { ... } before its face_indices");
	else if (pov_token(p) != TOK_FACE_INDICES)
		pov_expect(p, TOK_FACE_INDICES, "in mesh2");
	if (pov_failed(p) || !read_count(p, &l, 1) || !read_elements(p, &l, &kind))
		return false;
	if (!d->list_count)
		mesh_add_untextured(d, d->index.count);
	return true;
}

/* Indices of normals and of texture coordinates. */

static const char *scan_index(void *list, const char *at, const char *end, size_t i)
{
	const struct list *l = list;
	uint32_t *out = (uint32_t *)l->to->data + 3 * i;

	at = scan_indices3(at, end, out);
	return at && in_range(out, l->below) ? at : NULL;
}

static bool read_index(struct pov *p, struct list *l)
{
	struct mesh_array *a = l->to;
	uint32_t v[3];

	if (!read_indices(p, l, v) || !mesh_reserve(p, a, 1, l->expect))
		return false;
	for (int i = 0; i < 3; i++)
		((uint32_t *)a->data)[3 * a->count + (size_t)i] = v[i];
	a->count++;
	return true;
}

static const struct list_kind kind_indices = { scan_index, scan_index, NULL, read_index };

static bool read_normal_indices(struct pov *p, struct mesh_draft *d)
{
	struct list l = { .name = "normal_indices",
			  .d = d,
			  .to = &d->normal_index,
			  .below = (uint32_t)d->normal.count,
			  .of = "normals" };
	struct diag_pos at = pov_here(p);

	if (!read_count(p, &l, 0))
		return false;
	if (l.count > d->index.count) {
		pov_fail_at(p, &at, "normal_indices announces %zu, but the mesh has only %zu faces", l.count,
			    d->index.count);
		return false;
	}
	d->smooth_count = (uint32_t)l.count;
	return read_elements(p, &l, &kind_indices);
}

static bool read_uv_indices(struct pov *p, struct mesh_draft *d)
{
	struct list l = { .name = "uv_indices",
			  .d = d,
			  .to = &d->uv_index,
			  .below = d->uv.count ? (uint32_t)d->uv.count : 1,
			  .of = "uv vectors" };
	struct diag_pos at = pov_here(p);

	if (!read_count(p, &l, 0))
		return false;
	if (l.count != d->index.count) {
		pov_fail_at(p, &at, "uv_indices announces %zu, but the mesh has %zu faces: it needs one for "
			    "each", l.count, d->index.count);
		return false;
	}
	return read_elements(p, &l, &kind_indices);
}

static bool read_texture_list(struct pov *p, struct mesh_draft *d)
{
	struct list l = { .name = "texture_list", .d = d };
	struct mesh_array a = { .size = sizeof(struct pov_texture *) };
	bool ok;

	if (!read_count(p, &l, 0))
		return false;
	pov_comma(p);
	for (; l.done < l.count && !pov_failed(p); l.done++) {
		struct pov_texture *t = pov_take(p, ITEM_TEXTURE);

		if (!t && pov_token(p) == TOK_TEXTURE)
			t = pov_read_texture(p);
		if (!t && !pov_failed(p))
			pov_fail(p, "texture_list announces %zu, but has only %zu", l.count, l.done);
		if (pov_failed(p) || !mesh_reserve(p, &a, 1, 0))
			break;
		((struct pov_texture **)a.data)[a.count++] = t;
		pov_comma(p);
	}
	ok = list_ends(p, &l);
	if (ok && a.count) {
		d->list = pov_copy(p, a.data, a.count * a.size);
		d->list_count = (uint32_t)a.count;
		ok = d->list;
	}
	mem_free(a.data);
	return ok;
}

/* What stands before face_indices, in any order. */
static bool read_vectors(struct pov *p, struct mesh_draft *d)
{
	while (!pov_failed(p)) {
		switch (pov_token(p)) {
		case TOK_VERTEX_VECTORS:
			if (!read_vertices(p, d))
				return false;
			break;
		case TOK_NORMAL_VECTORS:
			if (!read_normals(p, d))
				return false;
			break;
		case TOK_UV_VECTORS:
			if (!read_uvs(p, d))
				return false;
			break;
		case TOK_TEXTURE_LIST:
			if (!read_texture_list(p, d))
				return false;
			break;
		default:
			if (!d->vertex.count)
				pov_fail(p, "vertex_vectors has to come before %s in mesh2",
					 pov_text(p));
			return !pov_failed(p);
		}
	}
	return false;
}

/* What stands behind face_indices. */
static bool read_indices_blocks(struct pov *p, struct mesh_draft *d)
{
	bool normals = false, uv = false;

	while (!pov_failed(p)) {
		if (pov_token(p) == TOK_NORMAL_INDICES && !normals) {
			normals = true;
			if (!read_normal_indices(p, d))
				return false;
		} else if (pov_token(p) == TOK_UV_INDICES && !uv) {
			uv = true;
			if (!read_uv_indices(p, d))
				return false;
		} else if (pov_accept(p, TOK_INSIDE_VECTOR)) {
			d->inside = pov_finite_vector(p, "inside_vector");
			d->has_inside = vec_length(d->inside) >= TINY;
		} else {
			break;
		}
	}
	if (pov_failed(p))
		return false;
	if (!normals && d->normal.count == d->vertex.count)
		d->smooth_count = (uint32_t)d->index.count; /* they share face_indices */
	else if (!normals && d->normal.count)
		pov_fail(p, "normal_indices is missing: the mesh has %zu normals for %zu vertices",
			 d->normal.count, d->vertex.count);
	if (!uv && d->uv.count > 1 && d->uv.count != d->vertex.count)
		pov_fail(p, "uv_indices is missing: the mesh has %zu uv vectors for %zu vertices", d->uv.count,
			 d->vertex.count);
	return !pov_failed(p);
}

struct pov_object *pov_read_mesh2(struct pov *p, const struct diag_pos *at)
{
	struct pov_object *o = NULL;
	struct mesh_draft d;

	mesh_draft_init(&d);
	d.pos = *at;
	if (read_vectors(p, &d) && read_faces(p, &d) && read_indices_blocks(p, &d))
		o = mesh_draft_finish(p, &d);
	mesh_draft_release(&d);
	return o;
}
