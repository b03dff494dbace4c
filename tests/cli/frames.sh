#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Animations: which frames are drawn, what their files are called, that each is the picture that it would be
# alone, what is built anew, and what is left when one stops.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$tap_dir" || exit 99

# The camera moves, then the sphere, then a lamp.
cat >clock.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <(frame_number = 2) * 0.3, 1, -5> look_at 0 }
light_source { <3, 5 + (frame_number = 4), -4>, 1 }
sphere { <0.5 * (frame_number = 3), 0, 0>, 1 pigment { color rgb <1, clock, frame_number / final_frame> } }
plane { y, -1 pigment { color rgb 0.7 } }
END

run()
{
	"$ALIDADE" -q -s 16x12 "$@"
}

list()
{
	find . -maxdepth 1 -name "$1" | sort | tr -d './\n' | sed 's/ppm/ /g'
}

ok "a range" run --range=1..4 -o a.ppm --stats=a.json clock.pov
is "is numbered" "$(list 'a*.ppm')" "a1 a2 a3 a4 "
is "the structure serves while the shapes are the same" \
	"$(grep -o '"structure_reused": [a-z]*' a.json | cut -d' ' -f2 | tr '\n' ' ')" "false true false false "
is "one object a frame" "$(grep -c '"frame":' a.json)" 4
if command -v python3 >/dev/null; then
	ok "in an array" python3 -c 'import json; assert len(json.load(open("a.json"))) == 4'
fi
sed 's/(frame_number = 2) \* 0.3, 1, -5/(frame_number = 2) * 900, 1, -5/' clock.pov >far.pov
ok "a camera that goes far" run --range=1..2 -o far.ppm --stats=far.json far.pov
is "has its structure built anew" "$(grep -c '"structure_reused": false' far.json)" 2
ok "and the frame" run --range=1..2 -f 2 -o far-alone.ppm far.pov
ok "is the same alone" cmp far2.ppm far-alone2.ppm
# Textures, and where they lie, are another matter than shapes.
cat >skin.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -5*z look_at 0 }
light_source { <3, 5, -4>, 1 }
#declare F = function { x * frame_number }
sphere { 0, 1 pigment { checker rgb 1, rgb x scale 0.3 translate frame_number * 0.1 * x } translate -1.5 * x }
box { -0.6, 0.6 pigment { gradient y color_map { [0 rgb y] [1 rgb z] } } #if (frame_number = 2) rotate 90 * z #end }
sphere { 0, 0.8 pigment { function { F(x, y, z) } } translate 1.8 * x }
mesh2 { vertex_vectors { 3, <-2, -2, 0>, <2, -2, 0>, <0, -1, 0> }
	uv_vectors { 3, <0, 0>, <clock, 0>, <0, 1> } face_indices { 1, <0, 1, 2> }
	pigment { uv_mapping checker rgb 1, rgb z scale 0.2 } }
END
ok "moving textures" run --range=1..3 -o skin.ppm skin.pov
for i in 1 2 3; do
	ok "alone" run --range=1..3 -f $i -o skin-alone.ppm skin.pov
	ok "gives frame $i" cmp skin$i.ppm skin-alone$i.ppm
done
ok "which moves" fails 1 cmp -s skin2.ppm skin3.ppm
# Whatever else there is, under a camera that moves over shapes that stay.
cat >much.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 radiosity { count 20 error_bound 0.5 recursion_limit 2 } }
camera { location <0.3 * clock, 1, -5> look_at 0 }
light_source { <3, 5, -4>, 1 }
fog { distance 20 color rgb 0.5 }
sky_sphere { pigment { gradient y color_map { [0 rgb 1] [1 rgb z] } } }
difference { box { -1, 1 } sphere { 0, 1.2 } pigment { rgb x } translate -1.5 * x }
blob { threshold 0.5 sphere { 0, 1, 1 } sphere { 0.8 * x, 1, 1 } pigment { rgbt <0, 1, 0, 0.5> } interior { ior 1.3 } }
sphere_sweep { linear_spline 3, <-1, 1, 0>, 0.1, <0, 2, 0>, 0.2, <1, 1, 0>, 0.1 pigment { rgb 1 } }
plane { y, -1 pigment { checker rgb 1, rgb 0.2 } normal { bumps 0.5 } }
END
for how in exact cache; do
	ok "much, $how" run --indirect=$how --range=1..3 -o much.ppm --stats=much.json much.pov
	is "is built once" "$(grep -c '"structure_reused": true' much.json)" 2
	ok "alone" run --indirect=$how --range=1..3 -f 3 -o much-alone.ppm much.pov
	ok "is the same" cmp much3.ppm much-alone3.ppm
done
# Pictures are read once, unless they change or nobody wants them any more.
cat >picture.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -5*z look_at 0 }
#if (frame_number != 3)
	box { -1, 1 pigment { image_map { ppm "skin1.ppm" } } finish { ambient 1 } }
#end
END
ok "pictures" run --range=1..5 -o pic.ppm --stats=pic.json picture.pov
is "are kept" "$(grep -o '"pictures_kept": [0-9]*' pic.json | cut -d' ' -f2 | tr '\n' ' ')" "0 1 0 0 1 "
ok "alone" run --range=1..5 -f 2 -o pic-alone.ppm picture.pov
ok "is the same" cmp pic2.ppm pic-alone2.ppm
ok "some frames" run --range=1..4 -f 2,4 -o b.ppm clock.pov
is "are these" "$(list 'b*.ppm')" "b2 b4 "
ok "alone" run --range=1..4 -f 3 -o b.ppm clock.pov
for i in 2 3 4; do
	ok "frame $i alone is frame $i among others" cmp a$i.ppm b$i.ppm
done
ok "they differ" fails 1 cmp -s a1.ppm a2.ppm
ok "on threads, and with another accelerator" run --range=1..4 -t 3 -a none -o c.ppm clock.pov
for i in 1 2 3 4; do
	ok "frame $i is the same" cmp a$i.ppm c$i.ppm
done
ok "from a pipe, with digits" sh -c '"$0" -q -s 16x12 --range=1..4 -o d###x.ppm - <clock.pov' "$ALIDADE"
is "as many as asked for" "$(list 'd*.ppm')" "d001x d002x d003x d004x "
ok "the same" cmp a4.ppm d004x.ppm
ok "a clock" run --clock=0.5 -o half.ppm -D final_frame=1 clock.pov
ok "a sequence of which nothing is known" sh -c '"$0" -s 16x12 -f 5..6 -o e.ppm clock.pov 2>err' "$ALIDADE"
ok "but the scene asks for the clock" grep -q 'clock.pov:5:.*warning: .*--range' err
is "said once" "$(wc -l <err)" 1

# A file a frame
for i in 0008 0009 0010; do
	sed "s/frame_number/${i#00}/g; s/final_frame/10/; s/clock/0/" clock.pov >scene$i.pov
done
ok "a file a frame" run -f 8..10 scene####.pov
ok "gives pictures of its name" test -s scene0010.png
echo 'Input_File_Name=scene####.pov
Output_File_Name=ini-##' >each.ini
ok "an .ini of them" run -f 8,10 each.ini
ok "and their pictures" test -s ini-08.png -a -s ini-10.png -a ! -e ini-09.png
ok "which frames?" sh -c '! "$0" -q scene####.pov 2>err && grep -q "scene####.pov: .*-f" err' "$ALIDADE"

# .ini
echo 'Input_File_Name=clock.pov
Final_Frame=12
Subset_Start_Frame=9
Subset_End_Frame=10' >range.ini
ok "an .ini with frames" run -o r.ppm range.ini
is "numbered as POV-Ray does" "$(list "r*.ppm")" "r09 r10 "
ok "-f before the .ini" run -f 2 -o r.ppm range.ini
ok "with its range" test -s r02.ppm
printf '+Iclock.pov +KFF4 ; as on the command line\n+KC +SF2 subset_end_frame=3 +W16 +H12\n' >switches.ini
ok "switches" run -o g.ppm switches.ini
is "are understood" "$(list 'g*.ppm')" "g2 g3 "
printf 'Final_Frame=2\nPre_Frame_Command="touch oops"\n' >clock.ini
ok "the scene of the same name" sh -c '"$0" -s 16x12 -o same.ppm clock.ini 2>err' "$ALIDADE"
ok "no commands" test ! -e oops -a -s same2.ppm
ok "which is said" grep -q 'clock.ini:2:.*Pre_Frame_Command is ignored: no commands are run' err
printf 'Input_File_Name=clock.pov\nFinal_Frame=2\nField_Render=on\n' >field.ini
ok "half frames" sh -c '! "$0" field.ini 2>err' "$ALIDADE"
ok "are refused by name" grep -q 'field.ini:3:.*Field_Render is not supported' err

# What stops
cat >stop.pov <<'END'
#version 3.7;
camera { location -5*z }
#if (frame_number = 3) sphere { 0 } #end
END
ok "an error in a frame" sh -c '"$0" -s 16x12 --range=1..5 -o s.ppm stop.pov 2>err; [ $? = 3 ]' "$ALIDADE"
is "keeps what was drawn" "$(list 's?.ppm')" "s1 s2 "
ok "and says where" grep -q 'stopped at frame 3; 2 frames were drawn, 3 not' err
ok "its own message first" grep -q '^alidade: stop.pov:3:.*error: ' err
printf '#version 3.7;\ncamera { location -5*z }\n' >stop.pov
echo marked >s2.ppm
ok "going on" run --skip-existing --range=1..5 -o s.ppm stop.pov
is "draws the rest" "$(list 's?.ppm')" "s1 s2 s3 s4 s5 "
is "and leaves what is there" "$(cat s2.ppm)" marked
ok "bad frames" sh -c '"$0" -f 9..3 clock.pov 2>err; [ $? = 2 ] && grep -q "expected frame numbers" err' "$ALIDADE"
ok "bad range" sh -c '"$0" --range=1..3,clock=2 clock.pov 2>err; [ $? = 2 ]' "$ALIDADE"

# A signal in the second frame, which would take minutes: frame 1 is there, and a part of frame 2.
cat >slow.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -5*z }
#if (frame_number = 2)
	#local I = 0;
	#while (I < 40) light_source { <I, 5, -4>, 0.1 } #local I = I + 1; #end
	sphere { 0, 1 } plane { y, -1 pigment { color rgb 1 } }
#end
END
env --default-signal=INT "$ALIDADE" -t 2 -s 800x600 --aa 8 --tile 16 --range 1..3 --progress=json -o slow.ppm \
	slow.pov >lines 2>err &
pid=$!
tries=0
until grep -qs '"frame": 2, .*"done"' lines || [ $((tries += 1)) -gt 600 ]; do
	sleep 0.1
done
kill -s TERM $pid
ok "SIGTERM" fails 143 wait $pid
is "leaves finished frames, and of another what there is" "$(list 'slow*.ppm')" "slow1 slow2partial "
tap_done
