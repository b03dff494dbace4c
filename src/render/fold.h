/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * From the leaves of the ray tree to its roots.
 */
#ifndef ALIDADE_RENDER_FOLD_H
#define ALIDADE_RENDER_FOLD_H

#include "shade/shade.h"

/* Fill in the colour, its variance and transmit of n nodes from first on, whose children's are known. */
void fold_nodes(const struct shader *, struct tree *, uint32_t first, uint32_t n);

#endif
