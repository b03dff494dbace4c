#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Picture files that scenes name: where they are found, and one clear line, with the statement's place, when they
# are missing, damaged, too large, or not what they say.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
pictures=$ALIDADE_SRC/tests/features/pictures
cd "$tap_dir" || exit 99
mkdir scene scene/sub lib

# scene TEXT: a scene whose third line is TEXT, in a pigment.
scene()
{
	printf '#version 3.7; global_settings { assumed_gamma 1 }\ncamera { location -3*z look_at 0 }\n%s\n' \
		"sphere { 0, 1 pigment { $* } finish { ambient 1 } }" >scene/x.pov
}

# renders [ARGS]: no message at all.
renders()
{
	"$ALIDADE" --progress=none -s 16x12 -o out.png "$@" scene/x.pov 2>err || { cat err; return 1; }
	[ ! -s err ] || { cat err; return 1; }
}

# warns PATTERN [ARGS]: a picture, and one warning at the statement.
warns()
{
	pattern=$1
	shift
	"$ALIDADE" --progress=none -s 16x12 -o out.png "$@" scene/x.pov 2>err || { cat err; return 1; }
	cat err
	[ "$(wc -l <err)" -eq 1 ] || return 1
	grep -q "^alidade: .*x.pov:3:[0-9]*: warning: .*$pattern" err
}

# ends PATTERN [ARGS]: status 3, one line.
ends()
{
	pattern=$1
	shift
	fails 3 "$ALIDADE" --progress=none -s 16x12 -o none.png "$@" scene/x.pov 2>err || { cat err; return 1; }
	cat err
	[ "$(wc -l <err)" -eq 1 ] || return 1
	[ ! -e none.png ] || return 1
	grep -q "^alidade: .*x.pov:3:[0-9]*: error: .*$pattern" err
}

# Where they are.
cp "$pictures/colour.png" scene/a.png
scene 'image_map { png "a.png" }'
ok "beside the scene" renders
mv scene/a.png lib/a.png
ok "not there" ends '"a.png" was not found'
ok "in a -L folder" renders -L lib
cp "$pictures/colour.png" a.png
ok "in the working folder" renders
rm a.png
scene 'image_map { png "/home/nobody/work/sub/a.png" interpolate 2 }'
ok "an absolute name that is wrong" ends "nobody/work/sub/a.png\" was not found"
ok "its last part in a -L folder" warns "there is no file \"/home/nobody.*lib/a.png" -L lib
cp "$pictures/clear.png" scene/sub/a.png
ok "its last two parts beside the scene come first" warns "there is no file.*sub/a.png" -L lib
scene 'image_map { png "C:\Users\me\sub\a.png" }'
rm -r scene/sub
ok "a name from Windows" warns "there is no file.*lib/a.png" -L lib
scene 'image_map { png "/home/nobody/../../../../../etc/a.png" }'
ok "no way out of the folders" ends "was not found"

# What they are.
cp "$pictures/colour.png" "$pictures/photo.jpg" "$pictures/palette.png" scene
scene 'image_map { "photo.jpg" }'
ok "no word for the format" renders
scene 'image_map { png "photo.jpg" }'
ok "a wrong word" warns "is a jpeg picture and is read as such, not as png"
mv scene/photo.jpg scene/photo.png
scene 'image_map { "photo.png" }'
ok "a wrong ending" warns "is a jpeg picture and is read as such, not as png"
: >scene/empty.png
scene 'image_map { png "empty.png" }'
ok "empty" ends '"scene/empty.png": .*empty'
head -c 200 scene/colour.png >scene/cut.png
scene 'image_map { png "cut.png" }'
ok "cut short" ends '"scene/cut.png": .*ends before its last pixel'
head -c 300 "$pictures/photo.jpg" >scene/cut.jpg
scene 'image_map { jpeg "cut.jpg" }'
ok "a JPEG cut short" ends '"scene/cut.jpg": .*ends before its last pixel'
echo 'sphere { }' >scene/text.png
scene 'image_map { png "text.png" }'
ALIDADE_MODULE_PATH=/nonexistent ok "no picture at all" ends '"scene/text.png": '
scene 'image_map { png "../scene" }'
ok "a folder" ends "was not found\|folder"

# How large they are.
scene 'image_map { png "colour.png" }'
ok "bytes within the limit" renders --limit texture_bytes=351
ok "bytes beyond it" ends "colour.png.*of memory; the limit" --limit texture_bytes=350
ok "pixels within the limit" renders --limit texture_pixels=117
ok "pixels beyond it" ends "claims 13 x 9 pixels; the limit is 116" --limit texture_pixels=116
scene 'checker pigment { image_map { png "colour.png" } } pigment { image_map { png "colour.png" gamma 1 } }'
ok "a file is read once" renders --limit texture_bytes=351
scene 'checker pigment { image_map { png "colour.png" } } pigment { image_map { png "palette.png" } }'
ok "all count together" ends "palette.png.*of memory; the limit" --limit texture_bytes=351
printf 'P6\n60000 60000\n255\n' >scene/huge.ppm
scene 'image_map { ppm "huge.ppm" }'
ok "a huge claim" ends "claims 60000 x 60000 pixels; the limit is 268435456"

# same WANT PICTURE TOLERANCE: other formats, through the module: the same samples by the same rules as what is built in.
same()
{
	scene "image_map { \"$pictures/$1\" }"
	renders --bits 8 && mv out.png want.png || return 1
	scene "image_map { \"$pictures/$2\" }"
	renders --bits 8 && "$ALIDADE_BUILD/tools/alidade-diff" -q --fail="$3" want.png out.png
}

# The last one is what POV-Ray sees in the .hdr, in half floats.
for pair in colour.png:old.tga colour.png:old.bmp plain.ppm:plain.tif bright.exr:bright.hdr; do
	if [ -e "${ALIDADE_MODULE_PATH:-/}/io_oiio.so" ]; then
		ok "${pair#*:} as ${pair%:*}" same "${pair%:*}" "${pair#*:}" "$([ "$pair" = "${pair#bright}" ] && echo 0 || echo 1/255)"
	else
		skip "${pair#*:} as ${pair%:*}" "built without OpenImageIO"
	fi
done

# Words.
scene 'image_map { png "colour.png" filter 2, 0.5 }'
ok "filter by number without a palette" ends "pictures with a palette"
scene 'image_map { png "palette.png" filter 6, 0.5 }'
ok "a number beyond the palette" ends "palette"
scene 'image_map { png "colour.png" interpolate 1 }'
ok "no such interpolation" ends "interpolate 1 is none"
scene 'image_map { png "colour.png" map_type 3 }'
ok "no such map_type" ends "map_type 3 is none"
scene 'image_map { png "colour.png" gamma 0 }'
ok "gamma 0" ends "gamma"
scene 'image_map { sys "colour.png" }'
ok "sys" ends "cannot be read"
tap_done
