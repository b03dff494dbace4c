src_libalidade_la_SOURCES += \
	src/read/frames.c src/read/frames.h \
	src/read/ini.c src/read/ini.h \
	src/read/limits.c src/read/limits.h \
	src/read/pictures.c src/read/pictures.h \
	src/read/read.c src/read/read.h \
	src/read/pov/algebraic.c \
	src/read/pov/ask.c \
	src/read/pov/atmosphere.c \
	src/read/pov/blob.c \
	src/read/pov/camera.c \
	src/read/pov/cond.c \
	src/read/pov/direct.c \
	src/read/pov/expr.c \
	src/read/pov/file.c \
	src/read/pov/finish.c \
	src/read/pov/func.c \
	src/read/pov/function.c src/read/pov/function.h \
	src/read/pov/heightfield.c \
	src/read/pov/internal.h \
	src/read/pov/image.c \
	src/read/pov/interior.c \
	src/read/pov/isosurface.c \
	src/read/pov/items.c src/read/pov/items.h \
	src/read/pov/keywords.c src/read/pov/keywords.def src/read/pov/keywords.h \
	src/read/pov/lex.c \
	src/read/pov/light.c \
	src/read/pov/macro.c \
	src/read/pov/map.c \
	src/read/pov/media.c \
	src/read/pov/mesh.c src/read/pov/mesh.h \
	src/read/pov/mesh2.c \
	src/read/pov/modifier.c \
	src/read/pov/name.c \
	src/read/pov/normal.c \
	src/read/pov/number.c src/read/pov/number.h \
	src/read/pov/object.c \
	src/read/pov/parser.h \
	src/read/pov/pattern.c src/read/pov/pattern.h \
	src/read/pov/pigment.c \
	src/read/pov/pov.c \
	src/read/pov/prism.c \
	src/read/pov/program.c src/read/pov/program.h \
	src/read/pov/picture.c src/read/pov/picture.h \
	src/read/pov/radiosity.c \
	src/read/pov/rainbow.c \
	src/read/pov/scan.c src/read/pov/scan.h \
	src/read/pov/settings.c \
	src/read/pov/share.c src/read/pov/share.h \
	src/read/pov/source.c \
	src/read/pov/spline.c \
	src/read/pov/string.c \
	src/read/pov/sweep.c \
	src/read/pov/texture.c \
	src/read/pov/token.c \
	src/read/pov/use.c \
	src/read/pov/value.c \
	src/read/pov/warp.c
