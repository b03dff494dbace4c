#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# --spp, --noise and --time from outside: the same bytes for all threads, tiles and accelerators; what the summary
# says draws the same picture; budgets that are missed; layers; JSON. Statistics are in seeds.sh.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need_exr
scenes=$ALIDADE_SRC/tests/budget
cd "$tap_dir" || exit 99

draw()
{
	"$ALIDADE" --progress=none -s 40x30 "$@" 2>said
}
# The options that the last summary says draw the same.
again()
{
	sed -n 's/.*; \(--noise=[^ ]* --spp=[^ ]*\) draws the same.*/\1/p' said
}
# shellcheck disable=SC2046 # two options
draw_again()
{
	[ "$(again | wc -w)" = 2 ] && draw $(again) "$@"
}
differs()
{
	! cmp -s "$1" "$2"
}
# How many pixels of the last picture have what name says, in the JSON.
json()
{
	sed -n "s/.*\"$1\": *\([^,]*\).*/\1/p" stats.json | head -n 1
}
number_below()
{
	awk -v a="$(json "$1")" -v b="$2" 'BEGIN { exit !(a != "" && a != "null" && a + 0 < b) }'
}

ok "samples on one thread" draw -t 1 --spp=13 -o a.pfm "$scenes/glass.pov"
ok "and on three, with other tiles and no accelerator" draw -t 3 --tile=7 -a none --spp=13 -o b.pfm "$scenes/glass.pov"
ok "give the same bytes" cmp a.pfm b.pfm
ok "as does a crop" draw --spp=13 --crop=5,6,20,10 -o c.exr "$scenes/glass.pov"
ok "one more sample" draw --spp=14 -o b.pfm "$scenes/glass.pov"
ok "gives others" differs a.pfm b.pfm
ok "noise on one thread" draw -t 1 --noise=0.03 -o a.pfm "$scenes/room.pov"
ok "the summary says what was asked and reached" grep -q '0.03 asked' said
ok "the samples that it says" draw_again -o b.pfm "$scenes/room.pov"
ok "draw the same bytes" cmp a.pfm b.pfm
ok "and on three, with other tiles and no accelerator" draw -t 3 --tile=7 -a none --noise=0.03 -o b.pfm \
	"$scenes/room.pov"
ok "give the same bytes" cmp a.pfm b.pfm
ok "noise of a whole picture" draw --noise=0.02 -o whole.exr "$scenes/rare.pov"
ok "and of a part" draw --noise=0.02 --crop=7,5,20,18 -o part.exr "$scenes/rare.pov"
if command -v oiiotool >/dev/null && command -v idiff >/dev/null; then
	ok "cut out" oiiotool whole.exr --cut 20x18+7+5 --fullpixels -o cut.exr
	ok "is that part, with its layers" sh -c 'idiff -q -fail 0 -warn 0 part.exr cut.exr'
	ok "which are there" sh -c 'oiiotool --info -v part.exr |
		grep -q "R, G, B, Error.R, Error.G, Error.B, Samples.Y"'
fi
ok "too few samples" fails 5 draw --noise=0.005 --spp=40 --stats=stats.json -o a.png "$scenes/room.pov"
ok "are an error that counts pixels" grep -q 'error: the budget was missed.*[0-9] pixels are not below 0.005' said
ok "with a picture" test -s a.png
ok "in JSON too" [ "$(json missed)" = true ]
ok "and how many samples there are" [ "$(json spp)" = 40 ]
ok "enough" draw --noise=0.03 --stats=stats.json -o a.png "$scenes/room.pov"
ok "are no error" [ "$(json missed)" = false ]
ok "and the noise is below" number_below noise 0.03
ok "quietly" draw -q --noise=0.03 -o a.png "$scenes/room.pov"
ok "nothing is said" test ! -s said
ok "no time at all" fails 5 draw -s 400x300 --time=0.000001 --stats=stats.json -o a.ppm "$scenes/glass.pov"
ok "is said" grep -q 'pixels had no time' said
ok "and the picture is whole" [ "$(wc -c <a.ppm)" = 360015 ]
ok "and not black" sh -c 'tail -c 360000 a.ppm | tr -d "\0" | [ $(wc -c) -gt 300000 ]'
ok "a time" draw --time=1.5 --stats=stats.json -o a.pfm "$scenes/lamp.pov"
ok "is enough for samples everywhere" [ "$(json without_sample)" = 0 ]
if [ -n "$(again)" ]; then
	ok "the samples that it says" draw_again -o b.pfm "$scenes/lamp.pov"
	ok "draw the same bytes" cmp a.pfm b.pfm
fi
ok "plenty of time" draw --time=600 --noise=0.05 --stats=stats.json -o a.png "$scenes/lamp.pov"
ok "is not used up" number_below noise 0.05
ok "a single sample" draw --spp=1 --noise=0 -o a.pfm "$scenes/lamp.pov"
ok "has no error that is known" grep -q 'the noise is unknown' said
ok "and is that of plain samples" draw --spp=1 -o b.pfm "$scenes/lamp.pov"
ok "to the byte" cmp a.pfm b.pfm
ok "samples with an error" draw --spp=50 --error-layer -o a.exr "$scenes/lamp.pov"
for other in --aa=2 --blur-samples=4 --indirect-samples=4; do
	for one in --spp=4 --noise=0.1 --time=1; do
		ok "$one $other" fails 2 draw $one $other -o a.png "$scenes/lamp.pov"
	done
done
ok "no noise and no end" fails 2 draw --noise=0 -o a.png "$scenes/lamp.pov"
ok "a noise of a cache" fails 2 draw --noise=0.1 --indirect=cache -o a.png "$scenes/room.pov"
tap_done
