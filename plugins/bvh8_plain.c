/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * bvh8's walk in plain C: for every machine.
 */
#define ISA_LEVEL 0
#define ISA_NAME bvh8_plain
#define ISA_TEXT "plain"
#include "bvh8_walk.h"
