#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# The man pages are clean for both formatters, and what they point to is there.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$ALIDADE_SRC" || exit 99
need mandoc

# A page that is not of ours is looked up in the system's database, which may be absent.
lint()
{
	! mandoc -T lint -W warning "$1" 2>&1 | grep -v 'outdated mandoc.db'
}

groff_clean()
{
	found=$(groff -mandoc -ww -z -T utf8 "$1" 2>&1) || return 1
	[ -z "$found" ] || { echo "$found"; return 1; }
}

pointed_to()
{
	grep '^\.Xr alidade' "$1" | while read -r _ name section _; do
		[ -f "man/$name.$section" ] || echo "$1 points to $name($section)"
	done | { ! grep .; }
}

for page in man/*.[1-9]; do
	ok "$page: mandoc" lint "$page"
	if command -v groff >/dev/null; then
		ok "$page: groff" groff_clean "$page"
	else
		skip "$page: groff" "groff is not installed"
	fi
	ok "$page: pages it points to" pointed_to "$page"
done
tap_done
