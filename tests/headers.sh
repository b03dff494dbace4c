#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Every header compiles alone, and twice; the public ones with a bare compiler as C11 and as C++ too.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$ALIDADE_SRC" || exit 99
: "${CC:=cc}" "${CXX:=c++}"

alone()
{
	language=$1
	name=$2
	shift 2
	printf '#include "%s"\n#include "%s"\nextern int not_empty;\n' "$name" "$name" >"$tap_dir/alone.$language"
	"$@" -fsyntax-only -I"$ALIDADE_SRC/include" "$tap_dir/alone.$language"
}

for header in include/alidade/*.h; do
	name=${header#include/}
	# shellcheck disable=SC2086 # $CC may be a command with arguments
	ok "$name as C11" alone c "$name" $CC -std=c11 -Wall -Wextra -Werror
	if command -v "${CXX%% *}" >/dev/null 2>&1; then
		# shellcheck disable=SC2086
		ok "$name as C++" alone cc "$name" $CXX -std=c++17 -Wall -Wextra -Werror
	else
		skip "$name as C++" "no C++ compiler"
	fi
done
for header in $(find src -name '*.h' | LC_ALL=C sort); do
	name=${header#src/}
	# shellcheck disable=SC2086
	ok "$name" alone c "$name" $CC -std=c17 -Wall -Wextra -Wmissing-prototypes -Werror \
		-D_GNU_SOURCE -DHAVE_CONFIG_H -I"$ALIDADE_SRC/src" -I"$ALIDADE_BUILD" -I"$ALIDADE_BUILD/src"
done
tap_done
