/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Functions compiled once more for wider instruction sets; the best is taken when the program starts. As nothing is
 * contracted or reordered (-ffp-contract=off), all copies give the same bits. Loops over lanes have to be
 * plain and of a constant length, and what such a function calls has to be inlined into it (LANED). It has to be
 * static: clang gives others names that its callers do not know.
 */
#ifndef ALIDADE_BASE_WIDE_H
#define ALIDADE_BASE_WIDE_H

#if defined __x86_64__ && defined __GNUC__ && !defined __AVX2__ && !defined __SANITIZE_ADDRESS__
#define WIDE __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define WIDE
#endif

#define LANES 8u /* values that such loops take at a time */

#ifdef __GNUC__
#define LANED static inline __attribute__((always_inline))
#else
#define LANED static inline
#endif

#endif
