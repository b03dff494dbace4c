/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Normals: how patterns bend a surface's normal (manual 3.4.6.2). Noise and waves push it by a vector of
 * their own; of any other pattern the slope is taken, from its values at the corners of a small tetrahedron.
 *
 * The normal is bent in the pattern's coordinates, where it has length 1, so that a bump keeps its
 * steepness however a texture is scaled; with no_bump_scale it keeps its height.
 */
#include "pattern/family.h"
#include "pattern/image.h"
#include "pattern/random.h"

static vec ripples(const struct scene *s, const struct normal *t, vec p, bool waves)
{
	vec sum = { 0, 0, 0 };
	uint32_t count = s->number_of_waves;

	for (uint32_t i = 0; i < count; i++) {
		struct noise_wave wave = noise_wave(i);
		vec away = vec_sub(p, wave.source);
		double l = vec_length(away), f = waves ? wave.frequency : 1;

		if (l == 0)
			l = 1;
		sum = vec_mad(sum, away,
			      cycloidal(l * t->pattern->frequency * f + t->pattern->phase) / (f * l * count));
	}
	return sum;
}

static vec dents(const struct scene *s, const struct normal *t, vec p)
{
	double v = noise_value(p, pattern_generator(s, t->pattern));

	return vec_scale(noise_vector(p), v * v * v);
}

static vec wrinkles(vec p)
{
	vec sum = { 0, 0, 0 };
	double scale = 1;

	for (int i = 0; i < 10; i++, scale *= 2) {
		vec v = noise_vector(vec_scale(p, scale));

		sum = vec_mad(sum, vec_make(fabs(v.x), fabs(v.y), fabs(v.z)), 1 / scale);
	}
	return sum;
}

static vec quilted(const struct normal *t, vec p)
{
	vec v = solid_quilt_place(p);

	return vec_scale(v, solid_quilt(t->pattern, vec_length(v)));
}

/* A nearby random point stands for the place (coords) or is the normal itself. */
static vec facets(const struct normal *t, vec p, vec n)
{
	double size = t->pattern->of.facets.size, coords = t->pattern->of.facets.coords;
	vec near, push;

	n = vec_unit(n);
	near = random_facet(vec_scale(coords != 0 ? p : n, size < 1e-6 ? 1e6 : 1 / size),
			      t->pattern->of.facets.metric);
	if (coords == 0)
		return near;
	push = noise_vector(near);
	return vec_mad(n, vec_mad(push, n, -vec_dot(push, n)), coords);
}

/* Height at a value of the pattern: itself, or a cubic between the entries of a slope_map. */
static double height(const struct map *m, double value)
{
	uint32_t i, j;
	double t, d, a, b;

	if (m->kind != MAP_SLOPE)
		return value;
	map_find(m, value, &i, &j, &t);
	if (i == j)
		return m->entry[i].is.slope.height;
	a = m->entry[i].is.slope.slope;
	b = m->entry[j].is.slope.slope;
	d = m->entry[i].is.slope.height - m->entry[j].is.slope.height;
	return ((a + b + 2 * d) * t - (2 * a + b + 3 * d)) * t * t + a * t + m->entry[i].is.slope.height;
}

/* The corners are those of a tetrahedron of radius 1. */
static vec gradient(const struct scene *s, const struct normal *t, const struct pattern_point *at, vec n)
{
	static const vec corner[4] = { { 0.942809041582063366, -1.0 / 3, 0 },
				       { -0.471404520791031683, -1.0 / 3, 0.816496580927726033 },
				       { -0.471404520791031683, -1.0 / 3, -0.816496580927726033 },
				       { 0, 1, 0 } };
	double amount = -5 * t->amount * 0.02 / t->accuracy;
	struct pattern_point q = *at;

	for (unsigned i = 0; i < 4; i++) {
		q.p = vec_mad(at->p, corner[i], t->accuracy);
		n = vec_mad(n, corner[i], amount * height(&t->map, pattern_value_warped(s, t->pattern, &q)));
	}
	return n;
}

static vec bend(const struct scene *, const struct normal *, const struct pattern_point *, vec n, bool keep);

static vec average(const struct scene *s, const struct normal *t, const struct pattern_point *at, vec n,
		   bool keep)
{
	vec sum = { 0, 0, 0 };
	double total = 0;

	for (uint32_t i = 0; i < t->map.count; i++) {
		sum = vec_mad(sum, bend(s, t->map.entry[i].is.normal, at, n, keep), t->map.entry[i].at);
		total += t->map.entry[i].at;
	}
	return vec_scale(sum, 1 / total);
}

static vec mapped(const struct scene *s, const struct normal *t, const struct pattern_point *at, vec n,
		  bool keep)
{
	uint32_t i, j;
	double blend;
	vec a, b;

	map_find(&t->map, pattern_value_warped(s, t->pattern, at), &i, &j, &blend);
	a = bend(s, t->map.entry[i].is.normal, at, n, keep);
	if (i == j)
		return a;
	b = bend(s, t->map.entry[j].is.normal, at, n, keep);
	return vec_add(vec_scale(a, 1 - blend), vec_scale(b, blend));
}

/* In the pattern's coordinates. */
static vec bend_there(const struct scene *s, const struct normal *t, const struct pattern_point *at, vec n,
		      bool keep)
{
	if (t->pattern->kind == PATTERN_AVERAGE)
		return average(s, t, at, n, keep);
	if (t->map.kind == MAP_NORMAL)
		return mapped(s, t, at, n, keep);
	/* A slope_map says nothing to patterns that are vectors; POV-Ray reads it and goes on as well. */
	switch (t->pattern->kind) {
	case PATTERN_BUMP_MAP: return image_bump(&t->pattern->of.image, at->p, t->amount, n);
	case PATTERN_BUMPS: return vec_mad(n, noise_vector(at->p), t->amount);
	case PATTERN_DENTS: return vec_mad(n, dents(s, t, at->p), t->amount);
	case PATTERN_FACETS: return facets(t, at->p, n);
	case PATTERN_QUILTED: return vec_mad(n, quilted(t, at->p), t->amount);
	case PATTERN_RIPPLES: return vec_mad(n, ripples(s, t, at->p, false), t->amount);
	case PATTERN_WAVES: return vec_mad(n, ripples(s, t, at->p, true), t->amount);
	case PATTERN_WRINKLES: return vec_mad(n, wrinkles(at->p), t->amount);
	default: return gradient(s, t, at, n);
	}
}

static vec scaled(vec n, bool keep)
{
	return keep ? n : vec_unit(n);
}

/* To the pattern's coordinates and back; only transforms count of its warps, as in POV-Ray. */
static vec normal_in(const struct pattern *q, vec n, bool keep)
{
	n = scaled(n, keep);
	for (uint32_t i = 0; i < q->warp_count; i++) {
		if (q->warp[i].kind == WARP_TRANSFORM)
			n = mat_normal(&q->warp[i].w.place.fwd, n);
	}
	return scaled(n, keep);
}

static vec normal_out(const struct pattern *q, vec n, bool keep)
{
	for (uint32_t i = q->warp_count; i-- > 0;) {
		if (q->warp[i].kind == WARP_TRANSFORM)
			n = mat_normal(&q->warp[i].w.place.inv, n);
	}
	return scaled(n, keep);
}

/* keep: no_bump_scale, which goes for all that stands in a map too. */
static vec bend(const struct scene *s, const struct normal *t, const struct pattern_point *at, vec n, bool keep)
{
	struct pattern_point inner = *at;

	keep |= t->no_bump_scale;
	inner.p = pattern_warp(t->pattern, t->uv ? vec_make(at->u, at->v, 0) : at->p);
	n = bend_there(s, t, &inner, normal_in(t->pattern, n, keep), keep);
	n = normal_out(t->pattern, n, keep);
	/* A map's is made unit in any case. */
	return t->map.kind == MAP_NORMAL && t->pattern->kind != PATTERN_AVERAGE ? vec_unit(n) : n;
}

vec normal_at(const struct scene *s, const struct normal *t, const struct pattern_point *at, vec n)
{
	bool keep = t->no_bump_scale;

	if (at->place && !t->uv) {
		/* no_bump_scale of a normal says nothing of textures around it: measured. */
		n = scaled(mat_normal(&at->place->fwd, n), keep && !at->within);
		n = mat_normal(&at->place->inv, bend(s, t, at, n, keep));
	} else {
		n = bend(s, t, at, n, keep);
	}
	n = vec_unit(n);
	return vec_finite(n) ? n : at->n;
}
