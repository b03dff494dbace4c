#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# House rules that a machine can check.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$ALIDADE_SRC" || exit 99

sources()
{
	find src include plugins tools tests -name '*.[ch]' -o -name '*.cc' | LC_ALL=C sort
}

# Tabs count as 8.
long_lines()
{
	sources | while read -r file; do
		expand "$file" | awk -v file="$file" -v limit=120 'length($0) > limit { print file ":" NR ": " length($0) " columns"; bad = 1 }
			END { exit bad }' || echo "$file"
	done | { ! grep .; }
}
ok "lines of at most 120 columns" long_lines

long_files()
{
	sources | while read -r file; do
		[ "$(wc -l <"$file")" -le 700 ] || echo "$file: $(wc -l <"$file") lines"
	done | { ! grep .; }
}
ok "files of at most 700 lines" long_files

no_licence()
{
	tag=SPDX-License- tag=${tag}Identifier # in two pieces, or reuse would read it here
	{ sources; find . -path './build*' -prune -o \( -name '*.sh' -o -name '*.py' -o -name '*.ac' -o -name '*.m4' \) -print |
		grep -vE '/(m4/(libtool|lt).*|aclocal|build-aux/.*)'; } | while read -r file; do
		head -n 5 "$file" | grep -q "$tag" || echo "$file has no line with $tag"
	done | { ! grep .; }
}
ok "every source says its licence" no_licence

spaces()
{
	! sources | xargs grep -nE '[ 	]+$|^ {8}' /dev/null
}
ok "tabs for indentation, no blanks at line ends" spaces

# strncmp(s, "word", 4): the number is the literal's length.
literal_lengths()
{
	! sources | xargs perl -ne '
		while (/(?:strn?(?:case)?cmp|memcmp)\([^"()]*,\s*"((?:[^"\\]|\\.)*)",\s*(\d+)\)/g) {
			my ($text, $length) = ($1, $2);
			$text =~ s/\\(?:x[0-9a-fA-F]{2}|[0-7]{1,3}|.)/x/g;
			print "$ARGV:$.: \"$1\" compared with length $length\n" if length($text) != $length;
		}
		close ARGV if eof' | grep .
}
if command -v perl >/dev/null; then
	ok "lengths of compared literals" literal_lengths
else
	skip "lengths of compared literals" "perl is not installed"
fi

if command -v reuse >/dev/null && [ -e .git ]; then
	ok "reuse lint" reuse lint
elif [ -n "${ALIDADE_CI:-}" ] && [ -e .git ]; then
	ok "reuse is installed" false
else
	skip "reuse lint" "reuse is not installed, or this is no git checkout"
fi

scripts()
{
	{ echo dev; find tests scenes -name '*.sh'; find .ci -name run; } | xargs shellcheck -x -S warning
}
if command -v shellcheck >/dev/null; then
	ok "shellcheck" scripts
else
	[ -z "${ALIDADE_CI:-}" ] || ok "shellcheck is installed" false
	skip "shellcheck" "shellcheck is not installed"
fi
tap_done
