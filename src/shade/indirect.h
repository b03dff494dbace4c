/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Indirect light: what POV-Ray's radiosity approximates, by rays gathered at every hit.
 *
 * A hit has at most two gathers, one a side (more if layers have normals of their own): all layers share the
 * light and differ in what they make of it.
 */
#ifndef ALIDADE_SHADE_INDIRECT_H
#define ALIDADE_SHADE_INDIRECT_H

#include "shade/shade.h"

/* While the layers of a part are gone through. */
struct indirect_part {
	bool wanted;
	uint32_t front, back; /* of tree.gather, or TREE_NONE: no layer was worth it yet */
};

struct indirect_part indirect_part(const struct shader *, const struct node *);
/* One layer. colour: its pigment with its opacity and what the layers above let through. normal: the layer's,
 * facing the ray. */
void indirect_layer(const struct shader *, struct tree *, const struct met *, struct indirect_part *,
		    const struct finish *, struct rgb colour, vec normal, double share);
/* The rays that the gathers of a hit ask for. */
void indirect_spawn(const struct shader *, struct tree *, const struct met *);

/* The light of a gather whose rays are known, without its factor. variance: of this mean, as far as
 * the replications tell it; NULL: not wanted. */
struct rgb indirect_fold(const struct radiosity *, const struct tree *, const struct gather *,
			 struct rgb *variance);

/* Make a record of gather number slot of a node, into t->record. */
void indirect_record(const struct radiosity *, const struct indirect *, struct tree *, const struct node *,
		     uint32_t slot);

/* Whether a gathered ray is followed to a child that would show share of its colour, by chance: the faint ones
 * seldom, and what they bring then counts *scale times, so that the mean stays. slot: of the node's random numbers,
 * any for each child. Camera rays always are. */
bool indirect_follow(const struct shader *, const struct node *, uint64_t slot, double share, double *scale);

/* What one gathered ray's colour is to the surface that sent it. */
struct rgb indirect_one(const struct radiosity *, struct rgb colour);
/* The power of two nearest to a number of rays. */
uint32_t indirect_power(double want);
/* Unit direction around normal, cosine-weighted for u and v even in 0 .. 1. */
vec indirect_hemisphere(vec normal, double u, double v);
/* Unit direction number index of a family, cosine-weighted around normal. */
vec indirect_direction(vec normal, uint32_t index, uint64_t key);

/* The level at which gathered rays start after so many diffuse bounces. POV-Ray makes it independent of the
 * way the light took before. */
static inline uint32_t indirect_level(uint32_t bounce)
{
	return 3 * bounce / 2;
}

#endif
