#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# For each program with a table of options: --help, the man page and the completion files name the same.
. "${ALIDADE_SRC:-.}/tests/tap.sh"
cd "$tap_dir" || exit 99

# Long options in --help, one a line, sorted.
of_help()
{
	"$1" --help | sed -n 's/^  .*--\([a-z][a-z-]*\).*/\1/p' | LC_ALL=C sort -u
}

# Those in the page's OPTIONS, as "Fl -name".
of_page()
{
	sed -n '/^\.Sh OPTIONS/,/^\.Sh [A-NP-Z]/p' "$1" | grep '^\.It Fl ' | grep -o 'Fl -[a-z][a-z-]*' |
		sed 's/Fl -//' | LC_ALL=C sort -u
}

short_of_help()
{
	"$1" --help | sed -n 's/^  -\([A-Za-z]\), .*/\1/p' | LC_ALL=C sort -u
}

short_of_page()
{
	sed -n '/^\.Sh OPTIONS/,/^\.Sh [A-NP-Z]/p' "$1" | grep -o '^\.It Fl [A-Za-z] ' | cut -c 8 | LC_ALL=C sort -u
}

of_bash()
{
	"$1" --print-completion bash | grep -o "compgen -W '--.*'" | grep -o -- '--[a-z][a-z-]*' | sed 's/--//' |
		LC_ALL=C sort -u
}

of_zsh()
{
	"$1" --print-completion zsh | grep -oE -- "(,|\*)--[a-z][a-z-]*" | sed 's/.*--//' | LC_ALL=C sort -u
}

of_fish()
{
	"$1" --print-completion fish | grep -o -- ' -l [a-z][a-z-]*' | sed 's/ -l //' | LC_ALL=C sort -u
}

# Where the shell is installed, it reads its file.
reads()
{
	"$1" --print-completion "$2" >"file.$2" && [ -s "file.$2" ] || return 1
	if command -v "$2" >/dev/null; then
		"$2" -n "file.$2"
	fi
}

# bash offers for the last word of a command line.
offers()
{
	bash -c '. "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); compopt() { :; }
		"$(complete -p "$1" | sed "s/.*-F \([^ ]*\).*/\1/")"; printf "%s\n" "${COMPREPLY[@]}"' - ./file.bash "$@" |
		tr '\n' ' '
}

check()
{
	name=$(basename "$1")
	help=$(of_help "$1")
	ok "$name --help names options" test -n "$help"
	is "$name: page and --help" "$(of_page "$2")" "$help"
	is "$name: letters of page and --help" "$(short_of_page "$2")" "$(short_of_help "$1")"
	is "$name: bash and --help" "$(of_bash "$1")" "$help"
	is "$name: zsh and --help" "$(of_zsh "$1")" "$help"
	is "$name: fish and --help" "$(of_fish "$1")" "$help"
	for shell in bash zsh fish; do
		ok "$name: $shell reads its file" reads "$1" $shell
	done
}

# Every accelerator that is listed, with its parameters, is in the page.
accels_in_page()
{
	"$ALIDADE" --list-accels >accels || return 1
	sed -n '/^\.Sh ACCELERATORS/,/^\.Sh REPORTS/p' "$ALIDADE_SRC/man/alidade.1" >section
	sed -n 's/^\([a-z][a-z0-9-]*\) .*/\1/p' accels | while read -r name; do
		grep -q "^\.It Cm $name\$" section || echo "$name is not in the page"
	done >lacking
	sed -n 's/^ *\([a-z][a-z0-9-]*\)=.*/\1/p' accels | while read -r name; do
		grep -q "^\.Cm $name\$" section || echo "the parameter $name is not in the page"
	done >>lacking
	cat lacking
	[ ! -s lacking ]
}

check "$ALIDADE" "$ALIDADE_SRC/man/alidade.1"
ok "alidade: page and --list-accels" accels_in_page
if command -v bash >/dev/null; then
	reads "$ALIDADE" bash
	is "bash offers options" "$(offers alidade --st)" "--stats "
	is "bash offers words" "$(offers alidade --progress = j)" "json "
	is "bash offers words after a space" "$(offers alidade --progress li)" "lines "
	touch 'a scene.pov' 'no scene.txt'
	is "bash offers scenes" "$(offers alidade a)" "a scene.pov "
else
	skip "bash offers options and words" "bash is not installed"
fi
for tool in alidade-diff alidade-trade; do
	check "$ALIDADE_BUILD/tools/$tool" "$ALIDADE_SRC/man/$tool.1"
done
tap_done
