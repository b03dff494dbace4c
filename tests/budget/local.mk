TESTS += tests/budget/seeds.sh tests/budget/budget.sh
EXTRA_DIST += tests/budget/seeds.sh tests/budget/budget.sh tests/budget/air.pov tests/budget/edges.pov \
	tests/budget/glass.pov tests/budget/lamp.pov tests/budget/lens.pov tests/budget/hall.pov \
	tests/budget/below.pov tests/budget/wood.pov tests/budget/rare.pov \
	tests/budget/room.pov tests/budget/seldom.pov
check_PROGRAMS += tests/budget/seeds
tests_budget_seeds_SOURCES = tests/budget/seeds.c
tests_budget_seeds_CPPFLAGS = $(AM_CPPFLAGS) -I$(top_srcdir)/src
tests_budget_seeds_LDADD = src/libalidade.la
