# ./dev bench: measurements, no tests.
EXTRA_DIST += tests/bench/run.sh tests/bench/lecture.py tests/bench/povray.py tests/bench/indirect.py \
	tests/bench/measure_runs.py
