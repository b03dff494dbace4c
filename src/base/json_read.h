/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Reading JSON (RFC 8259), strictly: a text becomes a tree of values in an arena.
 */
#ifndef ALIDADE_BASE_JSON_READ_H
#define ALIDADE_BASE_JSON_READ_H

#include <stddef.h>

#include "base/mem.h"

enum json_kind { JSON_NULL, JSON_FALSE, JSON_TRUE, JSON_NUMBER, JSON_STRING, JSON_ARRAY, JSON_OBJECT };

struct json_value {
	enum json_kind kind;
	double number;
	const char *text; /* JSON_STRING: UTF-8; ends at the first zero, should it hold one */
	const char *key; /* of a value in an object, else NULL */
	const struct json_value *child, *next; /* an array's or object's first value; its neighbour */
};

/* The one value that the n bytes hold; NULL: what they hold is no JSON, is deeper than JSON_DEPTH, or
 * memory ran out, and *fault then says so. */
const struct json_value *json_read(const char *text, size_t n, struct arena *, const char **fault);

/* Down through objects by keys: "seconds.render". NULL: there is no such value. v may be NULL. */
const struct json_value *json_at(const struct json_value *v, const char *path);
/* What is there if it is of that kind; otherwise the other. */
double json_number_at(const struct json_value *v, const char *path, double otherwise);
const char *json_text_at(const struct json_value *v, const char *path, const char *otherwise);

#endif
