src_libalidade_la_SOURCES += \
	src/read/read.h \
	src/read/pov/keywords.c src/read/pov/keywords.def src/read/pov/keywords.h \
	src/read/pov/number.c src/read/pov/number.h \
	src/read/pov/parser.h
