#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Make the golden values anew: what POV-Ray's own #debug says for each scene of this folder, without the
# newlines that it adds at column 80 (the test compares without newlines). Run it here.
set -eu
for scene in *.pov; do
	povray "+I$scene" -D -F -GS -GR -GW -GF +GDgolden.tmp +W2 +H2 </dev/null >golden.log 2>&1 || {
		grep -A 2 Error golden.log || cat golden.log
		exit 1
	}
	tr -d '\n' <golden.tmp >"${scene%.pov}.txt"
	echo >>"${scene%.pov}.txt"
done
rm -f golden.tmp golden.log
