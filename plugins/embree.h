/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * embree: what its files share.
 *
 * Embree walks in floats, through coordinates of its own here: X = (x - centre) * scale, scale a power of two, so that
 * the scene lies within [-1, 1] wherever and however large it is. A ray starts where it enters the scene's box, and
 * goes in a direction whose largest component is in [1/2, 1); t of the walk is (t - shift) * tscale, at most 4.
 *
 * Every primitive is one of Embree's user geometries, and alidade/kernel.h or the host decides whether it is hit (R1).
 * So Embree may not leave out a box that the ray meets. Its robust mode answers conservatively for the ray in floats;
 * that ray is off by at most 2^-25 at its origin, to which what the doubles err adds FAR_MOST, and by 2^-25 of a
 * distance <= 4 along its way: by less than 2^-22 in all, and boxes are GROWN by four times that. Rays from so far
 * away that FAR_MOST does not hold are asked of every primitive.
 */
#ifndef EMBREE_H
#define EMBREE_H

#include <alidade/accel.h>
#include <alidade/kernel.h>
#include <embree3/rtcore.h>
#include <stdatomic.h>

#define GROWN 0x1p-20
#define FAR_MOST 0x1p-24
#define STREAM 64u /* rays of a call at most, if they go as a stream */

enum embree_param { P_NATIVE, P_PACKET, P_ROBUST, P_QUALITY, P_ISA, P_HUGE };
enum { PACKET_AUTO, PACKET_1, PACKET_4, PACKET_8, PACKET_16, PACKET_STREAM };
enum { TRIANGLES, OTHERS }; /* geometries of native=1; without it all are OTHERS */

struct ald_accel {
	const ald_host *host;
	const ald_prims *prims;
	RTCDevice device;
	RTCScene scene;
	int native;
	unsigned packet;
	uint32_t first; /* primitive 0 of OTHERS is this id */
	double centre[3], scale; /* to X */
	ald_box box; /* around the primitives, grown (R4) */
	ald_frame frame;
	float (*bounds)[6]; /* of OTHERS, while building */
	const void *self; /* the thread that builds */
	_Atomic int64_t bytes, peak; /* of Embree's */
	_Atomic int stop; /* ALD_NO_MEMORY, ALD_CANCELLED */
	char why[200]; /* Embree's last complaint */
};

struct beam { /* a ray on its way */
	const ald_ray *ray;
	ald_hit *hit;
	ald_prep prep;
	double shift, tscale;
	float org[3], dir[3], tnear, tfar;
	int found;
};

struct call { /* context first: that is what callbacks get */
	struct RTCIntersectContext context;
	const ald_accel *a;
	ald_query *q;
	struct beam *beam; /* ray.id is the index */
	int any;
};

/* embree_walk.c: of up to STREAM rays. any: found is all that counts. */
void embree_fire(struct call *, const ald_ray *, ald_hit *, uint32_t n, unsigned packet);
void embree_intersect_cb(const struct RTCIntersectFunctionNArguments *);
void embree_occluded_cb(const struct RTCOccludedFunctionNArguments *);

#endif
