/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What a scene requires, without rendering it: things by kind, features, memory.
 */
#ifndef ALIDADE_LOOK_REQUIRE_H
#define ALIDADE_LOOK_REQUIRE_H

#include <stdio.h>

#include "scene/scene.h"

void require_text(const struct scene *, FILE *out);

#endif
