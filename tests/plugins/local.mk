# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_memory
tests_unit_test_memory_SOURCES = tests/unit/test_memory.c tests/unit/rays.c tests/unit/rays.h
tests_unit_test_memory_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_memory_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_memory
check_PROGRAMS += tests/unit/test_accels
tests_unit_test_accels_SOURCES = tests/unit/test_accels.c tests/unit/accel_fixture.h tests/unit/rays.c tests/unit/rays.h
tests_unit_test_accels_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_accels_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_accels
check_PROGRAMS += tests/unit/test_bvh8
tests_unit_test_bvh8_SOURCES = tests/unit/test_bvh8.c tests/unit/accel_fixture.h tests/unit/rays.c tests/unit/rays.h
tests_unit_test_bvh8_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_bvh8_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_bvh8

check_PROGRAMS += tests/unit/test_refit
tests_unit_test_refit_SOURCES = tests/unit/test_refit.c tests/unit/accel_fixture.h tests/unit/rays.c tests/unit/rays.h
tests_unit_test_refit_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_refit_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_refit

check_PROGRAMS += tests/unit/test_load
tests_unit_test_load_SOURCES = tests/unit/test_load.c
tests_unit_test_load_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_load_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_load
endif

check_PROGRAMS += tests/plugins/try
tests_plugins_try_SOURCES = tests/plugins/try.c
tests_plugins_try_LDADD = src/libalidade.la
TESTS += tests/plugins/load.sh
EXTRA_DIST += tests/plugins/load.sh tests/plugins/bad.c
TESTS += tests/plugins/verify.sh
EXTRA_DIST += tests/plugins/verify.sh tests/plugins/liar.c
TESTS += tests/plugins/template.sh
EXTRA_DIST += tests/plugins/template.sh
