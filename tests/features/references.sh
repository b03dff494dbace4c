#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Render POV-Ray's pictures of the feature scenes anew: linear, half float, one ray through each pixel's
# centre, one thread. Usage: references.sh [NAME ...]
set -eu
cd "$(dirname "$0")"
[ $# -gt 0 ] || set -- *.pov
for name; do
	name=${name%.pov}
	case $name in alpha-*) alpha=+UA ;; *) alpha=-UA ;; esac
	log=$(povray +I"$name.pov" +O"$name.exr" +FE $alpha +W96 +H72 -A -D -J +WT1 -GA 2>&1) || {
		echo "$log" >&2
		exit 1
	}
	echo "$name.exr"
done
