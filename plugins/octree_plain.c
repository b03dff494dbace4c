/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * octree_trace.h in plain C: for every machine.
 */
#define ISA_LEVEL 0
#define ISA_NAME octree_plain
#include "octree_trace.h"
