/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What a scene requires, without rendering it: things by kind, features, structure, memory.
 */
#ifndef ALIDADE_LOOK_REQUIRE_H
#define ALIDADE_LOOK_REQUIRE_H

#include <stdio.h>

#include "accel/trace.h"
#include "base/mem.h"
#include "scene/scene.h"

/* accel: as by accel_describe(). all: every mesh, not the first ones only. */
void require_text(const struct scene *, const struct geometry *, const char *accel, const struct mem_book *,
		  bool all, FILE *out);

#endif
