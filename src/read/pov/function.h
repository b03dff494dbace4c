/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * User functions and splines, from their text to what pattern/function.h evaluates.
 */
#ifndef ALIDADE_READ_POV_FUNCTION_H
#define ALIDADE_READ_POV_FUNCTION_H

#include "read/pov/parser.h"
#include "scene/function.h"

struct pov_function { /* ITEM_FUNCTION */
	struct function function;
	struct pov_lack lack; /* of what it is made of, or calls */
	uint32_t depth; /* of the patterns in it, as in items.h */
};

/* From behind the word: [(parameters)] { ... }. In the parser's arena; NULL after an error. */
struct pov_function *function_read(struct pov *);
/* spline { ... }; the current token is its word. */
struct spline *spline_read(struct pov *);
/* F(...): the identifier is the current token. v: its components; one value fills them all. */
void function_call(struct pov *, struct pov_value *v);
void spline_call(struct pov *, struct pov_value *v);
/* Can it be asked at a point? Reports if it does not take x, y and z. pos: where it begins. */
bool function_of_points(struct pov *, const struct diag_pos *pos, const struct pov_function *);

#endif
