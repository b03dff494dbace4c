# Varied Blender files against POV-Ray's pictures of them; only under ./dev check --all.
TESTS += tests/blender/breadth.sh
EXTRA_DIST += tests/blender/breadth.sh tests/blender/breadth.py tests/blender/kinds.py tests/blender/make.py
