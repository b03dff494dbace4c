#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# The same picture to the byte, whichever way its hits take to their colours: the short way without trees, the short way
# within trees, because there is a mirror somewhere, or the long way, because there is glass somewhere. Both are where
# nobody sees them.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$tap_dir" || exit 99

cat >scene.inc <<'END'
global_settings { assumed_gamma 1.5 max_trace_level 4 }
camera { location <0.1, 2, -6> look_at <0, 0.5, 0> }
background { color rgb <0.1, 0.2, 0.4> }
light_source { <4, 6, -5> color rgb <1, 0.9, 0.8> fade_distance 6 fade_power 2 }
light_source { <-5, 4, -2> color rgb 0.6 spotlight point_at 0 radius 20 falloff 40 tightness 3 }
light_source { <0, 9, 3> color rgb 0.3 parallel point_at 0 }
plane { y, -1 pigment { color rgb 0.7 } }
sphere { <-1.5, 0, 0>, 1 pigment { color rgb <1, 0.3, 0.2> } finish { phong 0.7 metallic } }
box { <0.4, -1, -0.5>, <1.6, 0.7, 0.6> rotate 30 * y pigment { color rgb <0.2, 0.9, 0.3> }
	finish { specular 0.4 roughness 0.02 diffuse 0.5, 0.3 brilliance 2 emission 0.05 } }
cylinder { <0, -1, 1.5>, <0, 2, 1.5>, 0.4 open pigment { color rgb <0.9, 0.9, 0.2> }
	interior_texture { pigment { color rgb <0, 0, 1> } } double_illuminate }
disc { <2.4, 0.5, 1>, <-1, 0.2, -1>, 0.8 pigment { color rgb <0.6, 0.2, 0.9> } no_shadow }
mesh2 {
	vertex_vectors { 4, <-1, 1.2, -1>, <0.5, 1.2, -1.2>, <0.2, 2.2, -0.4>, <-0.8, 2.3, 0> }
	normal_vectors { 4, <-1, 1, -1>, <1, 1, -1>, <1, 2, 1>, <-1, 2, 1> }
	texture_list { 3, texture { pigment { color rgb <1, 0, 0> } } texture { pigment { color rgb <0, 1, 0> } }
		texture { pigment { color rgb <0, 0, 1> } finish { ambient 0.3 } } }
	face_indices { 2, <0, 1, 2>, 0, 1, 2, <0, 2, 3>, 2 }
}
#declare Tent = mesh {
	smooth_triangle { <-0.5, 0, 0>, <-1, 1, -1>, <0, 1, 0>, <0, 1, -1>, <0.5, 0, 0>, <1, 1, -1> }
	smooth_triangle { <-0.5, 0, 0>, <-1, 1, 1>, <0, 1, 0>, <0, 1, 1>, <0, 0, 0.6>, <0, 0, 1> }
	triangle { <0.5, 0, 0>, <0, 1, 0>, <0, 0, 0.6> }
	triangle { <0.5, 0, 0>, <-0.5, 0, 0>, <0, 0, 0.6> }
}
object { Tent translate <-2.6, -1, -1> pigment { color rgb <0.5, 0.6, 1> } finish { diffuse 0.6, 0.4 } }
object { Tent scale <-1, 1.4, 1> rotate 20 * y translate <2.3, -1, -1.5> pigment { color rgb <1, 0.6, 0.2> }
	finish { phong 0.5 specular 0.3 ambient 0.2 } double_illuminate }
object { Tent rotate 70 * z translate <-0.6, -0.8, -1.6> pigment { color rgb 0.9 } finish { brilliance 1.5 } no_shadow }
mesh2 {
	vertex_vectors { 5, <1, -1, -3>, <1.6, -1, -3>, <1.6, -0.4, -3>, <1, -0.4, -3>, <1.3, -0.7, -3.3> }
	texture_list { 2, texture { pigment { color rgb <1, 1, 0> } } texture { pigment { color rgb <0, 1, 1> } } }
	face_indices { 4, <0, 1, 4>, 0, <1, 2, 4>, 1, <2, 3, 4>, 0, <3, 0, 4>, 1 }
}
light_group {
	light_source { <-2, 3, -5> color rgb <0.5, 0, 0.5> }
	object { Tent scale 0.6 translate <0, 1.6, -1.2> pigment { color rgb 1 } }
	global_lights off
}
END
echo '#include "scene.inc"' >short.pov
{ cat short.pov; echo 'sphere { <0, 0, -5e3>, 1 pigment { color rgb 1 } finish { reflection 1 } }'; } >mirror.pov
{ cat short.pov; echo 'sphere { <0, 0, -5e3>, 1 pigment { color rgbt 1 } interior { ior 1.5 } }'; } >glass.pov

for aa in none 2 pov1:threshold=0.1 pov1:threshold=0,depth=3 pov2; do
	for i in short mirror glass; do
		ok "$i, $aa" "$ALIDADE" -q -s 81x61 --aa=$aa -o $i.ppm $i.pov
	done
	ok "in the tree is the same" cmp short.ppm mirror.ppm
	ok "the long way is the same" cmp short.ppm glass.ppm
done
for i in short mirror glass; do
	ok "$i, alpha" "$ALIDADE" -q -s 81x61 --alpha -a none -t 2 -o $i.pfm $i.pov --stats=$i.json
	grep -E -A 3 '"camera"|"shadow"' $i.json | grep -E 'cast|hit' >$i.rays
done
ok "alpha: in the tree is the same" cmp short.pfm mirror.pfm
ok "alpha: the long way is the same" cmp short.pfm glass.pfm
ok "as many rays are counted" cmp short.rays mirror.rays
ok "verified" "$ALIDADE" -q -s 81x61 --verify=1 -o verified.ppm short.pov

tap_done
