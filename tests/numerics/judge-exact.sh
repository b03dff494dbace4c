#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# --precision=exact has nothing wrong, ids included: see judge.c.
exec sh "${ALIDADE_SRC:-.}/tests/numerics/judge.sh" judge -p exact
