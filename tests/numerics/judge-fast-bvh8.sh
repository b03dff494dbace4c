#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# What bvh8 gets wrong with --precision=fast: told, and sane. See judge.c.
exec sh "${ALIDADE_SRC:-.}/tests/numerics/judge.sh" judge -p fast -a bvh8
