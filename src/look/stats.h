/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What a picture took: rays by kind, tests, hits, volumes, seconds and bytes, for people and as JSON.
 */
#ifndef ALIDADE_LOOK_STATS_H
#define ALIDADE_LOOK_STATS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "accel/trace.h"
#include "base/mem.h"
#include "render/render.h"

struct stats {
	const char *version, *scene, *output, *options, *accel; /* accel as by accel_describe() */
	uint64_t scene_hash;
	uint32_t threads, width, height; /* of what was rendered */
	const struct geometry *geometry;
	const struct render_counts *render;
	const struct mem_book *book;
	uint64_t process_most; /* bytes of the process that were in memory at a time; 0: not known */
	double read_seconds, write_seconds;
	bool complete; /* false: interrupted */
	bool animated;
	uint32_t frame; /* of an animation, */
	double clock;
	uint64_t pictures_kept; /* textures' files that an earlier frame had read */
	bool reused; /* the structure is an earlier frame's: the scene's shapes are the same */
};

void stats_text(const struct stats *, FILE *out);
/* The keys are those of alidade(1), which a test compares. false: out could not be written. */
bool stats_json(const struct stats *, FILE *out);

#endif
