#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# alidade-diff beside OpenImageIO's idiff on the same pairs: the same exit status, except where idiff is
# blind: NaN and infinity, a hard threshold below the ordinary one, different sizes and channels (3 here,
# 2 in idiff before 2025).
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need idiff oiiotool
need_exr
diff=$ALIDADE_BUILD/tools/alidade-diff
cd "$tap_dir" || exit 99

grey='--pattern constant:color=.5,.5,.5 100x100 3 -d float'
box()
{
	# shellcheck disable=SC2086
	oiiotool $grey --fill:color=.6,.5,.5 "$1" -o "$2"
}
# shellcheck disable=SC2086
oiiotool $grey -o a.exr
cp a.exr same.exr
box 5x2+20+30 ten.exr
box 101x101 bias.exr
# shellcheck disable=SC2086
oiiotool $grey --fill:color=.5,.504,.5 100x100 -o slight.exr
oiiotool --pattern constant:color=.5,.5,.5 101x100 3 -d float -o wide.exr
oiiotool --pattern constant:color=.5,.5,.5,1 100x100 4 -d float -o alpha.exr
oiiotool --pattern fill:topleft=0,0,0:topright=1,0,0:bottomleft=0,1,0:bottomright=1,1,1 64x48 3 -d uint8 -o ramp.png
oiiotool ramp.png --addc .02,0,0 -d uint8 -o brighter.png
# PFM by hand: one pixel of 100 x 100 is NaN, or infinite. The bytes are little-endian.
pfm()
{
	printf 'Pf\n100 100\n-1\n'
	printf '%b' "$1"
	head -c 39996 /dev/zero
}
pfm '\0\0\300\177' >nan.pfm
pfm '\0\0\200\177' >inf.pfm
pfm '\0\0\0\0' >zero.pfm

# both WANT-OURS WANT-IDIFF ARGUMENT ...
both()
{
	ours=0 theirs=0
	want_ours=$1 want_theirs=$2
	shift 2
	"$diff" "$@" || ours=$?
	idiff "$@" || theirs=$?
	echo "alidade-diff ends with $ours, idiff with $theirs"
	[ "$ours" -eq "$want_ours" ] && [ "$theirs" -eq "$want_theirs" ]
}
agree()
{
	name=$1 want=$2
	shift 2
	ok "as idiff: $name" both "$want" "$want" "$@"
}
agree "equal" 0 a.exr same.exr
agree "equal, PNG" 0 ramp.png ramp.png
agree "ten pixels off" 2 a.exr ten.exr
agree "ten pixels off, a warning left" 1 -fail .05 -failpercent 1 a.exr ten.exr
agree "ten pixels off, allowed" 0 -fail .05 -failpercent 1 -warn .05 -warnpercent 1 a.exr ten.exr
agree "below the thresholds" 0 -fail .11 -warn .11 a.exr ten.exr
agree "below the failing threshold, none for warnings" 0 -fail .11 a.exr ten.exr
agree "hard threshold" 2 -fail .05 -failpercent 10 -warn .2 -hardfail .09 a.exr ten.exr
agree "hard warning" 1 -fail .05 -failpercent 1 -warn .05 -warnpercent 50 -hardwarn .09 a.exr ten.exr
agree "ten allowed failures" 0 -allowfailures 10 a.exr ten.exr
agree "nine allowed failures" 2 -allowfailures 9 a.exr ten.exr
agree "all a little off" 2 -fail .003 a.exr slight.exr
agree "all a little off, allowed" 0 -fail .005 -warn .005 a.exr slight.exr
agree "PNG against PNG" 2 ramp.png brighter.png
agree "PNG against PNG, allowed" 0 -fail .021 -warn .021 ramp.png brighter.png
agree "a file that is not there" 4 a.exr missing.exr
agree "an unknown option" 1 --no-such-option a.exr same.exr

ok "NaN, which idiff passes" both 2 0 -fail 1 -warn 1 zero.pfm nan.pfm
ok "infinity, which idiff passes" both 2 0 -fail 1 -warn 1 zero.pfm inf.pfm
ok "NaN in both" fails 2 "$diff" nan.pfm nan.pfm
ok "NaN in both, allowed" "$diff" --allow-nonfinite nan.pfm nan.pfm
ok "NaN in one, although allowed" fails 2 "$diff" --allow-nonfinite nan.pfm zero.pfm
ok "a hard threshold below the ordinary one" both 2 0 -fail .2 -warn .2 -hardfail .09 a.exr ten.exr
ok "a warning where nothing fails" both 1 0 -fail .11 -warn .05 a.exr ten.exr
ok "other size" fails 3 "$diff" a.exr wide.exr
ok "other channels" fails 3 "$diff" a.exr alpha.exr
ok "the channels that both have" "$diff" --channels=rgb a.exr alpha.exr
ok "a bias that no pixel shows" fails 2 "$diff" --fail=.005 --warn=.005 --max-mean=.001 a.exr slight.exr
ok "no second picture" fails 1 "$diff" a.exr
ok "a part of them" "$diff" --crop=0,32,100,68 a.exr ten.exr
ok "a part that is not there" fails 1 "$diff" --crop=0,32,100,69 a.exr ten.exr

# The same figures as idiff prints.
figures()
{
	idiff "$@" >theirs.txt
	"$diff" --json "$@" >ours.json
	awk '/Mean error/ { print "rms", 0 } /RMS error/ { printf "%.4g\n", $4 } /Max error/ { printf "%.4g\n", $4 }' theirs.txt |
		grep -v rms >theirs.fig
	awk -F '[:,]' '/^\t"rmse"/ { rms = $2 } /^\t"max"/ { max = $2 } END { printf "%.4g\n%.4g\n", rms, max }' ours.json >ours.fig
	cat theirs.txt ours.json
	[ -s theirs.fig ] && cmp theirs.fig ours.fig
}
ok "idiff's RMS and largest error" figures a.exr ten.exr
ok "idiff's RMS and largest error of PNG" figures ramp.png brighter.png

# EXR against PNG: along the sRGB curve.
oiiotool ramp.png --tocolorspace linear -d float -o ramp.exr 2>/dev/null
ok "EXR against PNG" "$diff" --fail=.0001 --warn=.0001 ramp.exr ramp.png

picture()
{
	"$diff" -q -o diff.png --scale=2 a.exr ten.exr
	[ $? -eq 2 ] && oiiotool --stats diff.png | grep -q 'Stats Max: 51 0 0'
}
ok "the picture of the differences" picture
ok "an unwritable picture" fails 4 "$diff" -q -o no/such/folder/d.png a.exr ten.exr
json_file()
{
	"$diff" -q --json=out.json a.exr ten.exr
	[ $? -eq 2 ] && grep -q '"verdict": "failure"' out.json
}
ok "figures in a file" json_file
if [ -c /dev/full ]; then
	full()
	{
		fails 4 "$diff" a.exr same.exr >/dev/full
	}
	ok "standard output is full" full
else
	skip "standard output is full" "no /dev/full"
fi
tap_done
