/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The instruction sets that parts of a plugin are compiled for, and which of them this processor has.
 */
#ifndef ISA_H
#define ISA_H

#include <alidade/accel.h>
#include <stdio.h>

enum { ISA_AUTO, ISA_PLAIN, ISA_SSE, ISA_AVX2, ISA_AVX512, ISA_COUNT };

static const char *const isa_label[] = { "auto", "plain", "sse", "avx2", "avx512", NULL };

#define ISA_PARAM { "isa", "instruction set; auto: the best there is", ALD_CHOICE, ISA_AUTO, 0, 4, isa_label }

/* Short loops over axes, corners or lanes, whose arrays are to stay in registers: -O2 alone leaves them in memory. */
#ifdef __clang__
#define UNROLL _Pragma("clang loop unroll(full)")
#else
#define UNROLL _Pragma("GCC unroll 8")
#endif

static inline int isa_here(unsigned isa)
{
#if defined __x86_64__
	switch (isa) {
	case ISA_SSE:
		return !!__builtin_cpu_supports("sse4.2");
	case ISA_AVX2:
		return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
		       __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
	case ISA_AVX512:
		return isa_here(ISA_AVX2) && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
		       __builtin_cpu_supports("avx512vl");
	default:
		break;
	}
#endif
	return isa == ISA_PLAIN;
}

/* The one to take, or ISA_AUTO: there is none such here, and *err says so. */
static inline unsigned isa_choose(unsigned want, ald_error *err)
{
	if (want == ISA_AUTO) {
		for (want = ISA_COUNT - 1; !isa_here(want);)
			want--;
		return want;
	}
	if (isa_here(want))
		return want;
	snprintf(err->text, sizeof(err->text), "isa=%s: this processor does not have it; give isa=auto",
		 isa_label[want]);
	return ISA_AUTO;
}

#endif
