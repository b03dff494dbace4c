NUMERICS_TESTS = tests/numerics/bits.sh tests/numerics/kernel-bits.sh tests/numerics/judge.sh \
	tests/numerics/judge-exact.sh tests/numerics/judge-seeds.sh tests/numerics/judge-fast.sh tests/numerics/judge-fast-bvh8.sh \
	tests/numerics/pictures.sh tests/numerics/shapes.sh
TESTS += $(NUMERICS_TESTS)
EXTRA_DIST += $(NUMERICS_TESTS) tests/numerics/pictures.py tests/numerics/kernel_bits.c \
	tests/numerics/kinds.pov tests/numerics/upset.c
check_PROGRAMS += tests/numerics/hits
tests_numerics_hits_SOURCES = tests/numerics/hits.c
tests_numerics_hits_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/src
tests_numerics_hits_LDADD = src/libalidade.la
if HAVE_GMP
check_PROGRAMS += tests/numerics/judge tests/numerics/shapes
tests_numerics_judge_SOURCES = tests/numerics/course.c tests/numerics/course.h tests/numerics/crew.c \
	tests/numerics/crew.h tests/numerics/judge.c tests/numerics/oracle.c tests/numerics/oracle.h \
	tests/numerics/sieve.c tests/numerics/sieve.h tests/numerics/soups.c tests/numerics/soups.h \
	tests/numerics/trial.c tests/numerics/trial.h
tests_numerics_judge_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/src
tests_numerics_judge_LDADD = src/libalidade.la -lgmp
tests_numerics_shapes_SOURCES = tests/numerics/shapes.c tests/numerics/soups.c tests/numerics/soups.h
tests_numerics_shapes_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/src
tests_numerics_shapes_LDADD = src/libalidade.la -lgmp
endif
