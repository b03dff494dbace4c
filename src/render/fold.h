/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * From the leaves of the ray tree to its roots.
 */
#ifndef ALIDADE_RENDER_FOLD_H
#define ALIDADE_RENDER_FOLD_H

#include "shade/tree.h"

/* Fill in every node's colour and transmit; children stand behind their parents. */
void fold_tree(struct tree *);

#endif
