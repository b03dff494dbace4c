dist_man_MANS += man/alidade.1
