#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Pictures as other programs see them, and what happens when the disk is full or a module is not there.
# alidade-diff -o is the writer: the difference of a picture and black is the picture.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need oiiotool
diff=$ALIDADE_BUILD/tools/alidade-diff
cd "$tap_dir" || exit 99
oiiotool --pattern fill:topleft=0,0,0:topright=1,0,0:bottomleft=0,1,0:bottomright=1,1,1 64x48 3 -d uint8 -o a.png
oiiotool --pattern constant:color=0,0,0 64x48 3 -d uint8 -o black.png

# convert FILE: writes a.png as FILE.
convert()
{
	"$diff" -q --scale=1 -o "$1" black.png a.png
	[ $? -eq 2 ]
}
# seen FILE: another program sees the values of a.png in it, whatever it takes them for.
seen()
{
	convert "$1" && oiiotool a.png -d float -o a.tif && oiiotool "$1" -d float -o b.tif && idiff -fail "$2" a.tif b.tif
}
ok ".png" seen b.png .002
ok ".ppm" seen b.ppm .002
ok ".pfm" seen b.pfm 1e-6
if "$diff" -q -o x.exr a.png a.png 2>/dev/null; then
	ok ".exr" seen b.exr 1e-6
else
	skip ".exr" "built without OpenEXR"
fi
to_stdout()
{
	"$diff" -q --scale=1 -o - black.png a.png >std.png
	"$diff" -q --scale=1 -o -.ppm black.png a.png >std.ppm
	"$diff" std.png a.png && "$diff" std.ppm a.png
}
ok "standard output" to_stdout
from_stdin()
{
	"$diff" - a.png <a.png
}
ok "standard input" from_stdin

if [ -e "$ALIDADE_MODULE_PATH/io_oiio.so" ]; then
	back()
	{
		convert "$1" && "$diff" --fail="$2" --warn="$2" a.png "$1"
	}
	ok ".tif through the module" back c.tif .002
	ok ".jpg through the module" back c.jpg .06
	ok ".bmp through the module" back c.bmp .002
	ok ".tga through the module" back c.tga .002
	"$diff" -q -o c.blob black.png a.png 2>err
	ok "an unknown ending: one line" [ "$(wc -l <err)" -eq 1 ]
	head -c 300 c.tif >cut.tif
	"$diff" -q cut.tif a.png 2>err
	ok "a damaged .tif: one line, status 4" [ "$?$(wc -l <err)" = 41 ]
else
	skip "the module" "built without OpenImageIO"
fi
no_module()
{
	ALIDADE_MODULE_PATH=$tap_dir/none fails 4 "$diff" -q -o c.jpg black.png a.png
}
ok "no module" no_module
ALIDADE_MODULE_PATH=$tap_dir/none "$diff" -q -o c.jpg black.png a.png 2>err
ok "no module: the message says so" grep -q 'no io_oiio.so in ' err
echo x >x.tif
mkdir bad
echo x >bad/io_oiio.so
ALIDADE_MODULE_PATH=$tap_dir/bad "$diff" -q x.tif a.png 2>err
ok "a broken module: one line, status 4" [ "$?$(wc -l <err)" = 41 ]

# A disk of 64 kB.
mkdir small
if mount -t tmpfs -o size=64k tmpfs small 2>/dev/null; then
	trap 'umount "$tap_dir/small"; rm -rf "$tap_dir"' EXIT
	oiiotool --pattern noise:type=uniform:min=0:max=1 300x300 3 -d uint8 -o noise.png
	oiiotool --pattern constant:color=0,0,0 300x300 3 -d uint8 -o noblack.png
	# full FILE: the old file is whole, no other is left, one line tells.
	full()
	{
		echo old >"small/$1"
		"$diff" -q --scale=1 -o "small/$1" noblack.png noise.png 2>err
		status=$?
		cat err
		[ $status -eq 4 ] && [ "$(wc -l <err)" -eq 1 ] && [ "$(cat "small/$1")" = old ] &&
			[ "$(find small -type f | wc -l)" -eq 1 ] && rm "small/$1"
	}
	full_space()
	{
		full "$1" && grep 'No space left' err
	}
	for ending in png ppm pfm exr; do
		[ $ending != exr ] || [ -e b.exr ] || continue
		ok "a full disk: .$ending" full_space d.$ending
	done
	if [ -e "$ALIDADE_MODULE_PATH/io_oiio.so" ]; then
		for ending in jpg tga bmp; do
			ok "a full disk: .$ending" full_space d.$ending
		done
		ok "a full disk: .tif" full d.tif
	fi
else
	skip "a full disk" "cannot mount one"
fi
tap_done
