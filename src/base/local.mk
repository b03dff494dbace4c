src_libalidade_la_SOURCES += \
	src/base/buf.h \
	src/base/clock.h \
	src/base/colour.h \
	src/base/complete.c \
	src/base/diag.c src/base/diag.h \
	src/base/interrupt.c src/base/interrupt.h \
	src/base/json_write.c src/base/json_write.h \
	src/base/mem.c src/base/mem.h \
	src/base/options.c src/base/options.h \
	src/base/pool.c src/base/pool.h \
	src/base/process.c src/base/process.h \
	src/base/rng.h \
	src/base/room.c src/base/room.h \
	src/base/single.h \
	src/base/sobol.c src/base/sobol.h \
	src/base/vec.c src/base/vec.h \
	src/base/wide.h
