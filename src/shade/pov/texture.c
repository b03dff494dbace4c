/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * From a hit to its textures: the layers that light falls on, what they let through and what they
 * mirror (manual 3.4.6, 3.4.6.9 for layers; weights as max_trace_level and adc_bailout want them,
 * 3.4.1).
 */
#include "shade/indirect.h"
#include "shade/pov/finish.h"
#include "shade/pov/interior.h"
#include "shade/pov/point.h"
#include "shade/pov/subsurface.h"
#include "shade/shade.h"

/* How much of its own light a layer shows. Before 3.7 POV-Ray weighed filter by the colour. */
static double opacity(const struct scene *s, const struct rgbft *c)
{
	if (s->version < 370)
		return 1 - (c->filter * rgb_max(rgbft_rgb(*c)) + c->transmit);
	return 1 - c->filter - c->transmit;
}

static double clearness(struct rgb filter)
{
	double c = fabs(rgb_grey(filter));

	return c < 1 ? c : 1;
}

/* The light a layer has without lamps. */
static struct rgb glow(const struct shader *sh, const struct finish *f, struct rgb pigment)
{
	struct rgb ambient = rgb_mul(f->ambient, sh->scene->ambient_light);

	/* Ambient stood for indirect light; older scenes keep both. */
	if (sh->indirect.method != INDIRECT_OFF && sh->scene->version >= 370)
		ambient = rgb_make(0, 0, 0);
	return rgb_mul(pigment, rgb_add(ambient, f->emission));
}

/* What is needed to look at the texture of a hit. */
struct looking {
	const struct shader *sh;
	struct tree *t;
	const struct met *m;
	const struct node *n;
	const ald_hit *hit;
	bool within; /* a texture that is a pattern of textures */
	vec bent; /* slope and aoi go by the last normal that was bent, be it another layer's: measured */
};

/* A layer as it is at the point. */
struct looked {
	const struct finish *finish;
	struct rgbft colour;
	vec normal;
};

/* A film's factor for what a mirror shows: of the light before the reflection's exponent bends it. */
static struct rgb mirror_irid(const struct looking *l, const struct looked *at)
{
	const struct finish *f = at->finish;
	vec to = vec_mad(l->n->dir, at->normal, -2 * vec_dot(l->n->dir, at->normal));
	struct rgb c = finish_irid(l->sh->scene, f, to, l->n->dir, at->normal, l->m->p);
	double e = 1 / f->reflection_exponent;

	return e == 1 ? c : rgb_make(pow(c.r, e), pow(c.g, e), pow(c.b, e));
}

static void add_mirror(const struct looking *l, struct part *p, const struct looked *at, double weight,
		       struct rgb *reflectivity)
{
	struct tree *t = l->t;
	const struct finish *f = at->finish;
	double cosine = -vec_dot(l->n->dir, at->normal), ior = 1;
	struct rgb strength;
	uint32_t i;

	if (f->reflection_fresnel)
		ior = interior_relative_ior(l->sh->scene, t, l->n->inside, l->m->object, l->m->interior);
	*reflectivity = finish_reflectivity(f, cosine, ior, rgbft_rgb(at->colour));
	if (reflectivity->r == 0 && reflectivity->g == 0 && reflectivity->b == 0)
		return;
	i = tree_push(t, &t->mirror, 1);
	if (i == TREE_NONE)
		return;
	strength = *reflectivity;
	if (f->irid > 0)
		strength = rgb_mul(strength, mirror_irid(l, at));
	*BUF_AT(&t->mirror, struct mirror, i) =
		(struct mirror){ .reflectivity = strength,
				 .exponent = 1 / f->reflection_exponent,
				 .weight = weight * finish_mirror_weight(f, cosine, ior),
				 .normal = at->normal,
				 .child = TREE_NONE };
	p->mirror_count++;
}

static void add_layer(struct tree *t, struct part *p, uint32_t part, const struct looked *at, double opaque,
		      bool beneath)
{
	uint32_t i;

	if (!finish_needs_light(at->finish, beneath))
		return;
	i = tree_push(t, &t->layer, 1);
	if (i == TREE_NONE)
		return;
	*BUF_AT(&t->layer, struct lit_layer, i) = (struct lit_layer){ .finish = at->finish,
								     .pigment = rgbft_rgb(at->colour),
								     .filter = p->filter,
								     .opacity = opaque,
								     .normal = at->normal,
								     .part = part,
								     .beneath = beneath };
	p->layer_count++;
}

/* A layer that light goes below. Gathered rays see it only if the radiosity block wants it. True: its indirect
 * light goes below too, and with it that of the layers under it. */
static bool add_beneath(const struct looking *l, const struct part *p, uint32_t part, const struct looked *at)
{
	const struct scene *s = l->sh->scene;
	uint32_t i;

	if (l->n->bounce && !s->radiosity.subsurface)
		return false;
	if (l->n->beneath < SUBSURFACE_DEEPEST) {
		i = tree_push(l->t, &l->t->beneath, 1);
		if (i == TREE_NONE)
			return false;
		*BUF_AT(&l->t->beneath, struct beneath, i) = (struct beneath){
			.met = *l->m,
			.finish = at->finish,
			.reflectance = rgb_scale(rgbft_rgb(at->colour), at->finish->indirect),
			.filter = p->filter,
			.ior = interior_relative_ior(s, l->t, l->n->inside, l->m->object, l->m->interior),
			.part = part };
	}
	return s->subsurface.radiosity;
}

/* What slope and aoi are told of it stays in the coordinates of the textures around, if a pattern blends or
 * chooses them: measured. */
static vec bend(struct looking *l, const struct normal *normal, const struct pattern_point *at)
{
	vec n = normal_at(l->sh->scene, normal, at, l->m->ns);

	l->bent = l->within && at->place ? vec_unit(mat_normal(&at->place->fwd, n)) : n;
	return n;
}

static struct looked look_at(struct looking *l, const struct texture *tex, uint32_t layer,
			     const struct pattern_point *at)
{
	const struct layer *from = &tex->layer[layer];
	struct looked to = { .finish = &from->finish, .colour = from->pigment.colour, .normal = l->m->ns };

	if (tex->plain)
		return to;
	if (from->normal)
		to.normal = bend(l, from->normal, at);
	if (from->pigment.pattern) {
		struct pattern_point bent = *at;

		bent.n = l->bent;
		to.colour = pigment_at(l->sh->scene, &from->pigment, &bent);
	}
	return to;
}

/* A layer of a part, on top of those that come later. */
static void put_layer(struct looking *l, struct part *p, uint32_t part, const struct looked *one, double share,
		      struct indirect_part *indirect)
{
	const struct finish *f = one->finish;
	double opaque = opacity(l->sh->scene, &one->colour);
	struct rgb pigment = rgbft_rgb(one->colour), reflectivity = { 0, 0, 0 };
	bool mirror = finish_is_mirror(f), beneath = l->sh->subsurface && f->subsurface;

	if (mirror)
		add_mirror(l, p, one, l->n->weight * p->clear, &reflectivity);
	p->own = rgb_add(p->own, rgb_mul(p->filter, rgb_scale(glow(l->sh, f, pigment), opaque)));
	if (l->n->bounce || !l->sh->indirect.filling) /* else nobody looks at it */
		add_layer(l->t, p, part, one, opaque, beneath);
	if (beneath && add_beneath(l, p, part, one))
		indirect->wanted = false;
	if (indirect->wanted)
		indirect_layer(l->sh, l->t, l->m, indirect, f,
			       rgb_mul(p->filter, rgb_scale(pigment, opaque)), one->normal, share);
	p->filter = rgb_mul(p->filter, rgbft_through(one->colour));
	if (mirror && f->conserve_energy)
		p->filter = rgb_mul(p->filter, rgb_make(fmin(1, 1 - reflectivity.r),
							fmin(1, 1 - reflectivity.g),
							fmin(1, 1 - reflectivity.b)));
	p->clear = clearness(p->filter);
}

/* A texture of layers. */
static void add_part(struct looking *l, const struct texture *tex, const struct pattern_point *at,
		     double share)
{
	static const struct part blank = {
		.filter = { 1, 1, 1 }, .fade = { 1, 1, 1 }, .clear = 1, .through = TREE_NONE
	};
	struct tree *t = l->t;
	uint32_t index = tree_push(t, &t->part, 1);
	struct indirect_part indirect = indirect_part(l->sh, l->n);
	double bailout = shade_bailout(l->sh, l->n->bounce);
	struct part *p;

	if (index == TREE_NONE)
		return;
	p = BUF_AT(&t->part, struct part, index);
	*p = blank;
	p->share = share;
	p->normal = l->m->ns;
	p->first_layer = t->layer.count;
	p->first_mirror = t->mirror.count;
	for (uint32_t i = 0; i < tex->count && p->clear > bailout; i++) {
		struct looked one = look_at(l, tex, i, at);

		if (i == 0)
			p->normal = one.normal;
		put_layer(l, p, index, &one, share, &indirect);
	}
}

static void visit(void *self, const struct texture *tex, const struct pattern_point *at, double share)
{
	add_part(self, tex, at, share);
}

/* Whatever the texture is made of. */
static void add_texture(struct looking *l, const struct surface *s, uint32_t texture,
			const struct xform *place, double share)
{
	double width = l->n->width + l->n->spread * l->m->t;
	const struct texture *tex;
	struct footprint foot;
	struct pattern_point at;

	if (texture == SCENE_NONE) /* nobody gave one: black */
		return;
	tex = &l->sh->scene->texture[texture];
	if (tex->plain) {
		add_part(l, tex, NULL, share);
		return;
	}
	l->within = tex->pattern;
	at = texture_point(s, place, l->m->ns, l->n->dir);
	if (l->sh->footprints && width > 0)
		texture_footprint(l->sh->geometry, l->hit, s, width, &at, &foot);
	texture_visit(l->sh->scene, tex, &at, share, visit, l);
}

static uint32_t add_lift(const struct shader *sh, struct tree *t, const ald_hit *hit, const struct surface *s,
			 bool from_inside)
{
	vec lift[2];
	uint32_t i;

	if (!surface_lift(sh->geometry, hit, s, lift))
		return 0;
	i = tree_push(t, &t->lift, 1);
	if (i == TREE_NONE)
		return 0;
	*BUF_AT(&t->lift, struct lift, i) = (struct lift){ lift[from_inside], lift[!from_inside] };
	return i + 1;
}

void shade_hit(const struct shader *sh, struct tree *t, uint32_t node, const ald_ray *ray,
	       const ald_hit *hit)
{
	uint32_t index;
	struct node *n = BUF_AT(&t->node, struct node, node);
	struct looking l = { .sh = sh, .t = t, .n = n, .hit = hit };
	struct surface s;
	bool from_inside;
	struct met *m;

	surface_at(sh->geometry, ray, hit, &s);
	if (sh->plain && plain_hit(sh, t, node, n->dir, n->pixel, &s, hit->prim)) {
		n->light_set = s.light_set;
		return;
	}
	index = tree_push(t, &t->met, 1);
	if (index == TREE_NONE)
		return;
	from_inside = vec_dot(s.ns, n->dir) > 0;
	m = BUF_AT(&t->met, struct met, index);
	m->node = node;
	m->p = s.p;
	m->n = s.n;
	m->ns = from_inside ? vec_neg(s.ns) : s.ns;
	m->error = surface_error(sh->geometry, ray, hit, &s);
	m->t = hit->t;
	m->skip = s.planar ? hit->prim : ALD_NONE;
	m->object = s.object;
	m->interior = s.interior;
	m->flags = s.flags;
	m->light_set = s.light_set;
	m->round = n->path;
	m->lift = sh->lifts ? add_lift(sh, t, hit, &s, from_inside) : 0;
	m->first_part = t->part.count;
	m->first_layer = t->layer.count;
	m->first_gather = t->gather.count;
	l.m = m;
	l.bent = m->ns;
	if (from_inside && s.interior_texture != SCENE_NONE) {
		add_texture(&l, &s, s.interior_texture, s.interior_texture_place, 1);
	} else if (surface_is_even(&s)) {
		add_texture(&l, &s, s.texture[0], s.texture_place[0], 1);
	} else {
		/* POV-Ray leaves out textures of a share below adc_bailout. */
		for (uint32_t i = 0; i < s.blend; i++) {
			if (s.bary[i] >= shade_bailout(sh, n->bounce))
				add_texture(&l, &s, s.texture[i], s.texture_place[i], s.bary[i]);
		}
	}
	m->part_count = t->part.count - m->first_part;
	m->layer_count = t->layer.count - m->first_layer;
	n->light_set = s.light_set;
	n->first_gather = m->first_gather;
	n->gather_count = t->gather.count - m->first_gather;
	n->first_part = m->first_part;
	n->part_count = m->part_count;
}
