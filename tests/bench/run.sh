#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Measurements, behind ./dev bench. They print tables; no test depends on a time.
#
#	run.sh lecture [--runs N]              what the lecture counted, see lecture.py
#	run.sh povray [--runs N] [--threads N] against POV-Ray, see povray.py
#	run.sh indirect [--runs N] [--threads N] [--exact]  indirect light at POV-Ray's own error, see indirect.py
#	run.sh rays [options] [ENGINE ...]     rays a second beside Embree, see rays.c
#	run.sh peers [--runs N] [--threads 1,2] whole programs, file to picture, see whole.py
#	run.sh scale [--all]                   how cost grows from 1,000 triangles to 100 million, see scale.py
#	run.sh precision [--runs N] [--size WxH] what exact answers cost and floats save, see precision.py
set -u
: "${ALIDADE_SRC:=$(cd "$(dirname "$0")/../.." && pwd)}"
: "${ALIDADE_BUILD:=$ALIDADE_SRC/build}"
: "${ALIDADE:=$ALIDADE_BUILD/src/alidade}"
: "${ALIDADE_ACCEL_PATH:=$ALIDADE_BUILD/plugins/.libs}"
export ALIDADE ALIDADE_SRC ALIDADE_BUILD ALIDADE_ACCEL_PATH PYTHONDONTWRITEBYTECODE=1
which=${1:-both}
[ $# -eq 0 ] || shift
python=python3
case $which in # what is not made otherwise
lecture | both)
	make -C "$ALIDADE_BUILD" -s tests/bench/lecture_rays || exit 1
	;;
esac
case $which in
lecture) ;;
rays)
	make -C "$ALIDADE_BUILD" -s tests/bench/rays || exit 1
	exec "$ALIDADE_BUILD/tests/bench/rays" "$@"
	;;
peers)
	make -C "$ALIDADE_BUILD" -s tests/bench/scene_files || exit 1
	exec python3 "$ALIDADE_SRC/tests/bench/whole.py" "$@"
	;;
scale)
	make -C "$ALIDADE_BUILD" -s tests/bench/rays || exit 1
	exec python3 "$ALIDADE_SRC/tests/bench/scale.py" "$@"
	;;
precision)
	make -C "$ALIDADE_BUILD" -s tests/bench/rays || exit 1
	exec python3 "$ALIDADE_SRC/tests/bench/precision.py" "$@"
	;;
povray | both | indirect)
	command -v povray >/dev/null || {
		echo "bench: povray is not installed; ./dev deps installs it" >&2
		exit 1
	}
	scene=landscape
	[ "$which" != indirect ] || scene=radiosity
	mkdir -p "$ALIDADE_BUILD/scenes"
	sh "$ALIDADE_SRC/scenes/export.sh" --missing --into "$ALIDADE_BUILD/scenes" $scene || exit 1
	;;
*)
	echo "Usage: ./dev bench [lecture|povray|indirect|peers|precision|rays|scale] [OPTIONS]" >&2
	exit 2
	;;
esac
if [ "$which" = indirect ]; then
	# Debian's own python3 has numpy, whatever comes first in the path.
	python3 -c 'import numpy' 2>/dev/null || python=/usr/bin/python3
	exec $python "$ALIDADE_SRC/tests/bench/indirect.py" "$@"
fi
[ "$which" = povray ] || python3 "$ALIDADE_SRC/tests/bench/lecture.py" "$@" || exit
[ "$which" = lecture ] || exec python3 "$ALIDADE_SRC/tests/bench/povray.py" "$@"
