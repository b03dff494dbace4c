#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Animations whose shapes move: the accelerators of the frame before are kept or refitted, and each frame is still the
# picture that it would be alone.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$tap_dir" || exit 99

# 1 and 2 deform; in 3 the camera alone moves, and far; in 4 there is more; in 5 the mesh is one point, in 6 parts of it
# are too far out to be there, and the shared mesh has changed; 7 and 8 are chaos, and 9 has no mesh at all.
cat >move.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
#declare T = (frame_number = 3 ? 2 : frame_number);
camera { location <0.5, 2, -4 - (frame_number = 3) * 900> look_at 0 }
light_source { <5, 8, -6>, 1 }
#declare R = seed(T);
#macro P(I, J)
	#switch (T)
	#case (5) <1, 1, 1>
	#break
	#case (6) <I * 0.1 - 1, (mod(I, 7) = 3 ? 1e305 : 0), J * 0.1 - 1>
	#break
	#range (7, 8) <rand(R) - 0.5, rand(R) - 0.5, rand(R) - 0.5>
	#break
	#else <I * 0.1 - 1, 0.3 * sin(I * 0.4 + T) * cos(J * 0.3 * T), J * 0.1 - 1>
	#end
#end
#macro Sheet(N, C)
	mesh2 {
		vertex_vectors { N * N, #for (I, 0, N - 1) #for (J, 0, N - 1) P(I, J) #end #end }
		face_indices { 2 * (N - 1) * (N - 1),
			#for (I, 0, N - 2) #for (J, 0, N - 2)
				<I * N + J, I * N + J + 1, I * N + J + N>, <I * N + J + 1, I * N + J + N, I * N + J + N + 1>
			#end #end }
		pigment { color C }
	}
#end
#if (T < 9) Sheet(20, rgb x) #end
#if (T = 4) Sheet(7, rgb z) #end
#declare T = (T = 6);
#declare Shared = Sheet(30, rgb y)
#declare T = (frame_number = 3 ? 2 : frame_number);
object { Shared translate <-1, 1, T * 0.1> }
object { Shared rotate 10 * T * z translate <1.5, 1, 1> }
sphere { <1, 0.5, -0.5 + 0.1 * T>, 0.3 pigment { rgb 1 } }
plane { y, -1 pigment { checker rgb 1, rgb 0.3 } }
END

run()
{
	"$ALIDADE" -q -s 32x24 --range=1..9 "$@" move.pov
}

# structures WHICH FILE: how many of them in each frame.
structures()
{
	sed -n '/"structures"/,/}/p' "$2" | grep -o "\"$1\": [0-9]*" | cut -d' ' -f2 | tr '\n' ' '
}

for i in 1 2 3 4 5 6 7 8 9; do
	ok "frame $i alone" run -a none -f $i -o alone.ppm
done
ok "they differ" fails 1 cmp -s alone1.ppm alone2.ppm
for accel in bvh8 bvh8:build=fast bvh8:build=sah,split=1 octree sphere box none; do
	for threads in 1 2; do
		ok "$accel, $threads threads" run -a $accel -t $threads -o go.ppm --stats=go.json
		for i in 1 2 3 4 5 6 7 8 9; do
			ok "frame $i is the same" cmp go$i.ppm alone$i.ppm
		done
	done
	echo "# kept $(structures kept go.json), refitted $(structures refitted go.json), built $(structures built go.json)"
done
ok "backwards" run -a bvh8 -f 9,8,7,6,5,4,3,2,1 -o go.ppm --stats=bvh8.json
for i in 1 2 3 4 5 6 7 8 9; do
	ok "frame $i is the same" cmp go$i.ppm alone$i.ppm
done
ok "rays are verified in all frames" run -a bvh8 --verify=1 -o go.ppm
# A shared mesh that stays is kept; more triangles are built anew; who has no refit() builds.
ok "bvh8" run -a bvh8:build=fast -o go.ppm --stats=bvh8.json
is "keeps" "$(structures kept bvh8.json)" "0 1 1 1 1 0 0 1 1 "
is "refits" "$(structures refitted bvh8.json | cut -d' ' -f1-4)" "0 1 1 0"
is "builds" "$(structures built bvh8.json | cut -d' ' -f1-4)" "2 0 0 1"
ok "box" run -a box -o go.ppm --stats=box.json
is "keeps" "$(structures kept box.json)" "0 1 1 1 1 0 0 1 1 "
is "builds" "$(structures built box.json)" "2 1 1 1 1 2 2 1 1 "
tap_done
