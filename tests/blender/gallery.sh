#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# The scenes of docs/exporter.md, as our own exporter writes them, against POV-Ray: see gallery.py. Takes half an hour on two
# processors, so only under ALIDADE_ALL=1 or when names of scenes are given.
#
#	gallery.sh [NAME...]
exec sh "${ALIDADE_SRC:-.}/tests/blender/breadth.sh" gallery "$@"
