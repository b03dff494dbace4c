#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# alidade/kernel.h gives the same bits whoever compiles it and however (rule R5).
. "${ALIDADE_SRC:-.}/tests/tap.sh"

# hash_of COMPILER FLAGS ...
hash_of()
{
	"$@" -std=c17 -ffp-contract=off -I"$ALIDADE_SRC/include" -o "$tap_dir/bits" \
		"$ALIDADE_SRC/tests/numerics/kernel_bits.c" -lm && "$tap_dir/bits"
}

need gcc
want=$(hash_of gcc -O0)
ok "gcc -O0 prints a hash" test -n "$want"
for cc in gcc clang; do
	for flags in -O0 -O2 "-O3" "-O3 -march=native"; do
		if command -v $cc >/dev/null 2>&1; then
			# shellcheck disable=SC2086
			is "$cc $flags" "$(hash_of $cc $flags)" "$want"
		else
			skip "$cc $flags" "$cc is not installed"
		fi
	done
done
tap_done
