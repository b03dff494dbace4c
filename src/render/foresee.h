/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * About how many rays a picture will take, before any is traced.
 */
#ifndef ALIDADE_RENDER_FORESEE_H
#define ALIDADE_RENDER_FORESEE_H

#include "render/render.h"

/* From the size, the samples and what the scene has; a guess, off by some factor either way. No byte of a picture
 * may depend on it. */
double render_foresee(const struct scene *, const struct render_options *);

#endif
