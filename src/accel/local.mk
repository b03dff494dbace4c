src_libalidade_la_SOURCES += \
	src/accel/brute.c \
	src/accel/geometry.c src/accel/geometry.h \
	src/accel/host.c src/accel/host.h \
	src/accel/inside.c \
	src/accel/instance.c \
	src/accel/load.h \
	src/accel/surface.c \
	src/accel/trace.c src/accel/trace.h
