#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# No lengths in the sources: what is near to what depends on the scene's size and on rounding alone (lengths.py).
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need python3
cd "$ALIDADE_SRC" || exit 99

ok "every small number is on the list, and the list is short" \
	python3 tests/lengths.py tests/lengths.txt src plugins include

# The check itself, with sources that it has to refuse.
mkdir "$tap_dir/src"
try()
{
	printf '%s\n' "$2" >"$tap_dir/src/a.c"
	printf '%s\n' "$3" >"$tap_dir/list.txt"
	got=$(cd "$tap_dir" && python3 "$ALIDADE_SRC/tests/lengths.py" list.txt src)
	is "$1" "$got" "$4"
}
hit='src/a.c:1: may be a length in scene units: '
try "an epsilon" 'r.tmin = 1e-4;' '' "${hit}r.tmin = 1e-4;"
try "as a decimal" 'if (t < .001) return;' '' "${hit}if (t < .001) return;"
try "as a float" 'p += 0.0005f * n;' '' "${hit}p += 0.0005f * n;"
try "as a power of two" '#define NEAR 0x1p-20' '' "${hit}#define NEAR 0x1p-20"
try "among other numbers" 'x = 3 * y + 1E-7 / 2;' '' "${hit}x = 3 * y + 1E-7 / 2;"
try "not in comments, strings, names; not large ones" 'a1e = 0.5 + 1e4 /* 1e-4 */; puts("1e-4"); /*
1e-6 */ x = 0x10 + 0;' '' ''
try "not what is on the list" 'r.tmin = 1e-4;' 'src/a.c | tmin = | a reason' ''
try "but nothing else" 'r.tmax = 1e-4;' 'src/b.c | tmax = | a reason' "${hit}r.tmax = 1e-4;
lengths.txt: matches nothing: src/b.c | tmax ="

# And what it is for: the reader knows no lengths either.
cat >"$tap_dir/one.pov" <<'END'
#version 3.7; global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> look_at <0, 0, 0> }
light_source { <5, 5, -9> rgb 1 spotlight point_at 0 radius 30 falloff 40 }
cylinder { <0, -1, 0>, <0, 1, 0>, 1 pigment { rgb 1 } }
cone { <2, -1, 0>, 1, <2, 1, 0>, 0 pigment { rgb 1 } }
torus { 1, 0.3 pigment { rgb 1 } }
END
sed '/#version/!s/\([1-9][0-9]*\|0\.3\)\([,> ]\)/\1e-12\2/g; s/rgb 1e-12/rgb 1/g; s/radius 30e-12 falloff 40e-12/radius 30 falloff 40/' \
	"$tap_dir/one.pov" >"$tap_dir/small.pov"
ok "a scene of the size of an atom" sh -c 'cd "$0" && for f in one small; do
	"$ALIDADE" -q -s 64x48 -o $f.ppm $f.pov || exit; done; cmp one.ppm small.ppm && grep -q -- "-4e-12" small.pov' "$tap_dir"
tap_done
