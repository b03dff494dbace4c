/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Scanning plain lists of numbers straight from the bytes of a file.
 *
 * Each function reads one element from at, with the blanks and comments before it and the comma behind
 * it, and returns what follows. NULL: the element is not plain (not only numbers with signs, in the
 * right number), or might go on (a ">" with an operator behind it), or is not whole before end; then
 * whatever was written to out means nothing.
 */
#ifndef ALIDADE_READ_POV_SCAN_H
#define ALIDADE_READ_POV_SCAN_H

#include <stddef.h>
#include <stdint.h>

const char *scan_vector(const char *at, const char *end, double out[3]); /* finite */
const char *scan_vector2(const char *at, const char *end, double out[2]); /* finite */
const char *scan_indices3(const char *at, const char *end, uint32_t out[3]);
/* <a,b,c> and up to three whole numbers behind it, *count of them. */
const char *scan_face(const char *at, const char *end, uint32_t out[3], uint32_t extra[3],
		      int *count);
/* Where what is not blank or a comment begins; NULL: nowhere before end, or a comment is not plain. */
const char *scan_blanks(const char *at, const char *end);
/* How many bytes are what. */
size_t scan_count(const char *at, const char *end, char what);

#endif
