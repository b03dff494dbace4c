
if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_json_write tests/unit/test_sobol tests/unit/test_dipole
tests_unit_test_dipole_SOURCES = tests/unit/test_dipole.c
tests_unit_test_dipole_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_dipole_LDADD = $(UNIT_LIBS)
tests_unit_test_sobol_SOURCES = tests/unit/test_sobol.c
tests_unit_test_sobol_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_sobol_LDADD = $(UNIT_LIBS)
tests_unit_test_json_write_SOURCES = tests/unit/test_json_write.c
tests_unit_test_json_write_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_json_write_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_json_write tests/unit/test_sobol tests/unit/test_dipole
endif

if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_diff tests/unit/test_image_files tests/unit/test_image_formats \
	tests/unit/test_textures
tests_unit_test_diff_SOURCES = tests/unit/test_diff.c tests/unit/image_fixture.h
tests_unit_test_diff_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_diff_LDADD = $(UNIT_LIBS)
tests_unit_test_image_files_SOURCES = tests/unit/test_image_files.c tests/unit/image_fixture.h
tests_unit_test_image_files_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_image_files_LDADD = $(UNIT_LIBS)
tests_unit_test_image_formats_SOURCES = tests/unit/test_image_formats.c tests/unit/image_fixture.h
tests_unit_test_image_formats_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_image_formats_LDADD = $(UNIT_LIBS)
tests_unit_test_textures_SOURCES = tests/unit/test_textures.c tests/unit/image_fixture.h
tests_unit_test_textures_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_textures_LDADD = $(UNIT_LIBS) $(PNG_LIBS) $(JPEG_LIBS)
TESTS += tests/unit/test_diff tests/unit/test_image_files tests/unit/test_image_formats \
	tests/unit/test_textures
endif

if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_frames tests/unit/test_options tests/unit/test_progress \
	tests/unit/test_settings tests/unit/test_stats
tests_unit_test_frames_SOURCES = tests/unit/test_frames.c
tests_unit_test_frames_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_frames_LDADD = $(UNIT_LIBS)
tests_unit_test_options_SOURCES = tests/unit/test_options.c
tests_unit_test_options_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_options_LDADD = $(UNIT_LIBS)
tests_unit_test_progress_SOURCES = tests/unit/test_progress.c
tests_unit_test_progress_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_progress_LDADD = $(UNIT_LIBS)
tests_unit_test_settings_SOURCES = tests/unit/test_settings.c src/settings.c src/settings.h src/settings_job.c
tests_unit_test_settings_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_settings_LDADD = $(UNIT_LIBS)
tests_unit_test_stats_SOURCES = tests/unit/test_stats.c
tests_unit_test_stats_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_stats_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_frames tests/unit/test_options tests/unit/test_progress tests/unit/test_settings \
	tests/unit/test_stats
endif
if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_trace tests/unit/test_mem
tests_unit_test_mem_SOURCES = tests/unit/test_mem.c
tests_unit_test_mem_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_mem_LDADD = $(UNIT_LIBS)
tests_unit_test_trace_SOURCES = tests/unit/test_trace.c tests/unit/mesh_fixture.h tests/unit/world_fixture.h
tests_unit_test_trace_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_trace_LDADD = $(UNIT_LIBS)
check_PROGRAMS += tests/unit/test_kernel
tests_unit_test_kernel_SOURCES = tests/unit/test_kernel.c tests/unit/mesh_fixture.h tests/unit/world_fixture.h
tests_unit_test_kernel_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_kernel_LDADD = $(UNIT_LIBS)
check_PROGRAMS += tests/unit/test_algebraic
tests_unit_test_algebraic_SOURCES = tests/unit/test_algebraic.c tests/unit/world_fixture.h
tests_unit_test_algebraic_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_algebraic_LDADD = $(UNIT_LIBS)
check_PROGRAMS += tests/unit/test_prim
tests_unit_test_prim_SOURCES = tests/unit/test_prim.c tests/unit/world_fixture.h
tests_unit_test_prim_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_prim_LDADD = $(UNIT_LIBS)
check_PROGRAMS += tests/unit/test_geometry
tests_unit_test_geometry_SOURCES = tests/unit/test_geometry.c tests/unit/mesh_fixture.h tests/unit/world_fixture.h
tests_unit_test_geometry_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_geometry_LDADD = $(UNIT_LIBS)
check_PROGRAMS += tests/unit/test_settle
tests_unit_test_settle_SOURCES = tests/unit/test_settle.c
tests_unit_test_settle_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_settle_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_settle tests/unit/test_algebraic
TESTS += tests/unit/test_trace tests/unit/test_mem tests/unit/test_kernel tests/unit/test_prim tests/unit/test_geometry
endif

if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_body tests/unit/test_csg
tests_unit_test_csg_SOURCES = tests/unit/test_csg.c tests/unit/mesh_fixture.h tests/unit/world_fixture.h
tests_unit_test_csg_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_csg_LDADD = $(UNIT_LIBS)
tests_unit_test_body_SOURCES = tests/unit/test_body.c tests/unit/world_fixture.h
tests_unit_test_body_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_body_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_body tests/unit/test_csg
endif

if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_shade
tests_unit_test_shade_SOURCES = tests/unit/test_shade.c
tests_unit_test_shade_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_shade_LDADD = $(UNIT_LIBS)
check_PROGRAMS += tests/unit/test_indirect
tests_unit_test_indirect_SOURCES = tests/unit/test_indirect.c
tests_unit_test_indirect_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_indirect_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_shade tests/unit/test_indirect
endif

if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_render tests/unit/test_estimate
tests_unit_test_estimate_SOURCES = tests/unit/test_estimate.c
tests_unit_test_estimate_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_estimate_LDADD = $(UNIT_LIBS)
tests_unit_test_render_SOURCES = tests/unit/test_render.c
tests_unit_test_render_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_render_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_render tests/unit/test_estimate
endif

if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_pov_scan
tests_unit_test_pov_scan_SOURCES = tests/unit/test_pov_scan.c
tests_unit_test_pov_scan_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_pov_scan_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_pov_scan
endif

if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_pov_core
tests_unit_test_pov_core_SOURCES = tests/unit/test_pov_core.c
tests_unit_test_pov_core_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_pov_core_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_pov_core
endif

if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_pov_items
tests_unit_test_pov_items_SOURCES = tests/unit/test_pov_items.c tests/unit/pov_fixture.h
tests_unit_test_pov_items_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_pov_items_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_pov_items
endif

if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_pov_mesh
tests_unit_test_pov_mesh_SOURCES = tests/unit/test_pov_mesh.c tests/unit/pov_fixture.h
tests_unit_test_pov_mesh_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_pov_mesh_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_pov_mesh
endif
EXTRA_DIST += tests/pov/core tests/fuzz/pov.py

EXTRA_DIST += tests/pov/blender

if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_noise
tests_unit_test_noise_SOURCES = tests/unit/test_noise.c
tests_unit_test_noise_CPPFLAGS = $(UNIT_CPPFLAGS)
tests_unit_test_noise_LDADD = $(UNIT_LIBS)
TESTS += tests/unit/test_noise
endif

if HAVE_CMOCKA
check_PROGRAMS += tests/unit/test_trade
tests_unit_test_trade_SOURCES = tests/unit/test_trade.c $(TRADE_PARTS)
tests_unit_test_trade_CPPFLAGS = $(UNIT_CPPFLAGS) $(JANSSON_CFLAGS) -I$(top_srcdir)/tools
tests_unit_test_trade_LDADD = $(UNIT_LIBS) $(JANSSON_LIBS)
TESTS += tests/unit/test_trade
endif
