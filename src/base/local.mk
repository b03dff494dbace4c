src_libalidade_la_SOURCES += \
	src/base/buf.h \
	src/base/colour.h \
	src/base/diag.c src/base/diag.h \
	src/base/json.c src/base/json.h \
	src/base/mem.c src/base/mem.h \
	src/base/pool.c src/base/pool.h \
	src/base/rng.h \
	src/base/vec.c src/base/vec.h
