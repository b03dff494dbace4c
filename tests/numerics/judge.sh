#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Every accelerator, or with shapes every round primitive, against exact arithmetic: see judge.c and shapes.c.
# ALIDADE_ALL=1 asks 201,000 and 20,000 rays a cell instead of 600 and 200, of a seed that is new each day
# (an hour or more); ALIDADE_SEED chooses another.
#
#	judge.sh [judge|shapes] [OPTION...]
. "${ALIDADE_SRC:-.}/tests/tap.sh"
program=$ALIDADE_BUILD/tests/numerics/${1:-judge}
if [ ! -x "$program" ]; then
	[ -z "${ALIDADE_CI:-}" ] || { echo "Bail out! libgmp-dev is missing"; exit 1; }
	skip_all "libgmp-dev is not installed"
fi
trap - EXIT
# shellcheck disable=SC2154 # tap.sh sets it
rm -rf "$tap_dir"
few=600 many=201000
[ "${1:-judge}" = judge ] || few=200 many=20000
[ $# -eq 0 ] || shift
if [ -n "${ALIDADE_ALL:-}" ]; then
	exec "$program" -n $many -s "${ALIDADE_SEED:-$(date +%Y%m%d)}" "$@"
fi
exec "$program" -n $few -s "${ALIDADE_SEED:-1}" "$@"
