IMAGE_TESTS = tests/images/diff.sh tests/images/formats.sh
TESTS += $(IMAGE_TESTS)
EXTRA_DIST += $(IMAGE_TESTS)
