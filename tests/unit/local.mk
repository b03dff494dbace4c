
if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_json
tests_unit_test_json_SOURCES = tests/unit/test_json.c
tests_unit_test_json_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_json_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_json
endif

if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_image_formats
tests_unit_test_image_formats_SOURCES = tests/unit/test_image_formats.c tests/unit/image_fixture.h
tests_unit_test_image_formats_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_image_formats_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_image_formats
endif
