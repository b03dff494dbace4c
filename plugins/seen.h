/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * For counting only, where a primitive is in several volumes: which ones a ray has met. It lies in the
 * query's scratch memory, so a table is never cleared between rays: slots bear the number of their ray.
 */
#ifndef SEEN_H
#define SEEN_H

#include <alidade/accel.h>

#include <string.h>

/* A ray that meets more than half as many different ones has repeats of the others counted as first tests. */
#define SEEN_MOST 4096u

struct seen {
	uint32_t ray, used;
	struct {
		uint32_t id, ray;
	} slot[]; /* seen_slots() */
};

/* prims: how many there are. */
ALD_INLINE uint32_t seen_slots(uint32_t prims)
{
	uint32_t n = 16;

	while (n < SEEN_MOST && n / 2 < prims)
		n *= 2;
	return n;
}

ALD_INLINE size_t seen_size(uint32_t prims)
{
	return sizeof(struct seen) + seen_slots(prims) * (size_t)8;
}

/* A new ray. */
ALD_INLINE void seen_begin(struct seen *s, uint32_t prims)
{
	s->used = 0;
	if (!++s->ray) { /* 2^32 rays later: slots of old would look new */
		memset(s, 0, seen_size(prims));
		s->ray = 1;
	}
}

/* 1: this ray has met it before. */
ALD_INLINE uint32_t seen_again(struct seen *s, uint32_t prims, uint32_t id)
{
	uint32_t n = seen_slots(prims), i = (id * 2654435761u >> 16) & (n - 1);

	while (s->slot[i].ray == s->ray && s->slot[i].id != id)
		i = (i + 1) & (n - 1);
	if (s->slot[i].ray == s->ray)
		return 1;
	if (s->used < n / 2) {
		s->used++;
		s->slot[i].ray = s->ray;
		s->slot[i].id = id;
	}
	return 0;
}

#endif
