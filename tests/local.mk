# Unit tests: one program per source file, on cmocka.
UNIT_LIBS = src/libalidade.la $(CMOCKA_LIBS)
UNIT_CPPFLAGS = $(AM_CPPFLAGS) $(CMOCKA_CFLAGS)
include tests/unit/local.mk
