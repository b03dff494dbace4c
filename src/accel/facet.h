/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Triangles of even meshes that rays hit, eight at a time: what surface_at() says of them, to the bit.
 */
#ifndef ALIDADE_ACCEL_FACET_H
#define ALIDADE_ACCEL_FACET_H

#include "accel/trace.h"
#include "base/wide.h"

struct prim_leaf;

/* What all triangles of one object have in common. */
struct facet_kind {
	uint32_t from, end; /* ids; none until it is found */
	bool even; /* one texture a face, nothing else inside, no cells of height fields: what follows counts */
	unsigned flags; /* enum object_flag */
	uint32_t light_set;
	const struct prim_leaf *leaf;
	const struct mesh *mesh;
	const uint32_t *face; /* of the mesh, by id - from; NULL: the same */
};

/* A lane each. */
struct facet_hits {
	double corner[3][3][LANES]; /* corner, axis; in the geometry's coordinates */
	double u[LANES], v[LANES];
	double side[LANES]; /* -1: the object's place mirrors */
	double normal[3][LANES]; /* interpolated, of any length; 0: the face is flat */
};

/* As in struct surface. */
struct facets {
	double p[3][LANES], n[3][LANES], ns[3][LANES], error[LANES];
	double size[LANES]; /* of the normal: slivers, for which the above does not hold, are below FACET_SLIVER */
};

#define FACET_SLIVER 0x1p-1022

/* What kind of primitive id is, if not the one that kind is about; false: not one that can be taken. [render] */
bool facet_find(const struct geometry *, uint32_t id, struct facet_kind *);
/* Into a lane goes a hit on a primitive of this kind; *texture is its own, or SCENE_NONE. False: the face's corners
 * have different ones. [render] */
bool facet_take(const struct geometry *, const struct facet_kind *, const ald_hit *, struct facet_hits *, unsigned lane,
		uint32_t *texture);
void facet_place(const struct geometry *, const struct facet_hits *, struct facets *); /* [render] */

#endif
