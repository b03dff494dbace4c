# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Whole programs, from file to picture: Alidade, POV-Ray and, where it is installed, Tachyon, on the same triangles,
camera and lamp, 800 x 600, with the same threads.

Scenes are made here (scene_files.c): a mesh2 of 100,000 and one of a million triangles on a stage, one point light with
shadows; and the small one of glass on a mirror, without Tachyon, which has no refraction. Without anti-aliasing, and with
3 x 3 rays in each pixel (POV-Ray's method 1 with a threshold of 0, ours the same; Tachyon takes 9 rays), of which only
tracing counts.

All programs take turns, and the order turns round in every second round. Told are medians and, for ratios, the median
of those within a round, with the middle eight tenths. "noise" is what the same ratio would be between two runs of one program: half
of the runs of Alidade against the next ones. A ratio whose middle eight tenths reach over the aim on both sides has no
verdict. Parse, build, trace and write are each program's own words (Alidade: --progress=json, and what is left of the
clock is "rest": starting, writing, ending); whole is the clock's, peak the kernel's, and not below this script's own 15 MB.

    whole.py [--runs N] [--threads 1,2] [--scenes NAME,..] [--size WxH] [--json FILE]
"""
import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

import measure_runs as m

SCENES = {'100k': ('statue100k', 'plain', False), '1m': ('statue1m', 'plain', False),
          'glass': ('statue100k', 'glass', False), 'aa': ('statue100k', 'plain', True),
          'terrain': ('terrain', 'plain', False), 'suzanne': ('suzanne', 'plain', False)}
PARTS = ['parse', 'build', 'trace', 'write', 'rest', 'whole', 'peak']
# How many times faster: whole and trace, against whom
AIMS = {('povray', 'plain'): (10, 10), ('povray', 'glass'): (5, 5), ('tachyon', 'plain'): (None, 8)}


def alidade_command(stem, o):
    return [os.environ['ALIDADE'], '--progress=json', '-s', '%dx%d' % o['size'], '-t', str(o['threads']),
            '--aa=' + ('pov1:threshold=0,depth=3' if o['aa'] else 'none'), '-o', stem + '.alidade.png', stem + '.pov']


def alidade_parts(text, seconds):
    ends = {}
    for line in text.splitlines():
        if line.startswith('{'):
            d = json.loads(line)
            if d['kind'] == 'end':
                ends[d['phase']] = d['elapsed']
    out = {'parse': ends['reading'], 'build': ends['building'], 'trace': ends['rendering'], 'write': ends['writing']}
    out['rest'] = seconds - sum(x for x in out.values() if x)
    return out


def povray_command(stem, o):
    name = os.path.basename(stem)
    return ['povray', '+I' + name + '.pov', '+O' + name + '.povray.png', '+W%d' % o['size'][0], '+H%d' % o['size'][1],
            '+FN', '-D', '-P', '-UA', '+WT%d' % o['threads'], '-V'] + (
                ['+A0.0', '+AM1', '+R3', '-J'] if o['aa'] else ['-A', '-J'])


def povray_parts(text, seconds):
    found = {k: float(v) for k, v in re.findall(r'(Parse|Photon|Bounding|Trace) Time:.*?\(([0-9.]+) seconds\)', text)}
    out = {'parse': found.get('Parse'), 'build': found.get('Bounding', 0) or None,
           'trace': found.get('Trace', 0) + found.get('Photon', 0)}
    out['rest'] = seconds - sum(x for x in out.values() if x)
    return out


def tachyon_command(stem, o):
    return ['tachyon', stem + '.dat', '+V', '-res', *map(str, o['size']), '-numthreads', str(o['threads']), '-format', 'PNG',
            '-o', stem + '.tachyon.png', '-aasamples', '8' if o['aa'] else '0']


def tachyon_parts(text, seconds):
    names = {'Scene Parsing': 'parse', 'Preprocessing': 'build', 'Ray Tracing': 'trace', 'Image I/O': 'write'}
    out = {names[k]: float(v) for k, v in re.findall(
        r'(Scene Parsing|Preprocessing|Ray Tracing|Image I/O) Time: +([0-9.]+) seconds', text)}
    out['rest'] = seconds - sum(out.values())
    return out


PROGRAMS = {'alidade': (alidade_command, alidade_parts), 'povray': (povray_command, povray_parts),
            'tachyon': (tachyon_command, tachyon_parts)}


def installed(kind):
    return [p for p in PROGRAMS if (p == 'alidade' or shutil.which(p)) and not (p == 'tachyon' and kind == 'glass')]


def one_run(program, stem, o):
    command, parts = PROGRAMS[program]
    seconds, peak, text = m.peaked(command(stem, o), cwd=os.path.dirname(stem))
    return {**dict.fromkeys(PARTS), **parts(text, seconds), 'whole': seconds, 'peak': peak / 1e6}


def middle(values):
    values = sorted(values)
    cut = len(values) // 10
    return statistics.median(values), values[cut], values[-1 - cut]


def ratios(turns, program, part, base='alidade'):
    """Within a turn, so that what disturbs one part of the time disturbs both."""
    return [t[program][part] / t[base][part] for t in turns]


def cell(values, part):
    values = [v for v in values if v is not None]
    if not values:
        return '-'
    mid, low, high = middle(values)
    if part == 'peak':
        return '%.0f' % mid
    return '%.1f (%.1f .. %.1f)' % (1e3 * mid, 1e3 * low, 1e3 * high)


def verdict(spread, aim):
    if aim is None:
        return ''
    if spread[1] >= aim:
        return ' >= %d' % aim
    return ' below %d' % aim if spread[2] < aim else ' no verdict on %d' % aim


def compare(turns, kind, aa):
    for program in turns[0]:
        if program == 'alidade':
            continue
        aims = AIMS.get((program, kind), (None, None))
        for part, aim in zip(('whole', 'trace'), aims):
            if aa and part == 'whole':
                continue
            spread = middle(ratios(turns, program, part))
            print('  %s takes %.1f times as long (%.1f .. %.1f), %s%s' % (program, *spread, part, verdict(spread, aim)))
    noise = [turns[i + 1]['alidade']['whole'] / t['alidade']['whole'] for i, t in enumerate(turns[:-1])]
    if noise:
        print('  noise: %.2f (%.2f .. %.2f)' % middle(noise), end='')
    print('; load %.2f' % os.getloadavg()[0], flush=True)


def race(name, stem, options, threads, kind, aa):
    o = {'size': options.size, 'threads': threads, 'aa': aa}
    turns, names = [], installed(kind)
    for turn in range(options.runs + 1):        # the first warms up
        order = names if turn % 2 else names[::-1]
        turns.append({p: one_run(p, stem, o) for p in order})
    turns = [{p: t[p] for p in names} for t in turns[1:]]
    print('\n%s, %d x %d, %s, %d thread%s, medians of %d (ms; peak in MB):' % (
        name, *options.size, '3 x 3 rays a pixel' if aa else 'no anti-aliasing', threads, 's' if threads > 1 else '',
        len(turns)))
    m.table([['', *PARTS]] + [[p] + [cell([t[p][k] for t in turns], k) for k in PARTS] for p in names])
    compare(turns, kind, aa)
    return {'scene': name, 'threads': threads, 'aa': aa, 'turns': turns}


def scaling(found):
    """Two threads against one, for each program."""
    for one in found:
        for two in found:
            if (one['scene'], one['threads'], two['scene'], two['threads']) == (two['scene'], 1, one['scene'], 2):
                for p in one['turns'][0]:
                    a, b = ([t[p] for t in x['turns']] for x in (one, two))
                    r = [statistics.median(t[k] for t in a) / statistics.median(t[k] for t in b) for k in ('trace', 'whole')]
                    print('%s, %s: two threads trace %.2f times as fast as one, whole runs %.2f' % (one['scene'], p, *r))


def size(text):
    w, h = text.split('x')
    return int(w), int(h)


def main():
    options = argparse.ArgumentParser(description='whole programs, from file to picture')
    options.add_argument('--runs', type=int, default=7, help='turns (7)')
    options.add_argument('--threads', default='1,2', help='of each program (1,2)')
    options.add_argument('--scenes', default='100k,1m,glass,aa', help='of: ' + ', '.join(SCENES))
    options.add_argument('--size', type=size, default=(800, 600), help='of the pictures (800x600)')
    options.add_argument('--json', help='file for every figure')
    options.add_argument('--keep', metavar='FOLDER', help='for scenes and pictures, instead of one that is removed')
    options = options.parse_args()
    for p in PROGRAMS:
        if p not in installed('plain'):
            print('%s is not installed, and left out' % p)
    found = []
    with tempfile.TemporaryDirectory(prefix='alidade-bench.') as folder:
        folder = os.path.abspath(options.keep or folder)     # Debian's POV-Ray opens files below here only
        for name in options.scenes.split(','):
            if name not in SCENES:
                sys.exit('no scene is called %s; there are %s' % (name, ', '.join(SCENES)))
            world, kind, aa = SCENES[name]
            stem = os.path.join(folder, world + '-' + kind)
            if not os.path.exists(stem + '.pov'):
                subprocess.run([os.path.join(os.environ['ALIDADE_BUILD'], 'tests', 'bench', 'scene_files'), world, kind,
                                stem], check=True)
            for threads in map(int, options.threads.split(',')):
                found.append(race(name, stem, options, threads, kind, aa))
    print()
    scaling(found)
    if options.json:
        with open(options.json, 'w', encoding='utf-8') as file:
            json.dump(found, file, indent=1)


if __name__ == '__main__':
    main()
