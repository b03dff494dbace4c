# The exporter for Blender: an add-on of Python files alone, which Blender installs as a zip.
# `make addon` packs it; no program is needed to use the folder as it is.
EXTRA_DIST += blender/pack.py blender/alidade_pov/__init__.py blender/alidade_pov/blender_manifest.toml \
	blender/alidade_pov/camera.py blender/alidade_pov/engine.py blender/alidade_pov/export.py \
	blender/alidade_pov/finish.py blender/alidade_pov/geometry.py blender/alidade_pov/images.py blender/alidade_pov/interface.py \
	blender/alidade_pov/lamps.py blender/alidade_pov/losses.py blender/alidade_pov/materials.py \
	blender/alidade_pov/paints.py blender/alidade_pov/pictures.py blender/alidade_pov/relief.py blender/alidade_pov/scene.py \
	blender/alidade_pov/text.py blender/alidade_pov/values.py blender/alidade_pov/versions.py \
	blender/alidade_pov/visible.py blender/alidade_pov/world.py blender/gallery/gallery.py blender/gallery/pictures.py

EXTRA_DIST += docs/exporter.md docs/exporter/areas.png docs/exporter/colours.png docs/exporter/focus.png docs/exporter/glass.png docs/exporter/hair.png docs/exporter/instances.png \
	docs/exporter/lamps.png docs/exporter/relief.png docs/exporter/room.png docs/exporter/shaders.png docs/exporter/shapes.png docs/exporter/sky.png docs/exporter/spheres.png docs/exporter/textures.png

addon: alidade_pov.zip
alidade_pov.zip: $(srcdir)/blender/pack.py $(srcdir)/blender/alidade_pov/*.py $(srcdir)/blender/alidade_pov/blender_manifest.toml
	python3 $(srcdir)/blender/pack.py $@
.PHONY: addon
CLEANFILES += alidade_pov.zip
