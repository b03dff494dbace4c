src_libalidade_la_SOURCES += \
	src/render/aa.c src/render/aa.h \
	src/render/budget.c src/render/budget.h \
	src/render/estimate.c src/render/estimate.h \
	src/render/fill.c src/render/fill.h \
	src/render/fold.c src/render/fold.h \
	src/render/foresee.c src/render/foresee.h \
	src/render/lens.c src/render/lens.h \
	src/render/paths.c src/render/paths.h \
	src/render/render.h \
	src/render/schedule.c \
	src/render/streams.c src/render/streams.h \
	src/render/short_tile.c src/render/short_wave.c src/render/short_wave.h \
	src/render/wave.c src/render/wave.h
