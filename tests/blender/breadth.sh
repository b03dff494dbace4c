#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Many varied Blender files against POV-Ray: see breadth.py. Takes minutes, so only under ALIDADE_ALL=1
# or when numbers of files are given.
#
#	breadth.sh [ordinary|gallery] [NUMBER...]
. "${ALIDADE_SRC:-.}/tests/tap.sh"
script=breadth
what=${1:-}
case $what in
ordinary) ;;
gallery)
	script=gallery
	shift
	[ $# -eq 0 ] || what=
	;;
?*) what= ;;
*) what=all ;;
esac
[ "$what" != ordinary ] || [ $# -eq 1 ] || what=
[ -n "${ALIDADE_ALL:-}" ] || [ -z "$what" ] || skip_all "only ./dev check --all makes files with Blender"
need blender povray python3
# Debian's own python3 has numpy, whatever comes first in the path.
python=python3
python3 -c 'import numpy' 2>/dev/null || python=/usr/bin/python3
if ! $python -c 'import numpy' 2>/dev/null; then
	[ -z "${ALIDADE_CI:-}" ] || { echo "Bail out! python3-numpy is missing"; exit 1; }
	skip_all "python3-numpy is not installed"
fi
export ALIDADE ALIDADE_SRC ALIDADE_BUILD PYTHONDONTWRITEBYTECODE=1
trap - EXIT
# shellcheck disable=SC2154 # tap.sh sets it
rm -rf "$tap_dir"
exec $python "$ALIDADE_SRC/tests/blender/$script.py" "$@"
