#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# judge.sh asks many rays of a few meshes; some mistakes of builders show in few meshes, but there to any ray. So here
# are the meshes of other seeds, with a few rays each.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
program=$ALIDADE_BUILD/tests/numerics/judge
if [ ! -x "$program" ]; then
	[ -z "${ALIDADE_CI:-}" ] || { echo "Bail out! libgmp-dev is missing"; exit 1; }
	skip_all "libgmp-dev is not installed"
fi
for seed in 1 2 3 4 5 6 7 8; do
	ok "default, seed $seed" "$program" -n 20 -s $seed -a octree -a bvh8 -a bvh8:build=fast
	ok "exact, seed $seed" "$program" -p exact -n 20 -s $seed -a bvh8
done
tap_done
