src_libalidade_la_SOURCES += \
	src/look/memory.c src/look/memory.h \
	src/look/progress.c src/look/progress.h \
	src/look/reached.c src/look/reached.h \
	src/look/require.c src/look/require.h \
	src/look/stats.c src/look/stats.h
