# Unit tests: one program per source file, on cmocka.
UNIT_LIBS = src/libalidade.la $(CMOCKA_LIBS)
UNIT_CPPFLAGS = $(AM_CPPFLAGS) $(CMOCKA_CFLAGS)
include tests/unit/local.mk

# Tests in shell: tests/tap.sh tells how they are written.
SHELL_TESTS = tests/headers.sh tests/layers.sh tests/lengths.sh tests/lint.sh tests/cli/broken.sh tests/cli/table.sh \
	tests/cli/terminator.sh \
	tests/cli/errors.sh tests/cli/examples.sh tests/cli/files.sh tests/cli/frames.sh tests/cli/output.sh \
	tests/cli/refit.sh tests/cli/ways.sh \
	tests/cli/pages.sh tests/cli/textures.sh tests/cli/texture-filter.sh tests/cli/trade.sh tests/cli/vertices.sh
TESTS += $(SHELL_TESTS)
include tests/images/local.mk
EXTRA_DIST += $(SHELL_TESTS) tests/tap.sh tests/cli/scene.pov tests/lengths.py tests/lengths.txt
include tests/plugins/local.mk
include tests/numerics/local.mk
include tests/blender/local.mk
include tests/features/local.mk
include tests/indirect/local.mk
include tests/bench/local.mk
include tests/budget/local.mk
