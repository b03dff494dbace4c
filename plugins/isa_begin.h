/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What follows, up to isa_end.h, is compiled for the instruction set ISA_LEVEL: 1 SSE4.2, 2 AVX2 with FMA, BMI and
 * BMI2, 3 AVX-512F, DQ and VL too (isa_here() tells which of them a processor has). For x86 only, once a file. Included
 * before a header, that header's functions are compiled so, too, and it knows what there is.
 */
#include <immintrin.h> /* first: its functions have targets of their own */

#ifdef __clang__
#if ISA_LEVEL == 1
#pragma clang attribute push(__attribute__((target("sse4.2"))), apply_to = function)
#elif ISA_LEVEL == 2
#pragma clang attribute push(__attribute__((target("avx2,fma,bmi,bmi2"))), apply_to = function)
#else
#pragma clang attribute push(__attribute__((target("avx2,fma,bmi,bmi2,avx512f,avx512dq,avx512vl"))), \
			     apply_to = function)
#endif
#elif ISA_LEVEL == 1
#pragma GCC target("sse4.2")
#elif ISA_LEVEL == 2
#pragma GCC target("avx2,fma,bmi,bmi2")
#else
#pragma GCC target("avx2,fma,bmi,bmi2,avx512f,avx512dq,avx512vl")
#endif
