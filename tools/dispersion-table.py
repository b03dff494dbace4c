#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes src/shade/pov/spectrum_table.h: the colours of POV-Ray's dispersion, by measuring them.
#
#   tools/dispersion-table.py          measure, and write the header
#   tools/dispersion-table.py --check  measure, and compare with the header as it stands
#
# A ray goes straight down into glass whose surface is tilted, and is split into N bands. On the bottom a pattern
# lets one pixel see the light of one band only: the surface shows white between the two places where rays of
# the indices between band i and its neighbours arrive. So a picture of N pixels is the list of the bands'
# colours, and that band i arrives where it should proves the law of the indices: ior D^(0.5 - (i + 0.5) / N).
#
# With 480 bands their colours are a staircase with 70 steps of equal width. So what stands behind it is 71 values
# of a sum over the spectrum, with straight lines between; with 70 bands, their differences are seen, each a
# multiple of 1/10000 to the picture's own resolution.
import argparse
import os
import subprocess
import sys
import tempfile

STEPS = 70
UNIT = 10000
SEES = 20 # a band's light is brightened by so much
HEADER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "src", "shade", "pov", "spectrum_table.h")

SCENE = """#version 3.7;
global_settings {{ assumed_gamma 1 adc_bailout 0 }}
camera {{ orthographic location <0, 0, -5> direction z right x up 1e-6 * y }}
#declare C = sqrt(0.5);
#declare Ratio = function(e) {{ 1 / (1.5 * pow(1.5, 0.5 - e)) }}
#declare Shift = function(r) {{ (r * C - sqrt(1 - r * r * (1 - C * C))) * C }}
#declare Lands = function(e) {{ 10 * Shift(Ratio(e)) / (Ratio(e) - Shift(Ratio(e))) }}
#declare Band = function(x) {{ floor((x + 0.5) * {bands}) }}
plane {{ <0, C, -C>, 0
	pigment {{ rgbf 1 }} finish {{ diffuse 0 ambient 0 }}
	interior {{ ior 1.5 dispersion 1.5 dispersion_samples {bands} }}
}}
plane {{ -z, -10
	pigment {{
		function {{ select((y - Lands(Band(x) / {bands})) * (y - Lands((Band(x) + 1) / {bands})), 0, 1) }}
		color_map {{ [0 rgb {sees}] [1 rgb 0] }}
	}}
	finish {{ emission 1 diffuse 0 ambient 0 }}
}}
"""


def picture(folder, bands, sees):
	"""The bands' colours, from 0 to 1."""
	name = os.path.join(folder, "measure.pov")
	out = os.path.join(folder, "measure.ppm")
	with open(name, "w") as f:
		f.write(SCENE.format(bands=bands, sees=sees))
	subprocess.run(["povray", "+I" + name, "+O" + out, "+FP16", "File_Gamma=1.0", "+W%d" % bands, "+H1", "-A",
			"-D", "-J", "-GA"], capture_output=True, check=True)
	with open(out, "rb") as f:
		data = f.read()
	if not data.startswith(b"P6"):
		sys.exit("povray wrote no PPM file")
	body = data[-6 * bands:]
	value = [int.from_bytes(body[i:i + 2], "big") / 65535 / sees for i in range(0, len(body), 2)]
	return [value[i:i + 3] for i in range(0, len(value), 3)]


def check_steps(folder, table):
	"""Bands that are finer than the steps show them, and nothing else."""
	fine = 7 * STEPS
	for i, colour in enumerate(picture(folder, fine, 100)):
		for seen, step in zip(colour, table[i * STEPS // fine]):
			if abs(seen * 7 - step / UNIT) > 0.0001:
				sys.exit("the bands' colours are no staircase: band %d of %d" % (i, fine))


def measured():
	with tempfile.TemporaryDirectory() as folder:
		table = []
		for colour in picture(folder, STEPS, SEES):
			table.append([round(c * UNIT) for c in colour])
			off = max(abs(c * UNIT - t) for c, t in zip(colour, table[-1]))
			if off > 0.05:
				sys.exit("not a multiple of 1/%d: %g off" % (UNIT, off))
		check_steps(folder, table)
	return table


def header(table):
	total, rows = [0, 0, 0], ["\t{ 0, 0, 0 }"]
	for row in table:
		total = [a + b for a, b in zip(total, row)]
		rows.append("\t{ %d, %d, %d }" % tuple(total))
	return """/* SPDX-FileCopyrightText: 2026 The Alidade authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The colours of the spectrum, from violet to red, summed up: measured.
 * Made by tools/dispersion-table.py, which says how: do not edit.
 */
#ifndef ALIDADE_SHADE_POV_SPECTRUM_TABLE_H
#define ALIDADE_SHADE_POV_SPECTRUM_TABLE_H

#include <stdint.h>

#define SPECTRUM_STEPS %d
#define SPECTRUM_UNIT %d

/* Red, green, blue of all light up to this step. */
static const uint16_t spectrum_sum[SPECTRUM_STEPS + 1][3] = {
%s
};

#endif
""" % (STEPS, UNIT, ",\n".join(rows))


def main():
	args = argparse.ArgumentParser(description="Make the colours of POV-Ray's dispersion by measuring them.")
	args.add_argument("--check", action="store_true", help="only compare with the header as it stands")
	text = header(measured())
	if not args.parse_args().check:
		with open(HEADER, "w") as f:
			f.write(text)
		return 0
	with open(HEADER) as f:
		if f.read() == text:
			return 0
	print("spectrum_table.h is not what is measured")
	return 1


if __name__ == "__main__":
	sys.exit(main())
