# Varied Blender files against POV-Ray's pictures of them; only under ./dev check --all.
TESTS += tests/blender/breadth.sh
EXTRA_DIST += tests/blender/breadth.sh tests/blender/breadth.py tests/blender/kinds.py tests/blender/make.py
# Written by breadth.sh; the landscape is exported for scenes.sh.
CLEANFILES += tests/breadth.html scenes/landscape/landscape.pov scenes/landscape/landscape.ini
clean-local:
	rm -rf tests/breadth
