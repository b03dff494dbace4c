/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A file of its own: accel/geometry.h and tests/unit/rays.h both have a struct mesh.
 */
#include "settle.h"

#include "accel/geometry.h"

void settle_as_host(const ald_prims *prims, const ald_frame *frame, const ald_ray *ray, ald_hit *hit, uint32_t n)
{
	const struct prim_level level = {
		.tri_count = prims->tri_count, .index = (uint32_t *)(uintptr_t)prims->index,
		.vertex = (void *)(uintptr_t)prims->vertex, .vertex_double = prims->vertex_double,
	};
	const struct view view = { .prims = *prims, .level = &level, .frame = *frame };

	view_settle_n(&view, ray, hit, n);
}
