#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# --noise has no bias, knows its error, and keeps to what is asked: see seeds.c. Three scenes, and with
# $ALIDADE_ALL all eight with more seeds and two more noises.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$ALIDADE_SRC/tests/budget" || exit 99
seeds=$ALIDADE_BUILD/tests/budget/seeds
"$seeds" 0.02 60 edges.pov seldom.pov glass.pov
