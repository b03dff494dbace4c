# ./dev bench: measurements, no tests.
EXTRA_DIST += tests/bench/run.sh tests/bench/lecture.py tests/bench/povray.py tests/bench/indirect.py tests/bench/precision.py \
	tests/bench/measure_runs.py
# Not made by make check.
EXTRA_PROGRAMS += tests/bench/rays
tests_bench_rays_SOURCES = tests/bench/rays.c tests/bench/peers.c tests/bench/peers.h tests/unit/rays.c \
	tests/unit/rays.h
tests_bench_rays_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/src
tests_bench_rays_LDADD = src/libalidade.la $(EMBREE_LIBS)
