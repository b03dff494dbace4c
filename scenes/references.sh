#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Render the pictures that ours are compared with: POV-Ray's, of the scenes as exported. Behind
# ./dev references.
#
#	references.sh [--into FOLDER] [SCENE...]
#
# Two a scene, next to its .pov: reference.exr (one sample at each pixel's centre) and
# reference-aa.exr (POV-Ray's adaptive method 2). The exact commands end up in reference.txt.
# +FE is OpenEXR with half floats in linear light; +WT1 because with more threads POV-Ray's pictures
# can differ from run to run. Options of the scene's own .ini are not used. Large scenes (see
# scenes.txt) are rendered too where their export is there; only their references are committed.
set -u
here=$(cd "$(dirname "$0")" && pwd) || exit 1
into=$here
while [ $# -gt 0 ]; do
	case $1 in
	--into) shift; into=$(cd "${1:?--into names a folder}" && pwd) || exit 1 ;;
	-*) echo "references.sh: unknown option $1" >&2; exit 2 ;;
	*) break ;;
	esac
	shift
done
# shellcheck disable=SC2046 # words
[ $# -gt 0 ] || set -- $(awk '!/^#/ && NF { print $1 }' "$here/scenes.txt")
command -v povray >/dev/null || {
	echo "references.sh: povray is not installed; ./dev deps installs it" >&2
	exit 1
}

# keep NEW OLD NAME: the new picture replaces the old one only where a pixel differs, because POV-Ray
# writes the time of day into its files and would make each look changed.
keep() {
	if command -v idiff >/dev/null && [ -s "$2" ] && idiff -q -fail 0 -warn 0 "$1" "$2" >/dev/null 2>&1
	then
		echo "unchanged $3"
	else
		mv "$1" "$2" && echo "rendered $3"
	fi
}

plain='+FE -D -P -UA +WT1 -A -J'
aa='+FE -D -P -UA +WT1 +A0.03 +AM2 +R2 +AG2.5 -J'

# Debian's POV-Ray reads and writes only below the current and the temporary folder.
work=$(mktemp -d "${TMPDIR:-/tmp}/alidade-references.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
failed=0
for scene in "$@"; do
	size=$(awk -v s="$scene" '$1 == s { print $2 }' "$here/scenes.txt")
	if [ -z "$size" ]; then
		echo "references.sh: scenes.txt does not name the scene $scene" >&2
		exit 2
	fi
	if [ ! -s "$here/$scene/$scene.pov" ]; then
		echo "references.sh: $scene is not exported yet: scenes/export.sh $scene" >&2
		failed=1
		continue
	fi
	cp "$here/$scene/$scene.pov" "$work/$scene.pov"
	geometry="+W${size%x*} +H${size#*x}"
	mkdir -p "$into/$scene"
	: >"$work/reference.txt"
	for kind in reference reference-aa; do
		options=$plain
		[ $kind = reference-aa ] && options=$aa
		command="povray +I$scene.pov +O$kind.exr $geometry $options"
		echo "$command" >>"$work/reference.txt"
		rm -f "$work/$kind.exr"
		if (cd "$work" && $command) >"$work/log" 2>&1 && [ -s "$work/$kind.exr" ]; then
			keep "$work/$kind.exr" "$into/$scene/$kind.exr" "$scene/$kind.exr"
		else
			echo "references.sh: POV-Ray did not render $scene:" >&2
			tail -n 20 "$work/log" >&2
			failed=1
		fi
	done
	povray --version 2>&1 | grep '^POV-Ray' >>"$work/reference.txt"
	mv "$work/reference.txt" "$into/$scene/reference.txt"
done
exit $failed
