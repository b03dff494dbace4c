src_libalidade_la_SOURCES +=
