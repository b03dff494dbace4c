/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Pictures laid on things: image_map, image_pattern, bump_map, material_map (POV-Ray's manual 3.4.6.1.5,
 * 3.4.6.2.4, 3.4.7.1.14, 3.4.6.6).
 */
#ifndef ALIDADE_PATTERN_IMAGE_H
#define ALIDADE_PATTERN_IMAGE_H

#include "scene/texture.h"

/* Points are those behind the pattern's warps, or (u, v, 0). */

/* foot: what around the point counts, if the picture has smaller copies; or NULL. */
struct footprint;
/* Beside a picture that is there once: clear. */
struct rgbft image_colour(const struct picture_place *, vec p, const struct footprint *foot);
/* 0 to 1; beside the picture 0. */
double image_value(const struct picture_place *, vec p, const struct footprint *foot);
/* Which material: a palette's number, or 0 to 255 by the red. */
uint32_t image_material(const struct picture_place *, vec p);
/* n (unit) bent by the picture as heights, size being bump_size; not unit. */
vec image_bump(const struct picture_place *, vec p, double size, vec n);

/* For mip.c: a pixel as a colour, without what filter all and transmit all add. */
struct rgbft image_texel(const struct picture_place *, uint32_t x, uint32_t y);
struct rgbft image_level_texel(const struct mip *, uint32_t level, uint32_t x, uint32_t y);
void image_level_store(struct mip *, uint32_t level, uint32_t x, uint32_t y, struct rgbft);

#endif
