#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# --noise has no bias, knows its error, and keeps to what is asked: see seeds.c. Some scenes and seeds, and with
# $ALIDADE_ALL eight scenes and 200 seeds, and two in which light comes seldom.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$ALIDADE_SRC/tests/budget" || exit 99
seeds=$ALIDADE_BUILD/tests/budget/seeds
if [ -n "${ALIDADE_ALL:-}" ]; then
	"$seeds" 0.01 200 air.pov below.pov edges.pov glass.pov lamp.pov lens.pov room.pov wood.pov -m rare.pov seldom.pov
else
	"$seeds" 0.02 40 edges.pov room.pov wood.pov -m rare.pov
fi
