src_libalidade_la_SOURCES += src/scene/scene.c src/scene/scene.h
