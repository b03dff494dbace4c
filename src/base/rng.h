/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Random numbers that depend on what they are for, never on the thread or the order of work: a 64-bit
 * key is hashed (the finaliser of MurmurHash3, with Stafford's constants, mix 13).
 */
#ifndef ALIDADE_BASE_RNG_H
#define ALIDADE_BASE_RNG_H

#include <stdint.h>

static inline uint64_t rng_mix(uint64_t x)
{
	x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
	x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
	return x ^ (x >> 31);
}

/* A key for the i-th thing that belongs to key. */
static inline uint64_t rng_child(uint64_t key, uint64_t i)
{
	return rng_mix(key + (i + 1) * 0x9e3779b97f4a7c15u);
}

/* 0 <= x < 1 */
static inline double rng_unit(uint64_t key)
{
	return (double)(rng_mix(key) >> 11) * 0x1p-53;
}

#endif
