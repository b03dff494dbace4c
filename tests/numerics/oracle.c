/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "oracle.h"

#include <float.h>
#include <stdlib.h>

#include <gmp.h>

#include "sieve.h"

struct exact { /* one triangle and one ray, as whole numbers: t = d / s 2^e */
	mpz_t w[3], s, d;
};

struct oracle {
	const struct soup *soup;
	struct sieve *sieve;
	uint32_t *candidate; /* room for all triangles */
	mpz_t origin[3]; /* relative to the sieve's point of reference */
	int mesh_exponent; /* every finite coordinate is a multiple of 2^this */
	mpz_t o[3], dir[3], v[3][3], cross, product;
	struct exact now, best;
	mpz_t left, right;
	mpf_t t, other;
	int exponent, exponent_m; /* of best's t; of the moment of the ray */
};

/* The greatest e such that x is a multiple of 2^e. */
static int exponent_of(double x)
{
	int e;
	int64_t m;

	if (x == 0 || !isfinite(x))
		return 2000;
	m = (int64_t)ldexp(frexp(x, &e), 53);
	return e - 53 + __builtin_ctzll((unsigned long long)(m < 0 ? -m : m));
}

static int lesser(int a, int b)
{
	return a < b ? a : b;
}

static int vec_exponent(vec v)
{
	return lesser(exponent_of(v.x), lesser(exponent_of(v.y), exponent_of(v.z)));
}

/* x / 2^e, which is whole. */
static void set_whole(mpz_t out, double x, int e)
{
	int f;
	int64_t m = (int64_t)ldexp(frexp(x, &f), 53);

	mpz_set_si(out, m);
	f -= 53 + e;
	if (f >= 0)
		mpz_mul_2exp(out, out, (mp_bitcnt_t)f);
	else
		mpz_tdiv_q_2exp(out, out, (mp_bitcnt_t)-f);
}

static void set_vec(mpz_t out[3], vec v, int e)
{
	set_whole(out[0], v.x, e);
	set_whole(out[1], v.y, e);
	set_whole(out[2], v.z, e);
}

static void exact_init(struct exact *x)
{
	mpz_inits(x->w[0], x->w[1], x->w[2], x->s, x->d, NULL);
}

static void exact_clear(struct exact *x)
{
	mpz_clears(x->w[0], x->w[1], x->w[2], x->s, x->d, NULL);
}

struct oracle *oracle_new(const struct soup *soup)
{
	struct oracle *o = calloc(1, sizeof(*o));

	o->soup = soup;
	o->mesh_exponent = 2000;
	for (uint32_t i = 0; i < soup->vertices; i++)
		o->mesh_exponent = lesser(o->mesh_exponent, vec_exponent(soup->vertex[i]));
	o->sieve = sieve_new(soup);
	o->candidate = calloc(soup->triangles + 1, sizeof(*o->candidate));
	o->mesh_exponent = lesser(o->mesh_exponent, vec_exponent(sieve_reference(o->sieve)));
	for (unsigned k = 0; k < 3; k++)
		mpz_inits(o->o[k], o->dir[k], o->origin[k], o->v[k][0], o->v[k][1], o->v[k][2], NULL);
	mpz_inits(o->cross, o->product, o->left, o->right, NULL);
	mpf_init2(o->t, 512);
	mpf_init2(o->other, 512);
	exact_init(&o->now);
	exact_init(&o->best);
	return o;
}

void oracle_free(struct oracle *o)
{
	sieve_free(o->sieve);
	free(o->candidate);
	for (unsigned k = 0; k < 3; k++)
		mpz_clears(o->o[k], o->dir[k], o->origin[k], o->v[k][0], o->v[k][1], o->v[k][2], NULL);
	mpz_clears(o->cross, o->product, o->left, o->right, NULL);
	mpf_clears(o->t, o->other, NULL);
	exact_clear(&o->now);
	exact_clear(&o->best);
	free(o);
}

/* out = a . (b x c) */
static void volume(struct oracle *o, mpz_t out, mpz_t a[3], mpz_t b[3], mpz_t c[3])
{
	mpz_set_ui(out, 0);
	for (unsigned k = 0; k < 3; k++) {
		unsigned i = (k + 1) % 3, j = (k + 2) % 3;

		mpz_mul(o->cross, b[i], c[j]);
		mpz_submul(o->cross, b[j], c[i]);
		mpz_addmul(out, o->cross, a[k]);
	}
}

/* Does the line of the ray (already in o and dir) meet triangle i? o->now, with s > 0, if so. */
static bool meets(struct oracle *o, uint32_t i, int exponent)
{
	struct exact *x = &o->now;
	bool pos = false, neg = false;

	for (unsigned k = 0; k < 3; k++) {
		set_vec(o->v[k], o->soup->vertex[o->soup->triangle[i][k]], exponent);
		for (unsigned j = 0; j < 3; j++)
			mpz_sub(o->v[k][j], o->v[k][j], o->o[j]);
	}
	for (unsigned k = 0; k < 3; k++) {
		volume(o, x->w[k], o->dir, o->v[(k + 1) % 3], o->v[(k + 2) % 3]);
		pos |= mpz_sgn(x->w[k]) > 0;
		neg |= mpz_sgn(x->w[k]) < 0;
	}
	if (pos == neg) /* both, or all are 0 */
		return false;
	mpz_add(x->s, x->w[0], x->w[1]);
	mpz_add(x->s, x->s, x->w[2]);
	volume(o, x->d, o->v[0], o->v[1], o->v[2]);
	if (neg) {
		mpz_neg(x->s, x->s);
		mpz_neg(x->d, x->d);
	}
	return true;
}

/* The sign of now's t less t. */
static int compare_t(struct oracle *o, double t, int e)
{
	int f = exponent_of(t);

	if (!isfinite(t))
		return t > 0 ? -1 : 1;
	if (t == 0)
		return mpz_sgn(o->now.d);
	set_whole(o->right, t, f); /* d 2^e against right 2^f s */
	mpz_mul(o->right, o->right, o->now.s);
	mpz_set(o->left, o->now.d);
	if (e >= f)
		mpz_mul_2exp(o->left, o->left, (mp_bitcnt_t)(e - f));
	else
		mpz_mul_2exp(o->right, o->right, (mp_bitcnt_t)(f - e));
	return mpz_cmp(o->left, o->right);
}

static int compare_best(struct oracle *o)
{
	mpz_mul(o->left, o->now.d, o->best.s);
	mpz_mul(o->right, o->best.d, o->now.s);
	return mpz_cmp(o->left, o->right);
}

static void scale_2exp(mpf_t x, int e)
{
	if (e >= 0)
		mpf_mul_2exp(x, x, (mp_bitcnt_t)e);
	else
		mpf_div_2exp(x, x, (mp_bitcnt_t)-e);
}

static bool finite_triangle(const struct soup *s, uint32_t i)
{
	const uint32_t *t = s->triangle[i];

	return vec_finite(s->vertex[t[0]]) && vec_finite(s->vertex[t[1]]) && vec_finite(s->vertex[t[2]]);
}

static void add_tie(struct truth *out, uint32_t i)
{
	if (out->ties < ORACLE_TIES)
		out->tie[out->ties++] = i;
}

/* (o - c) x d, each component off by less than 2^-52 of itself: cut off once. */
static vec moment(struct oracle *o, int e)
{
	vec m;

	set_vec(o->origin, sieve_reference(o->sieve), e);
	for (unsigned k = 0; k < 3; k++)
		mpz_sub(o->origin[k], o->o[k], o->origin[k]);
	for (unsigned k = 0; k < 3; k++) {
		unsigned i = (k + 1) % 3, j = (k + 2) % 3;
		long power;
		double x;

		mpz_mul(o->cross, o->origin[i], o->dir[j]);
		mpz_submul(o->cross, o->origin[j], o->dir[i]);
		x = mpz_get_d_2exp(&power, o->cross);
		(&m.x)[k] = ldexp(x, (int)power + o->exponent_m);
	}
	return m;
}

/* Takes triangle i, which has area and finite corners, into account. */
static void consider(struct oracle *o, const ald_ray *r, uint32_t i, int e, struct truth *out)
{
	int order;

	if (!meets(o, i, e) || compare_t(o, r->tmin, o->exponent) <= 0 || compare_t(o, r->tmax, o->exponent) > 0)
		return;
	order = out->hit ? compare_best(o) : -1;
	if (order < 0) {
		struct exact x = o->best;

		o->best = o->now;
		o->now = x;
		out->hit = true;
		out->ties = 0;
	}
	if (order <= 0)
		add_tie(out, i);
}

static void ask(struct oracle *o, const ald_ray *r, bool sieved, struct truth *out)
{
	int e = lesser(o->mesh_exponent, vec_exponent(r->org)), f = vec_exponent(r->dir);
	uint32_t n = o->soup->triangles;

	*out = (struct truth){ .hit = false };
	if (!vec_finite(r->org) || !vec_finite(r->dir) || f == 2000 || !(r->tmin <= r->tmax))
		return;
	set_vec(o->o, r->org, e);
	set_vec(o->dir, r->dir, f);
	o->exponent = e - f;
	o->exponent_m = e + f;
	if (sieved)
		n = sieve_line(o->sieve, r->dir, moment(o, e), o->candidate);
	for (uint32_t i = 0; i < n; i++) {
		if (sieved)
			consider(o, r, o->candidate[i], e, out);
		else if (finite_triangle(o->soup, i))
			consider(o, r, i, e, out);
	}
	if (!out->hit)
		return;
	mpf_set_z(o->t, o->best.d);
	mpf_set_z(o->other, o->best.s);
	mpf_div(o->t, o->t, o->other);
	scale_2exp(o->t, o->exponent);
	out->t = mpf_get_d(o->t);
}

void oracle_ask(struct oracle *o, const ald_ray *r, struct truth *out)
{
	ask(o, r, true, out);
}

void oracle_ask_all(struct oracle *o, const ald_ray *r, struct truth *out)
{
	ask(o, r, false, out);
}

bool truth_same(const struct truth *a, const struct truth *b)
{
	if (a->hit != b->hit || (a->hit && a->t != b->t) || a->ties != b->ties)
		return false;
	for (uint32_t i = 0; i < a->ties; i++) {
		if (a->tie[i] != b->tie[i])
			return false;
	}
	return true;
}

double oracle_error(struct oracle *o, double t)
{
	mpf_set_d(o->other, t);
	mpf_sub(o->other, o->other, o->t);
	mpf_div(o->other, o->other, o->t);
	return fabs(mpf_get_d(o->other));
}

bool truth_has(const struct truth *t, uint32_t id)
{
	for (uint32_t i = 0; i < t->ties; i++) {
		if (t->tie[i] == id)
			return true;
	}
	return false;
}
