/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Functions that a scene uses, copied into its arena with all that they call. Calls are followed to the depth
 * that the registers allow.
 */
#include "scene/function.h"

#include "scene/scene.h"

/* A copy of an array; of nothing there is none. */
static bool copy(struct scene *s, void *array, uint32_t count, size_t size)
{
	void **at = array;

	if (!count)
		return true;
	*at = arena_memdup(&s->arena, *at, mem_product(count, size));
	return *at != NULL;
}

static bool adopt_program(struct scene *s, struct copies *c, struct function *f)
{
	if (!copy(s, &f->is.program.op, f->is.program.op_count, sizeof(struct function_op)) ||
	    !copy(s, &f->is.program.constant, f->is.program.constant_count, sizeof(double)) ||
	    !copy(s, &f->is.program.call, f->is.program.call_count, sizeof(struct function_call)))
		return false;
	for (uint32_t i = 0; i < f->is.program.call_count; i++) {
		struct function_call *call = &f->is.program.call[i];

		call->function = scene_adopt_function(s, c, call->function);
		if (!call->function)
			return false;
	}
	return true;
}

static bool adopt_spline(struct scene *s, struct function *f)
{
	struct spline *to;

	if (!copy(s, &f->is.spline, 1, sizeof(*to)))
		return false;
	to = f->is.spline;
	return copy(s, &to->at, to->count, sizeof(double)) &&
	       copy(s, &to->value, to->count, FUNCTION_RESULTS * sizeof(double)) &&
	       copy(s, &to->bend, to->bend ? to->count : 0, FUNCTION_RESULTS * sizeof(double));
}

struct function *scene_adopt_function(struct scene *s, struct copies *c, const struct function *from)
{
	bool new, ok = true;
	struct function *f = copies_take(s, c, from, sizeof(*f), &new);

	if (!f || !new)
		return f;
	if (f->kind == FUNCTION_PROGRAM)
		ok = adopt_program(s, c, f);
	else if (f->kind == FUNCTION_PATTERN)
		ok = scene_adopt_pattern(s, c, &f->is.pattern);
	else if (f->kind == FUNCTION_PIGMENT)
		ok = (f->is.pigment = scene_adopt_pigment(s, c, f->is.pigment)) != NULL;
	else if (f->kind == FUNCTION_SPLINE)
		ok = adopt_spline(s, f);
	return ok ? f : NULL;
}
