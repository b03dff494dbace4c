/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A pattern while it is read, with its map: what pigments, normals and textures have in common.
 */
#ifndef ALIDADE_READ_POV_PATTERN_H
#define ALIDADE_READ_POV_PATTERN_H

#include "base/single.h"
#include "read/pov/items.h"

/* Measured: POV-Ray takes a little off the mortar and keeps it in single precision, so that it is a little
 * more than 0.3 but just 0.5. */
static inline double pattern_mortar(double given)
{
	return as_single(given - 2e-10);
}

enum pattern_use { IN_PIGMENT = 1, IN_NORMAL = 2, IN_TEXTURE = 4, IN_DENSITY = 8 };

struct pattern_draft {
	enum pattern_use use; /* what block the pattern stands in */
	bool given; /* there is a pattern */
	bool average; /* its map has weights */
	struct pattern pattern;
	struct pov_map map;
	struct pov_lack lack; /* of the pattern alone */
	double amount, accuracy; /* normals */
	bool no_bump_scale;
};

/* From what identifiers stand for; pattern: NULL if there is none. */
void pattern_draft_init(struct pattern_draft *, enum pattern_use, const struct pattern *);
/* If the current token is a pattern's word, read it and its parameters. */
bool pattern_word(struct pov *, struct pattern_draft *);
/* All the modifiers that follow. */
void pattern_modifiers(struct pov *, struct pattern_draft *);
/* The pattern in the parser's arena; NULL: none, or after an error. */
struct pattern *pattern_finish(struct pov *, struct pattern_draft *);
/* Put a transform after all that the pattern has. */
bool pattern_move(struct pov *, struct pattern *, const struct xform *);
/* A copy of the pattern, with a transform after all that it has. */
struct pattern *pattern_transform(struct pov *, const struct pattern *, const struct xform *);

/* warp { ... }, put before the pattern's other warps. */
void pattern_warp_read(struct pov *, struct pattern_draft *);
/* Room for one more warp, before the others; NULL: no memory. */
struct warp *pattern_warp_push(struct pov *, struct pattern *);
/* turbulence, octaves, lambda, omega: true if it was one. */
struct turbulence_words {
	vec *amount;
	uint32_t *octaves;
	double *lambda, *omega;
};
bool turbulence_word(struct pov *, const struct turbulence_words *);

/* The list of a block pattern's entries; what is not given is the default's. */
void pattern_blocks(struct pov *, struct pattern_draft *, uint32_t count);
/* These textures as a block pattern's entries. */
void pattern_textures(struct pov *, struct pattern_draft *, struct pov_texture *const *, uint32_t count);
/* no_bump_scale of a texture: for all normals in it, which are copied. False: no memory. */
bool pov_texture_keep_bumps(struct pov *, struct pov_texture *);
/* The textures of a material_map, as many as there are. */
void pattern_materials(struct pov *, struct pattern_draft *);

#endif
