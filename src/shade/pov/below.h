/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What the parts of subsurface light share: a chunk of layers whose light is being found, and the rays from below.
 */
#ifndef ALIDADE_SHADE_POV_BELOW_H
#define ALIDADE_SHADE_POV_BELOW_H

#include "base/sobol.h"
#include "shade/pov/dipole.h"
#include "shade/shade.h"

#define MOST_FLAT 3

/* A surface close by, as if it were flat. */
struct flat {
	vec foot, normal; /* of the hit on it */
	double source[2]; /* how far a dipole's sources are from there, mm */
	uint32_t rays; /* that go there */
};

/* A layer whose light is being found. */
struct place {
	const struct beneath *layer;
	struct dipole colour[3];
	vec base; /* below the hit */
	double real, mirrored, decay; /* of a dipole for all colours together */
	struct flat flat[MOST_FLAT];
	uint32_t flats, even; /* how many rays go everywhere */
	vec into; /* the ray from the eye, bent */
	bool bent; /* it is not reflected totally */
	double way; /* along it to the next surface, mm; or infinite */
	bool leaves; /* and there it leaves the solid */
	vec exit, exit_dir;
	uint32_t exit_skip;
	double cosine, cosine_below, fresnel; /* of the ray from the eye */
	uint32_t rays, singles; /* rays: a round */
	uint32_t rounds, least, most; /* that were, and have to be */
	double lost; /* the weights of rays that found nothing */
	struct rgb often, once; /* sums over rays */
	struct rgb before, sum, square; /* of the rounds: often before the last one; of their means */
	bool done;
	uint64_t key;
	uint32_t first; /* of the points of its sequences */
};

/* A ray sent from below. */
struct probe {
	uint32_t place;
	uint32_t flat, index; /* light scattered often: where it was sent to, and its number there */
	uint32_t light; /* light scattered once: which lamp */
	unsigned colours; /* and of which colours, a bit each */
	double out; /* and how far it is from there to the eye's hit, mm */
};

/* A place where light may come in: a met with the same number. */
struct sample {
	uint32_t place;
	double area; /* mm^2 */
	double in, out; /* ways below the surface, mm */
	unsigned colours; /* of light scattered once, or 0 */
};

/* All there is of a chunk. */
struct below {
	const struct shader *sh;
	struct tree *t;
	uint32_t thread;
	struct shade_counts *counts;
	double mm;
};

static inline struct place *place_at(const struct below *b, uint32_t i)
{
	return BUF_AT(&b->t->below.place, struct place, i);
}

static inline const struct node *node_of(const struct below *b, const struct place *p)
{
	return BUF_AT(&b->t->node, struct node, p->layer->met.node);
}

/* A union that was given an interior is one solid; objects that were given the same one each are not. */
static inline bool same_solid(const struct place *p, const struct surface *s)
{
	return p->layer->met.object == s->object;
}

/* Rays of the chunk: sent, traced at once, and what one of them found. */
bool below_push(struct below *, vec org, vec dir, double most, uint32_t skip, const struct probe *);
void below_forget(struct below *);
bool below_trace(struct below *);
bool below_found(const struct below *, uint32_t ray, const ald_hit **, struct surface *);

/* By Snell's law, whichever side the normal is on; ratio of the near index to the far one. */
bool below_refract(vec dir, vec normal, double ratio, vec *out);

/* Find the bases of all places, the ways of what is seen through, and what is close by. */
bool below_look(struct below *);
/* The rays that look for light scattered often, of all places that are not done. */
bool below_send(struct below *);
/* What such a ray counts in comparison to one of as many that all go everywhere. */
double below_weight(const struct place *, vec dir, double mm);
/* The sequences of the rays that go everywhere (0) and to one of the flats (1 and more). */
struct sobol below_sequence(const struct place *, uint32_t flat);

#endif
