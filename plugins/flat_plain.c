/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * flat_walk.h in plain C: for every machine.
 */
#define ISA_LEVEL 0
#define ISA_NAME flat_plain
#include "flat_walk.h"
