#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Indirect light against POV-Ray's radiosity at a quality at which it has converged (references.sh makes the
# pictures): RMS error at most 0.004, mean error at most 0.001 along the sRGB curve, with all defaults. And the same
# bytes for every accelerator, number of threads and tile.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need_exr
cd "$ALIDADE_SRC/tests/indirect" || exit 99

render()
{
	out=$1
	shift
	"$ALIDADE" -q --progress=none -s 80x60 -o "$tap_dir/$out" "$@"
}
compare()
{
	render "$1.exr" "$1.pov" &&
		"$ALIDADE_BUILD/tools/alidade-diff" --srgb --channels=rgb --fail=1 --warn=1 --warnpercent=100 \
			--max-rmse=0.004 --max-mean=0.001 "$1.exr" "$tap_dir/$1.exr"
}
differs()
{
	! cmp -s "$tap_dir/$1" "$tap_dir/$2"
}

for scene in *.pov; do
	ok "$scene" compare "${scene%.pov}"
done
ok "1 thread, large tiles" render a.pfm -t 1 --tile=64 --indirect-samples 16 bounces.pov
ok "7 threads, small tiles, no accelerator" render b.pfm -t 7 --tile=8 -a none --indirect-samples 16 bounces.pov
ok "give the same bytes" cmp "$tap_dir/a.pfm" "$tap_dir/b.pfm"
ok "another seed" render c.pfm --seed=1 --indirect-samples 16 bounces.pov
ok "gives others" differs a.pfm c.pfm
ok "--indirect=off" render d.pfm --indirect=off legacy.pov
ok "with it" render e.pfm --indirect-samples 4 legacy.pov
ok "is another picture" differs d.pfm e.pfm
tap_done
