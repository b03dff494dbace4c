/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A function's program while it is written.
 */
#ifndef ALIDADE_READ_POV_PROGRAM_H
#define ALIDADE_READ_POV_PROGRAM_H

#include "read/pov/function.h"
#include "read/pov/internal.h"

#define PROGRAM_LOOPS 16

struct program {
	struct pov *p;
	struct pov_function *out;
	struct atom *param[FUNCTION_PARAMS];
	uint32_t param_count;
	bool plain; /* parameters were not named: they are x, y and z */
	struct { /* of the sums that are open */
		struct atom *atom;
		uint16_t reg;
	} loop[PROGRAM_LOOPS];
	uint32_t loop_count;
	struct buf op, constant, call;
	uint32_t top, most; /* registers in use; at most so far */
	uint32_t called; /* registers that the greediest callee needs */
};

/* What a part of the program gives: a number that is known now, or one in a register. */
struct operand {
	bool constant;
	double k;
	uint16_t reg;
};

void program_emit(struct program *, enum function_code, uint32_t to, uint32_t a, uint32_t b);
uint32_t program_here(const struct program *); /* the number of the next op */
uint16_t program_register(struct program *); /* the next free one */
struct operand program_number(double);
struct operand program_in(uint32_t reg);
/* The operand's register, loaded if need be. */
uint16_t program_load(struct program *, struct operand);
/* Have it in this register. */
void program_put(struct program *, uint16_t reg, struct operand);
/* Results go to register base, which is then the only one in use from there on. */
struct operand program_two(struct program *, enum function_code, struct operand a, struct operand b, uint32_t base);
struct operand program_one(struct program *, enum function_code, struct operand a, uint32_t base);
struct operand program_call(struct program *, const struct pov_function *, uint32_t first, uint32_t member,
			    uint32_t base);
/* The whole program, into out. */
bool program_finish(struct program *, struct operand result);
void program_release(struct program *);

#endif
