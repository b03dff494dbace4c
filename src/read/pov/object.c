/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Objects (manual 3.4.5): shapes, unions, declared objects, and what modifies them.
 */
#include <config.h>

#include "read/pov/items.h"

#include <string.h>



struct pov_object *pov_object_new(struct pov *p, enum shape_kind kind, const struct diag_pos *at)
{
	struct pov_object *o = pov_state(p)->spare;

	if (o)
		memset(o, 0, sizeof(*o));
	else
		o = pov_new(p, sizeof(*o));
	pov_state(p)->spare = NULL;
	if (!o)
		return NULL;
	o->weight = 1;
	o->object.kind = kind;
	o->object.place = o->texture_place = o->interior_texture_place = xform_identity;
	o->interior_place = xform_identity;
	o->object.texture = o->object.interior_texture = o->object.interior = SCENE_NONE;
	o->object.first_child = o->object.next_sibling = SCENE_NONE;
	o->object.pos = *at;
	return o;
}

static double read_radius(struct pov *p, const char *what)
{
	struct diag_pos at = pov_here(p);
	double r = pov_finite_float(p, what);

	if (r < 0)
		pov_fail_at(p, &at, "%s is %g, but cannot be negative", what, r);
	return r;
}

static void read_sphere(struct pov *p, struct object *o)
{
	o->shape.sphere.centre = pov_finite_vector(p, "the sphere's centre");
	pov_comma(p);
	o->shape.sphere.radius = read_radius(p, "the sphere's radius");
}

static void read_box(struct pov *p, struct object *o)
{
	vec a = pov_finite_vector(p, "the box's first corner"), b;

	pov_comma(p);
	b = pov_finite_vector(p, "the box's second corner");
	o->shape.box.lo = vec_make(fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z));
	o->shape.box.hi = vec_make(fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z));
}

static void finish_cone(struct pov *p, struct object *o, const char *what)
{
	vec axis = vec_sub(o->shape.cone.apex, o->shape.cone.base);

	o->shape.cone.open = pov_accept(p, TOK_OPEN);
	if (pov_failed(p))
		return;
	if (!(vec_length(axis) > 0))
		pov_fail_at(p, &o->pos, "the %s has both its ends at one point", what);
}

static void read_cylinder(struct pov *p, struct object *o)
{
	o->shape.cone.base = pov_finite_vector(p, "the cylinder's first end");
	pov_comma(p);
	o->shape.cone.apex = pov_finite_vector(p, "the cylinder's second end");
	pov_comma(p);
	o->shape.cone.base_radius = read_radius(p, "the cylinder's radius");
	o->shape.cone.apex_radius = o->shape.cone.base_radius;
	finish_cone(p, o, "cylinder");
}

static void read_cone(struct pov *p, struct object *o)
{
	o->shape.cone.base = pov_finite_vector(p, "the cone's first end");
	pov_comma(p);
	o->shape.cone.base_radius = read_radius(p, "the cone's first radius");
	pov_comma(p);
	o->shape.cone.apex = pov_finite_vector(p, "the cone's second end");
	pov_comma(p);
	o->shape.cone.apex_radius = read_radius(p, "the cone's second radius");
	finish_cone(p, o, "cone");
}

static void read_plane(struct pov *p, struct object *o)
{
	struct diag_pos at = pov_here(p);
	vec n = pov_finite_vector(p, "the plane's normal");
	double length = vec_length(n);

	if (!pov_failed(p) && (!(length > 0) || !isfinite(length))) {
		pov_fail_at(p, &at, "the plane's normal has no direction");
		return;
	}
	pov_comma(p);
	o->shape.plane.normal = vec_scale(n, 1 / length);
	/* The distance is along the unit normal, however long the given one is. */
	o->shape.plane.distance = pov_finite_float(p, "the plane's distance");
}

static void read_disc(struct pov *p, struct object *o)
{
	struct diag_pos at;
	vec n;

	o->shape.disc.centre = pov_finite_vector(p, "the disc's centre");
	pov_comma(p);
	at = pov_here(p);
	n = pov_finite_vector(p, "the disc's normal");
	if (!pov_failed(p) && !(vec_length(n) > 0 && isfinite(vec_length(n)))) {
		pov_fail_at(p, &at, "the disc's normal has no direction");
		return;
	}
	o->shape.disc.normal = vec_scale(n, 1 / vec_length(n));
	pov_comma(p);
	o->shape.disc.radius = read_radius(p, "the disc's radius");
	pov_comma(p);
	if (pov_starts_number(p))
		o->shape.disc.hole = read_radius(p, "the disc's hole");
}

static void read_torus(struct pov *p, struct object *o)
{
	o->shape.torus.major = read_radius(p, "the torus's major radius");
	pov_comma(p);
	o->shape.torus.minor = read_radius(p, "the torus's minor radius");
}

static void read_superellipsoid(struct pov *p, struct object *o)
{
	struct diag_pos at = pov_here(p);

	pov_vector2(p, &o->shape.superellipsoid.a, &o->shape.superellipsoid.b);
	if (!pov_failed(p) && !(o->shape.superellipsoid.a > 0 && o->shape.superellipsoid.b > 0 &&
				isfinite(o->shape.superellipsoid.a) && isfinite(o->shape.superellipsoid.b)))
		pov_fail_at(p, &at, "the superellipsoid's exponents have to be greater than 0");
}

/* Shapes whose numbers are read here, and those that are only known by name. */
static const struct shape_word {
	enum pov_token_kind token;
	enum shape_kind kind;
	void (*read)(struct pov *, struct object *); /* NULL: not rendered */
} shape_word[] = {
	{ TOK_SPHERE, SHAPE_SPHERE, read_sphere },
	{ TOK_BOX, SHAPE_BOX, read_box },
	{ TOK_CYLINDER, SHAPE_CONE, read_cylinder },
	{ TOK_CONE, SHAPE_CONE, read_cone },
	{ TOK_PLANE, SHAPE_PLANE, read_plane },
	{ TOK_DISC, SHAPE_DISC, read_disc },
	{ TOK_TORUS, SHAPE_TORUS, read_torus },
	{ TOK_SUPERELLIPSOID, SHAPE_SUPERELLIPSOID, read_superellipsoid },
	{ TOK_LATHE, SHAPE_LATHE, pov_read_lathe },
	{ TOK_PRISM, SHAPE_PRISM, pov_read_prism },
	{ TOK_ISOSURFACE, SHAPE_ISOSURFACE, pov_read_isosurface },
	{ TOK_SPHERE_SWEEP, SHAPE_SWEEP, pov_read_sweep },
	{ TOK_QUADRIC, SHAPE_ALGEBRAIC, pov_read_quadric },
	{ TOK_CUBIC, SHAPE_ALGEBRAIC, pov_read_cubic },
	{ TOK_QUARTIC, SHAPE_ALGEBRAIC, pov_read_quartic },
	{ TOK_POLY, SHAPE_ALGEBRAIC, pov_read_poly },
	{ TOK_POLYNOMIAL, SHAPE_ALGEBRAIC, pov_read_polynomial },
	{ TOK_BICUBIC_PATCH, SHAPE_UNION, NULL },
	{ TOK_JULIA_FRACTAL, SHAPE_UNION, NULL },
	{ TOK_OVUS, SHAPE_UNION, NULL },
	{ TOK_PARAMETRIC, SHAPE_UNION, NULL },
	{ TOK_POLYGON, SHAPE_UNION, NULL },
	{ TOK_SOR, SHAPE_UNION, NULL },
	{ TOK_TEXT, SHAPE_UNION, NULL },
};

static const struct shape_word *find_shape(enum pov_token_kind t)
{
	for (size_t i = 0; i < sizeof(shape_word) / sizeof(shape_word[0]); i++) {
		if (shape_word[i].token == t)
			return &shape_word[i];
	}
	return NULL;
}

bool pov_starts_object(struct pov *p)
{
	switch (pov_token(p)) {
	case TOK_OBJECT:
	case TOK_UNION:
	case TOK_COMPOSITE:
	case TOK_MERGE:
	case TOK_INTERSECTION:
	case TOK_DIFFERENCE:
	case TOK_BLOB:
	case TOK_MESH:
	case TOK_MESH2:
	case TOK_HEIGHT_FIELD:
	case TOK_TRIANGLE:
	case TOK_SMOOTH_TRIANGLE:
	case TOK_LIGHT_SOURCE:
	case TOK_LIGHT_GROUP:
		return true;
	case TOK_IDENT:
		return pov_ident_kind(p) == ITEM_OBJECT;
	default:
		return find_shape(pov_token(p)) != NULL;
	}
}

/* On or off; what was not given is the parent's, or off. */
static void set_flag(struct pov_object *o, unsigned flag, bool on)
{
	o->given |= flag;
	o->object.flags = on ? o->object.flags | flag : o->object.flags & ~flag;
}

static bool read_flag(struct pov *p, struct pov_object *o)
{
	unsigned flag;

	switch (pov_token(p)) {
	case TOK_NO_SHADOW:
		flag = OBJECT_NO_SHADOW;
		break;
	case TOK_NO_IMAGE:
		flag = OBJECT_NO_IMAGE;
		break;
	case TOK_NO_REFLECTION:
		flag = OBJECT_NO_REFLECTION;
		break;
	case TOK_NO_RADIOSITY:
		flag = OBJECT_NO_RADIOSITY;
		break;
	case TOK_HOLLOW:
		flag = OBJECT_HOLLOW;
		break;
	case TOK_DOUBLE_ILLUMINATE:
		flag = OBJECT_DOUBLE_ILLUMINATE;
		break;
	default:
		return false;
	}
	pov_next(p);
	set_flag(o, flag, pov_bool(p, true));
	return true;
}

static void invert(struct pov_object *o)
{
	o->object.flags ^= OBJECT_INVERSE;
	if (!o->light && !o->lack.construct)
		o->object.kind = shape_inverse(o->object.kind);
}

static bool read_clip(struct pov *p, struct pov_object *o)
{
	if (!pov_open(p))
		return false;
	if (pov_token(p) == TOK_BOUNDED_BY) {
		pov_lack_note(p, &o->lack, "clipped_by { bounded_by }", "give clipped_by its own objects");
		pov_next(p);
	}
	while (!pov_failed(p) && pov_starts_object(p)) {
		struct pov_child *c = pov_new(p, sizeof(*c));

		if (!c)
			return false;
		c->object = pov_read_object(p);
		c->next = o->clip;
		c->before = o->object.place;
		o->clip = c;
		if (!c->object)
			return false;
		o->weight += c->object->weight < UINT64_MAX / 4 ? c->object->weight : 0;
	}
	return pov_close(p, "clipped_by");
}

/* Words that change nothing that we draw. */
static bool read_ignored(struct pov *p, struct pov_object *o)
{
	enum pov_token_kind t = pov_token(p);

	switch (t) {
	case TOK_STURM:
	case TOK_HIERARCHY:
	case TOK_SPLIT_UNION:
		pov_next(p);
		pov_bool(p, true);
		return true;
	case TOK_UV_MAPPING:
		if (o->texture)
			pov_fail(p, "uv_mapping has to come before the object's texture");
		o->uv = true;
		pov_next(p);
		return true;
	case TOK_CUTAWAY_TEXTURES:
		pov_lack_note(p, &o->lack, "cutaway_textures", "give the cutting objects textures");
		pov_next(p);
		return true;
	case TOK_RADIOSITY:
		pov_read_importance(p);
		return true;
	case TOK_BOUNDED_BY:
		break;
	case TOK_PHOTONS:
		if (!pov_state(p)->object_photons.construct)
			pov_lack_note(p, &pov_state(p)->object_photons, "photons", NULL);
		break;
	case TOK_CLIPPED_BY:
		return read_clip(p, o);
	default:
		if (pov_starts_colour(p) && t != TOK_IDENT && t != TOK_NUMBER) {
			pov_warn(p, NULL, "a colour belongs into pigment { }; it is not used here");
			pov_finite_colour(p, "the colour");
			return true;
		}
		return false;
	}
	pov_next(p);
	if (pov_token(p) != TOK_LEFT_BRACE) {
		pov_expect(p, TOK_LEFT_BRACE, keyword_text(t));
		return false;
	}
	pov_skip_block(p);
	return true;
}

/* What is read now stands in other coordinates than the texture so far, if there were transforms between. */
static void settle_texture(struct pov *p, struct pov_object *o)
{
	if (!mat_is_identity(&o->texture_place.fwd)) {
		o->texture = pov_texture_transform(p, o->texture, &o->texture_place);
		o->texture_place = xform_identity;
	}
	if (!mat_is_identity(&o->interior_texture_place.fwd)) {
		o->interior_texture =
			pov_texture_transform(p, o->interior_texture, &o->interior_texture_place);
		o->interior_texture_place = xform_identity;
	}
}

void pov_object_move(struct pov_object *o, const struct xform *x)
{
	o->object.place = xform_mul(&o->object.place, x);
	if (o->texture)
		o->texture_place = xform_mul(&o->texture_place, x);
	if (o->interior)
		o->interior_place = xform_mul(&o->interior_place, x);
	if (o->interior_texture)
		o->interior_texture_place = xform_mul(&o->interior_texture_place, x);
}

static bool read_transform(struct pov *p, struct pov_object *o)
{
	struct xform x = xform_identity;

	if (!pov_transform(p, &x))
		return false;
	pov_object_move(o, &x);
	return true;
}

static bool read_look(struct pov *p, struct pov_object *o)
{
	struct pov_material m = { o->texture, o->interior_texture, o->interior };
	struct pov_texture *t;

	switch (pov_token(p)) {
	case TOK_TEXTURE:
	case TOK_INTERIOR_TEXTURE:
	case TOK_PIGMENT:
	case TOK_NORMAL:
	case TOK_FINISH:
	case TOK_MATERIAL:
		settle_texture(p, o);
		break;
	default:
		break;
	}
	m.texture = o->texture;
	m.interior_texture = o->interior_texture;
	switch (pov_token(p)) {
	case TOK_TEXTURE:
		t = pov_read_texture(p);
		o->texture = pov_texture_over(p, t, o->texture);
		return true;
	case TOK_INTERIOR_TEXTURE:
		t = pov_read_texture(p);
		o->interior_texture = pov_texture_over(p, t, o->interior_texture);
		return true;
	case TOK_PIGMENT:
	case TOK_NORMAL:
	case TOK_FINISH:
		return pov_texture_part(p, &o->texture);
	case TOK_INTERIOR:
		o->interior = pov_read_interior(p, o->interior);
		o->interior_place = xform_identity;
		return true;
	case TOK_MATERIAL:
		if (!pov_read_material(p, &m))
			return false;
		o->texture = m.texture;
		o->interior_texture = m.interior_texture;
		o->interior = m.interior;
		return true;
	default:
		return false;
	}
}

void pov_object_modifiers(struct pov *p, struct pov_object *o)
{
	while (!pov_failed(p)) {
		if (pov_accept(p, TOK_INVERSE))
			invert(o);
		else if (!read_transform(p, o) && !read_look(p, o) && !read_flag(p, o) &&
			 !read_ignored(p, o))
			return;
	}
}

bool pov_object_add(struct pov *p, struct pov_object *o, struct pov_object *child)
{
	struct pov_child *c = pov_new(p, sizeof(*c));

	if (!c)
		return false;
	c->object = child;
	if (o->last)
		o->last->next = c;
	else
		o->first = c;
	o->last = c;
	/* Unions of unions double: the count is kept from running over, and is refused when used. */
	o->weight = o->weight + child->weight < UINT64_MAX / 4 ? o->weight + child->weight : UINT64_MAX / 4;
	if (o->depth <= child->depth)
		o->depth = child->depth + 1;
	if (o->depth > 1000) {
		pov_fail_at(p, &o->object.pos, "unions stand in unions more than 1000 deep");
		return false;
	}
	return true;
}

/* A difference is the first object without what lies in the others: with their inverses. */
static struct pov_object *read_children(struct pov *p, struct pov_object *o, enum pov_token_kind t)
{
	bool first = true;

	o->object.kind = t == TOK_MERGE						      ? SHAPE_MERGE :
			 t == TOK_INTERSECTION || t == TOK_DIFFERENCE ? SHAPE_INTERSECTION :
									SHAPE_UNION;
	while (!pov_failed(p) && pov_starts_object(p)) {
		struct pov_object *child = pov_read_object(p);

		if (child && t == TOK_DIFFERENCE && !first) {
			child = pov_copy(p, child, sizeof(*child));
			if (child)
				invert(child);
		}
		if (!child || !pov_object_add(p, o, child))
			return NULL;
		first = first && child->light;
	}
	return o;
}

/* A block that we cannot read any further: what follows in it is passed over. */
static struct pov_object *read_unknown(struct pov *p, struct pov_object *o, const char *word)
{
	pov_lack_note(p, &o->lack, word, "convert the object to a mesh");
	o->lack.pos = o->object.pos;
	pov_skip_rest(p);
	return pov_close(p, word) ? o : NULL;
}

/* The inside of the braces, up to the modifiers. */
static struct pov_object *read_body(struct pov *p, struct pov_object *o, enum pov_token_kind t)
{
	const struct diag_pos *at = &o->object.pos;
	const struct shape_word *s = find_shape(t);

	switch (t) {
	case TOK_OBJECT:
		if (!pov_starts_object(p)) {
			pov_fail(p, "an object is expected in object { ... }, not %s", pov_text(p));
			return NULL;
		}
		return pov_read_object(p);
	case TOK_UNION:
	case TOK_COMPOSITE:
	case TOK_MERGE:
	case TOK_INTERSECTION:
	case TOK_DIFFERENCE:
		return read_children(p, o, t);
	case TOK_BLOB:
		return pov_read_blob(p, o);
	case TOK_MESH:
		return pov_read_mesh(p, at);
	case TOK_MESH2:
		return pov_read_mesh2(p, at);
	case TOK_HEIGHT_FIELD:
		return pov_read_height_field(p, at);
	case TOK_TRIANGLE:
	case TOK_SMOOTH_TRIANGLE:
		return pov_read_triangle(p, at, t == TOK_SMOOTH_TRIANGLE);
	default:
		o->object.kind = s->kind;
		s->read(p, &o->object);
		return o;
	}
}

/* A union with lights of its own. POV-Ray lets it have no other modifiers. */
static struct pov_object *read_group(struct pov *p, struct diag_pos at)
{
	struct pov_object *o = pov_object_new(p, SHAPE_UNION, &at);

	if (!o || !pov_open(p) || !read_children(p, o, TOK_UNION))
		return NULL;
	o->group = true;
	while (!pov_failed(p)) {
		if (pov_accept(p, TOK_GLOBAL_LIGHTS))
			o->global_lights = pov_bool(p, true);
		else if (!read_transform(p, o) && (pov_token(p) != TOK_PHOTONS || !read_ignored(p, o)))
			break;
	}
	return pov_close(p, "light_group") ? o : NULL;
}

/* Objects in an object are copied before they are changed: others may use the same one. */
static struct pov_object *read_block(struct pov *p, enum pov_token_kind t, struct diag_pos at)
{
	const struct shape_word *s = find_shape(t);
	struct pov_object *o = pov_object_new(p, SHAPE_UNION, &at), *named;

	if (!o || !pov_open(p))
		return NULL;
	named = pov_take(p, ITEM_OBJECT);
	if (named) {
		*o = *named;
		o->object.pos = at;
	} else if (s && !s->read) {
		return read_unknown(p, o, keyword_text(t));
	} else {
		o = read_body(p, o, t);
		if (!o || pov_failed(p))
			return NULL;
		o->object.pos = at;
	}
	pov_object_modifiers(p, o);
	return pov_close(p, keyword_text(t)) ? o : NULL;
}

struct pov_object *pov_read_object(struct pov *p)
{
	struct diag_pos at = pov_here(p);
	enum pov_token_kind t = pov_token(p);

	if (t == TOK_IDENT)
		return pov_take(p, ITEM_OBJECT);
	if (t == TOK_LIGHT_SOURCE)
		return pov_read_light(p);
	if (t == TOK_LIGHT_GROUP)
		return read_group(p, at);
	return read_block(p, t, at);
}
