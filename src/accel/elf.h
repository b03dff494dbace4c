/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * A look into a plugin's file before any of its code can run.
 *
 * dlopen() runs a library's constructors, and dies of SIGBUS on a file whose end is missing. So the
 * file is checked first: is it whole, does it export the one symbol, and which ABI does that name.
 */
#ifndef ALIDADE_ACCEL_ELF_H
#define ALIDADE_ACCEL_ELF_H

#include <stdint.h>

struct elf_peek {
	uint32_t found; /* 1: abi and size are the entry's first two words */
	uint32_t abi, size;
};

/* NULL, or what is wrong with the file. Of a kind of file that is not known here, nothing is said. */
const char *elf_peek_file(const char *path, const char *symbol, struct elf_peek *out);

#endif
