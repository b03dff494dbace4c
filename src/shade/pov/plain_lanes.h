/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The short way (plain.c) for a thousand hits of camera rays on triangles, eight at a time; the operations are the same
 * in their order, and so are the bits.
 */
#ifndef ALIDADE_SHADE_POV_PLAIN_LANES_H
#define ALIDADE_SHADE_POV_PLAIN_LANES_H

#include "accel/facet.h"
#include "shade/shade.h"

#define PLAIN_LANES TRACE_ROOM /* hits at a time, at most */

/* Of a ray, in the end. */
struct seen {
	struct rgb colour;
	double transmit;
};

/* What the short way knows of a texture. */
struct paint {
	const struct finish *finish; /* NULL: it goes another way */
	struct rgb base; /* its own light */
	struct rgb pigment;
	double diffuse, back; /* towards the light, and away from it */
	double noise; /* what crand takes from it */
	bool lit; /* light does something to it */
	bool dull; /* and nothing but diffuse, by the cosine */
};

/* What hits on one kind of surface have in common, for a lamp. */
struct paint_lanes {
	double pigment[3][LANES], diffuse[LANES], back[LANES], noise[LANES];
	double lit[LANES], both[LANES]; /* 0 or not */
};

/* A thread's own. */
struct plain_lanes {
	struct trace_room room;
	struct facet_kind kind;
	struct facet_hits now; /* lanes being filled */
	struct facets placed[PLAIN_LANES / LANES]; /* ns: turned to where the ray comes from */
	double eye[3][PLAIN_LANES]; /* by hit: where the ray goes */
	uint32_t count; /* hits taken */
	uint32_t sort, sorts; /* what the last hit has in common with others is numbered, from 1 on */
	uint32_t group[PLAIN_LANES / LANES]; /* the number of eight hits, or 0: they differ */
	double dir[3][PLAIN_LANES]; /* by ray: where it goes */
	uint32_t ray[PLAIN_LANES], prim[PLAIN_LANES], texture[PLAIN_LANES], light_set[PLAIN_LANES];
	bool both[PLAIN_LANES];
	struct paint_lanes paint;
	/* Shadow rays in the room, of one lamp. */
	uint32_t asked, asks[PLAIN_LANES]; /* the hit */
	struct rgb light[PLAIN_LANES]; /* what they add if nothing is in the way */
	uint8_t hidden[PLAIN_LANES];
	ald_hit hit[PLAIN_LANES]; /* of camera rays */
};

/* What all threads share, texture_count of them. */
void plain_paint(const struct shader *, struct paint *);

/* Nothing is taken yet; false: the geometry wants rays one by one. */
bool plain_lanes_begin(struct plain_lanes *, const struct shader *, uint32_t thread);
/* Takes the hit of a ray, whose direction is known; or does not: false. [render] */
bool plain_lanes_take(struct plain_lanes *, const struct shader *, const struct paint *, uint32_t ray,
		      const ald_hit *);
/* Colours of all hits taken, by ray, with shadow rays traced. [render] */
void plain_lanes_light(struct plain_lanes *, const struct shader *, const struct paint *, uint32_t thread,
		       uint32_t hints, struct seen *, struct shade_counts *);

#endif
