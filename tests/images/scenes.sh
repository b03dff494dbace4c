#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Every scene of scenes/ with every accelerator, and against POV-Ray's picture: see scenes.py. Under
# ALIDADE_ALL=1 also what is too large to be committed, exported by Blender now.
#
#	scenes.sh [SCENE...]
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need python3
need_exr
# Debian's own python3 has numpy, whatever comes first in the path.
python=python3
python3 -c 'import numpy' 2>/dev/null || python=/usr/bin/python3
if ! $python -c 'import numpy' 2>/dev/null; then
	[ -z "${ALIDADE_CI:-}" ] || { echo "Bail out! python3-numpy is missing"; exit 1; }
	skip_all "python3-numpy is not installed"
fi
if [ -n "${ALIDADE_ALL:-}" ] && command -v blender >/dev/null; then
	mkdir -p "$ALIDADE_BUILD/scenes"
	large=$(awk '!/^#/ && /large/ { print $1 }' "$ALIDADE_SRC/scenes/scenes.txt")
	# shellcheck disable=SC2086 # words
	sh "$ALIDADE_SRC/scenes/export.sh" --missing --into "$ALIDADE_BUILD/scenes" $large | sed 's/^/# /'
fi
export ALIDADE ALIDADE_SRC ALIDADE_BUILD PYTHONDONTWRITEBYTECODE=1
trap - EXIT
# shellcheck disable=SC2154 # tap.sh sets it
rm -rf "$tap_dir"
exec $python "$ALIDADE_SRC/tests/images/scenes.py" "$@"
