/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What building was said to take, and what it took.
 */
#ifndef ALIDADE_LOOK_MEMORY_H
#define ALIDADE_LOOK_MEMORY_H

#include <stdio.h>

#include "accel/trace.h"
#include "base/json_write.h"

void memory_building_text(const struct geometry *, FILE *out);
/* An object "building". */
void memory_building_json(struct json_writer *, const struct geometry *);

#endif
