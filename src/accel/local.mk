src_libalidade_la_SOURCES += \
	src/accel/brute.c \
	src/accel/csg.c \
	src/accel/elf.c src/accel/elf.h \
	src/accel/facet.c src/accel/facet.h \
	src/accel/forecast.c \
	src/accel/geometry.c src/accel/geometry.h \
	src/accel/host.c src/accel/host.h \
	src/accel/inside.c \
	src/accel/instance.c \
	src/accel/load.c src/accel/load.h \
	src/accel/param.c src/accel/param.h \
	src/accel/renew.c \
	src/accel/settle.c \
	src/accel/surface.c \
	src/accel/text.c src/accel/text.h \
	src/accel/trace.c src/accel/trace.h \
	src/accel/verify.c src/accel/verify.h \
	src/accel/vertices.c
