/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#ifndef TESTS_BENCH_SUZANNE_H
#define TESTS_BENCH_SUZANNE_H

#include <stdint.h>

struct surf {
	uint32_t vertices, triangles;
	double (*v)[3]; /* by malloc */
	uint32_t (*t)[3];
};

/* Blender's monkey, 967 * 4^times triangles, face to -y, up is z; exits where it can't. */
void surf_suzanne(struct surf *, unsigned times);

#endif
