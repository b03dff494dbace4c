bin_PROGRAMS += src/alidade
src_alidade_SOURCES = src/alidade.c src/settings.c src/settings.h src/settings_job.c
src_alidade_LDADD = src/libalidade.la
