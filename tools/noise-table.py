#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes src/pattern/noise_table.h and cell_table.h: the tables behind POV-Ray's noise, by measuring it.
#
#   tools/noise-table.py          measure, and write the headers
#   tools/noise-table.py --check  measure, and compare with the headers as they stand
#
# POV-Ray's noise is a lattice noise as Perlin described it (An Image Synthesizer, SIGGRAPH 1985): the eight
# corners of a cell are hashed to a value and three slopes each, four neighbours in a list of reals, and
# blended by 3t^2 - 2t^3. The hash is a shuffled list of 0 to 4095, shuffled by the linear congruential
# generator that is also behind the language's rand(). So one value of the vector noise is a sum of known
# weights times the reals, and 267 reals are the solution of some thousand linear equations, one for every
# component of vturbulence(2, 0.5, 1, P) that POV-Ray prints. They come out to 1e-13, and as all of them then
# are within that of a number of six digits, such numbers are what is written.
#
# The gradients of the third noise generator (Perlin's of the same paper, whose values at the corners are 0)
# and its permutation are made by the same congruential generator. What is random a unit cell (cells, crackle,
# facets) is the standard Mersenne Twister's output, as the pattern cells shows, by the same hash. The waves'
# sources are the directions of the vector noise at 0, 1, 2 ... on the x axis, and their frequencies once more
# from the congruential generator.
import argparse
import itertools
import math
import os
import random
import subprocess
import sys
import tempfile

import numpy

REALS = 267
SHUFFLED = 4096
ENTRIES = 2048
WAVES = 10
FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "src", "pattern")


class Congruential:
	def __init__(self, seed):
		self.state = seed

	def next(self):
		self.state = (self.state * 1812433253 + 12345) & 0xffffffff
		return self.state >> 16 & 0x7fff


def shuffled():
	rnd = Congruential(0)
	table = list(range(SHUFFLED))
	for i in range(SHUFFLED - 1, -1, -1):
		j = rnd.next() % SHUFFLED
		table[i], table[j] = table[j], table[i]
	return table


def gradients():
	"""Integers whose directions are the gradients, and the permutation."""
	rnd = Congruential(1)
	vectors = []
	while len(vectors) < ENTRIES:
		v = [rnd.next() % (2 * ENTRIES) - ENTRIES for _ in range(3)]
		s = sum((c / ENTRIES) ** 2 for c in v)
		if 1e-5 <= s <= 1:
			vectors.append(v)
	# One entry too many takes part, a 0: so 0 stands in the permutation twice and another number never.
	table = list(range(ENTRIES)) + [0]
	for i in range(ENTRIES, 0, -2):
		j = rnd.next() % ENTRIES
		table[i], table[j] = table[j], table[i]
	return vectors, table[:ENTRIES]


def mersenne(count):
	"""MT19937 as Matsumoto and Nishimura published it, from its default seed."""
	state = [5489]
	for i in range(1, 624):
		state.append(1812433253 * (state[-1] ^ state[-1] >> 30) + i & 0xffffffff)
	generator = numpy.random.RandomState()
	generator.set_state(("MT19937", state, 624))
	return numpy.frombuffer(generator.bytes(4 * count), dtype="<u4")


def povray(lines):
	"""What POV-Ray prints for expressions of strings."""
	with tempfile.TemporaryDirectory() as folder:
		name = os.path.join(folder, "measure.pov")
		with open(name, "w") as f:
			f.write('#version 3.7;\n#include "functions.inc"\ncamera { location 0 }\n')
			for line in lines:
				f.write('#debug concat("= ", %s, "\\n")\n' % line)
		said = subprocess.run(["povray", "+I" + name, "+W4", "+H4", "-D", "-F"], capture_output=True, check=True)
	found = [line[2:] for line in said.stderr.decode("latin1").splitlines() if line.startswith("= ")]
	if len(found) != len(lines):
		sys.exit("povray printed %d lines, not %d" % (len(found), len(lines)))
	return [[float(w) for w in line.split()] for line in found]


def corners(p, table):
	"""(weight, place in the reals, offset from the corner) of a point's eight corners."""
	low = [math.floor(c) for c in p]
	cell = [c + 10000 & 4095 for c in low]
	t = [a - b for a, b in zip(p, low)]
	for d in itertools.product((0, 1), repeat=3):
		weight = 1
		for a, b in zip(t, d):
			s = a * a * (3 - 2 * a)
			weight *= s if b else 1 - s
		at = 0
		for a, b in zip(cell, d):
			at = table[(at ^ a + b) & 4095]
		yield weight, at & 255, [a - b for a, b in zip(t, d)]


def measured_reals(table):
	random.seed(1)
	points = [[random.randint(-1999, 1999) / 64 for _ in range(3)] for _ in range(3000)]
	values = povray(['vstr(3, vturbulence(2, 0.5, 1, <%r,%r,%r>), " ", 0, 17)' % tuple(p) for p in points])
	matrix = numpy.zeros((3 * len(points), REALS))
	for i, p in enumerate(points):
		for weight, at, offset in corners(p, table):
			for k in range(3):
				matrix[3 * i + k, at + 4 * k] += weight * 0.5
				for a in range(3):
					matrix[3 * i + k, at + 4 * k + 1 + a] += weight * offset[a]
	right = numpy.array(values).ravel()
	reals, _, rank, _ = numpy.linalg.lstsq(matrix, right, rcond=None)
	digits = [float("%.6g" % r) for r in reals]
	off = max(abs(a - b) for a, b in zip(reals, digits))
	left = numpy.abs(matrix @ numpy.array(digits) - right).max()
	if rank < REALS or off > 1e-12 or left > 1e-12:
		sys.exit("not solved: rank %d, %g from six digits, %g left over" % (rank, off, left))
	return digits


def listing(kind, name, size, texts):
	lines, line = [], "\t"
	for text in texts:
		if len(line) + 7 + len(text) > 119:
			lines.append(line.rstrip())
			line = "\t"
		line += text + ", "
	return "static const %s %s[%s] = {\n%s\n%s\n};\n" % (kind, name, size, "\n".join(lines), line.rstrip(" ,"))


HEAD = """/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * %s.
 * Made by tools/noise-table.py, which says how: do not edit.
 */
#ifndef ALIDADE_PATTERN_%s_H
#define ALIDADE_PATTERN_%s_H

#include <stdint.h>

"""


def noise_header():
	table = shuffled()
	vectors, permutation = gradients()
	reals = measured_reals(table)
	return HEAD % (("The tables behind the noise",) + 2 * ("NOISE_TABLE",)) + """#define NOISE_REALS %d
#define NOISE_SHUFFLED %d
#define NOISE_ENTRIES %d

/* Solved from what POV-Ray prints. */
%s
/* 0 to 4095, shuffled. */
%s
/* x, y, z of gradients, not unit. */
%s
%s
#endif
""" % (REALS, SHUFFLED, ENTRIES,
       listing("double", "noise_real", "NOISE_REALS", ["%.6g" % r for r in reals]),
       listing("uint16_t", "noise_shuffled", "NOISE_SHUFFLED", [str(i) for i in table]),
       listing("int16_t", "noise_gradient", "3 * NOISE_ENTRIES", [str(c) for v in vectors for c in v]),
       listing("uint16_t", "noise_permutation", "NOISE_ENTRIES", [str(i) for i in permutation]))


def waves():
	"""(x, y, z, frequency) of each wave."""
	rnd = Congruential(-560851967)
	for x, y, z in povray(['vstr(3, vturbulence(2, 0.5, 1, <%d, 0, 0>), " ", 0, 17)' % i for i in range(WAVES)]):
		length = math.sqrt(x * x + y * y + z * z)
		yield x / length, y / length, z / length, rnd.next() * 0.000030518509476 + 0.01


def cell_header():
	return HEAD % (("What is random a unit cell, three numbers each; and the first waves",) + 2 * ("CELL_TABLE",)) + """/* Of 4294967296. */
%s
#define CELL_WAVES %d

/* x, y, z, frequency of each. */
%s
#endif
""" % (listing("uint32_t", "cell_random", "4096 + 2", ["%du" % i for i in mersenne(SHUFFLED + 2)]), WAVES,
       listing("double", "cell_wave", "4 * CELL_WAVES", ["%.17g" % c for w in waves() for c in w]))


HEADERS = {"noise_table.h": noise_header, "cell_table.h": cell_header}


def main():
	args = argparse.ArgumentParser(description="Make the tables behind POV-Ray's noise by measuring it.")
	args.add_argument("--check", action="store_true", help="only compare with the headers as they stand")
	check = args.parse_args().check
	bad = 0
	for name, make in HEADERS.items():
		text = make()
		path = os.path.join(FOLDER, name)
		if not check:
			with open(path, "w") as f:
				f.write(text)
			continue
		with open(path) as f:
			if f.read() != text:
				print("%s is not what is measured" % name)
				bad = 1
	return bad


if __name__ == "__main__":
	sys.exit(main())
