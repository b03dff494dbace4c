#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# --texture-filter=mip is nearer to what many rays a pixel see than one place of the picture a ray is: on a plane
# to the horizon, a ball, a mesh with texture coordinates, and in a mirror. Threads and tiles change no byte.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$tap_dir" || exit 99
diff=$ALIDADE_BUILD/tools/alidade-diff
# A picture of 240 x 180 squares and stripes: drawn by ourselves, so that nothing has to be stored.
cat >picture.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1.0 }
camera { orthographic location <0.5, 0.5, -1> direction z right x up y }
plane { z, 0
	pigment { checker pigment { gradient x color_map { [0 rgb <1, 0.1, 0.2>] [1 rgb <0.9, 0.8, 0.1>] } }
		pigment { gradient y color_map { [0 rgb <0.1, 0.2, 0.6>] [1 rgb <0.1, 0.7, 0.9>] } } scale 1 / 16 }
	finish { ambient 1 diffuse 0 } }
END
cat >scene.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 4 }
camera { location <0, 2.2, -6> look_at <0, 0.8, 0> right x * 4 / 3 up y angle 60 }
background { rgb <0.2, 0.3, 0.5> }
#default { finish { ambient 1 diffuse 0 } }
plane { y, 0 pigment { image_map { png "picture.png" interpolate 2 } rotate 90 * x scale 1.5 } }
sphere { <-2, 1.2, 1>, 1.2 pigment { image_map { png "picture.png" map_type 1 interpolate 2 } scale 0.3 } }
mesh2 { vertex_vectors { 4, <0.5, 0.1, 3>, <3.5, 0, 0>, <3.4, 3, 0.4>, <0.6, 2.7, 3> }
	uv_vectors { 4, <-2, 0>, <2, 0>, <2, 3>, <-2, 3> }
	face_indices { 2, <0, 1, 2>, <0, 2, 3> }
	pigment { uv_mapping image_map { png "picture.png" interpolate 2 } } }
sphere { <0.2, 0.7, -1>, 0.7 pigment { rgb 0 } finish { reflection 0.9 ambient 0 } }
END
render()
{
	"$ALIDADE" -q --progress=none -o "$@"
}

ok "the picture" render picture.png -s 240x180 picture.pov
ok "many rays a pixel" render many.pfm -s 120x90 --aa=16 scene.pov
ok "one" render pov.pfm -s 120x90 scene.pov
ok "one, of means" render mip.pfm -s 120x90 --texture-filter=mip scene.pov
# Measured: RMSE 0.200 and 0.054; 0.002 and 0.0004 too dark.
ok "one is far off" fails 2 "$diff" -q --linear --fail=1 --failpercent=100 --max-rmse=0.15 many.pfm pov.pfm
ok "of means it is not" "$diff" -q --linear --fail=1 --failpercent=100 --max-rmse=0.07 --max-mean=0.003 many.pfm mip.pfm
ok "pov is the default" render default.pfm -s 120x90 --texture-filter=pov scene.pov
ok "and the same" cmp pov.pfm default.pfm
ok "other threads and tiles" render again.pfm -s 120x90 --texture-filter=mip -t 3 --tile 13 scene.pov
ok "change no byte" cmp mip.pfm again.pfm
ok "other filters are errors" fails 2 "$ALIDADE" -q --texture-filter=ewa scene.pov
tap_done
