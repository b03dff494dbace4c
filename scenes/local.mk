# Scenes: the script that makes each, what Blender exported, POV-Ray's reference pictures.
EXTRA_DIST += scenes/common.py scenes/export.sh scenes/references.sh scenes/scenes.txt
EXTRA_DIST += scenes/radiosity/make.py
EXTRA_DIST += scenes/landscape/make.py scenes/landscape/landscape.ini scenes/landscape/reference.exr \
	scenes/landscape/reference-aa.exr scenes/landscape/reference.txt
EXTRA_DIST += scenes/lecture/make.py scenes/lecture/lecture.pov scenes/lecture/lecture.ini \
	scenes/lecture/reference.exr scenes/lecture/reference-aa.exr scenes/lecture/reference.txt
EXTRA_DIST += scenes/suzanne/make.py scenes/suzanne/suzanne.pov scenes/suzanne/suzanne.ini \
	scenes/suzanne/reference.exr scenes/suzanne/reference-aa.exr scenes/suzanne/reference.txt
EXTRA_DIST += scenes/spheres/make.py scenes/spheres/spheres.pov scenes/spheres/spheres.ini \
	scenes/spheres/reference.exr scenes/spheres/reference-aa.exr scenes/spheres/reference.txt
EXTRA_DIST += scenes/glass/make.py scenes/glass/glass.pov scenes/glass/glass.ini \
	scenes/glass/reference.exr scenes/glass/reference-aa.exr scenes/glass/reference.txt
EXTRA_DIST += scenes/lamps/make.py scenes/lamps/lamps.pov scenes/lamps/lamps.ini \
	scenes/lamps/reference.exr scenes/lamps/reference-aa.exr scenes/lamps/reference.txt
EXTRA_DIST += scenes/vertexcolours/make.py scenes/vertexcolours/vertexcolours.pov scenes/vertexcolours/vertexcolours.ini \
	scenes/vertexcolours/reference.exr scenes/vertexcolours/reference-aa.exr scenes/vertexcolours/reference.txt
EXTRA_DIST += scenes/shading/make.py scenes/shading/shading.pov scenes/shading/shading.ini \
	scenes/shading/reference.exr scenes/shading/reference-aa.exr scenes/shading/reference.txt
EXTRA_DIST += scenes/instances/make.py scenes/instances/instances.pov scenes/instances/instances.ini \
	scenes/instances/reference.exr scenes/instances/reference-aa.exr scenes/instances/reference.txt
EXTRA_DIST += scenes/ortho/make.py scenes/ortho/ortho.pov scenes/ortho/ortho.ini \
	scenes/ortho/reference.exr scenes/ortho/reference-aa.exr scenes/ortho/reference.txt
EXTRA_DIST += scenes/beams/make.py scenes/beams/beams.pov scenes/beams/beams.ini \
	scenes/beams/reference.exr scenes/beams/reference-aa.exr scenes/beams/reference.txt
EXTRA_DIST += scenes/finishes/make.py scenes/finishes/finishes.pov scenes/finishes/finishes.ini \
	scenes/finishes/reference.exr scenes/finishes/reference-aa.exr scenes/finishes/reference.txt
EXTRA_DIST += scenes/transforms/make.py scenes/transforms/transforms.pov scenes/transforms/transforms.ini \
	scenes/transforms/reference.exr scenes/transforms/reference-aa.exr scenes/transforms/reference.txt
EXTRA_DIST += scenes/primitives/make.py scenes/primitives/primitives.pov scenes/primitives/primitives.ini \
	scenes/primitives/reference.exr scenes/primitives/reference-aa.exr scenes/primitives/reference.txt
EXTRA_DIST += scenes/text/make.py scenes/text/text.pov scenes/text/text.ini \
	scenes/text/reference.exr scenes/text/reference-aa.exr scenes/text/reference.txt
EXTRA_DIST += scenes/modifiers/make.py scenes/modifiers/modifiers.pov scenes/modifiers/modifiers.ini \
	scenes/modifiers/reference.exr scenes/modifiers/reference-aa.exr scenes/modifiers/reference.txt
