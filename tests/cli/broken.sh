#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Input that is no geometry, and light that is no number: left out or masked, counted, named, told by the status.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need python3
cd "$tap_dir" || exit 99

head='#version 3.7; global_settings { assumed_gamma 1 }
camera { location <0, 0, -5> look_at 0 } light_source { <3, 5, -9> rgb 1 }'

# of FILE EXPRESSION: of the report, j.
of()
{
	python3 -c 'import json, sys; j = json.load(open(sys.argv[1])); print(eval(sys.argv[2]))' "$@"
}

draw()
{
	"$ALIDADE" --progress=none -s 32x24 --stats="$1.json" -o "$1.ppm" "$1.pov" 2>"$1.err"
}

# ---- primitives ----
cat >good.pov <<END
$head
mesh2 { vertex_vectors { 4, <-1, -1, 0>, <1, -1, 0>, <1, 1, 0>, <-1, 1, 0> }
	face_indices { 2, <0, 1, 2>, <0, 2, 3> } pigment { rgb 1 } }
END
cat >bad.pov <<END
$head
mesh2 { vertex_vectors { 4, <-1, -1, 0>, <1, -1, 0>, <1, 1, 0>, <-1, 1, 0> }
	face_indices { 5, <0, 1, 2>, <0, 0, 1>, <0, 2, 3>, <1, 1, 1>, <3, 2, 3> } pigment { rgb 1 } }
mesh { triangle { 0, x, y } triangle { 0, x, 2*x } scale 1e150 }
sphere { 0, 0 }
cylinder { 0, y, 0 }
torus { 1, 0 }
disc { 0, y, 0 }
sphere { 0, 1 scale 1e150 }
sphere { <1e99, 0, 0>, 1 }
cone { 0, 0, y, 0 open }
END
ok "a scene without flaws" draw good
is "says nothing" "$(cat good.err)" ""
is "drops nothing" "$(of good.json 'j["geometry"]["dropped"]')" 0
ok "a scene with many" draw bad
is "is the same picture" "$(cksum <bad.ppm)" "$(cksum <good.ppm)"
is "drops them" "$(of bad.json 'j["geometry"]["dropped"], j["geometry"]["triangles"]')" "(12, 2)"
is "and says so in one line" "$(cat bad.err)" "alidade: warning: 12 primitives without area, or too large, left out: \
3 triangles of the mesh in bad.pov:3, the first being number 1; 2 triangles of the mesh in bad.pov:5, the first being \
number 0; the sphere in bad.pov:6; the cone or cylinder in bad.pov:7; the torus in bad.pov:8; the disc in bad.pov:9; \
and of 3 more objects"
ok "--dry-run says so too" sh -c '"$ALIDADE" --dry-run bad.pov 2>/dev/null | grep -q "left out.* 12$"'
ok "-q says nothing" test -z "$("$ALIDADE" -q -s 8x6 -o q.ppm bad.pov 2>&1)"

# A mesh of which several copies stand in the scene is one, and named where it first stands.
cat >copies.pov <<END
$head
#declare M = mesh2 { vertex_vectors { 3, 0, x, y } face_indices { 70, #for (I, 1, 69) <0, 1, 2>, #end <0, 1, 1> } }
object { M pigment { rgb 1 } }
object { M pigment { rgb 1 } translate x }
END
ok "copies" draw copies
is "are named once" "$(cat copies.err)" \
	"alidade: warning: 1 primitive without area, or too large, left out: 1 triangle of the mesh in copies.pov:4, number 69"

# Smooth faces stand first in memory; the number is the file's.
cat >smooth.pov <<END
$head
mesh2 { vertex_vectors { 3, 0, x, y } normal_vectors { 3, z, z+x, z+y }
	face_indices { 3, <0, 1, 2>, <0, 0, 1>, <0, 1, 2> }
	normal_indices { 3, <0, 0, 0>, <0, 0, 0>, <0, 1, 2> } pigment { rgb 1 } }
END
ok "smooth faces" draw smooth
is "keep their numbers" "$(sed 's/.*pov:3, //' smooth.err)" "number 1"

# ---- light ----
# The left half of the picture is too bright for a float; below it is bright.
cat >light.pov <<END
$head
background { rgb 0.25 }
box { <-9, -9, 1>, <0, 9, 2> pigment { rgb 1e30 } finish { emission 1e30 diffuse 0 } }
END
draw light
is "light that is not finite has a status of its own" $? 6
is "is counted" "$(of light.json 'j["nonfinite"], j["nonfinite_first"]')" "(384, {'x': 0, 'y': 0})"
is "and told in a line" "$(cat light.err)" "alidade: error: 384 pixels have samples that are not finite numbers, the \
first at 0,0; they are black in the picture. Unless the scene's numbers are extreme, please report it with the scene"
is "the picture is black there, and no other pixel is touched" "$(python3 -c '
data = open("light.ppm", "rb").read()[-32 * 24 * 3:]
rows = [data[96 * y:96 * y + 96] for y in range(24)]
print(all(r[:48] == bytes(48) and set(r[48:]) == {137} for r in rows))')" True
"$ALIDADE" -q -s 32x24 -t 3 --tile 5 -o light3.ppm light.pov 2>light3.err
is "with 3 threads too" "$?: $(cat light3.err)" "6: $(cat light.err)"
if has_exr; then
	"$ALIDADE" -q -s 32x24 --alpha -o light.exr light.pov 2>/dev/null
	is "a picture of floats" $? 6
	"$ALIDADE_BUILD/tools/alidade-diff" light.exr light.exr >diff.txt 2>&1
	is "has finite numbers only" $? 0
fi
tap_done
