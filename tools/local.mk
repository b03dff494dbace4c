bin_PROGRAMS += tools/alidade-diff tools/alidade-trade
tools_alidade_diff_SOURCES = tools/alidade-diff.c
tools_alidade_diff_LDADD = src/libalidade.la
# It asks alidade's own table of options what there is to sweep.
TRADE_PARTS = tools/trade/chart.c tools/trade/child.c tools/trade/columns.c tools/trade/combine.c \
	tools/trade/confirm.c tools/trade/html.c tools/trade/judge.c tools/trade/measure.c tools/trade/picture.c tools/trade/plan.c tools/trade/report.c \
	tools/trade/scene.c tools/trade/store.c tools/trade/trade.h src/settings.c src/settings.h src/settings_job.c
tools_alidade_trade_SOURCES = tools/alidade-trade.c $(TRADE_PARTS)
tools_alidade_trade_CPPFLAGS = $(AM_CPPFLAGS) $(JANSSON_CFLAGS)
tools_alidade_trade_LDADD = src/libalidade.la $(JANSSON_LIBS)
EXTRA_DIST += tools/dispersion-table.py tools/noise-table.py
