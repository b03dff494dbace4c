src_libalidade_la_SOURCES += \
	src/image/exr_read.c src/image/exr_write.c src/image/half.h \
	src/image/format.h src/image/image.c src/image/image.h \
	src/image/oiio.c src/image/oiio/io_oiio.h \
	src/image/out.c src/image/out.h \
	src/image/png.c src/image/pnm.c src/image/samples.c
