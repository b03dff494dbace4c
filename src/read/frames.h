/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Which frames of an animation are drawn, what time it is in each, and what their files are called
 * (POV-Ray's manual 3.2.8.2, and what its program was measured to do).
 */
#ifndef ALIDADE_READ_FRAMES_H
#define ALIDADE_READ_FRAMES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define FRAME_MAX 999999999u
#define FRAME_SPANS 64u

struct frame_span { /* first, first + step ... up to last */
	uint32_t first, last, step;
};

/* What an .ini or the command line says of an animation; a field is given if its bit in set is. */
enum {
	FRAMES_INITIAL = 1, FRAMES_FINAL = 2, FRAMES_INITIAL_CLOCK = 4, FRAMES_FINAL_CLOCK = 8,
	FRAMES_SUBSET_START = 16, FRAMES_SUBSET_END = 32, FRAMES_STEP = 64, FRAMES_CLOCK = 128
};

struct frame_settings {
	unsigned set;
	uint32_t initial_frame, final_frame, step;
	double initial_clock, final_clock;
	double clock; /* a fixed one */
	double subset_start, subset_end; /* frame numbers, or shares of all below 1 */
	bool cyclic; /* the frame after the last one would be the first */
};

/* One frame, as the scene sees it. */
struct frame_now {
	bool clock_on;
	bool guessed; /* nobody has said how long the animation is: clock may not be what is meant */
	uint32_t number, initial, final;
	double clock, initial_clock, final_clock, clock_delta;
};

struct frame_plan {
	bool animated; /* false: one picture, no number */
	bool guessed;
	uint32_t initial, final;
	uint32_t digits; /* of a number in a file's name */
	double initial_clock, final_clock, clock_delta;
	bool clock_fixed;
	double clock;
	uint32_t span_count;
	struct frame_span span[FRAME_SPANS];
};

/* "1,3..9,20..100:10" into at most FRAME_SPANS; false: not of this form. */
bool frames_parse(const char *text, struct frame_span *span, uint32_t *count);
/* list: the frames asked for; count 0: what the settings say. */
void frames_plan(struct frame_plan *, const struct frame_settings *, const struct frame_span *list,
		 uint32_t count);
uint64_t frames_count(const struct frame_plan *);
/* The i-th of them. */
uint32_t frames_number(const struct frame_plan *, uint64_t i);
void frames_now(const struct frame_plan *, uint32_t number, struct frame_now *);

/* The last #### of the name becomes the number, of at least so many digits. */
bool frames_has_place(const char *name);
/* A name without #### gets the number before its ending if insert. false: too long. */
bool frames_name(char *out, size_t size, const char *name, uint32_t number, uint32_t digits, bool insert);

#endif
