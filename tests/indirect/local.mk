TESTS += tests/indirect/indirect.sh tests/indirect/unbiased.sh
EXTRA_DIST += tests/indirect/unbiased.sh tests/indirect/unbiased.py tests/indirect/unbiased/unbiased.pov \
	tests/indirect/unbiased/furnace.pov tests/indirect/indirect.sh tests/indirect/references.sh tests/indirect/room.inc \
	tests/indirect/air.pov tests/indirect/air.exr \
	tests/indirect/normals.pov tests/indirect/normals.exr \
	tests/indirect/bounces.pov tests/indirect/bounces.exr \
	tests/indirect/lamps.pov tests/indirect/lamps.exr \
	tests/indirect/layers.pov tests/indirect/layers.exr \
	tests/indirect/legacy.pov tests/indirect/legacy.exr \
	tests/indirect/limit.pov tests/indirect/limit.exr \
	tests/indirect/mirrors.pov tests/indirect/mirrors.exr \
	tests/indirect/spread.pov tests/indirect/spread.exr \
	tests/indirect/weights.pov tests/indirect/weights.exr
