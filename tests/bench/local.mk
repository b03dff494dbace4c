# ./dev bench: measurements, no tests.
EXTRA_DIST += tests/bench/run.sh tests/bench/lecture.py tests/bench/povray.py tests/bench/indirect.py tests/bench/precision.py \
	tests/bench/whole.py tests/bench/scale.py tests/bench/measure_runs.py
# Not made by make check.
EXTRA_PROGRAMS += tests/bench/rays
tests_bench_rays_SOURCES = tests/bench/rays.c tests/bench/race.c tests/bench/race.h tests/bench/settle.c \
	tests/bench/settle.h tests/bench/tally.c \
	tests/bench/worlds.c tests/bench/worlds.h tests/bench/suzanne.c tests/bench/suzanne.h tests/bench/shots.c \
	tests/bench/directions.h tests/bench/forest.c tests/bench/forest.h tests/bench/tree.c \
	tests/bench/peers.c tests/bench/peers.h tests/unit/rays.c tests/unit/rays.h
tests_bench_rays_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/src \
	-DSUZANNE='"$(abs_top_srcdir)/scenes/suzanne/suzanne.pov"'
tests_bench_rays_LDADD = src/libalidade.la $(EMBREE_LIBS)

EXTRA_PROGRAMS += tests/bench/lecture_rays
tests_bench_lecture_rays_SOURCES = tests/bench/lecture_rays.c tests/unit/rays.c tests/unit/rays.h
tests_bench_lecture_rays_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/src
tests_bench_lecture_rays_LDADD = src/libalidade.la

EXTRA_PROGRAMS += tests/bench/scene_files
tests_bench_scene_files_SOURCES = tests/bench/scene_files.c tests/bench/worlds.c tests/bench/worlds.h \
	tests/bench/suzanne.c tests/bench/suzanne.h tests/bench/directions.h tests/bench/forest.c tests/bench/forest.h tests/bench/tree.c \
	tests/unit/rays.c tests/unit/rays.h
tests_bench_scene_files_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/src \
	-DSUZANNE='"$(abs_top_srcdir)/scenes/suzanne/suzanne.pov"'
tests_bench_scene_files_LDADD = src/libalidade.la
