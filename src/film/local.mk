src_libalidade_la_SOURCES += src/film/tone.c src/film/tone.h
