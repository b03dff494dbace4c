/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "read/limits.h"

#include <math.h>
#include <string.h>

enum { NESTING, MACRO_DEPTH, INCLUDE_DEPTH, LOOP_STEPS, STRING_BYTES, TOKENS, ELEMENTS, OBJECTS,
       TEXTURE_PIXELS, TEXTURE_BYTES, MEMORY, SECONDS, LIMITS };

const struct read_limit_row read_limit_table[] = {
	[NESTING] = { "nesting", 500, "of braces, parentheses and #if, together" },
	[MACRO_DEPTH] = { "macro_depth", 200, "macros calling macros" },
	[INCLUDE_DEPTH] = { "include_depth", 32, "files including files" },
	[LOOP_STEPS] = { "loop_steps", 1e7, "of all #while and #for loops together" },
	[STRING_BYTES] = { "string_bytes", 1 << 20, "of one string" },
	[TOKENS] = { "tokens", 2e8, "words, numbers and signs read, over one for each byte of the files" },
	[ELEMENTS] = { "elements", 1e8, "of one list or array" },
	[OBJECTS] = { "objects", 1e7, "in the scene" },
	[TEXTURE_PIXELS] = { "texture_pixels", 1 << 28, "of one picture file" },
	[TEXTURE_BYTES] = { "texture_bytes", 4294967296.0, "of all picture files together, in memory" },
	[MEMORY] = { "memory", 1 << 29, "bytes of declared values and items" },
	[SECONDS] = { "seconds", 0, "of reading; 0 sets no limit" },
};

const size_t read_limit_count = LIMITS;

static double get(const struct read_limits *l, size_t i)
{
	const double value[LIMITS] = {
		l->nesting, l->macro_depth, l->include_depth, (double)l->loop_steps,
		(double)l->string_bytes, (double)l->tokens, (double)l->elements, (double)l->objects,
		(double)l->texture_pixels, (double)l->texture_bytes,
		(double)l->memory, l->seconds
	};

	return value[i];
}

static void set(struct read_limits *l, size_t i, double value)
{
	uint64_t n = value >= 1e18 ? (uint64_t)1e18 : (uint64_t)value;
	uint32_t small = n > UINT32_MAX ? UINT32_MAX : (uint32_t)n;

	switch (i) {
	case NESTING: l->nesting = small; break;
	case MACRO_DEPTH: l->macro_depth = small; break;
	case INCLUDE_DEPTH: l->include_depth = small; break;
	case LOOP_STEPS: l->loop_steps = n; break;
	case STRING_BYTES: l->string_bytes = n; break;
	case TOKENS: l->tokens = n; break;
	case ELEMENTS: l->elements = n; break;
	case OBJECTS: l->objects = n; break;
	case TEXTURE_PIXELS: l->texture_pixels = n; break;
	case TEXTURE_BYTES: l->texture_bytes = n; break;
	case MEMORY: l->memory = n; break;
	case SECONDS: l->seconds = value; break;
	}
}

struct read_limits read_limits_fill(const struct read_limits *given)
{
	struct read_limits l = *given;

	for (size_t i = 0; i < LIMITS; i++) {
		if (!(get(&l, i) > 0))
			set(&l, i, read_limit_table[i].value);
	}
	return l;
}

bool read_limits_set(struct read_limits *l, const char *name, double value)
{
	for (size_t i = 0; i < LIMITS; i++) {
		if (strcmp(read_limit_table[i].name, name))
			continue;
		if (!(value >= (i == SECONDS ? 0 : 1)) || !isfinite(value))
			return false;
		set(l, i, value);
		return true;
	}
	return false;
}
