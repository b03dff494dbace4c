src_libalidade_la_SOURCES += \
	src/scene/atmosphere.h \
	src/scene/dump.c src/scene/dump.h \
	src/scene/function.c src/scene/function.h \
	src/scene/hash.h \
	src/scene/media.c src/scene/media.h \
	src/scene/put.h \
	src/scene/scene.c src/scene/scene.h \
	src/scene/texture.c src/scene/texture.h \
	src/scene/texture_dump.c \
	src/scene/texture_hash.c
