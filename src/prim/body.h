/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Bodies: shapes made of many pieces, each a primitive of its own so that its box fits, over data that the
 * pieces share (sphere sweeps, blobs).
 *
 * A body is a struct prim without an id: its own coordinates are about the origin and of size 1. A piece
 * finds the crossings of the whole body's surface that are its own: every crossing belongs to exactly one
 * piece, whatever piece is asked first.
 */
#ifndef ALIDADE_PRIM_BODY_H
#define ALIDADE_PRIM_BODY_H

#include "prim/prim.h"

struct prim_piece {
	ald_box box; /* grown, as the accelerator sees it */
	uint32_t body, part;
};

struct body_root {
	double t, u; /* u: whatever surface() wants to know */
};

/* What a body's data begins with; objects of one shape share it. */
struct body_data {
	vec centre; /* of own coordinates in the object's, which are size times as large */
	double size;
	uint32_t pieces;
};

struct body_ops {
	/* Which of the scene's shapes of this kind the object has, and how many there are. */
	uint32_t (*shape)(const struct scene *, const struct object *, uint32_t *count);
	uint32_t (*pieces)(const struct scene *, const struct object *);
	size_t (*bytes)(const struct scene *, const struct object *); /* of data, which make() fills */
	void (*make)(const struct scene *, const struct object *, void *data);
	/* The greatest p.m of the piece's points p, in own coordinates. */
	double (*reach)(const struct prim *, uint32_t piece, vec m);
	/* The piece's first crossing behind t = from of the line o + t d, o being the line's point nearest
	 * to the origin; the same numbers whatever from is. The ray starts at t = -slide. */
	bool (*next)(const struct prim *, uint32_t piece, const struct prim_line *, double from,
		     struct body_root *);
	void (*surface)(const struct prim *, vec p, uint32_t piece, double u, struct prim_point *);
	bool (*inside)(const struct prim *, vec p);
};

extern const struct body_ops blob_ops, isosurface_ops, lathe_ops, prism_ops, sweep_ops;

/* NULL: the kind is no body. */
const struct body_ops *body_ops_of(enum shape_kind);
/* As prim_make(), without a box; data is as ops->make() left it and stays the caller's. */
bool body_make(struct prim *, const struct object *, const struct xform *place, vec shift, double scale,
	       const void *data);
/* False: something is not finite. */
bool piece_make(struct prim_piece *, const struct prim *, uint32_t body, uint32_t part, double size,
		double pad);
/* As prim_intersect() and prim_surface(); hit->part is the piece's part, hit->u its root's u. */
int piece_intersect(const struct prim *, const struct prim_piece *, uint32_t id, const ald_ray *,
		    ald_hit *);
void piece_surface(const struct prim *, const ald_ray *, const ald_hit *, vec *p, vec *n, double *error);
/* The components whose textures meet at p on a piece's surface, one for each texture and place, SCENE_NONE
 * for the blob's own, and their shares; at most room of them, those with the greatest shares. */
uint32_t blob_blend(const struct blob *, const struct prim *, uint32_t piece, vec p, uint32_t *part,
		    double *share, uint32_t room);
bool body_inside(const struct prim *, vec p);

#endif
