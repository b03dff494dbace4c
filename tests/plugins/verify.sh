#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# --verify finds out an accelerator that lies, at the right pixel, and suspects none that does not.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need python3
: "${CC:=cc}"
cd "$tap_dir" || exit 99

# Primitive 0 is glass, 1 stands behind it, 2 is the floor. Light comes from above.
cat >scene.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 3, -5> look_at 0 right 4*x up 3*y }
light_source { <0, 9, -1> rgb 1 }
sphere { <0.5, 0.3, 0>, 0.5 pigment { rgbt <1, 0.9, 0.8, 0.7> } finish { diffuse 0.3 } }
sphere { <-0.4, 0.6, 0.6>, 0.35 pigment { rgbt <0.5, 0.9, 0.8, 0.2> } finish { diffuse 0.6 } }
box { <-2, -1.2, -2>, <2, -1, 2> pigment { rgb 0.7 } finish { diffuse 0.7 } }
sphere { <0.9, 0.9, -0.3>, 0.2 pigment { rgb 0.7 } finish { diffuse 0.7 reflection 0.3 } }
END
# Where nothing is clear a shadow ray asks if anything is there; else it walks from surface to surface.
sed 's/rgbt <\([^,]*, [^,]*, [^,]*\), [^>]*>/rgb <\1>/' scene.pov >opaque.pov

# shellcheck disable=SC2086 # $CC may be a command with arguments
ok "an accelerator that lies is built" $CC -shared -fPIC -O1 -ffp-contract=off -I"$ALIDADE_SRC/include" \
	-o liar.so "$ALIDADE_SRC/tests/plugins/liar.c"

scene=scene.pov
draw()
{
	"$ALIDADE" -q -s 80x60 "$@" $scene
}

# status NAME EXPECTED ARGUMENTS ...
status()
{
	name=$1 want=$2
	shift 2
	draw "$@" 2>err
	is "$name" $? "$want"
}

# of FILE EXPRESSION: of the JSON's verify, v.
of()
{
	python3 -c 'import json, sys; v = json.load(open(sys.argv[1])).get("verify"); print(eval(sys.argv[2]))' "$@"
}

status "a picture" 0 -o plain.ppm --stats=plain.json
is "without --verify says nothing of it" "$(of plain.json v)" None
embree= # it is optional
[ ! -f "$ALIDADE_BUILD/plugins/.libs/embree.so" ] || embree="embree embree:packet=16"
# shellcheck disable=SC2086 # words
for accel in none box sphere octree bvh8 $embree ./liar.so; do
	status "$accel" 0 -a $accel --verify 1 -o honest.ppm --stats=honest.json
	ok "all its rays were asked again" test "$(of honest.json 'v["checked"]')" -ge 6000
	is "from surface to surface" "$(of honest.json 'min(v[q]["checked"] for q in ("nearest", "next")) > 100')" True
	is "all answers were right" "$(of honest.json 'v["different"]')" 0
	ok "the picture is the same" cmp plain.ppm honest.ppm
	is "nothing is said" "$(cat err)" ""
	scene=opaque.pov
	status "$accel, nothing clear" 0 -a $accel --verify 1 -o opaque.ppm --stats=opaque.json
	is "its answers were right" "$(of opaque.json 'v["different"] == 0 and v["occluded"]["checked"] > 100')" True
	scene=scene.pov
done
cast='sum(j["rays"][k]["cast"] for k in ("camera", "reflected", "refracted"))'
is "rays checked are rays cast" "$(python3 -c 'import json; j = json.load(open("honest.json"))
print(j["verify"]["nearest"]["checked"] >= j["rays"]["shadow"]["cast"] + '"$cast"')')" True
is "and where nothing is clear" "$(python3 -c 'import json; j = json.load(open("opaque.json"))
print(j["verify"]["nearest"]["checked"] == '"$cast"' and
	j["verify"]["occluded"]["checked"] == j["rays"]["shadow"]["cast"])')" True

# The pixels in which a forgotten primitive shows: camera rays alone.
draw --camera-only -o all.ppm
grep -v '^sphere.*<-0\|^sphere.*<0.9\|^box' scene.pov >alone.pov
"$ALIDADE" -q -s 80x60 --camera-only -o alone.ppm alone.pov
status "a lie about what is nearest" 7 --camera-only -a ./liar.so:lie=nearest,about=0 --verify 1 -o lie.ppm --stats=lie.json
cat >where.py <<'END'
import json

def pixels(name):
    data = open(name, 'rb').read()
    return data[len(data) - 80 * 60 * 3:]

a, b = pixels('all.ppm'), pixels('lie.ppm')
wrong = [(i % 80, i // 80) for i in range(80 * 60) if a[3 * i:3 * i + 3] != b[3 * i:3 * i + 3]]
v = json.load(open('lie.json'))['verify']
first = [(d['x'], d['y']) for d in v['first']]
# Where something else stands behind it, the hit is wrong although both are white.
alone = sum(x > 0 for x in pixels('alone.ppm')[::3])
assert len(wrong) > 50 and set(first) <= set(wrong) and first[0] == wrong[0], (first, wrong[:9])
assert len(wrong) <= v['different'] == v['nearest']['different'] <= alone, (v, len(wrong), alone)
END
ok "is found where it is told, as often" python3 where.py
is "it is told in a line each, and a last one" "$(wc -l <err)" 6
ok "with the pixel, the ray and the primitive" \
	grep -Eq 'pixel [0-9]+,[0-9]+: camera ray, the nearest hit: liar found nothing, the judge primitive 0 of object 0 \(scene.pov:5\) at t = .* ray from <' err

for question in nearest occluded next; do
	about=3
	[ $question != next ] || about=0
	[ $question != occluded ] || scene=opaque.pov
	draw -o truth.ppm
	status "a lie: $question" 7 -a ./liar.so:lie=$question,about=$about --verify 1 -o lie.ppm --stats=lie.json
	is "is one about that" "$(of lie.json '[q for q in ("nearest", "occluded", "next") if v[q]["different"]]')" \
		"['$question']"
	ok "and another picture" sh -c '! cmp -s truth.ppm lie.ppm'
	scene=scene.pov
done
ok "the lines name shadow rays" sh -c '"$ALIDADE" -q -s 80x60 opaque.pov \
	-a ./liar.so:lie=occluded,about=3 --verify 1 -o lie.ppm 2>&1 | grep -q "shadow ray, whether anything is hit: liar found nothing, the judge primitive 3 "'

# One in seven: the same ones for every number of threads and side of tiles.
status "a lie to one ray in seven, 1 thread" 7 -t 1 -a ./liar.so:lie=nearest,about=0 --verify 7 -o one.ppm --stats=one.json
cp err one.err
status "3 threads" 7 -t 3 --tile 7 -a ./liar.so:lie=nearest,about=0 --verify 7 -o three.ppm --stats=three.json
is "the same rays" "$(of three.json v)" "$(of one.json v)"
ok "the same lines" cmp err one.err
status "the truth for one ray in seven" 0 --verify 7 -o seven.ppm --stats=seven.json
is "one in seven" "$(of seven.json '8 * v["checked"] > json.load(open("honest.json"))["verify"]["checked"] > 6 * v["checked"]')" True
# Two floors that cross, at less of an angle than rounding can tell: which is above is not always known by default.
cat >floors.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0.3, 700, -900> look_at 0 angle 3 }
#macro Floor(Y) mesh2 { vertex_vectors { 3, <-70, -Y, -90>, <80, Y, -60>, <1, 0.01 * Y, 75> } face_indices { 1, <0, 1, 2> } } #end
union { Floor(2e-12) Floor(-2e-12) pigment { rgb 1 } }
END
sed 's/^#version.*/&/' floors.pov >scene.pov
status "a scene at the edge of rounding" 0 --camera-only --verify 1 -o edge.ppm --stats=edge.json
is "no accelerator is to blame" "$(of edge.json 'v["different"]')" 0
ok "some hits are not the ones that are really first" test "$(of edge.json 'v["nearest"]["inexact"]')" -ge 5
is "the first are listed" "$(of edge.json 'len(v["first_inexact"])')" 5
"$ALIDADE" -v -s 80x60 --camera-only --verify 1 -o edge.ppm scene.pov 2>err
ok "and with -v told" grep -q 'pixel [0-9]*,[0-9]*: camera ray, the nearest hit: bvh8 found primitive ., .*in exact order it is primitive' err
status "--precision=exact" 0 --camera-only --precision=exact --verify 1 -o edge.ppm --stats=edge.json
is "finds these" "$(of edge.json 'v["different"] + v["inexact"]')" 0
status "not a number" 2 --verify 0 -o x.ppm
tap_done
