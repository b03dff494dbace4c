/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A scene as text, one thing a line: for `alidade --dry-run -v` and for tests.
 */
#ifndef ALIDADE_SCENE_DUMP_H
#define ALIDADE_SCENE_DUMP_H

#include <stdio.h>

#include "scene/scene.h"

enum {
	SCENE_DUMP_ARRAYS = 1, /* the contents of meshes too */
	SCENE_DUMP_PLACES = 2 /* file:line:col of what has one */
};

/* Numbers are written so that reading them gives the same double. */
void scene_dump(const struct scene *, unsigned what, FILE *to);

#endif
