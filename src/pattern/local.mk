src_libalidade_la_SOURCES += \
	src/pattern/pattern.h \
	src/pattern/pigment.c
