#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# What the loader refuses, in which words, and that nothing of what it refuses is ever run.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
: "${CC:=cc}"
try=$ALIDADE_BUILD/tests/plugins/try
own=$ALIDADE_BUILD/plugins/.libs
cd "$tap_dir" || exit 99
umask 022
mkdir bad other

# plugin FILE FLAGS ...
plugin()
{
	out=$1
	shift
	# shellcheck disable=SC2086 # $CC may be a command with arguments
	$CC -shared -fPIC -O1 -I"$ALIDADE_SRC/include" "$@" -o "$out" "$ALIDADE_SRC/tests/plugins/bad.c"
}

# refused NAME SPEC TEXT: status 4, and just this one line, in which @ stands for the folder bad.
refused()
{
	got=$("$try" "$2" 2>&1)
	status=$?
	is "$1" "$status: $got" "4: error: $(printf '%s' "$3" | sed "s|@|$tap_dir/bad|g")"
}

# says NAME STATUS SPEC PATTERN
says()
{
	got=$("$try" "$3" 2>&1)
	status=$?
	tap_count=$((tap_count + 1))
	if [ "$status" = "$2" ] && printf '%s\n' "$got" | grep -Eq -- "$4"; then
		echo "ok $tap_count - $1"
	else
		echo "not ok $tap_count - $1"
		tap_failed=$((tap_failed + 1))
		printf '%s\n' "status $status, expected $2" "got: $got" "pattern: $4" | sed 's/^/# /'
	fi
}

embree= # it is optional
[ ! -f "$own/embree.so" ] || embree=", embree"
ALIDADE_ACCEL_PATH=$tap_dir/bad:$own
export ALIDADE_ACCEL_PATH

# ---- what is not there ----
says "a name with a slip of the pen" 4 octre "no accelerator 'octre'\. Did you mean 'octree'\? Searched: $tap_dir/bad \(none\); $own \(box, bvh8$embree, none, octree, sphere\); .* ALIDADE_ACCEL_PATH"
says "a name like no other" 4 quadrangle "^error: no accelerator 'quadrangle'\. Searched: "
refused "no name" "" "an accelerator is given as NAME, NAME:KEY=VALUE,... or a path with a slash"
refused "not a name" "Octree" "'Octree' can't be an accelerator's name, which is of the form [a-z][a-z0-9-]*; a file is named by a path with a slash: ./Octree"
refused "not a name either" "octree.so" "'octree.so' can't be an accelerator's name, which is of the form [a-z][a-z0-9-]*; a file is named by a path with a slash: ./octree.so"
refused "no such file" ./nowhere.so "accelerator ./nowhere.so: No such file or directory"
mkdir -p bad/folder.so
refused "a folder" "$tap_dir/bad/folder.so" "accelerator @/folder.so: this is a folder; give the .so file in it"
rmdir bad/folder.so
cp "$own/none.so" other/None.so
refused "a file of another kind of name" ./other/None.so "accelerator ./other/None.so: a plugin's file is named NAME.so with NAME of [a-z][a-z0-9-]*"

# ---- where is looked ----
cp "$own/none.so" other/mine.so
says "nothing in the working directory" 4 mine "no accelerator 'mine'"
got=$(cd other && ALIDADE_ACCEL_PATH=:.:./x:$own "$try" mine 2>&1)
is "relative folders are left out, and said to be" "$(printf '%s\n' "$got" | head -n 2)" \
	"warning: ALIDADE_ACCEL_PATH: '.' is left out: only absolute folders are searched
warning: ALIDADE_ACCEL_PATH: './x' is left out: only absolute folders are searched"
# mine, as none may have been installed already.
LD_LIBRARY_PATH=$PWD/other
export LD_LIBRARY_PATH
says "the linker's path is not ours" 4 mine "no accelerator 'mine'"
unset LD_LIBRARY_PATH

# ---- what is wrong with the file ----
plugin bad/bad.so
says "the bad plugin is good so far" 0 bad '^bad$'
plugin bad/bad.so -DBAD_CONSTRUCTOR
says "and tells when its code is run" 0 bad '^code was run$'
plugin bad/bad.so -DBAD_ABI=7 -DBAD_CONSTRUCTOR
refused "another ABI" bad "accelerator @/bad.so: it speaks ABI 7, this program ABI 1; build it again with this version's <alidade/accel.h>"
plugin bad/bad.so -DBAD_SYMBOL=ald_accel_enter -DBAD_CONSTRUCTOR
refused "no such symbol" bad "accelerator @/bad.so: it does not export the symbol ald_accel_entry: it is no accelerator"
plugin bad/bad.so -DBAD_FUNCTION -DBAD_CONSTRUCTOR
refused "the symbol is a function" bad "accelerator @/bad.so: its ald_accel_entry is a function; it must be the structure itself"
plugin bad/bad.so -DBAD_SIZE=8 -DBAD_CONSTRUCTOR
says "too small" 4 bad "^error: accelerator $tap_dir/bad/bad.so: its entry states a size of 8 bytes, which is not between [0-9]* and [0-9]*; size must be sizeof\(ald_accel_plugin\)$"
plugin bad/bad.so -DBAD_SIZE=4096 -DBAD_CONSTRUCTOR
refused "larger than it is" bad "accelerator @/bad.so: its ald_accel_entry is smaller than the size that it states"
plugin bad/whole.so -DBAD_NAME='"whole"' -DBAD_CONSTRUCTOR
size=$(wc -c <bad/whole.so)
for part in 1 3 63 64 100 $((size / 4)) $((size / 2)) $((size - 100)) $((size - 1)); do
	head -c "$part" bad/whole.so >bad/bad.so
	case $part in
	1 | 3) why="it is not a shared library" ;;
	*) why="the file is cut short" ;;
	esac
	refused "cut to $part of $size bytes" bad "accelerator @/bad.so: $why"
done
: >bad/bad.so
refused "empty" bad "accelerator @/bad.so: it is empty"
echo 'sphere { 0, 1 }' >bad/bad.so
refused "a scene" bad "accelerator @/bad.so: it is not a shared library"
head -c 8192 /dev/zero >bad/bad.so
refused "zeroes" bad "accelerator @/bad.so: it is not a shared library"
cp "$try" bad/bad.so
says "a program" 4 bad "^error: accelerator $tap_dir/bad/bad.so: "
cp "$own/none.so" bad/bad.so
refused "under a wrong name" bad "accelerator @/bad.so: it calls itself 'none'; the file has to be named none.so"

# ---- what is wrong inside ----
plugin bad/bad.so -DBAD_NO_INTERSECT
refused "a function is missing" bad "accelerator @/bad.so: its function intersect is missing; build, intersect and destroy are required"
plugin bad/bad.so -DBAD_SUMMARY=NULL
refused "no summary" bad "accelerator @/bad.so: its version, license or summary is missing"
plugin bad/bad.so -DBAD_PRECISIONS=0
refused "no precision" bad "accelerator @/bad.so: it states no precision that it can serve; set precisions to ALD_PRECISION_DEFAULT"
plugin bad/bad.so -DBAD_PRECISIONS=ALD_PRECISION_DEFAULT
is "a precision that it does not serve" \
	"$("$ALIDADE_BUILD/src/alidade" -a bad --precision=exact --dry-run "$ALIDADE_SRC/tests/cli/scene.pov" 2>&1 |
		grep ^alidade)" \
	"alidade: error: accelerator bad: it does not serve --precision=exact; these do: box, bvh8$embree, none, octree, sphere"
plugin bad/bad.so -DBAD_PARAMS='{ "k", "help", ALD_INT, 9, 0, 5, NULL }'
refused "a default out of range" bad "accelerator @/bad.so: its parameter 'k' is wrong: its default is outside its range"
plugin bad/bad.so -DBAD_INEXACT=2 -DBAD_PARAMS='{ "k", "help", ALD_INT, 0, 0, 5, NULL }'
refused "a bit for no parameter" bad "accelerator @/bad.so: its inexact has a bit for a parameter that it has not"
plugin bad/bad.so -DBAD_INEXACT=1 -DBAD_PARAMS='{ "k", "of steel", ALD_INT, 0, 0, 5, NULL }' \
	-DBAD_PRECISIONS=ALD_PRECISION_DEFAULT+ALD_PRECISION_EXACT
says "a parameter that is inexact" 0 bad:k=1 '^bad:k=1$'
ok "and listed as such" sh -c '"$0" --list-accels 2>&1 | grep -q "k=0  (0 to 5)  inexact, unless as by default: of steel"' \
	"$ALIDADE_BUILD/src/alidade"
is "is no way to exact hits" \
	"$("$ALIDADE_BUILD/src/alidade" -a bad:k=1 --precision=exact --dry-run "$ALIDADE_SRC/tests/cli/scene.pov" 2>&1 |
		grep ^alidade)" \
	"alidade: error: accelerator bad: what k asks for (of steel) is inexact, and --precision=exact is asked for too; leave one out"
is "unless it is its default" \
	"$("$ALIDADE_BUILD/src/alidade" -a bad:k=0 --precision=exact --dry-run "$ALIDADE_SRC/tests/cli/scene.pov" 2>&1 |
		grep -c inexact)" 0
plugin bad/bad.so -DBAD_PARAMS='{ "K", "help", ALD_INT, 0, 0, 5, NULL }'
refused "a parameter's name" bad "accelerator @/bad.so: its parameter 'K' is wrong: its name is not of the form [a-z][a-z0-9-]*"
plugin bad/bad.so -DBAD_PARAMS='{ "k", "help", ALD_INT, 0.5, 0, 5, NULL }'
refused "half an integer" bad "accelerator @/bad.so: its parameter 'k' is wrong: its range is not of whole numbers up to 2^53"
plugin bad/bad.so -DBAD_PARAMS='{ "k", "help", ALD_REAL, 0, 0, __builtin_inf(), NULL }'
refused "an infinite range" bad "accelerator @/bad.so: its parameter 'k' is wrong: its range is not finite"
plugin bad/bad.so -DBAD_PARAMS='{ "k", "help", ALD_CHOICE, 0, 0, 5, NULL }'
refused "a choice of nothing" bad "accelerator @/bad.so: its parameter 'k' is wrong: its range does not match its labels"
plugin bad/bad.so -DBAD_PARAMS='{ "k", "help", ALD_INT, 0, 0, 5, NULL }, { "k", "help", ALD_INT, 0, 0, 5, NULL }'
refused "two of one name" bad "accelerator @/bad.so: its parameter 'k' is wrong: its name is there twice"

# ---- whom to trust ----
plugin bad/bad.so -DBAD_CONSTRUCTOR
chmod 666 bad/bad.so
refused "a file that anyone may write" bad "accelerator @/bad.so: anyone may write to this file, so it is not run; say chmod o-w on it if you trust it"
chmod 644 bad/bad.so
chmod 777 bad
refused "a folder that anyone may write" bad "accelerator @/bad.so: anyone may write to its folder, so it is not run; say chmod o-w on the folder if you trust it, or move the file"
ln -sf ../bad/bad.so other/bad.so
refused "and a link to it" ./other/bad.so "accelerator ./other/bad.so: anyone may write to its folder, so it is not run; say chmod o-w on the folder if you trust it, or move the file"
chmod 1777 bad
says "a folder like /tmp, the file being ours" 0 bad '^bad$'
chmod 755 bad
says "a link" 0 ./other/bad.so '^bad$'
mkfifo bad/pipe.so
refused "a pipe" pipe "accelerator @/pipe.so: this is not an ordinary file"
rm bad/pipe.so

# ---- arithmetic: gcc's -ffast-math start file flushes denormal numbers to zero ----
plugin bad/bad.so -ffast-math
says "a plugin that changes the arithmetic" 0 bad '^bad$'

# ---- parameters ----
says "defaults" 0 octree '^octree:depth=[0-9]+,leaf=[0-9]+,price=[0-9.]+,index=auto,shape=cube,node=box,walk=loop,isa=auto$'
says "given ones" 0 octree:leaf=3,index=32,price=0.25,depth=1e1 '^octree:depth=10,leaf=3,price=0\.25,index=32,shape=cube,node=box,walk=loop,isa=auto$'
says "a path and parameters" 0 "$own/octree.so:leaf=3" '^octree:depth=[0-9]+,leaf=3,'
says "an unknown one" 4 octree:leef=3 "^error: accelerator 'octree' has no parameter 'leef'\. Did you mean 'leaf'\? It takes depth \(0\.\.21\), leaf \(1\.\.65535\), price \(0\.\.1000\), index \(auto, 16 or 32\), shape \(cube or box\), node \(box or sphere\), walk \(loop or recursion\), isa \(auto, plain, sse, avx2 or avx512\)\.$"
refused "there are none" bad:leaf=3 "accelerator 'bad' has no parameter 'leaf'. It takes none."
for bad in leaf= leaf=0 leaf=65536 leaf=2.5 leaf=x leaf=3x leaf=nan leaf=0x3; do
	says "$bad" 4 "octree:$bad" "^error: accelerator 'octree': $bad is refused; leaf is a whole number 1\.\.65535 \(.*\)$"
done
says "no such choice" 4 octree:index=8 "index=8 is refused; index is auto, 16 or 32 \(.*\)$"
refused "twice" octree:leaf=3,leaf=4 "accelerator 'octree': parameter 'leaf' is given twice"
refused "no value" octree:leaf "accelerator 'octree': 'leaf' is not of the form KEY=VALUE"
refused "nothing behind the colon" octree: "accelerator 'octree': '' is not of the form KEY=VALUE"

# ---- the list ----
rm bad/whole.so
cp "$own/none.so" bad/bad.so
cp "$own/octree.so" bad/octree.so
got=$("$try" --list 2>"$tap_dir/err" | sed 's/:.*//' | tr '\n' ' ')
is "the list, the first of a name" "$got" "octree box bvh8${embree#,} none sphere "
is "the list warns of what is broken" "$(cat "$tap_dir/err")" \
	"warning: accelerator $tap_dir/bad/bad.so: it calls itself 'none'; the file has to be named none.so"
tap_done
