#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# alidade-trade: what it reports is consistent, a second run measures nothing again, and what is wrong is said.
# No time is asserted.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$tap_dir" || exit 99
need python3
TRADE=$ALIDADE_BUILD/tools/alidade-trade
export ALIDADE

cat >s.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <3, 5, -4>, 1 }
sphere { 0, 0.8 pigment { rgb <0.8, 0.2, 0.1> } }
box { <-2, -0.9, -2>, <2, -0.8, 2> pigment { checker rgb 1, rgb 0.2 scale 0.3 } }
END

# Front, recommendations and medians are computed anew from what is in the files.
cat >check.py <<'END'
import json, statistics, sys
r = json.load(open(sys.argv[1]))
runs = {}
for line in open(sys.argv[2]):
    line = json.loads(line)
    if line["kind"] == "run":
        runs.setdefault(line["setting"], []).append(line)
clock, error = r["clock"], r["error"]
good = [s for s in r["settings"] if s["measured"]]
assert good and r["settings"][0]["setting"] == "default"
assert len({s["setting"] for s in r["settings"]}) == len(r["settings"])
T = {s["setting"]: s["values"][clock]["median"] for s in good}
E = {s["setting"]: abs(s["values"][error]["median"]) for s in good}
for s in good:
    n, mine = s["setting"], runs[s["setting"]]
    assert s["runs"] == len(mine), n
    for key, v in s["values"].items():
        assert v["low"] <= v["median"] <= v["high"], (n, key)
        if key != "wrong_per_million":
            assert abs(statistics.median(m[key] for m in mine) - v["median"]) <= 1e-12 * abs(v["median"]), (n, key)
    assert s["command"].startswith("alidade ") and s["command"].endswith("s.pov")
    assert all(o in s["command"] for o in s["options"])
    assert s["values"]["render_seconds"]["median"] <= s["values"]["process_seconds"]["median"]
    assert s["values"]["memory_bytes"]["median"] > 1e6
tied = any(v["outcome"] == "tied" for v in json.load(open("a.json"))["recommendations"])
least, front = float("inf"), set()
for n in sorted(T, key=T.get):
    if E[n] < 0.99 * least:
        least = E[n]
        front.add(n)
assert front == {s["setting"] for s in good if s["front"]}, front
assert not [s for s in r["settings"] if s["front"] and not s["measured"]]
by = {s["setting"]: s for s in good}
for v in r["recommendations"]:
    if v["outcome"] == "none":
        assert all((by[n]["values"][v["of"]]["high"] > v["bound"]) for n in by)
        continue
    pick = by[v["setting"]]["values"]
    assert pick[v["of"]]["high"] <= v["bound"], v
    assert (v["outcome"] == "tied") == bool(v["tied"])
    near = [n for n in by if by[n]["values"][v["of"]]["high"] <= v["bound"]]
    if v["kind"] == "fastest":
        fastest = min(near, key=T.get)
        assert pick[clock]["low"] <= by[fastest]["values"][clock]["high"], v
        if v["outcome"] == "clear":
            assert v["setting"] == fastest
            assert all(by[n]["values"][clock]["low"] > pick[clock]["high"] for n in near if n != fastest)
    else:
        best = min(near, key=E.get)
        assert 0.99 * pick[error]["low"] <= by[best]["values"][error]["high"], v
for want in sys.argv[3:]:
    assert eval(want), want
END
lines()
{
	grep -c '"kind": "run"' "$1"
}
trade()
{
	"$TRADE" --progress=none --verify=0 "$@"
}

sweep='--sweep=accel=box,none --sweep=aa=2,3 --combinations=3 --repeat=3'
# shellcheck disable=SC2086 # a list of words
ok "a sweep" trade $sweep --json=a.json --html=a.html --max-error=0.5 s.pov -- -s 24x18
ok "its files" test -s a.json -a -s a.html -a -s s-trade/results.jsonl
ok "figures, front and recommendations are what the runs say" python3 check.py a.json s-trade/results.jsonl \
	'r["complete"] and not r["random"]' 'len(good) >= 4' 'all(s["runs"] >= 2 for s in good)' 'by["default"]["runs"] >= 3' \
	'E["default"] > 0 and E["box"] == E["default"] and E["none"] == E["default"]' \
	'{"clear", "tied"} >= {v["outcome"] for v in r["recommendations"]}' 'r["recommendations"][0]["asked"]'
ok "no pictures are left but the reference" sh -c '[ "$(ls s-trade | grep -vc "^reference-.*pfm$")" = 1 ]'
ok "the command draws the picture" sh -c "$(python3 -c '
import json
print(json.load(open("a.json"))["recommendations"][0]["command"].replace("alidade", "\"$ALIDADE\" -q -o c.ppm", 1))')"
is "of the size" "$(head -c 9 c.ppm | tr '\n' ' ')" "P6 24 18 "
ok "the page is whole, and needs nothing else" python3 -c '
import html.parser, re, xml.etree.ElementTree as x
t = open("a.html").read()
svg = re.search("<svg.*</svg>", t, re.S).group(0)
assert len(x.fromstring(svg).findall(".//{http://www.w3.org/2000/svg}circle")) >= 5
assert not re.search(r"(src|href)=|url\(|@import", t)
assert set(re.findall("https?://[^\"]*", t)) == {"http://www.w3.org/2000/svg"}
open_ = []
class P(html.parser.HTMLParser):
    def handle_starttag(self, tag, attrs):
        if tag not in ("meta", "br"): open_.append(tag)
    def handle_startendtag(self, tag, attrs): pass
    def handle_endtag(self, tag): assert open_.pop() == tag, tag
P().feed(t)
assert not open_, open_'

ok "JSON instead of a table" sh -c '"$0" -q --verify=0 --sweep=aa=2 --repeat=1 --folder=other --json s.pov -- -s 16x12 |
	python3 -m json.tool' "$TRADE"

# Going on
n=$(lines s-trade/results.jsonl)
# shellcheck disable=SC2086
ok "again" trade $sweep --json=b.json s.pov -- -s 24x18
ok "measures nothing but what could break a tie" python3 check.py b.json s-trade/results.jsonl \
	"r['runs_kept'] == $n" "r['runs_measured_now'] == 0 or tied" 'max(s["runs"] for s in good) <= 9'
sed 's/#version/ \/\/ a comment\n&/' s.pov >t.pov && mv t.pov s.pov
trade --sweep=aa=2,3 --combinations=0 --repeat=1 --json=c.json s.pov -- -s 24x18 >table
ok "a comment changes no scene" python3 check.py c.json s-trade/results.jsonl 'r["runs_measured_now"] == 0'
is "a table with a row each" "$(grep -c '^[* ] *[0-9.]* [0-9.]*\.\.[0-9.]* .*  \(default\|aa=[23]\)$' table)" 3
sed -i 's/rgb <0.8/rgb <0.7/' s.pov
ok "another scene" trade --sweep=aa=2 --combinations=0 --repeat=1 --json=d.json s.pov -- -s 24x18
ok "is measured" python3 -c 'import json; assert json.load(open("d.json"))["runs_kept"] == 0'
printf '{"kind": "run", "key' >>s-trade/results.jsonl
ok "a line that was cut off" trade --sweep=aa=2 --combinations=0 --repeat=2 --json=e.json s.pov -- -s 24x18
ok "hurts nobody" python3 -c '
import json
r = json.load(open("e.json"))
assert r["runs_kept"] >= 2 and r["runs_measured_now"] >= 2
bad = 0
for l in open("s-trade/results.jsonl"):
    try: json.loads(l)
    except ValueError: bad += 1
assert bad == 1'
# Lines that nobody of us wrote: what can be read has other types, signs and sizes than it should.
python3 - <<'END'
import json
run = next(l for l in open("s-trade/results.jsonl") if '"kind": "run"' in l)
key = json.loads(run)["key"]
plan = dict(kind="plan", key=key, name=5, levels=[[-1, 1e300, "x", None] * 99, 7, {}] * 999)
with open("s-trade/results.jsonl", "ab") as f:
    for line in (b"nothing of the kind", b"[" * 100000, b'{"kind": "run" "key": 1}', b'"\\ud800"', b'{"a": "\xff"}',
                 b'{"kind": "run\x00", "key": 1}', b'{"kind": "run", "key": 1e999}', b"{" + b'"a": {' * 5000,
                 b"null", b"5", b"[]", b"{}", b'{"kind": 7, "key": []}',
                 json.dumps(plan).encode(), json.dumps(dict(kind="reference", key=key, pictures=-1e300)).encode(),
                 json.dumps(dict(kind="verify", key=key, checked="all", different={})).encode(),
                 json.dumps(dict(kind="failure", key=key, limit=-1, message=[])).encode(),
                 json.dumps(dict(kind="run", key=key, seed=-1e300, process_seconds="1", rmse=None)).encode()):
        f.write(line + b"\n")
END
wrong=$(grep -n '^{"kind": "run", "key$' s-trade/results.jsonl | cut -d: -f1)
ok "lines of others" sh -c 'n=$1; shift; "$@" 2>err && grep -q "results.jsonl:$n: warning: this is no JSON: .* it and other" err' \
	sh "$wrong" "$TRADE" --verify=0 --sweep=aa=2 --combinations=0 --repeat=1 --json=m.json s.pov -- -s 24x18
ok "change nothing" python3 -c '
import json
a, b = (json.load(open(f)) for f in ("e.json", "m.json"))
assert b["runs_measured_now"] == 0
for x, y in zip(a["settings"], b["settings"], strict=True):
    assert x["setting"] == y["setting"] and x["values"] == y["values"], (x, y)'
ok "--fresh" trade --fresh --sweep=aa=2 --combinations=0 --repeat=1 s.pov -- -s 24x18
ok "forgets" sh -c '! grep -q "\"setting\": \"box\"" s-trade/results.jsonl'

# What fails in one setting is no end of the others.
ok "a setting that fails" trade --sweep=accel=box,nosuch --json=f.json --repeat=1 s.pov -- -s 24x18
ok "is listed with what it said" python3 -c '
import json
s = {s["setting"]: s for s in json.load(open("f.json"))["settings"]}
assert "no accelerator" in s["nosuch"]["failure"] and not s["nosuch"]["measured"] and s["box"]["measured"]'
ok "one that takes too long" trade --sweep=aa=64 --limit=0.5 --json=g.json --repeat=1 \
	--reference-options=aa=1 --folder=slow s.pov -- -s 400x300 -t 1
ok "is stopped" python3 -c '
import json
s = json.load(open("g.json"))["settings"][1]
assert s["setting"] == "aa=64" and "--limit" in s["failure"], s'

ok "hits are checked" "$TRADE" -q --sweep=accel=box --combinations=0 --repeat=1 --verify=1 --json=l.json s.pov -- -s 24x18
ok "and are right" python3 -c '
import json
s = [s for s in json.load(open("l.json"))["settings"] if s["measured"]]
assert len(s) == 2
assert all(x["hits_checked"] >= 24 * 18 and x["values"]["wrong_per_million"]["median"] == 0 for x in s)'

ok "hits of which some may be wrong" sh -c '"$0" -q --verify=1 --sweep=aa=2 --repeat=1 --json=n.json --html=n.html s.pov \
	-- -s 24x18 --precision=fast >text' "$TRADE"
ok "are said to be inexact beside what is recommended, with how many were wrong" python3 -c '
import json
r = json.load(open("n.json"))
text, page = open("text").read(), open("n.html").read()
assert all(s["inexact"] == "--precision=fast" for s in r["settings"])
for v in r["recommendations"]:
    assert v["caution"].startswith("Its hits are inexact: --precision=fast. Wrong here: "), v
    assert "\n  " + v["caution"] + "\n" in text and v["caution"] in page
assert r["recommendations"]
assert all(v["caution"] is None for v in json.load(open("l.json"))["recommendations"])'

# Errors are the same whoever draws; of times nothing is said here.
ok "confirming" trade --sweep=aa=2 --repeat=3 --confirm --json=k.json s.pov -- -s 24x18
ok "holds" python3 -c '
import json
r = json.load(open("k.json"))["recommendations"]
assert r and all(v["again"]["runs"] == 3 and v["again"]["error_holds"] for v in r)
assert all(isinstance(v["again"]["time_holds"], bool) for v in r)'

# Errors
ok "the truth itself" "$ALIDADE" -q -s 24x18 -o truth.pfm s.pov
ok "as reference" trade --reference=truth.pfm --sweep=accel=box --repeat=1 --json=h.json s.pov -- -s 24x18
ok "there is no error" python3 -c '
import json
r = json.load(open("h.json"))
assert all(s["values"]["rmse"]["median"] == 0 for s in r["settings"] if s["measured"])
assert any("to the bit" in n for n in r["notes"])'
ok "a reference of another size" sh -c '"$0" --reference=truth.pfm s.pov -- -s 32x24 2>err; [ $? = 2 ]' "$TRADE"
ok "is refused with both" grep -q 'truth.pfm has 24 x 18 pixels.*32 x 24' err
ok "a bound that nothing keeps" fails 5 "$TRADE" -q --verify=0 --sweep=aa=2 --repeat=1 --max-error=1e-9 s.pov -- -s 24x18
ok "no scene" fails 2 "$TRADE"
ok "two scenes" fails 2 "$TRADE" s.pov s.pov
ok "a sweep of what is no option" fails 2 "$TRADE" --sweep=speed=9 s.pov
ok "a level that is none" fails 2 "$TRADE" --sweep=aa=often s.pov
ok "an output of one's own" fails 2 "$TRADE" s.pov -- -o x.png
ok "counting" fails 2 "$TRADE" s.pov -- --stats
ok "an animation" fails 2 "$TRADE" s.pov -- -f 1..3
ok "standard input" fails 2 "$TRADE" -
echo 'sphere { 0 }' >bad.pov
ok "a scene that is wrong" sh -c '"$0" bad.pov 2>err; [ $? = 3 ] && grep -q "^alidade-trade: bad.pov:1:" err' "$TRADE"
ok "no program" sh -c '"$0" --program=/nonexistent s.pov 2>err; [ $? = 1 ] && grep -q "/nonexistent.*--program" err' "$TRADE"
mkdir full && ln -s /dev/full full/results.jsonl
if [ -c /dev/full ]; then
	ok "a full disk" sh -c '"$0" -q --folder=full s.pov -- -s 24x18 2>err; [ $? = 1 ]' "$TRADE"
	ok "is said" grep -q 'full/results.jsonl: No space left' err
fi

# ^C
env --default-signal=INT "$TRADE" --progress=none --verify=0 --sweep=aa=2,3,4,5,6 --repeat=16 --folder=stop \
	--json=i.json s.pov -- -s 200x150 >/dev/null 2>err &
pid=$!
tries=0
until [ "$(cat stop/results.jsonl 2>/dev/null | wc -l)" -ge 4 ] || [ $((tries += 1)) -gt 600 ]; do
	sleep 0.1
done
ok "two at a time" sh -c '"$0" --folder=stop s.pov 2>err2; [ $? = 1 ] && grep -q "in use" err2' "$TRADE"
kill -s INT $pid
ok "SIGINT" fails 130 wait $pid
ok "says that it can go on" grep -q 'goes on' err
ok "reports what there is" python3 check.py i.json stop/results.jsonl 'not r["complete"]'
ok "leaves no pictures" sh -c '! ls stop | grep -q work'
ok "and results that are kept" trade --sweep=aa=2,3,4,5,6 --repeat=1 --combinations=0 --folder=stop --json=j.json \
	s.pov -- -s 200x150
ok "by the next" python3 -c 'import json; assert json.load(open("j.json"))["runs_kept"] >= 3'
tap_done
