/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 */
#include "base/sobol.h"

static uint32_t reversed(uint32_t x)
{
	x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
	x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
	x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
	x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
	return x << 16 | x >> 16;
}

/* Owen's scrambling of a number whose bits stand in reverse (the hash of Laine and Karras). */
static uint32_t scramble(uint32_t x, uint32_t seed)
{
	x += seed;
	x ^= x * 0x6c50b47cu;
	x ^= x * 0xb82f1e52u;
	x ^= x * 0xc7afe638u;
	return x ^ x * 0x8d22f6e6u;
}

static uint32_t point(uint32_t index, uint32_t dim)
{
	static const uint32_t direction[SOBOL_DIMS][32] = {
		{ 0x80000000, 0x40000000, 0x20000000, 0x10000000, 0x08000000, 0x04000000,
		  0x02000000, 0x01000000, 0x00800000, 0x00400000, 0x00200000, 0x00100000,
		  0x00080000, 0x00040000, 0x00020000, 0x00010000, 0x00008000, 0x00004000,
		  0x00002000, 0x00001000, 0x00000800, 0x00000400, 0x00000200, 0x00000100,
		  0x00000080, 0x00000040, 0x00000020, 0x00000010, 0x00000008, 0x00000004,
		  0x00000002, 0x00000001 },
		{ 0x80000000, 0xc0000000, 0xa0000000, 0xf0000000, 0x88000000, 0xcc000000,
		  0xaa000000, 0xff000000, 0x80800000, 0xc0c00000, 0xa0a00000, 0xf0f00000,
		  0x88880000, 0xcccc0000, 0xaaaa0000, 0xffff0000, 0x80008000, 0xc000c000,
		  0xa000a000, 0xf000f000, 0x88008800, 0xcc00cc00, 0xaa00aa00, 0xff00ff00,
		  0x80808080, 0xc0c0c0c0, 0xa0a0a0a0, 0xf0f0f0f0, 0x88888888, 0xcccccccc,
		  0xaaaaaaaa, 0xffffffff },
		{ 0x80000000, 0xc0000000, 0x60000000, 0x90000000, 0xe8000000, 0x5c000000,
		  0x8e000000, 0xc5000000, 0x68800000, 0x9cc00000, 0xee600000, 0x55900000,
		  0x80680000, 0xc09c0000, 0x60ee0000, 0x90550000, 0xe8808000, 0x5cc0c000,
		  0x8e606000, 0xc5909000, 0x6868e800, 0x9c9c5c00, 0xeeee8e00, 0x5555c500,
		  0x8000e880, 0xc0005cc0, 0x60008e60, 0x9000c590, 0xe8006868, 0x5c009c9c,
		  0x8e00eeee, 0xc5005555 },
		{ 0x80000000, 0xc0000000, 0x20000000, 0x50000000, 0xf8000000, 0x74000000,
		  0xa2000000, 0x93000000, 0xd8800000, 0x25400000, 0x59e00000, 0xe6d00000,
		  0x78080000, 0xb40c0000, 0x82020000, 0xc3050000, 0x208f8000, 0x51474000,
		  0xfbea2000, 0x75d93000, 0xa0858800, 0x914e5400, 0xdbe79e00, 0x25db6d00,
		  0x58800080, 0xe54000c0, 0x79e00020, 0xb6d00050, 0x800800f8, 0xc00c0074,
		  0x200200a2, 0x50050093 },
	};
	uint32_t x = 0;

	for (uint32_t i = 0; index; index >>= 1, i++)
		x ^= index & 1 ? direction[dim][i] : 0;
	return x;
}

struct sobol sobol_make(uint64_t key)
{
	struct sobol s = { .order = (uint32_t)rng_child(key, SOBOL_DIMS) };

	for (uint32_t i = 0; i < SOBOL_DIMS; i++)
		s.scramble[i] = (uint32_t)rng_child(key, i);
	return s;
}

double sobol_at(const struct sobol *s, uint32_t index, uint32_t dim)
{
	uint32_t at = reversed(scramble(reversed(index), s->order));

	return reversed(scramble(reversed(point(at, dim)), s->scramble[dim])) * 0x1p-32;
}
