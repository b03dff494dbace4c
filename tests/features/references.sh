#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Render POV-Ray's pictures of the feature scenes anew: linear, half float, one ray through each pixel's
# centre, one thread. Usage: references.sh [NAME ...]
set -eu
cd "$(dirname "$0")"
[ $# -gt 0 ] || set -- *.pov

# Jittered lamps, light below surfaces: other blocks of pixels meet other random numbers, and their mean has less noise.
mean()
{
	dir=$(mktemp -d)
	set -- "$1" 0
	for block in 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 22 24 26 28 30 34 38; do
		povray +I"$1.pov" +O"$dir/one.exr" +FE +W96 +H72 -A -D -J +WT1 -GA +BS"$block" >/dev/null 2>&1 ||
			exit 1
		if [ "$2" -eq 0 ]; then
			oiiotool "$dir/one.exr" -d float -o "$dir/sum.exr"
		else
			oiiotool "$dir/sum.exr" "$dir/one.exr" --add -d float -o "$dir/sum.exr"
		fi
		set -- "$1" $(($2 + 1))
	done
	oiiotool "$dir/sum.exr" --divc "$2" -d half -o "$1.exr"
	rm -r "$dir"
	echo "$1.exr"
}

for name; do
	name=${name%.pov}
	case $name in soft-lamp* | soft-subsurface*) mean "$name"; continue ;; esac
	case $name in alpha-*) alpha=+UA ;; *) alpha=-UA ;; esac
	log=$(povray +I"$name.pov" +O"$name.exr" +FE $alpha +W96 +H72 -A -D -J +WT1 -GA 2>&1) || {
		echo "$log" >&2
		exit 1
	}
	echo "$name.exr"
done
