#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# The exporter for Blender: its parts that need no Blender, its zip in an empty user folder, its command line,
# and what it writes, which POV-Ray and Alidade must read.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need blender python3
python=python3
python3 -c 'import numpy' 2>/dev/null || python=/usr/bin/python3
if ! $python -c 'import numpy' 2>/dev/null; then
	[ -z "${ALIDADE_CI:-}" ] || { echo "Bail out! python3-numpy is missing"; exit 1; }
	skip_all "python3-numpy is not installed"
fi
export PYTHONDONTWRITEBYTECODE=1
export BLENDER_USER_RESOURCES="$tap_dir/user"
addon=$ALIDADE_SRC/blender/alidade_pov
here=$ALIDADE_SRC/tests/blender
work=$tap_dir
cd "$work" || exit 99
mkdir "$work/user"

# Programs that print "ok NAME" or "not ok NAME: why", a line a test, and "done" at the end.
count()
{
	title=$1
	shift
	"$@" >"$work/log" 2>&1
	grep -E '^(not )?ok ' "$work/log" >"$work/lines"
	while IFS= read -r line; do
		tap_count=$((tap_count + 1))
		case $line in
		ok*) echo "ok $tap_count - ${line#ok }" ;;
		*)
			echo "not ok $tap_count - ${line#not ok }"
			tap_failed=$((tap_failed + 1))
			;;
		esac
	done <"$work/lines"
	ok "$title came to its end" grep -q '^done$' "$work/log"
	grep -q '^done$' "$work/log" || sed 's/^/# /' "$work/log" | tail -n 30
}

count exporter_parts.py $python "$here/exporter_parts.py" "$ALIDADE_SRC/blender"

$python "$ALIDADE_SRC/blender/pack.py" "$work/a.zip" && $python "$ALIDADE_SRC/blender/pack.py" "$work/b.zip"
ok "the zip is the same each time" cmp "$work/a.zip" "$work/b.zip"
mv "$work/a.zip" "$work/alidade_pov.zip"
count exporter_install.py blender -b -P "$here/exporter_install.py" -- "$work/alidade_pov.zip" "$work/installed.pov"
count exporter_cases.py blender -b --factory-startup -P "$here/exporter_cases.py" -- "$ALIDADE_SRC/blender" "$work"

# The command line, on the file that the cases left.
run()
{
	blender -b "$work/cases.blend" -P "$addon/export.py" -- "$@" >"$work/run.log" 2>&1
}
mkdir one two
ok "export.py writes a scene" run "$work/one/s.pov" --frame 3
ok "and again" run "$work/two/s.pov" --frame 3
ok "the same scene gives the same bytes" diff -r one two
ok "no folder of this machine is named in it" sh -c "! grep -a '$work' one/s.pov one/s.ini"
ok "what is lost is told" grep -q 'export.py: warning: lost: Fog, Volume, Material Output' run.log
rm one/s.pov
ok "with --strict it is an error" fails 1 run "$work/one/s.pov" --strict
ok "which says what" grep -q 'export.py: error: lost: Fog, Volume, Material Output' run.log
ok "and nothing is written" test ! -e one/s.pov
ok "a folder that is not there is one clear line" fails 1 run "$work/none/s.pov"
ok "that names it" grep -q "export.py: error: .*none/s.pov.*: No such file or directory" run.log
ok "a wrong option is a usage error" fails 2 run "$work/one/s.pov" --nonsense
ok "a range of frames" run "$work/one/f.pov" --frames 1..3:2
is "writes numbered files" "$(cd one && echo f*.pov)" "f.pov f0001.pov f0003.pov"
is "that differ" "$(cmp -s one/f0001.pov one/f0003.pov; echo $?)" 1
ok "and an .ini with the frames" grep -q '^Final_Frame=3$' one/f.ini

# Every scene of the gallery and every case is SDL that both programs read.
for scene in "$work"/case-*.pov "$work"/gallery-*.pov "$work/installed.pov"; do
	name=$(basename "$scene" .pov)
	[ -e "$scene" ] || continue
	if command -v povray >/dev/null; then
		sed '/^radiosity {/,/^}/d' "$scene" >"$work/x-$name.pov"
		ok "POV-Ray reads $name" povray "+Ix-$name.pov" "+O$name.png" +FN +W16 +H12 -A -D -J +WT1 -GA
	else
		skip "POV-Ray reads $name" "povray is not installed"
	fi
	ok "Alidade reads $name" "$ALIDADE" --dry-run "$scene"
done
tap_done
