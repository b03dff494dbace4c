IMAGE_TESTS = tests/images/diff.sh tests/images/formats.sh tests/images/scenes.sh
TESTS += $(IMAGE_TESTS)
EXTRA_DIST += $(IMAGE_TESTS) tests/images/scenes.py tests/images/measure.py tests/images/picture.py \
	tests/images/enlarge.py tests/images/renderers.py tests/images/report.py tests/images/tap.py
# Written by scenes.sh.
CLEANFILES += tests/report.html
