#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# A plugin built outside of the tree, against an installed Alidade and nothing else, gives the same hits
# and the same picture.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
need make pkg-config
root=$tap_dir/root
umask 022

ok "install" make -s -C "$ALIDADE_BUILD" install DESTDIR="$root" MAKEFLAGS=
pc=$(find "$root" -name alidade-accel.pc)
ok "alidade-accel.pc is there" test -f "$pc"
ok "no .la files are" test -z "$(find "$root" -path '*/accel-1/*.la')"
ok "four accelerators are" test "$(find "$root" -path '*/accel-1/*.so' | wc -l)" -ge 4
PKG_CONFIG_PATH=${pc%/*}
PKG_CONFIG_SYSROOT_DIR=$root
export PKG_CONFIG_PATH PKG_CONFIG_SYSROOT_DIR

cp -R "$ALIDADE_SRC/plugins/template" "$tap_dir/mine"
chmod -R u+w "$tap_dir/mine"
cd "$tap_dir/mine" || exit 99
ok "make, without a warning" make -s MAKEFLAGS= CC="${CC:-cc}" CFLAGS="-O2 -Wall -Wextra -Werror"
ok "it is loaded" "$ALIDADE_BUILD/tests/plugins/try" ./mine.so:leaf=3

tests=$ALIDADE_BUILD/tests/unit/test_accels
if [ -x "$tests" ]; then
	ok "the same hits" env ALIDADE_TEST_ACCEL=./mine.so ALIDADE_ALL= "$tests"
else
	skip "the same hits" "no cmocka"
fi
if [ -x "$ALIDADE" ]; then
	ok "a picture with none" "$ALIDADE" -a none -s 80x60 -o none.ppm "$ALIDADE_SRC/tests/cli/scene.pov"
	ok "and with the new one" "$ALIDADE" -a ./mine.so -s 80x60 -o mine.ppm "$ALIDADE_SRC/tests/cli/scene.pov"
	ok "the same bytes" cmp none.ppm mine.ppm
fi

# The example in alidade-accel(3).
awk '/^\.Ed/ { exit } on { print } /^\.Bd -literal$/ { on = 1 }' "$ALIDADE_SRC/man/alidade-accel.3" |
	sed 's/\\e/\\/g' >least.c
# shellcheck disable=SC2046,SC2086 # words are wanted
ok "the manual's example" ${CC:-cc} -std=c17 -O2 -Wall -Wextra -Werror -shared -fPIC \
	$(pkg-config --cflags alidade-accel) -o least.so least.c
ok "it is loaded too" "$ALIDADE_BUILD/tests/plugins/try" ./least.so
if [ -x "$ALIDADE" ]; then
	ok "a picture with it" "$ALIDADE" -a ./least.so -s 80x60 -o least.ppm "$ALIDADE_SRC/tests/cli/scene.pov"
	ok "the same bytes again" cmp none.ppm least.ppm
fi
ok "install into the installed folder" make -s MAKEFLAGS= install
ok "it is where plugins are" test -n "$(find "$root" -path '*/accel-1/mine.so')"
tap_done
