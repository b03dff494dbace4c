#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Every accelerator against exact arithmetic: see judge.c. ALIDADE_ALL=1 asks 201,000 rays a cell instead of
# 600, of a seed that is new each day; ALIDADE_SEED chooses another.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
judge=$ALIDADE_BUILD/tests/numerics/judge
if [ ! -x "$judge" ]; then
	[ -z "${ALIDADE_CI:-}" ] || { echo "Bail out! libgmp-dev is missing"; exit 1; }
	skip_all "libgmp-dev is not installed"
fi
trap - EXIT
# shellcheck disable=SC2154 # tap.sh sets it
rm -rf "$tap_dir"
if [ -n "${ALIDADE_ALL:-}" ]; then
	exec "$judge" -n 201000 -s "${ALIDADE_SEED:-$(date +%Y%m%d)}"
fi
exec "$judge" -n 600 -s "${ALIDADE_SEED:-1}"
