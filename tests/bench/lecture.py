# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""The lecture's table: what each structure saves on one mesh of 3,072 triangles in world coordinates.

Camera rays only, one through each pixel of 512 x 512, one thread. Volumes are bounding volumes: of the
object for sphere and box, of the cells for the octree, whose leaves hold one triangle unless depth runs
out. A volume hit is useful if what is inside is hit too. Counts come from one run with counters on; "build"
and "render" are medians of such runs, "whole run" that of runs without counters, from the start of the
program to its end. Runs of all structures take turns.

Then rays alone, without start, shading and writing (lecture_rays.c): times as ratios to plain brute force, for all
accelerators, octrees by depth, of boxes and of spheres, with narrow and wide indices, in a loop and by recursion; and
how many tests a second none makes.

    lecture.py [--runs N] [--rays]      (--rays: only the second part)
"""
import argparse
import os
import subprocess
import sys
import tempfile

import measure_runs as m

STRUCTURES = ['none', 'sphere', 'box'] + ['octree:depth=%d,leaf=1,price=0' % d for d in range(6)]
TRIANGLES = 3072
RAYS = (['none', 'sphere', 'box', 'bvh8', 'octree'] +
        ['octree:' + p for p in ('leaf=8', 'leaf=24', 'index=16', 'index=32', 'walk=recursion', 'node=sphere')] +
        ['octree:%sdepth=%d,leaf=1,price=0' % (node, d) for node in ('', 'node=sphere,') for d in range(9)])
SETS = ['auto', 'avx2', 'sse', 'plain']


def rays_alone(runs):
    tool = os.path.join(os.environ['ALIDADE_BUILD'], 'tests', 'bench', 'lecture_rays')
    sets = ['none:isa=' + s for s in SETS]
    if not os.path.exists('/proc/cpuinfo') or 'avx2' not in open('/proc/cpuinfo').read():
        sets = ['none']
    for kind, engines in (('camera', RAYS), ('camera', sets), ('lamp', sets), ('any', sets)):
        print('\nrays alone, %s, medians of %d rounds:' % (kind, runs), flush=True)
        subprocess.run([tool, '-n', str(runs), '-k', kind] + engines, check=True)


def number(n):
    return '{:,}'.format(n)


def row(name, reports, plain):
    r = reports[0]
    t, camera = r['tests'], r['rays']['camera']
    useful = t.get('volume_hits_useful_percent')
    return [name, number(camera['cast']), number(t['intersection_tests']), number(camera['hit']),
            number(camera['missed']), number(t['volume_hits']), number(t['volume_misses']),
            '-' if useful is None else '%.1f' % useful,
            '%.4f' % m.median([r['seconds']['build'] for r in reports]),
            '%.4f' % m.median([r['seconds']['render'] for r in reports]), '%.4f' % m.median(plain)]


def main():
    options = argparse.ArgumentParser(description='the lecture\'s table')
    options.add_argument('--runs', type=int, default=5, help='runs of each structure (5)')
    options.add_argument('--threads', type=int, default=1, help='threads (1)')
    options.add_argument('--rays', action='store_true', help='rays alone, no whole runs')
    options = options.parse_args()
    if options.rays:
        rays_alone(options.runs)
        return
    scene = os.path.join(os.environ['ALIDADE_SRC'], 'scenes', 'lecture', 'lecture.pov')
    reports = {name: [] for name in STRUCTURES}
    plain = {name: [] for name in STRUCTURES}
    with tempfile.TemporaryDirectory(prefix='alidade-bench.') as folder:
        fixed = ['-s', '512x512', '-t', str(options.threads), '--aa', 'none', '--camera-only', '-o',
                 os.path.join(folder, 'out.ppm'), scene]
        for _ in range(options.runs):
            for name in STRUCTURES:
                reports[name].append(m.alidade(['-a', name] + fixed, folder))
                plain[name].append(m.run([os.environ['ALIDADE'], '-q', '-a', name] + fixed)[0])
    print('%d triangles, 512 x 512 camera rays, medians of %d runs' % (TRIANGLES, options.runs))
    m.table([['structure', 'rays', 'tests', 'hits', 'misses', 'volume hits', 'volume misses', 'useful %',
              'build s', 'render s', 'whole run s']] +
            [row(name, reports[name], plain[name]) for name in STRUCTURES])
    first = reports['none'][0]
    rays, tests = first['rays']['camera']['cast'], first['tests']['intersection_tests']
    if tests != rays * TRIANGLES:
        sys.exit('none tested %d times, and not rays x triangles = %d' % (tests, rays * TRIANGLES))
    counted = {(r['rays']['camera']['cast'], r['rays']['camera']['hit']) for rs in reports.values() for r in rs}
    if len(counted) != 1:
        sys.exit('the structures do not agree on the rays that hit: %s' % sorted(counted))
    rays_alone(options.runs)


if __name__ == '__main__':
    main()
