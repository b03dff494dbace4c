# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""How cost grows with size: a fractal terrain of 1,000 to 10 million triangles (100 million with --all, if the memory
is there), the same view of it, the same number of rays. Nanoseconds a ray, milliseconds of building and bytes a
triangle, each the median of rounds in one process a size (tests/bench/rays); and a curve over the logarithm of the
number of triangles.

If a ray costs a + b log2 n, all points of a curve lie on a line. b is fitted by least squares to the sizes whose tree
fits into a cache of the processor and to the others apart, since a miss costs more than a step: a bend between the
two is the memory's, not the algorithm's.

    scale.py [--all] [--least N] [--most N] [--engine NAME ..] [--rounds N] [--builds N] [--width W] [--threads N] [--json FILE]
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

import measure_runs as m

SIZES = [22, 71, 224, 707, 2236]        # squares a side: two triangles each; the next are for --all
MORE = [5000, 7071]
CACHE = 8 << 20     # bytes, about what a core can keep of a cache that it shares
KINDS = ['camera', 'shadow', 'bounce', 'shuffled']
BYTES = 150      # a triangle, of mesh and tree, while that is built: to refuse in time


def memory():
    with open('/proc/meminfo', encoding='ascii') as file:
        return 1024 * int(next(line for line in file if line.startswith('MemAvailable')).split()[1])


def measure(side, options, folder):
    path = os.path.join(folder, 'rays.json')
    triangles = 2 * side * side
    if triangles * BYTES > memory():
        print('%d triangles would take about %.1f GB, and %.1f are free: left out' % (
            triangles, 1e-9 * triangles * BYTES, 1e-9 * memory()), flush=True)
        return None
    big = triangles > 2e7
    _, peak, _ = m.peaked([os.path.join(os.environ['ALIDADE_BUILD'], 'tests', 'bench', 'rays'), '-m', 'terrain%d' % side,
                           '-n', str(options.rounds), '-b', str(1 if big else options.builds), '-s', str(options.width),
                           '-t', str(options.threads), '-j', path, *options.engine])
    with open(path, encoding='utf-8') as file:
        world = json.load(file)['worlds'][0]
    out = []
    for e in world['engines']:
        if e['name'] not in options.engine:
            continue
        out.append({'engine': e['name'], 'triangles': world['triangles'], 'build': 1e3 * e['build_seconds'],
                    'bytes': e['bytes'] / world['triangles'], 'tree': e['bytes'], 'peak': peak,
                    'others': world['others_share'],
                    **{k: 1e9 * options.threads / e['kinds'][k]['rays_per_second'] for k in KINDS}})
    return out


def slope(points):
    """Of y over log2 x, by least squares."""
    n = len(points)
    if n < 2:
        return None
    x, y = [math.log2(p[0]) for p in points], [p[1] for p in points]
    mx, my = sum(x) / n, sum(y) / n
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def curve(rows, kind):
    most = max(r[kind] for r in rows)
    for r in rows:
        print('  %11s  %s %.0f' % ('{:,}'.format(r['triangles']), '#' * max(1, round(50 * r[kind] / most)), r[kind]))


def tell(engine, rows, threads):
    print('\n%s, %d thread%s:' % (engine, threads, 's' if threads > 1 else ''))
    head = ['triangles', 'build ms', 'ns/tri', 'B/tri', 'peak MB'] + ['%s ns' % k for k in KINDS] + ['ns/log2 n', 'others']
    m.table([head] + [['{:,}'.format(r['triangles']), '%.2f' % r['build'], '%.0f' % (1e6 * r['build'] / r['triangles']),
                       '%.0f' % r['bytes'], '%.0f' % (r['peak'] / 1e6)] + ['%.0f' % r[k] for k in KINDS] +
                      ['%.1f' % (r['bounce'] / math.log2(r['triangles'])), '%.0f %%' % (100 * r['others'])] for r in rows])
    limit = CACHE
    for kind in KINDS:
        near = slope([(r['triangles'], r[kind]) for r in rows if r['tree'] <= limit])
        far = slope([(r['triangles'], r[kind]) for r in rows if r['tree'] > limit])
        whole = slope([(r['triangles'], r[kind]) for r in rows])
        print('  %s: each doubling costs %s ns' % (kind, '%.1f' % whole if whole is not None else '-'), end='')
        print('' if near is None else ', %.1f while the tree fits into %d MB of cache' % (near, limit >> 20), end='')
        print('' if far is None else ', %.1f beyond' % far)
    print('  ns a bounce ray:')
    curve(rows, 'bounce')


def main():
    options = argparse.ArgumentParser(description='how cost grows with size')
    options.add_argument('--all', action='store_true', help='up to 100 million triangles')
    options.add_argument('--least', type=int, default=0, help='no fewer triangles than that')
    options.add_argument('--most', type=int, default=10**9, help='no more triangles than that')
    options.add_argument('--engine', nargs='+', default=['bvh8'], help='accelerators, as rays.c takes them (bvh8)')
    options.add_argument('--rounds', type=int, default=7, help='rounds of rays (7)')
    options.add_argument('--builds', type=int, default=3, help='builds, of which the median counts; one of large ones (3)')
    options.add_argument('--width', type=int, default=512, help='of the picture whose rays are traced (512)')
    options.add_argument('--threads', type=int, default=1)
    options.add_argument('--json', help='file for every figure')
    options = options.parse_args()
    found = []
    with tempfile.TemporaryDirectory(prefix='alidade-bench.') as folder:
        for side in SIZES + (MORE if options.all else []):
            wanted = options.least <= 2 * side * side <= options.most
            rows = measure(side, options, folder) if wanted else None
            for r in rows or []:
                print('%s, %d triangles: build %.1f ms, bounce %.0f ns' % (r['engine'], r['triangles'], r['build'],
                                                                         r['bounce']), flush=True)
            found += rows or []
    if not found:
        sys.exit('no size was measured')
    for engine in dict.fromkeys(r['engine'] for r in found):
        tell(engine, [r for r in found if r['engine'] == engine], options.threads)
    if options.json:
        with open(options.json, 'w', encoding='utf-8') as file:
            json.dump(found, file, indent=1)


if __name__ == '__main__':
    main()
