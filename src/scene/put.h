/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What scene_dump() writes with.
 */
#ifndef ALIDADE_SCENE_PUT_H
#define ALIDADE_SCENE_PUT_H

#include <stdio.h>

#include "scene/scene.h"

/* " x", in the fewest digits that read back as the same number. */
void put(FILE *, double x);
void put_word(FILE *, const char *word, double x);
void put_vec(FILE *, const char *word, vec);
void put_rgb(FILE *, const char *word, struct rgb);
void put_rgbft(FILE *, const char *word, struct rgbft);
void put_mat(FILE *, const char *word, const struct mat *);

/* texture_dump.c: textures, and before them what they are made of. */
void dump_textures(const struct scene *, FILE *);

#endif
