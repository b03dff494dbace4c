/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "shade/shade.h"

#include "shade/indirect.h"

#define CAMERA_SOLIDS 64

void shader_init(struct shader *sh, const struct scene *s, const struct geometry *g, bool alpha,
		 const struct indirect *indirect)
{
	*sh = (struct shader){ .scene = s, .geometry = g, .alpha = alpha };
	if (s->radiosity.given)
		sh->indirect = *indirect;
	for (uint32_t i = 0; i < s->texture_count && !sh->translucent; i++)
		sh->translucent = texture_translucent(&s->texture[i]);
	sh->clear_shadows = sh->translucent && s->light_count > 0;
	sh->media = s->media_count > 0;
	for (uint32_t i = 0; i < s->interior_count && !sh->media; i++)
		sh->media = s->interior[i].media_count > 0;
	sh->fog = s->fog_count > 0;
	for (uint32_t i = 0; i < s->light_count; i++)
		sh->projected |= s->light[i].projected;
	sh->subsurface = s->subsurface.given && s->subsurface.used;
	sh->insides = sh->translucent || sh->media || sh->fog;
	shade_sky_init(sh);
}

bool shade_worth(const struct shader *sh, uint32_t bounce, uint32_t level, double weight)
{
	uint32_t most = sh->scene->max_trace_level, start = indirect_level(bounce);

	if (bounce && most <= start)
		most = start + 1;
	return level < most && weight >= shade_bailout(sh, bounce);
}

uint32_t shade_camera_inside(const struct shader *sh, struct tree *t, vec org)
{
	struct solid solid[CAMERA_SOLIDS];
	uint32_t list = TREE_NONE, n;

	if (!sh->insides)
		return list;
	n = geometry_inside(sh->geometry, org, solid, CAMERA_SOLIDS);
	for (uint32_t i = 0; i < n && i < CAMERA_SOLIDS; i++)
		list = inside_enter(t, list, solid[i].object, solid[i].interior, solid[i].hollow);
	return list;
}
