#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Many ordinary Blender files, with radiosity, image textures, hair and all that, against POV-Ray: see against.py.
# Takes half an hour on two processors, so only under ALIDADE_ALL=1 or when numbers of files are given.
#
#	ordinary.sh [NUMBER...]
exec sh "${ALIDADE_SRC:-.}/tests/blender/breadth.sh" ordinary "$@"
