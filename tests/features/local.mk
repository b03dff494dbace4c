TESTS += tests/features/features.sh
EXTRA_DIST += tests/features
