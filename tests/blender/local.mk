# Varied Blender files against POV-Ray's pictures of them; only under ./dev check --all.
TESTS += tests/blender/breadth.sh tests/blender/ordinary.sh tests/blender/gallery.sh
EXTRA_DIST += tests/blender/breadth.sh tests/blender/ordinary.sh tests/blender/gallery.sh tests/blender/breadth.py \
	tests/blender/against.py tests/blender/gallery.py tests/blender/gallery_export.py \
	tests/blender/kinds.py tests/blender/make.py tests/blender/ordinary.py tests/blender/procedural.py
# Our own exporter; left out where there is no Blender.
TESTS += tests/blender/exporter.sh
EXTRA_DIST += tests/blender/exporter.sh tests/blender/exporter_parts.py tests/blender/exporter_install.py \
	tests/blender/exporter_cases.py
# Written by breadth.sh; the landscape is exported for scenes.sh.
CLEANFILES += tests/breadth.html tests/ordinary.html tests/gallery.html scenes/landscape/landscape.pov scenes/landscape/landscape.ini
clean-local:
	rm -rf tests/breadth tests/ordinary tests/gallery
