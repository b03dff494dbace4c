/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The finish block (manual 3.4.6.3).
 */
#include <config.h>

#include "read/pov/items.h"

#define DARKEST 0.01 /* of translucency's clearest colour, for those of none */

/* The albedo variants are applied when the block ends, with what brilliance, phong_size and roughness
 * are by then. */
struct draft {
	struct pov_finish f;
	bool diffuse_albedo, phong_albedo, specular_albedo;
};

/* For a value that multiplies light: negative ones are allowed, as in POV-Ray. */
static double read_amount(struct pov *p, bool *albedo)
{
	const char *what = keyword_text(pov_token(p));

	pov_next(p);
	while (pov_accept(p, TOK_ALBEDO))
		*albedo = true;
	return pov_finite_float(p, what);
}

static void read_diffuse(struct pov *p, struct draft *d)
{
	d->f.finish.diffuse = read_amount(p, &d->diffuse_albedo);
	d->f.finish.diffuse_back = 0;
	pov_comma(p);
	if (pov_starts_number(p))
		d->f.finish.diffuse_back = pov_finite_float(p, "diffuse");
}

static void read_roughness(struct pov *p, struct finish *f)
{
	struct diag_pos at;

	pov_next(p);
	at = pov_here(p);
	f->roughness = pov_finite_float(p, "roughness");
	if (f->roughness < 0) {
		pov_fail_at(p, &at, "roughness is %g, but cannot be negative", f->roughness);
	} else if (f->roughness == 0) {
		pov_warn(p, &at, "roughness 0 gives a highlight without end, as in POV-Ray; 0.001 is very "
			 "smooth");
		f->roughness = 1e300; /* so that the exponent 1 / roughness vanishes, as there */
	}
}

static void read_exponent(struct pov *p, struct finish *f)
{
	pov_next(p);
	f->reflection_exponent = pov_positive(p, "reflection's exponent");
}

static bool read_mirror_word(struct pov *p, struct finish *f, bool two)
{
	switch (pov_token(p)) {
	case TOK_FRESNEL:
		pov_next(p);
		f->reflection_fresnel = pov_bool(p, true);
		/* One colour is the maximum then; as both it would leave Fresnel's law no effect. */
		if (!two && f->reflection_fresnel)
			f->reflection_min = rgb_make(0, 0, 0);
		return true;
	case TOK_FALLOFF:
		pov_next(p);
		f->reflection_falloff = pov_finite_float(p, "reflection's falloff");
		return true;
	case TOK_EXPONENT:
		read_exponent(p, f);
		return true;
	case TOK_METALLIC:
		pov_next(p);
		f->reflection_metallic =
			pov_starts_number(p) ? pov_finite_float(p, "reflection's metallic") : 1;
		return true;
	default:
		return false;
	}
}

static void read_reflection(struct pov *p, struct finish *f)
{
	bool two = false;

	pov_next(p);
	if (pov_token(p) != TOK_LEFT_BRACE) {
		f->reflection_max = rgbft_rgb(pov_finite_colour(p, "reflection"));
		f->reflection_min = f->reflection_max;
		f->reflection_falloff = 1;
		f->reflection_fresnel = false;
		return;
	}
	pov_next(p);
	pov_nest(p);
	f->reflection_min = rgbft_rgb(pov_finite_colour(p, "reflection"));
	f->reflection_max = f->reflection_min;
	pov_comma(p);
	if (pov_starts_colour(p)) {
		f->reflection_max = rgbft_rgb(pov_finite_colour(p, "reflection"));
		two = true;
	}
	while (!pov_failed(p) && read_mirror_word(p, f, two))
		;
	pov_close(p, "reflection");
}

static bool read_irid_word(struct pov *p, struct finish *f)
{
	enum pov_token_kind t = pov_token(p);

	if (t != TOK_THICKNESS && t != TOK_TURBULENCE)
		return false;
	pov_next(p);
	if (t == TOK_THICKNESS)
		f->irid_thickness = pov_finite_float(p, "thickness");
	else
		f->irid_turbulence = pov_finite_float(p, "turbulence");
	return true;
}

static void read_irid(struct pov *p, struct finish *f)
{
	if (!pov_open(p))
		return;
	f->irid = pov_finite_float(p, "irid");
	while (!pov_failed(p) && read_irid_word(p, f))
		;
	pov_close(p, "irid");
}

/* Words of POV-Ray before 3.1, which belong to the interior since. */
static void read_old_interior(struct pov *p, struct draft *d)
{
	struct pov_lack lack = { 0 };
	bool ior = pov_token(p) == TOK_IOR;
	double x;

	pov_lack_note(p, &lack, ior ? "ior in a finish" : "caustics in a finish",
		      "write it in interior { }");
	pov_next(p);
	x = pov_finite_float(p, "a value of the interior");
	if (x != (ior ? 1 : 0))
		pov_lack_add(&d->f.lack, &lack);
}

/* POV-Ray 3.7 reads anisotropy and takes it for 0. */
static bool read_subsurface_word(struct pov *p, struct draft *d)
{
	enum pov_token_kind t = pov_token(p);
	struct rgb c;

	if (t != TOK_TRANSLUCENCY && t != TOK_ANISOTROPY)
		return false;
	pov_next(p);
	c = rgbft_rgb(pov_finite_colour(p, keyword_text(t)));
	if (t == TOK_TRANSLUCENCY)
		d->f.finish.translucency = c;
	return true;
}

static void read_subsurface(struct pov *p, struct draft *d)
{
	struct rgb *c = &d->f.finish.translucency;
	double least;

	d->f.opaque_at = pov_here(p);
	if (!pov_open(p))
		return;
	while (!pov_failed(p) && read_subsurface_word(p, d))
		;
	pov_close(p, "subsurface");
	d->f.finish.subsurface = rgb_max(*c) > 0;
	least = rgb_max(*c) * DARKEST;
	d->f.opaque = !(c->r > 0 && c->g > 0 && c->b > 0);
	if (d->f.opaque && d->f.finish.subsurface)
		*c = rgb_make(fmax(c->r, least), fmax(c->g, least), fmax(c->b, least));
}

static bool read_light_word(struct pov *p, struct draft *d)
{
	struct finish *f = &d->f.finish;

	switch (pov_token(p)) {
	case TOK_AMBIENT:
		pov_next(p);
		f->ambient = rgbft_rgb(pov_finite_colour(p, "ambient"));
		return true;
	case TOK_EMISSION:
		pov_next(p);
		f->emission = rgbft_rgb(pov_finite_colour(p, "emission"));
		return true;
	case TOK_DIFFUSE:
		read_diffuse(p, d);
		return true;
	case TOK_BRILLIANCE:
		pov_next(p);
		f->brilliance = pov_finite_float(p, "brilliance");
		return true;
	case TOK_PHONG:
		f->phong = read_amount(p, &d->phong_albedo);
		return true;
	case TOK_PHONG_SIZE:
		pov_next(p);
		f->phong_size = pov_finite_float(p, "phong_size");
		return true;
	case TOK_SPECULAR:
		f->specular = read_amount(p, &d->specular_albedo);
		return true;
	case TOK_ROUGHNESS:
		read_roughness(p, f);
		return true;
	case TOK_METALLIC:
		pov_next(p);
		f->metallic = pov_starts_number(p) ? pov_finite_float(p, "metallic") : 1;
		return true;
	default:
		return false;
	}
}

static bool read_other_word(struct pov *p, struct draft *d)
{
	switch (pov_token(p)) {
	case TOK_REFLECTION:
		read_reflection(p, &d->f.finish);
		return true;
	case TOK_REFLECTION_EXPONENT:
		read_exponent(p, &d->f.finish);
		return true;
	case TOK_CONSERVE_ENERGY:
		pov_next(p);
		d->f.finish.conserve_energy = pov_bool(p, true);
		return true;
	case TOK_CRAND:
		pov_next(p);
		d->f.finish.crand = pov_finite_float(p, "crand");
		return true;
	case TOK_IRID:
		read_irid(p, &d->f.finish);
		return true;
	case TOK_IOR:
	case TOK_CAUSTICS:
		read_old_interior(p, d);
		return true;
	case TOK_REFRACTION:
		pov_next(p);
		pov_float(p);
		return true;
	case TOK_SUBSURFACE:
		read_subsurface(p, d);
		return true;
	default:
		return false;
	}
}

/* A value of 1 then means that all incoming light leaves again (manual 3.4.6.3.2). */
static void apply_albedo(struct draft *d)
{
	struct finish *f = &d->f.finish;
	double e;

	f->indirect = f->diffuse;
	f->indirect_back = f->diffuse_back;
	if (d->diffuse_albedo) {
		f->diffuse *= (f->brilliance + 1) / 2;
		f->diffuse_back *= (f->brilliance + 1) / 2;
	}
	if (d->phong_albedo)
		f->phong *= (f->phong_size + 1) / 2;
	if (d->specular_albedo) {
		e = 1 / f->roughness;
		f->specular *= (e + 2) / (4 * (2 - pow(2, -e / 2)));
	}
}

struct pov_finish *pov_read_finish(struct pov *p, const struct pov_finish *base)
{
	struct draft d = { .f = *base };
	struct pov_finish *named;

	if (!pov_open(p))
		return NULL;
	named = pov_take(p, ITEM_FINISH);
	if (named)
		d.f = *named;
	while (!pov_failed(p) && (read_light_word(p, &d) || read_other_word(p, &d)))
		;
	apply_albedo(&d);
	return pov_close(p, "finish") ? pov_copy(p, &d.f, sizeof(d.f)) : NULL;
}
