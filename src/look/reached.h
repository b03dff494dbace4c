/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What was asked of a picture's noise and time, and what became of it: a sentence, and JSON.
 */
#ifndef ALIDADE_LOOK_REACHED_H
#define ALIDADE_LOOK_REACHED_H

#include <stddef.h>

#include "base/json_write.h"
#include "render/render.h"

/* seconds: since the frame was begun. */
void reached_text(const struct render_reached *, double seconds, char *out, size_t size);
/* An object "budget". */
void reached_json(struct json_writer *, const struct render_reached *);

#endif
