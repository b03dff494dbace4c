src_libalidade_la_SOURCES += \
	src/pattern/block.c \
	src/pattern/cell_table.h src/pattern/noise_table.h \
	src/pattern/defaults.c \
	src/pattern/family.h \
	src/pattern/fractal.c \
	src/pattern/function.c src/pattern/function.h \
	src/pattern/footprint.h src/pattern/image.c src/pattern/image.h \
	src/pattern/mip.c src/pattern/mip.h \
	src/pattern/internal.c \
	src/pattern/noise.c src/pattern/noise.h \
	src/pattern/normal.c \
	src/pattern/pattern.c src/pattern/pattern.h \
	src/pattern/pigment.c \
	src/pattern/random.c src/pattern/random.h \
	src/pattern/solid.c \
	src/pattern/spline.c \
	src/pattern/surface.c \
	src/pattern/warp.c
