# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""What being right costs: --precision=default against fast (the same code with float kernels and volumes that are not
grown), and exact against default.

For each scene all precisions draw the whole picture, on one thread, taking turns; then camera rays alone
(--camera-only). Compared are processor seconds of whole runs, less those of reading and building (--dry-run); a turn
gives one ratio, and told are the median and the middle eight tenths. A busy machine widens them: where they lie on
both sides of a limit there is no answer. Last come rays alone by kind, from tests/bench/rays.

The limits: default at most 1.10 times fast, for whole pictures; exact at most 1.25 times default, for rays too.

    precision.py [--runs N] [--size WxH] [--accel NAME] [SCENE ...]
"""
import argparse
import os
import statistics
import subprocess
import sys
import tempfile

import measure_runs as m

SCENES = ['suzanne', 'lecture', 'instances', 'shading', 'finishes', 'glass', 'modifiers', 'landscape']
PRECISIONS = ['fast', 'default', 'exact']
LIMITS = {('default', 'fast'): 1.10, ('exact', 'default'): 1.25}


def commands(scene, accel, size, out):
    base = [os.environ['ALIDADE'], '-q', '--progress=none', '-t', '1', '-a', accel, '-s', size, '-o', out]
    kinds = {'picture': ['--aa=none'], 'camera rays': ['--aa=4', '--camera-only'], 'before': ['--dry-run']}
    return {(kind, p): base + more + ['--precision=' + p, scene] for kind, more in kinds.items() for p in PRECISIONS}


def ratios(kind, a, b, turns):
    return sorted((t[kind, a] - t['before', a]) / (t[kind, b] - t['before', b]) for t in turns)


def spread(values):
    cut = len(values) // 10
    return statistics.median(values), values[cut], values[-1 - cut]


def measure(name, options, folder):
    path = name
    for place in (os.environ['ALIDADE_BUILD'], os.environ['ALIDADE_SRC']):
        inside = os.path.join(place, 'scenes', name, name + '.pov')
        if os.path.exists(inside):
            path = inside
    if not os.path.exists(path):
        print('%s: not there, left out; ./dev scenes exports it' % name)
        return []
    asked = commands(os.path.abspath(path), options.accel, options.size, os.path.join(folder, 'out.ppm'))
    turns = []
    for turn in range(options.runs + 1):        # the first warms up
        order = sorted(asked) if turn % 2 else sorted(asked, reverse=True)
        turns.append({key: m.timed(asked[key], os.path.dirname(os.path.abspath(path)))[1] for key in order})
    turns = turns[1:]
    rows = []
    for kind in ('picture', 'camera rays'):
        cells = [os.path.splitext(os.path.basename(path))[0] + ', ' + kind]
        for p in PRECISIONS:
            cells.append('%.3f' % statistics.median(t[kind, p] - t['before', p] for t in turns))
        for a, b in LIMITS:
            cells.append('%.3f (%.3f .. %.3f)' % spread(ratios(kind, a, b, turns)))
        rows.append(cells)
        print('  '.join(cells), flush=True)
    return [(rows, turns)]


def verdict(kind, pair, found):
    """Over all scenes: the median of the scenes' medians, and the worst scene."""
    medians = [statistics.median(ratios(kind, *pair, turns)) for _, turns in found]
    limit = LIMITS[pair]
    print('%s, %s/%s: geometric mean %.3f, worst %.3f; %d of %d scenes at most %.2f' % (
        kind, *pair, statistics.geometric_mean(medians), max(medians), sum(x <= limit for x in medians), len(medians),
        limit))


def main():
    options = argparse.ArgumentParser(description='what exact answers cost and floats save')
    options.add_argument('--runs', type=int, default=11, help='turns (11)')
    options.add_argument('--size', default='320x240', help='of the pictures (320x240)')
    options.add_argument('--accel', default='bvh8', help='accelerator (bvh8)')
    options.add_argument('scene', nargs='*', help='names of our scenes, or files')
    options = options.parse_args()
    print('%s, accelerator %s, one thread, %d turns: processor seconds without reading and building, then ratios' % (
        options.size, options.accel, options.runs))
    found = []
    with tempfile.TemporaryDirectory(prefix='alidade-bench.') as folder:
        for name in options.scene or SCENES:
            found += measure(name, options, folder)
    if not found:
        sys.exit('no scenes')
    print()
    m.table([['', *PRECISIONS, *('%s/%s' % pair for pair in LIMITS)]] + [row for rows, _ in found for row in rows])
    print()
    for kind in ('picture', 'camera rays'):
        for pair in LIMITS:
            verdict(kind, pair, found)
    print('\nrays alone, against the default:')
    sys.stdout.flush()
    subprocess.run([os.path.join(os.environ['ALIDADE_BUILD'], 'tests', 'bench', 'rays'), '-n', str(options.runs), '-s',
                    '256', '-m', 'torus,statue100k,beams', options.accel] +
                   [options.accel + '@' + p for p in ('exact', 'fast')], check=True)


if __name__ == '__main__':
    main()
