#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Whole pictures at all sizes and far from the origin: see pictures.py. ALIDADE_ALL=1 takes all accelerators,
# more sizes and larger pictures.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need python3
# Debian's own python3 has numpy, whatever comes first in the path.
python=python3
python3 -c 'import numpy' 2>/dev/null || python=/usr/bin/python3
if ! $python -c 'import numpy' 2>/dev/null; then
	[ -z "${ALIDADE_CI:-}" ] || { echo "Bail out! python3-numpy is missing"; exit 1; }
	skip_all "python3-numpy is not installed"
fi
export ALIDADE ALIDADE_SRC PYTHONDONTWRITEBYTECODE=1
trap - EXIT
# shellcheck disable=SC2154 # tap.sh sets it
rm -rf "$tap_dir"
exec $python "$ALIDADE_SRC/tests/numerics/pictures.py"
