NUMERICS_TESTS = tests/numerics/kernel-bits.sh
TESTS += $(NUMERICS_TESTS)
EXTRA_DIST += $(NUMERICS_TESTS) tests/numerics/kernel_bits.c
