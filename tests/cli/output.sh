#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Where pictures and reports go, what a signal leaves, and that options do what they say.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$tap_dir" || exit 99
cp "$ALIDADE_SRC/tests/cli/scene.pov" .
mkdir sub
cp scene.pov sub/other.pov

run()
{
	"$ALIDADE" -q "$@"
}

# size FILE: of a ppm, as 16x12.
size()
{
	head -n 3 "$1" | grep -v '^#' | tr '\n' ' ' | awk '{ print $2 "x" $3 }'
}

ok "default output" run -s 16x12 sub/other.pov
ok "is in the current folder" test -s other.png
ok "standard input" sh -c '"$0" -q -s 16x12 -o in.ppm - <scene.pov' "$ALIDADE"
ok "a file" run -s 16x12 -o file.ppm scene.pov
ok "are the same picture" cmp in.ppm file.ppm
is "size" "$(size file.ppm)" 16x12
ok "crop" run -s 16x12 --crop=4,2,8,6 -o crop.ppm scene.pov
is "size of a crop" "$(size crop.ppm)" 8x6
for ending in png exr ppm pfm; do
	[ $ending != exr ] || has_exr || { skip .exr "built without OpenEXR"; continue; }
	ok ".$ending" run -s 16x12 -o "all.$ending" scene.pov
done
ok "threads, tiles" run -s 16x12 -t 3 --tile 5 -o tile.ppm scene.pov
ok "make no difference" cmp tile.ppm file.ppm
ok "an older picture is replaced" run -s 20x10 -o file.ppm scene.pov
is "by the new one" "$(size file.ppm)" 20x10
is "nothing else is left" "$(find . -name '*.pp[m]?*' -o -name '.*.ppm*' -o -name '*tmp*')" ""
ok "camera rays only" run -s 16x12 --camera-only -o hits.ppm scene.pov
ok "a variable" run -s 16x12 -D Turn=1 -o turn.ppm scene.pov

# .ini
cat >job.ini <<'END'
; as Blender's add-on writes them
Input_File_Name="scene.pov"
Output_File_Name="job"
Width=24 ; as POV-Ray
Height=18	# takes them
Antialias=off
Start_Column=3
End_Column=10
[large]
Width=1000
Height=1000
END
ok ".ini" run job.ini
ok "names the output" test -s job.png
ok ".ini, and the command line before it" run -o job.ppm job.ini
is "its columns" "$(size job.ppm)" 8x18
ok ".ini, and another size" run -s 12x9 --crop=0,0,12,9 -o job.ppm job.ini
is "is taken" "$(size job.ppm)" 12x9

# Reports
ok "--dry-run" sh -c '"$0" --dry-run scene.pov >dry' "$ALIDADE"
ok "counts" grep -q '^  sphere  *1$' dry
ok "--stats" sh -c '"$0" -s 16x12 -a none -o s.ppm --stats scene.pov 2>stats' "$ALIDADE"
ok "counts camera rays" grep -q '^  camera  *192 ' stats
cat >mirrors.pov <<'END'
global_settings { assumed_gamma 1 max_trace_level 14 adc_bailout 0 }
camera { location 0 look_at <.3, 1, 0> angle 1 }
#declare T = texture { average texture_map { [1 finish { reflection .5 }] [1 finish { reflection .4 }] } }
plane { y, -1 texture { T } }
plane { y, 1 texture { T } }
END
ok "mirrors of blended textures" sh -c '"$0" -s 1x1 --aa none -o s.ppm --stats mirrors.pov 2>stats' "$ALIDADE"
ok "share their rays" grep -q '^  reflected  *26 ' stats
ok "--stats=FILE" run -s 16x12 -o s.ppm --stats=s.json scene.pov
keys()
{
	grep -o '"[a-z_]*": [^"]' s.json | grep -o '"[a-z_]*"' | tr -d '"' | sort -u | while read -r key; do
		sed -n '/^\.Sh REPORTS/,/^\.Sh ENV/p' "$ALIDADE_SRC/man/alidade.1" | grep -qw -- "$key" ||
			sed -n '/"structure"/,/}/p' s.json | grep -q "\"$key\"" || echo "$key is not in the page"
	done | { ! grep .; }
}
ok "every key is in alidade(1)" keys
ok "--progress=json" sh -c '"$0" -s 16x12 -o s.ppm --progress=json scene.pov >progress' "$ALIDADE"
is "begins with reading" "$(head -n 1 progress)" '{"kind": "begin", "phase": "reading", "elapsed": 0}'
ok "and ends" sh -c 'tail -n 1 progress | grep -q "\"kind\": \"end\", \"phase\": \"writing\""'
is "quiet is quiet" "$(run -s 16x12 -o s.ppm scene.pov 2>&1)" ""
ok "--list-accels" sh -c '"$0" --list-accels | grep -q "^octree "' "$ALIDADE"
ok "--version" sh -c '"$0" --version | grep -q "^Alidade [0-9]"' "$ALIDADE"

# Signals: a picture that would take minutes. The signal comes once progress is being made.
interrupt()
{
	signal=$1
	shift
	rm -f slow.partial.ppm lines
	# A shell starts its background jobs with SIGINT ignored, which alidade would respect.
	env --default-signal=INT "$ALIDADE" -t 2 -s 4000x3000 --aa 16 --tile 16 --progress=json -o slow.ppm scene.pov >lines 2>err &
	pid=$!
	tries=0
	until grep -q '"done"' lines || [ $((tries += 1)) -gt 600 ]; do
		sleep 0.1
	done
	kill -s "$signal" $pid
	wait $pid
}
echo old >slow.ppm
ok "SIGTERM" fails 143 interrupt TERM
ok "leaves what there is" test -s slow.partial.ppm
is "in whole size" "$(size slow.partial.ppm)" 4000x3000
is "and the older picture as it was" "$(cat slow.ppm)" old
ok "SIGINT" fails 130 interrupt INT
ok "leaves what there is too" test -s slow.partial.ppm
ok "says so" grep -q 'stopped; what is there is in slow.partial.ppm' err
tap_done
