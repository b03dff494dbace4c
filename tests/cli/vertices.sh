#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# --dry-run says in which precision vertices are kept, and what in the scene decided it.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$tap_dir" || exit 99

# scene FILE LINES ...: the camera takes part in where the scene is.
scene()
{
	file=$1
	shift
	printf '#version 3.7;\nglobal_settings { assumed_gamma 1 }\n' >"$file"
	printf '%s\n' "$@" >>"$file"
}

says()
{
	is "$1" "$("$ALIDADE" -q --dry-run "$2" | grep -E '^  (vertices|floats)')" "$3"
}

triangle='mesh2 { vertex_vectors { 3, 0, x, y } face_indices { 1, <0, 1, 2> }'
scene near.pov "$triangle }" "$triangle translate 3 }"
says "floats where they lose nothing" near.pov "  vertices of 0 meshes in double, of 2 in float, exactly"

scene tenth.pov "$triangle }" "$triangle translate 0.1 * x }" "$triangle translate 3 }"
says "a tenth is no float" tenth.pov "  vertices of 3 meshes in double, of 0 in float, exactly
  floats would change 1 of them, most the one in tenth.pov:4, by 2.4e-08 of its size (2.38e-08 units; it is 1 wide, \
0.6 off the origin)"

scene wide.pov "$triangle }" "$triangle translate 16777216.25 * x }"
says "far from each other: doubles" wide.pov "  vertices of 2 meshes in double, of 0 in float, exactly
  floats would change 1 of them, most the one in wide.pov:4, by 0.75 of its size (0.75 units; it is 1 wide, 1.68e+07 \
off the origin)"

scene far.pov "camera { location <16777216, 0, -4> look_at <16777216, 0, 0> }" "$triangle translate 16777216.25 * x }"
says "all of it far from the origin: another origin, and floats" far.pov "  vertices of 0 meshes in double, of 1 in \
float, exactly
  vertices are relative to <16777216.6, 0, 0>, as the scene is far from the origin"

each()
{
	is "$1" "$("$ALIDADE" -q --dry-run "$2" | sed -n 's/^    //p')" "$3"
}

each "of each mesh, what it is in and why: floats" near.pov "near.pov:3: float, which loses nothing
near.pov:4: float, which loses nothing"
each "of each mesh, what it is in and why: doubles" tenth.pov "tenth.pov:3: double, as others beside it need it
tenth.pov:4: double, floats would change it by 2.4e-08 of its size
tenth.pov:5: double, as others beside it need it"
scene many.pov "#for (I, 1, 12)" "$triangle translate I }" "#end"
is "of twelve the first ten" "$("$ALIDADE" -q --dry-run many.pov | grep -c '^    many.pov:4: float, which')" 10
is "with -v all" "$("$ALIDADE" -v --dry-run many.pov 2>&1 | grep -c '^    many.pov:4: float, which')" 12

scene none.pov "sphere { 0, 1 }"
says "no mesh" none.pov ""
tap_done
