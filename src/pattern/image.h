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

/* Beside a picture that is there once: clear. */
struct rgbft image_colour(const struct picture_place *, vec p);
/* 0 to 1; beside the picture 0. */
double image_value(const struct picture_place *, vec p);
/* Which material: a palette's number, or 0 to 255 by the red. */
uint32_t image_material(const struct picture_place *, vec p);
/* n (unit) bent by the picture as heights, size being bump_size; not unit. */
vec image_bump(const struct picture_place *, vec p, double size, vec n);

#endif
