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
#ifndef ALIDADE_BASE_JSON_WRITE_H
#define ALIDADE_BASE_JSON_WRITE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#define JW_DEPTH 64

enum jw_layout {
	JW_LINE, /* all on one line, as "JSON lines" want it */
	JW_INDENT /* one value a line, tabs */
};

struct json_writer {
	FILE *out;
	enum jw_layout layout;
	uint32_t depth;
	uint64_t object; /* bit d: level d is an object, not an array */
	uint64_t filled; /* bit d: level d has a value already */
	bool misused; /* a key missing or too many, or too deep: a mistake in the program */
};

void jw_init(struct json_writer *, FILE *out, enum jw_layout);
void jw_object(struct json_writer *, const char *key);
void jw_array(struct json_writer *, const char *key);
void jw_end(struct json_writer *); /* of the innermost object or array */
void jw_string(struct json_writer *, const char *key, const char *value); /* NULL: null */
void jw_double(struct json_writer *, const char *key, double value);
void jw_uint(struct json_writer *, const char *key, uint64_t value);
void jw_int(struct json_writer *, const char *key, int64_t value);
void jw_bool(struct json_writer *, const char *key, bool value);
void jw_null(struct json_writer *, const char *key);
/* Ends the line and flushes. false: the stream has failed, or the calls did not make a whole
 * value. */
bool jw_finish(struct json_writer *);

#endif
