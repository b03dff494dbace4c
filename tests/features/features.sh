#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# One small scene for each thing that shading knows, against POV-Ray's picture of the same file (references.sh
# makes them): 99.5 % of the pixels within 1/255 in every channel after sRGB encoding, nothing non-finite.
# What POV-Ray draws with random numbers (soft-*.pov, with as many samples as make its own noise small):
# root mean square error at most 0.004, mean error at most 0.001.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need_exr
cd "$ALIDADE_SRC/tests/features" || exit 99

compare()
{
	"$ALIDADE" -q --progress=none -s 96x72 --aa none -o "$tap_dir/$1.exr" "$1.pov" &&
		"$ALIDADE_BUILD/tools/alidade-diff" --srgb --channels=rgb --fail=1/255 --failpercent=0.5 \
			--warn=1 --warnpercent=100 --max-mean=0.0005 "$1.exr" "$tap_dir/$1.exr"
}

soft()
{
	"$ALIDADE" -q --progress=none -s 96x72 --aa none -o "$tap_dir/$1.exr" "$1.pov" &&
		"$ALIDADE_BUILD/tools/alidade-diff" --srgb --channels=rgb --fail=1 \
			--max-rmse=0.004 --max-mean=0.001 "$1.exr" "$tap_dir/$1.exr"
}

# With the alpha channel, as POV-Ray's +UA; all four channels count.
alpha()
{
	"$ALIDADE" -q --progress=none -s 96x72 --aa none --alpha -o "$tap_dir/$1.exr" "$1.pov" &&
		"$ALIDADE_BUILD/tools/alidade-diff" --srgb --fail=1/255 --failpercent=0.5 \
			--warn=1 --warnpercent=100 --max-mean=0.0005 "$1.exr" "$tap_dir/$1.exr"
}

for scene in *.pov; do
	case $scene in
	alpha-*) ok "$scene" alpha "${scene%.pov}" ;;
	soft-*) ok "$scene" soft "${scene%.pov}" ;;
	*) ok "$scene" compare "${scene%.pov}" ;;
	esac
done
tap_done
