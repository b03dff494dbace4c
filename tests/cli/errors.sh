#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# What goes wrong ends with one clear line, the right exit status, and no picture.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$tap_dir" || exit 99
cp "$ALIDADE_SRC/tests/cli/scene.pov" .

# ends STATUS PATTERN ARGS ...: that exit status, one line on standard error that matches, and nothing
# new in the folder.
ends()
{
	want=$1
	pattern=$2
	shift 2
	before=$(find . -type f ! -name .out ! -name err | sort)
	fails "$want" "$ALIDADE" -s 16x12 "$@" 2>err || { cat err; return 1; }
	cat err
	[ "$(wc -l <err)" -eq 1 ] || { echo "not one line"; return 1; }
	grep -q "^alidade: .*$pattern" err || { echo "does not match: $pattern"; return 1; }
	[ "$before" = "$(find . -type f ! -name .out ! -name err | sort)" ] || { echo "left a file"; ls; return 1; }
}

# The command line.
ok "no scene" ends 2 "no scene given"
ok "two scenes" ends 2 "one scene at a time" a.pov b.pov
ok "unknown option" ends 2 "did you mean --threads" --treads=3 scene.pov
ok "bad size" ends 2 "expected WIDTHxHEIGHT" -s 12 scene.pov
ok "crop outside" ends 2 "reaches out of the picture" --crop=10,10,10,10 scene.pov

# The scene.
ok "missing scene" ends 3 "nowhere.pov.*error: " nowhere.pov
ok "a directory" ends 3 "error: " "$tap_dir"
: >empty.pov
ok "an empty file" ends 3 "empty.pov.*error: " empty.pov
printf '#version 3.7;\nsphere { 0, 1' >cut.pov
ok "a file that breaks off" ends 3 "cut.pov:2:[0-9]*: error: " cut.pov
echo 'camera { location -z } mesh2 { vertex_vectors { 3, 0, x, y } face_indices { 1, <0,1,3> } }' >index.pov
ok "an index out of range" ends 3 "index.pov:1:[0-9]*: error: " index.pov
echo 'camera { location -z } sphere { <1e400, 0, 0>, 1 }' >huge.pov
ok "a number out of range" ends 3 "huge.pov:1:[0-9]*: error: " huge.pov
head -c 4096 /dev/urandom >noise.pov
ok "noise" fails 3 "$ALIDADE" noise.pov
echo 'camera { location -z look_at 0 } julia_fractal { <-0.1,0.8,-0.1,0> }' >julia.pov
ok "what is not supported" ends 3 "julia.pov:1:[0-9]*: error: .*julia_fractal" julia.pov

# The accelerator.
ok "no such accelerator" ends 4 "nothing-like-it" -a nothing-like-it scene.pov
ok "no such parameter" ends 4 "what" -a octree:what=1 scene.pov
ok "no such plugin file" ends 4 "nowhere.so" -a ./nowhere.so scene.pov
cp scene.pov text.so
ok "a plugin that is none" ends 4 "text.so" -a ./text.so scene.pov
rm text.so

# The picture.
ok "no such folder" ends 1 "nowhere/x.png" -o nowhere/x.png scene.pov
ok "no such format" ends 2 "x.nothing" -o x.nothing scene.pov
if [ "$(id -u)" = 0 ]; then
	skip "a folder that may not be written to" "root may write anywhere"
else
	mkdir locked
	chmod a-w locked
	ok "a folder that may not be written to" ends 1 "locked/x.png" -o locked/x.png scene.pov
fi
# A full disk, as far as a test can: files may not grow past 512 bytes, so that writing fails in the middle.
full()
{
	(
		trap '' XFSZ
		ulimit -f 1 && ends 1 "x.ppm" -o x.ppm -s 64x48 scene.pov
	)
}
ok "no room for the picture" full
echo old >x.ppm
ok "no room, and an older picture" full
is "the older picture is still there" "$(cat x.ppm)" old

# Reports.
ok "--stats into nowhere" fails 1 "$ALIDADE" -q -s 8x6 -o y.ppm --stats=nowhere/x.json scene.pov
ok "not enough memory" ends 8 "memory" --memory=1K -o z.ppm scene.pov
ok "a picture that won't fit" ends 8 "the picture's 152[67] MiB.*--memory allows 64 MiB.*smaller picture would" \
	--memory=64M -s 10000x10000 -o z.ppm scene.pov
# 80,000 triangles are refused where less is allowed than they take, before they are built.
{
	echo 'camera { location <5,5,5> look_at 0 } light_source { 9 rgb 1 } mesh2 { vertex_vectors { 40401'
	awk 'BEGIN { for (i = 0; i <= 200; i++) for (j = 0; j <= 200; j++) printf ", <%d,%g,%d>\n", i, (i * j) % 7 / 9, j }'
	echo '} face_indices { 80000'
	awk 'BEGIN { for (i = 0; i < 200; i++) for (j = 0; j < 200; j++) { a = 201 * i + j
		printf ", <%d,%d,%d>, <%d,%d,%d>\n", a, a + 201, a + 202, a, a + 202, a + 1 } }'
	echo '} pigment { rgb 1 } }'
} >field.pov
ok "a structure that won't fit" ends 8 \
	"bvh8: with 80000 triangles it would take about .* MiB, the scene's .*--memory allows 8.00 MiB; " -t 1 --memory=8M field.pov
ok "what would fit is told" ends 8 "what would fit: -a bvh8:leaf=28 (.* MiB)" -t 1 -a bvh8:leaf=1 --memory=20M field.pov
ok "and does" "$ALIDADE" -s 16x12 -t 1 -a bvh8:leaf=28 --memory=20M -o z.ppm field.pov
rm -f z.ppm
ok "an accelerator that fits is told" ends 8 "what would fit: .*-a none (.* MiB)" -t 1 --memory=11500K field.pov
# AddressSanitizer takes terabytes of addresses for itself.
# shellcheck disable=SC3045 # most have it
if ! grep -q __asan_init "$ALIDADE" && (ulimit -d 100000) 2>/dev/null; then
	limited()
	{
		# shellcheck disable=SC3045
		(ulimit -d 100000; ends 8 "are left of what ulimit -d allows; .*; --memory=1G tries all the same" "$@")
	}
	ok "what the system does not allow" limited -s 4000x3000 -o z.ppm scene.pov
else
	skip "what the system does not allow" "no ulimit -d here, or AddressSanitizer"
fi
to_full()
{
	"$ALIDADE" --help >/dev/full
}
[ ! -e /dev/full ] || ok "help into a full device" fails 1 to_full
tap_done
