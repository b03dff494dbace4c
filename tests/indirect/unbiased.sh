#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Indirect light has no bias and knows its noise: see unbiased.py.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need python3
need_exr
# Debian's own python3 has numpy, whatever comes first in the path.
python=python3
works='import numpy, OpenImageIO'
python3 -c "$works" 2>/dev/null || python=/usr/bin/python3
if ! $python -c "$works" 2>/dev/null; then
	[ -z "${ALIDADE_CI:-}" ] || { echo "Bail out! python3-numpy or python3-openimageio is missing"; exit 1; }
	skip_all "python3-numpy or python3-openimageio is not installed"
fi
export ALIDADE ALIDADE_SRC PYTHONDONTWRITEBYTECODE=1
# shellcheck disable=SC2154 # tap.sh sets it
$python "$ALIDADE_SRC/tests/indirect/unbiased.py" "$tap_dir"
