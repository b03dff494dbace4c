src_libalidade_la_SOURCES += \
	src/image/exr_read.c src/image/exr_write.c src/image/half.h \
	src/image/diff.c src/image/diff.h src/image/diff_report.c \
	src/image/format.h src/image/image.c src/image/image.h \
	src/image/oiio.c src/image/oiio/io_oiio.h \
	src/image/jpeg.c \
	src/image/out.c src/image/out.h \
	src/image/png.c src/image/png_in.h src/image/png_raw.c src/image/png_strips.c src/image/png_strips.h src/image/pnm.c \
	src/image/raw.c src/image/raw.h src/image/samples.c src/image/srgb_table.h

# The one piece of C++: never linked to the library, see io_oiio.h.
if HAVE_OIIO
pkglib_LTLIBRARIES += src/image/oiio/io_oiio.la
src_image_oiio_io_oiio_la_SOURCES = src/image/oiio/io_oiio.cc src/image/oiio/io_oiio.h
src_image_oiio_io_oiio_la_CXXFLAGS = $(AM_CXXFLAGS) $(OIIO_CFLAGS)
src_image_oiio_io_oiio_la_LIBADD = $(OIIO_LIBS)
src_image_oiio_io_oiio_la_LDFLAGS = $(AM_LDFLAGS) -module -avoid-version -shared \
	-export-symbols-regex '^alidade_io_oiio$$'
endif
