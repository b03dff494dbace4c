bin_PROGRAMS += tools/alidade-diff
tools_alidade_diff_SOURCES = tools/alidade-diff.c
tools_alidade_diff_LDADD = src/libalidade.la
EXTRA_DIST += tools/dispersion-table.py tools/noise-table.py
