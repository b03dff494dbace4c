# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
#
# Accelerators: modules that export one symbol and include the two public headers only.
PLUGIN_LDFLAGS = -module -avoid-version -shared -export-symbols-regex '^ald_accel_entry$$' $(AM_LDFLAGS)
PLUGIN_CPPFLAGS = -I$(top_srcdir)/include

pkglibaccel_LTLIBRARIES += plugins/none.la plugins/sphere.la plugins/box.la plugins/octree.la plugins/bvh8.la

ISA = plugins/isa.h plugins/isa_begin.h plugins/isa_end.h

FLAT = plugins/flat.c plugins/flat_plain.c plugins/flat_sse.c plugins/flat_avx2.c plugins/flat_avx512.c \
	plugins/flat.h plugins/flat_walk.h plugins/lines.h plugins/simd.h plugins/f4.h $(ISA)

plugins_none_la_SOURCES = plugins/none.c $(FLAT)
plugins_none_la_CPPFLAGS = $(PLUGIN_CPPFLAGS)
plugins_none_la_LDFLAGS = $(PLUGIN_LDFLAGS)

plugins_sphere_la_SOURCES = plugins/sphere.c $(FLAT)
plugins_sphere_la_CPPFLAGS = $(PLUGIN_CPPFLAGS)
plugins_sphere_la_LDFLAGS = $(PLUGIN_LDFLAGS)

plugins_box_la_SOURCES = plugins/box.c $(FLAT)
plugins_box_la_CPPFLAGS = $(PLUGIN_CPPFLAGS)
plugins_box_la_LDFLAGS = $(PLUGIN_LDFLAGS)

plugins_octree_la_SOURCES = plugins/octree.c plugins/octree_build.c plugins/octree_plain.c \
	plugins/octree_sse.c plugins/octree_avx2.c plugins/octree_avx512.c plugins/octree.h plugins/octree_trace.h \
	plugins/octree_walk.h plugins/octree_herd.h plugins/doubles.h plugins/lane_triangle.h $(ISA) plugins/seen.h
plugins_octree_la_CPPFLAGS = $(PLUGIN_CPPFLAGS)
plugins_octree_la_LDFLAGS = $(PLUGIN_LDFLAGS)

plugins_bvh8_la_SOURCES = plugins/bvh8.c plugins/bvh8.h plugins/bvh8_ask.h plugins/bvh8_avx2.c \
	plugins/bvh8_avx512.c plugins/bvh8_beam.h plugins/bvh8_bins.h plugins/bvh8_build.c \
	plugins/bvh8_corner.h plugins/bvh8_crop.c plugins/bvh8_crop.h plugins/bvh8_crop_avx2.c \
	plugins/bvh8_crew.h plugins/bvh8_crown.c plugins/bvh8_fast.c plugins/bvh8_fast.h plugins/bvh8_fill.h \
	plugins/bvh8_flood.h plugins/bvh8_fold.h \
	plugins/bvh8_grow.h plugins/bvh8_herd.h plugins/bvh8_hull.h plugins/bvh8_lanes.c \
	plugins/bvh8_leaf.h plugins/bvh8_lone.h plugins/bvh8_lot.h plugins/bvh8_order.h plugins/bvh8_part.h \
	plugins/bvh8_plain.c \
	plugins/bvh8_predict.c plugins/bvh8_refit.c plugins/bvh8_ride.h \
	plugins/bvh8_sah.c plugins/bvh8_sah.h plugins/bvh8_sah_avx2.c \
	plugins/bvh8_solo.h plugins/bvh8_spatial.h plugins/bvh8_split.c plugins/bvh8_sse.c plugins/bvh8_vec.h \
	plugins/bvh8_vecg.h plugins/bvh8_walk.h plugins/bvh8_wide.c plugins/doubles.h plugins/f4.h $(ISA) \
	plugins/lane_triangle.h plugins/seen.h
plugins_bvh8_la_CPPFLAGS = $(PLUGIN_CPPFLAGS)
plugins_bvh8_la_LDFLAGS = $(PLUGIN_LDFLAGS)

# What it links with has threads of its own, and stays loaded for their sake.
if HAVE_EMBREE
pkglibaccel_LTLIBRARIES += plugins/embree.la
plugins_embree_la_SOURCES = plugins/embree.c plugins/embree_walk.c plugins/embree.h
plugins_embree_la_CPPFLAGS = $(PLUGIN_CPPFLAGS)
plugins_embree_la_LDFLAGS = $(PLUGIN_LDFLAGS) -Wl,-z,nodelete
plugins_embree_la_LIBADD = $(EMBREE_LIBS)
endif

# Libtool's .la files are of no use to dlopen(); only libtool itself would miss them.
install-data-hook:
	cd '$(DESTDIR)$(pkglibacceldir)' && rm -f none.la sphere.la box.la octree.la bvh8.la embree.la
	rm -f '$(DESTDIR)$(pkglibdir)/io_oiio.la'

uninstall-hook:
	cd '$(DESTDIR)$(pkglibacceldir)' && rm -f none.so sphere.so box.so octree.so bvh8.so embree.so
	rm -f '$(DESTDIR)$(pkglibdir)/io_oiio.so'

# To start one's own from, outside of this tree.
EXTRA_DIST += plugins/template/Makefile plugins/template/README.md plugins/template/mine.c
