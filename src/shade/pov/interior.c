/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "shade/pov/interior.h"

double interior_ior(const struct scene *s, uint32_t interior)
{
	return interior == SCENE_NONE ? 1 : s->interior[interior].ior;
}

static double fade(double colour, double depth, double power)
{
	/* Powers of 1000 and more stand for the exponential law (manual 3.4.8.1.4). */
	if (power >= 1000)
		return exp(-(1 - colour) * depth);
	return colour + (1 - colour) / (1 + pow(depth, power));
}

/* Without a fade_power, or with a negative one, what is seen through the interior fades all the same:
 * measured. */
struct rgb interior_fade(const struct scene *s, uint32_t interior, double distance)
{
	const struct interior *in;
	double depth;

	if (interior == SCENE_NONE)
		return rgb_make(1, 1, 1);
	in = &s->interior[interior];
	if (in->fade_distance == 0)
		return rgb_make(1, 1, 1);
	depth = distance / in->fade_distance;
	return rgb_make(fade(in->fade_colour.r, depth, in->fade_power),
			fade(in->fade_colour.g, depth, in->fade_power),
			fade(in->fade_colour.b, depth, in->fade_power));
}

struct rgb interior_shadow_fade(const struct scene *s, uint32_t interior, double distance)
{
	if (interior == SCENE_NONE || !(s->interior[interior].fade_power > 0))
		return rgb_make(1, 1, 1);
	return interior_fade(s, interior, distance);
}

double interior_relative_ior(const struct scene *s, const struct tree *t, uint32_t list, uint32_t object,
			     uint32_t interior)
{
	double own = interior_ior(s, interior), around;
	const struct inside *head;

	if (list == TREE_NONE)
		return own;
	head = BUF_AT(&t->inside, struct inside, list);
	around = interior_ior(s, head->interior);
	if (!inside_contains(t, list, object))
		return own / around;
	return head->outer == TREE_NONE ? 1 / own : around / own;
}

#define BANDS 7 /* POV-Ray's, also of what has no interior */

static const struct interior air = { .ior = 1, .dispersion = 1, .dispersion_samples = BANDS };

static const struct interior *interior_of(const struct scene *s, uint32_t interior)
{
	return interior == SCENE_NONE ? &air : &s->interior[interior];
}

static const struct interior *innermost(const struct scene *s, const struct tree *t, uint32_t list)
{
	return list == TREE_NONE ? &air : interior_of(s, BUF_AT(&t->inside, struct inside, list)->interior);
}

/* The surface is own's, which also says into how many bands light is split: measured. */
static struct crossing between(const struct interior *near, const struct interior *far, const struct interior *own)
{
	return (struct crossing){ near->ior / far->ior, near->dispersion / far->dispersion,
				  own->dispersion_samples };
}

struct crossing interior_cross(const struct scene *s, struct tree *t, uint32_t *list, const struct met *m)
{
	const struct interior *own = interior_of(s, m->interior), *around = innermost(s, t, *list);
	struct crossing c;

	if (*list != TREE_NONE && BUF_AT(&t->inside, struct inside, *list)->object == m->object) {
		/* out of the innermost: the next one counts as outside */
		*list = BUF_AT(&t->inside, struct inside, *list)->outer;
		around = innermost(s, t, *list);
		c = between(own, around, own);
		if (*list != TREE_NONE && c.bands < around->dispersion_samples)
			c.bands = around->dispersion_samples;
		return c;
	}
	if (inside_contains(t, *list, m->object)) { /* out of an overlap: left before */
		*list = inside_leave(t, *list, m->object);
		return (struct crossing){ 1, 1, 0 };
	}
	c = between(around, own, own);
	*list = inside_enter(t, *list, m->object, m->interior, m->flags & OBJECT_HOLLOW);
	return c;
}
