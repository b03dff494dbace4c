#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# The EXAMPLES of alidade(1), line by line as they stand there.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$tap_dir" || exit 99
mkdir bin
ln -s "$ALIDADE" bin/alidade
PATH=$PWD/bin:$PATH
cp "$ALIDADE_SRC/tests/cli/scene.pov" .

sed -n '/^\.Sh EXAMPLES/,/^\.Sh DIAG/s/^\.Dl //p' "$ALIDADE_SRC/man/alidade.1" >lines
ok "the page has examples" test -s lines
while read -r line; do
	case $line in
	*.exr*) has_exr || { skip "$line" "built without OpenEXR"; continue; } ;;
	esac
	ok "$line" sh -c "$line"
done <lines
for picture in scene.png scene.exr part.ppm piped.png; do
	[ $picture != scene.exr ] || has_exr || continue
	ok "$picture is there" test -s "$picture"
done
ok "octree.json is there" test -s octree.json
tap_done
