/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#ifdef HAVE_CONFIG_H
#include <config.h>
#endif

#include "base/process.h"

#include <dlfcn.h>
#include <fenv.h>
#include <locale.h>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

void process_arithmetic(void)
{
#if defined __SSE2__ && defined __x86_64__
	enum { DEFAULT = 0x1f80, FLAGS = 0x3f }; /* of MXCSR: all traps masked; what has happened so far */

	if ((_mm_getcsr() & ~(unsigned)FLAGS) == DEFAULT)
		return;
#endif
	fesetenv(FE_DFL_ENV);
}

void process_begin(void)
{
	process_arithmetic();
	setlocale(LC_ALL, "C");
}

void *process_load(const char *path, int flags)
{
	void *handle = dlopen(path, flags);

	process_begin();
	return handle;
}
