#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Round primitives from far away: see shapes.c.
exec sh "${ALIDADE_SRC:-.}/tests/numerics/judge.sh" shapes
