#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# --terminator=hanika: a coarse mesh with smooth normals has its shadow where a fine one has it, and no light comes
# through closed meshes.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need python3
cd "$tap_dir" || exit 99

# A ball of 4 N^2 triangles. Inside: the camera is in it. Size: of everything.
cat >ball.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
#ifndef (N) #declare N = 6; #end
#ifndef (Size) #declare Size = 1; #end
#ifndef (Smooth) #declare Smooth = 1; #end
#ifndef (Lamp) #declare Lamp = 0; #end
#ifndef (Copies) #declare Copies = 1; #end
camera { location <0, 0, #ifdef (Inside) 0 #else -4 * Size #end> look_at z angle 40 }
light_source { <20, 6, 2> * Size rgb 1
	#ifdef (Shadowless) shadowless #end
	#if (Lamp = 1) parallel point_at 0 #end
	#if (Lamp = 2) area_light x * Size, y * Size, 5, 5 adaptive 1 #end }
#macro P(I, J) <sin(pi * J / N) * cos(pi * I / N), cos(pi * J / N), sin(pi * J / N) * sin(pi * I / N)> #end
#macro List() 2 * N * (N + 1), #for (J, 0, N) #for (I, 0, 2 * N - 1) P(I, J), #end #end #end
#declare Ball = mesh2 {
	vertex_vectors { List() }
	#if (Smooth) normal_vectors { List() } #end
	face_indices { 4 * N * N, #for (J, 0, N - 1) #for (I, 0, 2 * N - 1)
		#local A = J * 2 * N + I; #local B = J * 2 * N + mod(I + 1, 2 * N);
		<A, B, A + 2 * N>, <B, B + 2 * N, A + 2 * N>, #end #end }
};
#for (I, 1, Copies)
	object { Ball pigment { rgb 1 } finish { diffuse 1 ambient 0 } rotate 20 * x scale Size translate (I - 1) * 9 * Size * x }
#end
END

draw()
{
	out=$1
	shift
	"$ALIDADE" -q -s 120x90 -o "$out" "$@" ball.pov
}

cat >dark.py <<'END'
"""How many pixels that show the ball are far darker than in another picture of it."""
import sys

def pixels(name):
    return open(name, 'rb').read()[-120 * 90 * 3:]

fine, coarse, shape = map(pixels, sys.argv[1:])
print(sum(a > b + 30 and c > 0 for a, b, c in zip(fine[::3], coarse[::3], shape[::3])))
END

draw shape.ppm --camera-only
for lamp in 0 1 2; do
	draw fine.ppm -D N=90 -D Lamp=$lamp
	draw pov.ppm -D Lamp=$lamp
	draw hanika.ppm -D Lamp=$lamp --terminator=hanika
	pov=$(python3 dark.py fine.ppm pov.ppm shape.ppm)
	hanika=$(python3 dark.py fine.ppm hanika.ppm shape.ppm)
	ok "lamp $lamp: facets are dark at the terminator" test "$pov" -gt 150
	ok "lamp $lamp: with hanika hardly a pixel is" test "$hanika" -le $((pov / 4))
	# Nothing hides anything of a ball. A few pixels of its outline are seen from behind, by their normals.
	draw truth.ppm -D Lamp=$lamp -D Shadowless=1
	hanika=$(python3 dark.py truth.ppm hanika.ppm shape.ppm)
	ok "lamp $lamp: and none that should be lit" test "$hanika" -le 25
done
draw copies.ppm -D Copies=2 --terminator=hanika
draw one.ppm --terminator=hanika
ok "copies of a mesh" cmp copies.ppm one.ppm
draw tiny.ppm -D Size=9.5367431640625e-7 --terminator=hanika
ok "a millionth of the size" cmp tiny.ppm one.ppm
draw flat.ppm -D Smooth=0
draw flat2.ppm -D Smooth=0 --terminator=hanika
ok "without normals nothing is changed" cmp flat.ppm flat2.ppm
draw given.ppm --terminator=pov
draw default.ppm
ok "pov is the default" cmp given.ppm default.ppm
draw inside.ppm -D Inside=1 --terminator=hanika
is "no light comes in" "$(python3 -c 'print(max(open("inside.ppm", "rb").read()[-120 * 90 * 3:]))')" 0
ok "no third way" sh -c '! "$ALIDADE" -q --terminator=none -o x.ppm ball.pov 2>/dev/null'
tap_done
