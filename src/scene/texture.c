/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "scene/texture.h"

struct finish finish_default(void)
{
	return (struct finish){ .ambient = { 0.1, 0.1, 0.1 },
				.diffuse = 0.6,
				.indirect = 0.6,
				.brilliance = 1,
				.phong_size = 40,
				.roughness = 0.05,
				.reflection_falloff = 1,
				.reflection_exponent = 1 };
}

bool texture_translucent(const struct texture *t)
{
	for (uint32_t i = 0; i < t->count; i++) {
		const struct rgbft *c = &t->layer[i].pigment.colour;

		if (c->filter == 0 && c->transmit == 0)
			return false;
	}
	return true;
}
