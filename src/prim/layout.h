/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Filling the levels that compile.c has chosen.
 */
#ifndef ALIDADE_PRIM_LAYOUT_H
#define ALIDADE_PRIM_LAYOUT_H

#include "prim/compile.h"

/* The level of the instanced mesh. */
enum status layout_mesh_level(struct prim_set *, uint32_t level, struct diag *);
/* Level 0 and the unbounded list, after all other levels. */
enum status layout_world(struct prim_set *, struct diag *);

#endif
