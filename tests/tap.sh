# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh
#
# Tests in shell that speak TAP (https://testanything.org). Start with
#	. "${ALIDADE_SRC:-.}/tests/tap.sh"
# and end with tap_done. make check sets ALIDADE_SRC and ALIDADE_BUILD (whole paths of the two trees) and
# ALIDADE (the program). Work in $tap_dir, which is removed at the end.
: "${ALIDADE_SRC:=$PWD}" "${ALIDADE_BUILD:=$ALIDADE_SRC/build}"
: "${ALIDADE:=$ALIDADE_BUILD/src/alidade}"
tap_count=0
tap_failed=0
tap_dir=$(mktemp -d) || exit 99
trap 'rm -rf "$tap_dir"' EXIT
trap 'exit 99' HUP INT TERM

# ok NAME COMMAND ...: passes if the command succeeds; what it printed is shown if not.
ok()
{
	tap_name=$1
	shift
	tap_count=$((tap_count + 1))
	if "$@" >"$tap_dir/.out" 2>&1; then
		echo "ok $tap_count - $tap_name"
	else
		echo "not ok $tap_count - $tap_name"
		tap_failed=$((tap_failed + 1))
		echo "# failed: $*"
		sed 's/^/# /' "$tap_dir/.out" | head -n 40
	fi
}

# fails STATUS COMMAND ...: succeeds if the command ends with just that exit status.
fails()
{
	tap_want=$1
	shift
	tap_got=0
	"$@" || tap_got=$?
	[ "$tap_got" -eq "$tap_want" ] || {
		echo "exit status $tap_got, expected $tap_want"
		return 1
	}
}

# is NAME GOT WANT
is()
{
	tap_count=$((tap_count + 1))
	if [ "$2" = "$3" ]; then
		echo "ok $tap_count - $1"
	else
		echo "not ok $tap_count - $1"
		tap_failed=$((tap_failed + 1))
		printf '%s\n' "got: $2" "expected: $3" | sed 's/^/# /'
	fi
}

# skip NAME REASON: one test that cannot run here.
skip()
{
	tap_count=$((tap_count + 1))
	echo "ok $tap_count - $1 # SKIP $2"
}

skip_all()
{
	echo "1..0 # SKIP $1"
	exit 0
}

# need TOOL ...: leave all of this file out where a tool is missing; under CI that is an error.
need()
{
	for tap_tool do
		command -v "$tap_tool" >/dev/null 2>&1 && continue
		[ -z "${ALIDADE_CI:-}" ] || {
			echo "Bail out! $tap_tool is missing"
			exit 1
		}
		skip_all "$tap_tool is not installed"
	done
}

# has_exr: alidade was built with OpenEXR. need_exr: leave this file out if it was not, as with need.
has_exr()
{
	"$ALIDADE" --version | grep -q '^pictures:.*exr'
}

need_exr()
{
	has_exr && return
	[ -z "${ALIDADE_CI:-}" ] || {
		echo "Bail out! built without OpenEXR"
		exit 1
	}
	skip_all "built without OpenEXR"
}

tap_done()
{
	echo "1..$tap_count"
	[ "$tap_failed" -eq 0 ]
}
