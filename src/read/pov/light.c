/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Light sources (manual 3.4.4.1): point, spot, cylinder, parallel and area lights.
 */
#include <config.h>

#include "read/pov/items.h"

/* point_at and the transforms may come in any order, and each transform acts on what was read so far. */
struct draft {
	struct light light;
	vec point_at;
	struct pov_object *like; /* looks_like: a union that the light moves, or NULL */
	struct pov_object *through; /* projected_through: the same */
	struct pov_lack lack;
};

static void transform_light(struct light *l, const struct mat *m)
{
	l->location = mat_point(m, l->location);
	l->axis1 = mat_dir(m, l->axis1);
	l->axis2 = mat_dir(m, l->axis2);
}

static void read_area(struct pov *p, struct draft *d)
{
	struct light *l = &d->light;

	pov_next(p);
	l->area = true;
	l->axis1 = pov_finite_vector(p, "area_light's first axis");
	pov_comma(p);
	l->axis2 = pov_finite_vector(p, "area_light's second axis");
	pov_comma(p);
	l->size1 = pov_count(p, "points along area_light's first axis", 1, 65536);
	pov_comma(p);
	l->size2 = pov_count(p, "points along area_light's second axis", 1, 65536);
}

static void need_cone(struct pov *p, const struct draft *d, const char *word)
{
	if (d->light.kind == LIGHT_POINT)
		pov_fail(p, "%s is for a spotlight or cylinder light; write spotlight before it", word);
}

/* spotlight, cylinder and shadowless exclude each other: POV-Ray takes the last one given. */
static bool read_kind(struct pov *p, struct draft *d)
{
	struct light *l = &d->light;

	switch (pov_token(p)) {
	case TOK_SPOTLIGHT:
		l->kind = LIGHT_SPOT;
		l->shadowless = false;
		l->radius = 30;
		l->falloff = 45;
		l->tightness = 0;
		break;
	case TOK_CYLINDER:
		l->kind = LIGHT_CYLINDER;
		l->shadowless = false;
		l->parallel = true;
		l->radius = 0.75;
		l->falloff = 1;
		l->tightness = 0;
		break;
	case TOK_SHADOWLESS:
		l->kind = LIGHT_POINT;
		l->shadowless = true;
		break;
	case TOK_PARALLEL:
		l->parallel = true;
		break;
	default:
		return false;
	}
	pov_next(p);
	return true;
}

static bool read_cone(struct pov *p, struct draft *d)
{
	enum pov_token_kind t = pov_token(p);
	double *to = t == TOK_RADIUS ? &d->light.radius :
		     t == TOK_FALLOFF ? &d->light.falloff :
		     t == TOK_TIGHTNESS ? &d->light.tightness : NULL;

	if (t == TOK_POINT_AT) {
		if (d->light.kind == LIGHT_POINT && !d->light.parallel && !d->light.shadowless)
			pov_fail(p, "point_at is for a spotlight, cylinder or parallel light; write that "
				 "word before it");
		pov_next(p);
		d->point_at = pov_finite_vector(p, "point_at");
		return true;
	}
	if (!to)
		return false;
	if (!d->light.shadowless)
		need_cone(p, d, keyword_text(t));
	pov_next(p);
	*to = pov_finite_float(p, keyword_text(t));
	return true;
}

static bool read_area_word(struct pov *p, struct draft *d)
{
	struct light *l = &d->light;
	struct diag_pos at;
	double x;

	switch (pov_token(p)) {
	case TOK_AREA_LIGHT:
		read_area(p, d);
		return true;
	case TOK_JITTER:
		l->jitter = true;
		break;
	case TOK_ORIENT:
		l->orient = true;
		break;
	case TOK_CIRCULAR:
		l->circular = true;
		break;
	case TOK_AREA_ILLUMINATION:
		pov_next(p);
		l->area_illumination = pov_bool(p, true);
		return true;
	case TOK_ADAPTIVE:
		pov_next(p);
		at = pov_here(p);
		x = pov_finite_float(p, "adaptive");
		if (x < 0 || x > 100)
			pov_fail_at(p, &at, "adaptive is %g, but has to be from 0 to 100", x);
		else
			l->adaptive = (uint32_t)x;
		return true;
	default:
		return false;
	}
	pov_next(p);
	return true;
}

/* A block with an object and its modifiers, in a union that the light moves. at: where the object starts from. */
static struct pov_object *read_companion(struct pov *p, const char *what, vec at, unsigned flag)
{
	struct diag_pos pos = pov_here(p);
	struct pov_object *child, *wrap;
	struct xform start = xform_translate(at);

	if (!pov_open(p))
		return NULL;
	child = pov_starts_object(p) ? pov_read_object(p) : NULL;
	if (!child && !pov_failed(p))
		pov_fail(p, "%s needs an object, not %s", what, pov_text(p));
	if (child)
		child = pov_copy(p, child, sizeof(*child)); /* others may use the same one */
	if (!child)
		return NULL;
	pov_object_move(child, &start);
	pov_object_modifiers(p, child);
	wrap = pov_close(p, what) ? pov_object_new(p, SHAPE_UNION, &pos) : NULL;
	if (!wrap || !pov_object_add(p, wrap, child))
		return NULL;
	wrap->object.flags = wrap->given = flag;
	return wrap;
}

/* It stands in the scene's coordinates, and transforms after it move it with the light. */
static void read_through(struct pov *p, struct draft *d)
{
	if (d->through) {
		pov_fail(p, "a light can be projected_through one object only; make a union of them");
		return;
	}
	d->through = read_companion(p, "projected_through", vec_make(0, 0, 0), OBJECT_PROJECTED);
}

/* What does nothing without media or photons, and what stands beside the light. */
static bool read_rest(struct pov *p, struct draft *d)
{
	switch (pov_token(p)) {
	case TOK_FADE_DISTANCE:
		pov_next(p);
		d->light.fade_distance = pov_finite_float(p, "fade_distance");
		return true;
	case TOK_FADE_POWER:
		pov_next(p);
		d->light.fade_power = pov_finite_float(p, "fade_power");
		return true;
	case TOK_MEDIA_ATTENUATION:
		pov_next(p);
		d->light.attenuated = pov_bool(p, true);
		return true;
	case TOK_MEDIA_INTERACTION:
		pov_next(p);
		d->light.no_media = !pov_bool(p, true);
		return true;
	case TOK_PHOTONS:
		break;
	case TOK_LOOKS_LIKE:
		d->like = read_companion(p, "looks_like", d->light.location, OBJECT_NO_SHADOW);
		return true;
	case TOK_PROJECTED_THROUGH:
		read_through(p, d);
		return true;
	default:
		return false;
	}
	pov_next(p);
	pov_skip_block(p);
	return true;
}

static bool read_modifier(struct pov *p, struct draft *d)
{
	struct xform x = xform_identity;

	if (pov_transform(p, &x)) {
		transform_light(&d->light, &x.fwd);
		d->point_at = mat_point(&x.fwd, d->point_at);
		if (d->like)
			d->like->object.place = xform_mul(&d->like->object.place, &x);
		if (d->through)
			d->through->object.place = xform_mul(&d->through->object.place, &x);
		return true;
	}
	return read_kind(p, d) || read_cone(p, d) || read_area_word(p, d) || read_rest(p, d);
}

/* POV-Ray makes lights with orient circular, where they have the points for it. */
static void make_circular(struct pov *p, struct light *l)
{
	l->circular = l->area && l->size1 > 1 && l->size2 > 1;
	if (l->circular)
		pov_warn(p, &l->pos, "orient makes the area light circular, as in POV-Ray; add circular");
}

static void check_light(struct pov *p, struct draft *d)
{
	struct light *l = &d->light;

	l->direction = vec_sub(d->point_at, l->location);
	l->axis_length = vec_length(l->direction);
	if (l->axis_length > 0)
		l->direction = vec_scale(l->direction, 1 / l->axis_length);
	else if (l->kind != LIGHT_POINT || l->parallel)
		pov_fail_at(p, &l->pos, "the light's point_at is its location; move one of them");
	if (l->circular && (!l->area || l->size1 < 2 || l->size2 < 2))
		pov_fail_at(p, &l->pos, "a circular area_light needs at least 2 x 2 points");
	if (l->orient && !l->circular)
		make_circular(p, l);
	if (l->kind == LIGHT_CYLINDER && l->falloff < 0)
		pov_fail_at(p, &l->pos, "the light's falloff is negative");
	if (!vec_finite(l->location) || !vec_finite(l->direction) || !vec_finite(l->axis1) ||
	    !vec_finite(l->axis2))
		pov_fail_at(p, &l->pos, "the light's vectors are too large");
}

/* A light and what it looks like, as one thing. */
static struct pov_object *beside(struct pov *p, struct pov_object *light, struct pov_object *like)
{
	struct pov_object *both = pov_object_new(p, SHAPE_UNION, &light->object.pos);

	if (!both || !pov_object_add(p, both, light) || !pov_object_add(p, both, like))
		return NULL;
	both->lamp = true;
	return both;
}

struct pov_object *pov_read_light(struct pov *p)
{
	struct draft d = { .point_at = { 0, 0, 1 } };
	struct pov_object *o;

	d.light = (struct light){ .kind = LIGHT_POINT,
				  .adaptive = LIGHT_NOT_ADAPTIVE,
				  .size1 = 1,
				  .size2 = 1,
				  .axis1 = { 0, 0, 1 },
				  .axis2 = { 0, 1, 0 },
				  .pos = pov_here(p) };
	o = pov_object_new(p, SHAPE_UNION, &d.light.pos);
	if (!o || !pov_open(p))
		return NULL;
	if (pov_token(p) == TOK_IDENT && pov_ident_kind(p) == ITEM_OBJECT) {
		*o = *(struct pov_object *)pov_ident_item(p);
		pov_next(p);
		while (!pov_failed(p) && pov_transform(p, &o->object.place))
			;
		return pov_close(p, "light_source") ? o : NULL;
	}
	d.light.location = pov_finite_vector(p, "the light's location");
	pov_comma(p);
	d.light.colour = rgbft_rgb(pov_finite_colour(p, "the light's colour"));
	while (!pov_failed(p) && read_modifier(p, &d))
		;
	if (!pov_failed(p))
		check_light(p, &d);
	o->light = pov_copy(p, &d.light, sizeof(d.light));
	o->lack = d.lack;
	o->through = d.through;
	if (o->through)
		o->weight += o->through->weight;
	if (!o->light || !pov_close(p, "light_source"))
		return NULL;
	return d.like ? beside(p, o, d.like) : o;
}
