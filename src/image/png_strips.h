/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A PNG picture's rows, filtered and compressed by all threads, a strip of rows each.
 */
#ifndef ALIDADE_IMAGE_PNG_STRIPS_H
#define ALIDADE_IMAGE_PNG_STRIPS_H

#include <stdbool.h>
#include <stddef.h>

#include "image/format.h"

#define PNG_STRIP_BYTES ((size_t)128 << 10) /* before compression, or a row */
#define PNG_STRIPS_ROW ((size_t)0x7f000000) /* bytes of a row, at most: a strip is a chunk, of less than 2^31 */

struct png_strips;

/* One chunk's data, in the order of the file. May not return (libpng). */
typedef void png_strips_put(void *arg, const unsigned char *data, size_t n);

/* NULL: no memory. Job and pick outlive it. */
struct png_strips *png_strips_new(const struct image_job *, const struct image_pick *);
/* All of the picture; how many strips there are and what is in them depends on the picture alone. False: no memory. */
bool png_strips_write(struct png_strips *, png_strips_put *put, void *arg);
void png_strips_free(struct png_strips *); /* NULL is harmless */

#endif
