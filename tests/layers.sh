#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Who may include whom: the arrows of ARCHITECTURE.md, held against the #include lines.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$ALIDADE_SRC" || exit 99

# FOLDER ALLOWED ...: a folder, or a single header of one. Everybody may include itself; "include" is
# alidade/*.h, and base needs its vector type.
arrows='
include
src/base	include
src/scene	base include
src/pattern	base scene include
src/read	base scene pattern image include
src/prim	base scene pattern include
src/accel	base scene prim include
src/shade	base scene pattern accel/facet.h accel/trace.h include
src/film	base image
src/image	base
src/render	base scene accel/facet.h accel/trace.h shade film image include
src/look	base scene accel render film image include
plugins		include
'

# Included names of all files in a folder, "FILE NAME" a line; system headers are no concern of ours.
includes()
{
	find "$1" -name '*.[ch]' -exec grep -HE '^[ 	]*#[ 	]*include[ 	]*["<](alidade/|[a-z]+/[a-z_/0-9]+\.h"|[a-z_0-9]+\.h")' {} + |
		sed 's/^\([^:]*\):[^"<]*["<]\([^">]*\)[">].*/\1 \2/'
}

# Prints the lines that no arrow allows.
broken()
{
	folder=$1
	shift
	own=${folder#src/}
	includes "$folder" | while read -r file name; do
		case $name in
		alidade/*) part=include ;;
		*/*) part=${name%%/*} ;;
		*) continue ;; # beside the file itself
		esac
		[ "$part" != "$own" ] || continue
		good=
		for allowed do
			case $allowed in
			*.h) [ "$allowed" != "$name" ] || good=1 ;;
			*) [ "$allowed" != "$part" ] || good=1 ;;
			esac
		done
		[ -n "$good" ] || echo "$file includes $name"
	done
}

within()
{
	found=$(broken "$@")
	[ -z "$found" ] || {
		echo "$found"
		return 1
	}
}

while read -r folder allowed; do
	[ -n "$folder" ] || continue
	[ -d "$folder" ] || continue
	# shellcheck disable=SC2086 # a list of words
	ok "$folder includes only: ${allowed:-nothing of ours}" within "$folder" $allowed
done <<END
$arrows
END

# A folder that the table does not know would go unchecked.
unknown()
{
	for folder in src/*/; do
		echo "$arrows" | grep -q "^${folder%/}[	 ]" || { echo "$folder has no arrows"; return 1; }
	done
}
ok "every folder of src has its arrows" unknown
tap_done
