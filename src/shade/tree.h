/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The rays of a tile as a tree, and what is known of each.
 *
 * A node is one ray and, in the end, the colour it brings. What it hit has parts: one texture, or three
 * that are blended over a triangle. A part has its own light and asks for other nodes: one through the
 * surface, one mirrored by each layer. Children stand behind their parents, so that folding goes from
 * the last node to the first (render/fold.c): POV-Ray's reflection exponent needs a child's colour
 * before it is added.
 */
#ifndef ALIDADE_SHADE_TREE_H
#define ALIDADE_SHADE_TREE_H

#include "accel/trace.h"
#include "base/buf.h"
#include "base/rng.h"
#include "scene/scene.h"

#define TREE_NONE UINT32_MAX

enum node_kind { NODE_CAMERA, NODE_REFLECTED, NODE_REFRACTED, NODE_GATHERED };

struct node {
	vec org, dir; /* dir is unit */
	double weight; /* share of the pixel that it can still be, for adc_bailout */
	uint64_t key; /* what its random numbers are made of */
	double width, spread; /* of its cone where it starts, and by how much it widens a unit; 0: none */
	double band; /* of the spectrum, from violet 0 to red 1, if a prism left it no more; or 0: white */
	double length; /* of its way to what it hit, or infinite; known once it is traced */
	uint32_t level; /* mirrors and refractions before it */
	uint32_t bounce; /* diffuse bounces before it: it brings indirect light if not 0 */
	uint32_t path; /* which of those that share its key: rays sent from one hit, or samples of a pixel */
	uint32_t beneath; /* surfaces that it is below of: what they ask for is asked within what others asked */
	uint32_t inside; /* what it is inside of, an index of tree.inside, or TREE_NONE */
	uint32_t skip; /* the planar primitive it starts on */
	uint32_t pixel[2]; /* that its sample lies in, for reports */
	uint32_t light_set; /* of what it hit, SCENE_NONE if nothing; known once it is traced */
	enum node_kind kind;
	bool straight; /* went on through a surface without bending: not counted as a level */
	bool mirrored; /* it or a ray before it was reflected: sees as mirrors do, also through glass */
	bool clear_sky; /* the background's transparency is wanted (alpha) */
	uint32_t sharers; /* parts and mirrors of one hit that share it, beyond the first */
	bool nowhere; /* no ray at all: the camera sees nothing here */
	uint32_t first_part, part_count; /* no parts: colour is what it is */
	uint32_t veil; /* what hangs between its origin and its end: 1 + an index, or 0 */
	double way; /* length of the rays that led to it from the camera, through mirrors and glass */
	uint32_t first_gather, gather_count; /* where its hit asks for indirect light */
	struct rgb colour;
	struct rgb variance; /* of the colour, as an estimate; 0 without replications */
	double transmit; /* how much of the background is seen, for alpha */
};

/* For random numbers that have no sequence of their own: what shares a key has others. */
static inline uint64_t node_key(const struct node *n)
{
	return n->path ? rng_child(n->key, n->path) : n->key;
}

/* Media and fog on the way: what comes from the ray's end is multiplied by clear, glow is added. */
struct veil {
	struct rgb clear, glow;
};

/* Indirect light on one side of a hit, for all its layers together: the mean of what the rays bring. */
struct gather {
	struct rgb factor; /* what the layers make of it */
	struct rgb light; /* if known: the cache's answer */
	vec normal; /* rays lie around it */
	bool around_raw; /* normal is the surface's own, not a bent one */
	bool back; /* of the far side */
	uint32_t first, count; /* nodes; count 0: none yet */
	bool known;
	bool recorded; /* becomes a record of the cache, at p */
	vec p;
	double pixel; /* width of one there, for the record */
	uint32_t replications; /* of count / replications rays each, independent of each other */
};

/* Being in a solid; a list from the innermost outward that never changes, so that rays share it. */
struct inside {
	uint32_t object, interior, outer;
	bool hollow; /* the object is: media and fog fill it */
};

struct part {
	double share; /* of the hit's colour */
	struct rgb own; /* its own light, all layers */
	struct rgb filter; /* what all layers let through */
	struct rgb fade; /* by the way through the interior */
	vec normal; /* of the topmost layer, bent: refraction goes by it */
	double clear; /* grey of filter, at most 1 */
	uint32_t through; /* a node, or TREE_NONE */
	bool total; /* through is a total reflection, and is not filtered */
	/* Of light that is split: how many bands, of which those from .. to - 1 are totally reflected. One node
	 * from through on for each other band, and one for these. 0: not split. */
	uint32_t bands, total_from, total_to;
	uint32_t first_layer, layer_count; /* of tree.layer, until the wave is shaded */
	uint32_t first_mirror, mirror_count;
	uint32_t first_scatter, scatter_count;
};

/* A ray that a part asks for because light comes out from below it. */
struct scatter {
	struct rgb factor;
	uint32_t child; /* a node */
	bool gathered; /* it brings indirect light */
};

struct mirror {
	struct rgb reflectivity;
	double exponent, weight;
	uint32_t child; /* a node, or TREE_NONE: not worth tracing */
	vec normal;
};

/* A layer that light falls on. */
struct lit_layer {
	const struct finish *finish;
	struct rgb pigment, filter; /* filter: what the layers above let through */
	double opacity;
	vec normal;
	uint32_t part;
	bool beneath; /* light goes below it: it has no diffuse of its own */
};

/* One light at one hit. */
struct lit {
	uint32_t hit; /* of tree.hit */
	uint32_t light;
	vec dir;
	double depth;
	struct rgb colour; /* arriving, shadows included once they are known */
	uint32_t grid; /* area lights: the first of its cells in tree.cell, or TREE_NONE */
	uint32_t soft; /* jittered ones: an index of tree.soft, or TREE_NONE */
};

/* A jittered area light asked for again and again, each time with other points. */
struct soft {
	struct rgb sum, square;
	uint32_t rounds;
	uint32_t points; /* asked for, if all brought the same, or 0 */
};

/* A surface that the current wave met. */
struct met {
	uint32_t node;
	vec p, n, ns; /* n, ns as in struct surface; ns faces the ray */
	double error; /* see surface_error() */
	double t;
	uint32_t skip; /* its primitive, if planar */
	uint32_t object, interior, light_set;
	unsigned flags;
	uint32_t first_part, part_count;
	uint32_t first_layer, layer_count; /* over all its parts */
	uint32_t first_gather;
	uint32_t lift; /* 1 + an index of tree.lift, or 0 */
	uint32_t round; /* which of the points that share random numbers and that lamps shine on: others see
			 * them jittered otherwise */
};

/* From a hit to the smooth surface that its mesh stands for: on the side of ns, and on the other. */
struct lift {
	vec near, far;
};

/* A layer of a hit that light goes below. */
struct beneath {
	struct met met;
	const struct finish *finish;
	struct rgb reflectance, filter; /* filter: what the layers above let through */
	double ior; /* relative to where the ray comes from */
	uint32_t part;
};

/* A question to one light point, or to one point of a light's grid. */
struct shadow {
	vec org, dir;
	double depth;
	uint32_t skip, inside;
	uint32_t pixel[2];
	bool air; /* fog and what else fills the world takes from it */
	bool vacuum; /* media take nothing from it */
	bool shadowless; /* nothing hides it */
	uint32_t projector; /* the light that has to come through something first, or SCENE_NONE */
	struct rgb colour; /* in: unshadowed; out: what arrives */
};

/* A hit that takes the short way (pov/plain.c), and one light at it. */
struct plain {
	uint32_t to; /* whose colour it is: a node's, or a sample's */
	uint32_t skip, light_set;
	uint32_t pixel[2];
	bool both_sides; /* double_illuminate */
	bool lit; /* light does something to it */
	vec dir; /* of the ray */
	vec p, n, ns; /* as in struct met */
	double error;
	const struct layer *layer;
	struct rgb colour;
};

struct plain_light {
	uint32_t plain; /* of tree.plain */
	bool behind; /* the surface takes it from its far side */
	vec dir;
	struct rgb colour;
};

struct cell {
	struct rgb colour;
	bool known, asked;
};

struct tree {
	struct mem_book *book;
	bool no_memory; /* sticky: some push failed */
	struct buf node, part, mirror, inside, veil, gather, scatter; /* until folded */
	struct buf met, lift, layer, lit, soft, shadow, cell, asked; /* of the current wave */
	struct buf plain, plain_light; /* of the current wave */
	struct buf ray, hit, hidden; /* of the current call to trace */
	struct buf beneath; /* of the current wave, until its light is known */
	struct buf record, strata; /* for the cache of indirect light, while it is filled */
	struct {
		struct buf segment, span, reach, sample, slot;
	} media; /* see pov/media.c */
	struct {
		struct buf place, probe, sample;
	} below; /* see pov/subsurface.c */
};

void tree_init(struct tree *, struct mem_book *);
void tree_reset(struct tree *); /* empty, memory kept */
void tree_reset_wave(struct tree *);
void tree_release(struct tree *);

bool tree_grow(struct tree *, struct buf *, uint32_t n); /* false: no_memory is set */

/* Append n uninitialised elements; the index of the first, or TREE_NONE (then no_memory is set). */
static inline uint32_t tree_push(struct tree *t, struct buf *b, uint32_t n)
{
	uint32_t first = b->count;

	if (n > b->room - first && !tree_grow(t, b, n))
		return TREE_NONE;
	b->count = first + n;
	return first;
}

/* Hang another veil before those that node has: nearer to its origin, or around them all. */
void tree_veil(struct tree *, uint32_t node, struct rgb clear, struct rgb glow);

/* Lists of what a ray is in. contains: the list has an entry for object. */
bool inside_contains(const struct tree *, uint32_t list, uint32_t object);
/* Everything in it is hollow. */
bool inside_hollow(const struct tree *, uint32_t list);
uint32_t inside_enter(struct tree *, uint32_t list, uint32_t object, uint32_t interior, bool hollow);
uint32_t inside_leave(struct tree *, uint32_t list, uint32_t object); /* its innermost entry */

#endif
