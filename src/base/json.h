/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Writing JSON (RFC 8259): reports, progress lines, figures of a comparison.
 *
 * Values are written in the order of the calls, to any stdio stream (open_memstream() for a
 * string). Inside an object each value has a key; inside an array, and at the top, the key is NULL.
 * Numbers are the shortest that read back to the same double; NaN and Inf, which JSON lacks, become
 * null. Text is taken as UTF-8; bytes that are not are written as U+FFFD, so that the result is
 * always valid.
 */
#ifndef ALIDADE_BASE_JSON_H
#define ALIDADE_BASE_JSON_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#define JSON_DEPTH 64

enum json_layout {
	JSON_LINE, /* all on one line, as "JSON lines" want it */
	JSON_INDENT /* one value a line, tabs */
};

struct json {
	FILE *out;
	enum json_layout layout;
	uint32_t depth;
	uint64_t object; /* bit d: level d is an object, not an array */
	uint64_t filled; /* bit d: level d has a value already */
	bool misused; /* a key missing or too many, or too deep: a mistake in the program */
};

void json_init(struct json *, FILE *out, enum json_layout);
void json_object(struct json *, const char *key);
void json_array(struct json *, const char *key);
void json_end(struct json *); /* of the innermost object or array */
void json_string(struct json *, const char *key, const char *value); /* NULL: null */
void json_double(struct json *, const char *key, double value);
void json_uint(struct json *, const char *key, uint64_t value);
void json_int(struct json *, const char *key, int64_t value);
void json_bool(struct json *, const char *key, bool value);
void json_null(struct json *, const char *key);
/* Ends the line and flushes. false: the stream has failed, or the calls did not make a whole
 * value. */
bool json_finish(struct json *);

#endif
