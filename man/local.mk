dist_man_MANS += man/alidade.1
dist_man_MANS += man/alidade-diff.1
dist_man_MANS += man/alidade-trade.1
dist_man_MANS += man/alidade-accel.3
