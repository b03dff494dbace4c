src_libalidade_la_SOURCES += \
	src/shade/camera.c src/shade/camera.h \
	src/shade/cache.c src/shade/cache.h \
	src/shade/frame.h \
	src/shade/indirect.c src/shade/indirect.h \
	src/shade/light.c src/shade/light.h \
	src/shade/pov/finish.c src/shade/pov/finish.h \
	src/shade/pov/below.c src/shade/pov/below.h \
	src/shade/pov/dipole.c src/shade/pov/dipole.h \
	src/shade/pov/fog.c src/shade/pov/fog.h \
	src/shade/pov/interior.c src/shade/pov/interior.h \
	src/shade/pov/lights.c src/shade/pov/lights.h \
	src/shade/pov/media.c src/shade/pov/media.h \
	src/shade/pov/plain.c \
	src/shade/pov/plain_lanes.c src/shade/pov/plain_lanes.h \
	src/shade/pov/point.c src/shade/pov/point.h \
	src/shade/pov/rainbow.c \
	src/shade/pov/shadow.c src/shade/pov/shadow.h \
	src/shade/pov/sky.c \
	src/shade/pov/spawn.c \
	src/shade/pov/spectrum.c src/shade/pov/spectrum.h src/shade/pov/spectrum_table.h \
	src/shade/pov/subsurface.c src/shade/pov/subsurface.h \
	src/shade/pov/texture.c \
	src/shade/shade.c src/shade/shade.h \
	src/shade/tree.c src/shade/tree.h
