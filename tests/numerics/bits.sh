#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# The same hits and pictures to the bit: with every accelerator and any number of threads; whatever libraries and
# plugins do to arithmetic and locale; and with another build, which is that in $ALIDADE_OTHER if it is set (./dev
# check names the one by clang). ALIDADE_ALL=1: by gcc and clang at -O0, -O2 and -O3 -march=native, each built from
# the sources, and all scenes of tests/features; ALIDADE_JOBS: with as many jobs (2).
. "${ALIDADE_SRC:-.}/tests/tap.sh"
: "${CC:=cc}"
here=$ALIDADE_SRC/tests/numerics
scene=$here/kinds.pov
unset ALIDADE_TEST_ACCEL

# hits ARGS ...: the hash of this build, or of that in $build
hits()
{
	ALIDADE_ACCEL_PATH=${build:-$ALIDADE_BUILD}/plugins/.libs \
		"${build:-$ALIDADE_BUILD}/tests/numerics/hits" "$@" "$scene"
}

# picture ARGS ... SCENE: its checksum
picture()
{
	rm -f "$tap_dir/out.pfm"
	ALIDADE_ACCEL_PATH=${build:-$ALIDADE_BUILD}/plugins/.libs \
		ALIDADE_MODULE_PATH=${build:-$ALIDADE_BUILD}/src/image/oiio/.libs \
		"${build:-$ALIDADE_BUILD}/src/alidade" -q -o "$tap_dir/out.pfm" "$@" 2>"$tap_dir/said" ||
		{ echo "none: $(cat "$tap_dir/said")"; return; }
	cksum <"$tap_dir/out.pfm"
}

small="-s 64x48 --aa=pov2"
want_hits=$(hits)
# shellcheck disable=SC2086 # words
want_picture=$(picture $small -t 2 "$scene")
ok "there are hits to compare" test -n "$want_hits"
ok "there is a picture to compare" test "${want_picture#none}" = "$want_picture"

# ---- accelerators and threads ----
accels=$(for file in "$ALIDADE_BUILD"/plugins/.libs/*.so; do basename "$file" .so; done)
for accel in $accels; do
	is "hits: $accel" "$(hits -a "$accel")" "$want_hits"
	for threads in 1 2 3 7 16 64; do
		# shellcheck disable=SC2086
		is "picture: $accel, $threads threads" "$(picture $small -a "$accel" -t $threads "$scene")" "$want_picture"
	done
done
# shellcheck disable=SC2086
ok "another picture has another checksum" test "$(picture --aa=pov2 -s 64x49 "$scene")" != "$want_picture"

# ---- what others change ----
# A locale with a comma, that of this folder: most machines have none.
LOCPATH=$tap_dir
export LOCPATH
comma=
if localedef -i de_DE -f UTF-8 "$tap_dir/de_DE.UTF-8" >/dev/null 2>&1; then
	printf '#include <locale.h>\n#include <stdio.h>\nint main(void) { setlocale(LC_ALL, ""); printf("%%g", 0.5); }\n' \
		>"$tap_dir/half.c"
	# shellcheck disable=SC2086
	$CC -o "$tap_dir/half" "$tap_dir/half.c" && [ "$(LC_ALL=de_DE.UTF-8 "$tap_dir/half")" = "0,5" ] && comma=1
fi
dry()
{
	ALIDADE_ACCEL_PATH=$ALIDADE_BUILD/plugins/.libs "$ALIDADE" --dry-run -s 80x60 "$scene" 2>&1 | grep -v ' s$'
}
plain=$(dry)
locales=C
if [ -n "$comma" ]; then
	locales="C de_DE.UTF-8"
	# shellcheck disable=SC2086
	is "picture: LC_ALL=de_DE.UTF-8" "$(LC_ALL=de_DE.UTF-8 picture $small "$scene")" "$want_picture"
	is "hits: LC_ALL=de_DE.UTF-8" "$(LC_ALL=de_DE.UTF-8 hits)" "$want_hits"
else
	skip "a locale with a comma" "localedef makes no de_DE.UTF-8 here"
fi
# shellcheck disable=SC2086
if [ "$(uname -m)" = x86_64 ] && $CC -shared -fPIC -O1 -frounding-math -o "$tap_dir/upset.so" "$here/upset.c" -lm &&
	mkdir "$tap_dir/plugin" && $CC -std=gnu17 -shared -fPIC -O3 -ffp-contract=off -fvisibility=hidden -DUPSET_PLUGIN \
		-I"$ALIDADE_SRC/include" -I"$ALIDADE_SRC/plugins" -o "$tap_dir/plugin/none.so" "$here/upset.c" \
		"$ALIDADE_SRC"/plugins/flat*.c -lm; then
	for locale in $locales; do
		upset="flush to zero, rounding up, LC_ALL=$locale"
		is "hits: a library there before main(): $upset" \
			"$(LC_ALL=$locale LD_PRELOAD=$tap_dir/upset.so hits)" "$want_hits"
		# shellcheck disable=SC2086
		is "picture: a library there before main(): $upset" \
			"$(LC_ALL=$locale LD_PRELOAD=$tap_dir/upset.so picture $small -t 3 "$scene")" "$want_picture"
		is "--dry-run: a library there before main(): $upset" \
			"$(LC_ALL=$locale LD_PRELOAD=$tap_dir/upset.so dry)" "$plain"
		is "hits: a plugin: $upset" "$(LC_ALL=$locale hits -a "$tap_dir/plugin/none.so")" "$want_hits"
		# shellcheck disable=SC2086
		is "picture: a plugin: $upset" \
			"$(LC_ALL=$locale picture $small -t 3 -a "$tap_dir/plugin/none.so" "$scene")" "$want_picture"
	done
else
	skip "libraries that change arithmetic" "they are made for x86-64"
fi

# ---- other builds ----

# Every scene of tests/features, small.
features()
{
	for file in "$ALIDADE_SRC"/tests/features/*.pov; do
		echo "$(basename "$file") $(picture -s 32x24 -t 2 "$file")"
	done
}

# same_build NAME DIR: does it answer as this one does?
same_build()
{
	build=$2
	is "hits: $1" "$(hits -a none -a octree)" "$(printf '%s\n' "$want_hits" "$want_hits")"
	# shellcheck disable=SC2086
	is "picture: $1" "$(picture $small "$scene")" "$want_picture"
	if [ -n "${want_features:-}" ]; then
		features >"$tap_dir/got"
		ok "pictures of all features: $1" diff "$tap_dir/want" "$tap_dir/got"
	fi
	build=
}

# make_build NAME COMPILER FLAGS
make_build()
{
	mkdir -p "$tap_dir/build"
	(
		cd "$tap_dir/build" || exit 1
		case $2 in *clang) cxx=$2++ ;; *) cxx=g++ ;; esac
		"$ALIDADE_SRC/configure" -q CC="$2" CXX="$cxx" CFLAGS="$3" CXXFLAGS="$3" &&
			make -s -j"${ALIDADE_JOBS:-2}" all && make -s tests/numerics/hits
	) >"$tap_dir/log" 2>&1 || { tail -n 20 "$tap_dir/log"; return 1; }
}

if [ -n "${ALIDADE_OTHER:-}" ]; then
	same_build "the build in $(basename "$ALIDADE_OTHER")" "$ALIDADE_OTHER"
fi
if [ -n "${ALIDADE_ALL:-}" ] && [ -e "$ALIDADE_SRC/config.status" ]; then
	skip "other builds" "the sources were built in their own folder, where configure allows no other"
elif [ -n "${ALIDADE_ALL:-}" ]; then
	want_features=1
	features >"$tap_dir/want"
	for cc in gcc clang; do
		if ! command -v $cc >/dev/null 2>&1; then
			skip "$cc" "it is not installed"
			continue
		fi
		for flags in "-O0" "-O2" "-O3 -march=native"; do
			ok "$cc $flags builds it" make_build "$cc $flags" $cc "$flags"
			same_build "$cc $flags" "$tap_dir/build"
			rm -rf "$tap_dir/build"
		done
	done
fi
tap_done
