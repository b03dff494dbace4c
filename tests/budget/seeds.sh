#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# --noise has no bias, knows its error, and keeps to what is asked: see seeds.c. Some scenes and seeds, and with
# $ALIDADE_ALL eight scenes and 200 seeds, one with light below surfaces, and two in which light comes seldom.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$ALIDADE_SRC/tests/budget" || exit 99
seeds=$ALIDADE_BUILD/tests/budget/seeds
if [ -n "${ALIDADE_ALL:-}" ]; then
	# Light below surfaces comes from a few rays that count much: 66 and 91 of 100 were measured.
	"$seeds" -s 200 -n 0.01 air.pov edges.pov glass.pov hall.pov lamp.pov lens.pov room.pov wood.pov \
		-t 5 below.pov -n 0.02 -m rare.pov seldom.pov
else
	"$seeds" -s 40 -n 0.02 edges.pov room.pov wood.pov -m rare.pov
fi
