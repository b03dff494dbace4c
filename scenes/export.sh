#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Export the scenes from Blender with its own POV-Ray add-on: one Blender a scene, because the
# add-on keeps state between exports. Behind ./dev scenes.
#
#	export.sh [--missing] [--into FOLDER] [SCENE...]
#
# Without SCENE: every scene of scenes.txt. --missing exports only what has no .pov yet (the large
# scenes, which are not committed). FOLDER/SCENE/ gets the files; the default is this folder.
set -u
here=$(cd "$(dirname "$0")" && pwd) || exit 1
missing=no
into=$here
while [ $# -gt 0 ]; do
	case $1 in
	--missing) missing=yes ;;
	--into) shift; into=$(cd "${1:?--into names a folder}" && pwd) || exit 1 ;;
	-*) echo "export.sh: unknown option $1" >&2; exit 2 ;;
	*) break ;;
	esac
	shift
done
# shellcheck disable=SC2046 # words
[ $# -gt 0 ] || set -- $(awk '!/^#/ && NF { print $1 }' "$here/scenes.txt")
command -v blender >/dev/null || {
	echo "export.sh: blender is not installed; ./dev deps installs it" >&2
	exit 1
}

work=$(mktemp -d "${TMPDIR:-/tmp}/alidade-export.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
failed=0
for scene in "$@"; do
	if [ ! -f "$here/$scene/make.py" ]; then
		echo "export.sh: no such scene: $scene (there is no $here/$scene/make.py)" >&2
		exit 2
	fi
	[ $missing = yes ] && [ -s "$into/$scene/$scene.pov" ] && continue
	mkdir -p "$work/$scene" "$into/$scene"
	# Blender's own exit status is 0 even where a script fails: what counts are the files.
	blender -b --factory-startup -P "$here/$scene/make.py" -- "$work/$scene" \
		>"$work/log" 2>&1
	if [ -s "$work/$scene/$scene.pov" ] && grep '^exported ' "$work/log"; then
		mv "$work/$scene/$scene.pov" "$work/$scene/$scene.ini" "$into/$scene/"
	else
		echo "export.sh: Blender did not export $scene:" >&2
		tail -n 20 "$work/log" >&2
		failed=1
	fi
done
exit $failed
