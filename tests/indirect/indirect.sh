#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Indirect light against POV-Ray's radiosity at a quality at which it has converged (references.sh makes the
# pictures): RMS error at most 0.004, mean error at most 0.001 along the sRGB curve, with all defaults; 0.006 and
# 0.002 for the cache. And the same bytes for every accelerator, number of threads and tile.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need_exr
cd "$ALIDADE_SRC/tests/indirect" || exit 99

render()
{
	out=$1
	shift
	"$ALIDADE" -q --progress=none -s 80x60 -o "$tap_dir/$out" "$@"
}
# compare SCENE RMSE MEAN [OPTION...]
compare()
{
	scene=$1 rmse=$2 mean=$3
	shift 3
	render "$scene.exr" "$@" "$scene.pov" &&
		"$ALIDADE_BUILD/tools/alidade-diff" --srgb --channels=rgb --fail=1 --warn=1 --warnpercent=100 \
			--max-rmse="$rmse" --max-mean="$mean" "$scene.exr" "$tap_dir/$scene.exr"
}
differs()
{
	! cmp -s "$tap_dir/$1" "$tap_dir/$2"
}

for scene in *.pov; do
	ok "$scene" compare "${scene%.pov}" 0.004 0.001
done
# In so small pictures the finest grid is coarse.
for scene in *.pov; do
	ok "$scene, cache" compare "${scene%.pov}" 0.006 0.002 --indirect=cache
done
ok "1 thread, large tiles" render a.pfm -t 1 --tile=64 --indirect-samples 16 bounces.pov
ok "7 threads, small tiles, no accelerator" render b.pfm -t 7 --tile=8 -a none --indirect-samples 16 bounces.pov
ok "give the same bytes" cmp "$tap_dir/a.pfm" "$tap_dir/b.pfm"
ok "a cache, 1 thread" render f.pfm --indirect=cache -t 1 --tile=64 bounces.pov
ok "7 threads, no accelerator" render g.pfm --indirect=cache -t 7 --tile=8 -a none bounces.pov
ok "give the same bytes" cmp "$tap_dir/f.pfm" "$tap_dir/g.pfm"
ok "another seed" render c.pfm --seed=1 --indirect-samples 16 bounces.pov
ok "gives others" differs a.pfm c.pfm
ok "--indirect=off" render d.pfm --indirect=off legacy.pov
ok "with it" render e.pfm --indirect-samples 4 legacy.pov
ok "is another picture" differs d.pfm e.pfm
tap_done
