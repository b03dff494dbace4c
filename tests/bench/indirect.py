# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Indirect light at equal error: how long until a picture is as near to the truth as POV-Ray's own.

The scene is an ordinary one of 15,000 triangles with the radiosity block that Blender's add-on writes by default
(scenes/radiosity), 640 x 480, no anti-aliasing. The truth is POV-Ray's picture at high quality: count 1600,
error_bound 0.1, nearest_count 10, pretrace_start 0.08, minimum_reuse 0.002; it takes minutes once, and is kept in the
build folder. With --exact our own of 1024 rays a pixel is made too, and both errors are told. Errors are RMS along the
sRGB curve, of pictures in floating point; timed are whole runs that write PNG, on the same threads, taking turns.

Asked is whether our fastest setting that is at least as good takes at most half of POV-Ray's time. Each turn gives
one ratio of times; where the middle eight tenths of them lie on both sides of a half there is no answer.

    indirect.py [--runs N] [--threads N] [--exact]
"""
import argparse
import os
import re
import shutil
import sys
import tempfile

import measure_runs as m

sys.path.insert(0, os.path.join(os.environ['ALIDADE_SRC'], 'tests', 'images'))
import measure
import picture

SIZE = (640, 480)
HIGH = {'count': '1600', 'error_bound': '0.1', 'nearest_count': '10', 'pretrace_start': '0.08',
        'minimum_reuse': '0.002'}
CACHE = ['--indirect=cache']
OURS = [('off', ['--indirect=off']),
        ('cache, error 8, 16 rays', CACHE + ['--indirect-error=8', '--indirect-samples=16']),
        ('cache, error 4, 32 rays', CACHE + ['--indirect-error=4', '--indirect-samples=32']),
        ('cache, error 2, 64 rays', CACHE + ['--indirect-error=2', '--indirect-samples=64']),
        ('cache, error 1.5, 64 rays', CACHE + ['--indirect-error=1.5', '--indirect-samples=64']),
        ('cache, 64 rays', CACHE + ['--indirect-samples=64']),
        ('cache, default', CACHE),
        ('exact, 16 rays', ['--indirect-samples=16'])]
GOAL = 0.5


def povray(scene, out, threads, kind='E'):
    return ['povray', '+I' + scene, '+O' + out, '+W%d' % SIZE[0], '+H%d' % SIZE[1], '+F' + kind, '-D', '-P', '-UA',
            '-A', '-J', '+WT%d' % threads]


def alidade(scene, out, threads, more):
    return [os.environ['ALIDADE'], '-q', '-s', '%dx%d' % SIZE, '--aa', 'none', '-t', str(threads), '-o', out,
            *more, scene]


def high_quality(text):
    for name, value in HIGH.items():
        text, found = re.subn(r'(?m)^(\s*%s)\s+\S+$' % name, r'\1 ' + value, text)
        if found != 1:
            sys.exit('the scene\'s radiosity block has no %s' % name)
    return text


def truths(scene, kept, threads, exact):
    """Names and pictures. Made anew if the scene is newer."""
    def missing(path):
        return not os.path.exists(path) or os.path.getmtime(path) < os.path.getmtime(scene)
    os.makedirs(kept, exist_ok=True)
    theirs, ours = os.path.join(kept, 'povray.exr'), os.path.join(kept, 'exact.exr')
    if missing(theirs):
        print('POV-Ray at high quality: this takes some minutes', flush=True)
        with open(scene, encoding='utf-8') as file:
            text = high_quality(file.read())
        with tempfile.TemporaryDirectory(prefix='alidade-bench.') as folder:
            with open(os.path.join(folder, 'high.pov'), 'w', encoding='utf-8') as file:
                file.write(text)
            m.run(povray('high.pov', 'high.exr', threads), cwd=folder)
            shutil.move(os.path.join(folder, 'high.exr'), theirs)
    found = [('POV-Ray at high quality', picture.read(theirs))]
    if exact and missing(ours):
        print('1024 rays a pixel: this takes some minutes', flush=True)
        m.run(alidade(scene, ours, threads, ['--indirect=exact', '--indirect-samples=1024']))
    if exact:
        found.append(('exact, 1024 rays', picture.read(ours)))
        print('the two truths differ: %s' % measure.Figures(found[1][1], found[0][1]).text())
    return found


def errors(path, known):
    made = picture.read(path)
    return [measure.Figures(made, truth).rmse for _, truth in known]


def verdict(name, pairs, what):
    """pairs: seconds of ours and of POV-Ray's, a turn."""
    ratios = sorted(a / b for a, b in pairs)
    cut = len(ratios) // 10
    low, high = ratios[cut], ratios[-1 - cut]
    answer = 'yes' if high <= GOAL else 'no' if low > GOAL else 'too noisy to tell'
    print('%s: at most half of POV-Ray\'s %s time? %s: ratio %.3f, from %.3f to %.3f' % (
        name, what, answer, m.median(ratios), low, high))


def main():
    options = argparse.ArgumentParser(description='time to POV-Ray\'s own error')
    options.add_argument('--runs', type=int, default=11, help='runs of each (11)')
    options.add_argument('--threads', type=int, default=2, help='threads of each (2)')
    options.add_argument('--exact', action='store_true', help='compare with our own picture of many rays too')
    options = options.parse_args()
    build = os.environ['ALIDADE_BUILD']
    export = os.path.join(build, 'scenes', 'radiosity', 'radiosity.pov')
    known = truths(export, os.path.join(build, 'bench'), options.threads, options.exact)
    runs = {name: [] for name, _ in [('POV-Ray', None)] + OURS}
    error = {}
    with tempfile.TemporaryDirectory(prefix='alidade-bench.') as folder:
        scene = os.path.join(folder, 'scene.pov')     # Debian's POV-Ray opens files below here only
        shutil.copyfile(export, scene)
        m.run(povray('scene.pov', 'theirs.exr', options.threads), cwd=folder)
        error['POV-Ray'] = errors(os.path.join(folder, 'theirs.exr'), known)
        for name, more in OURS:
            out = os.path.join(folder, 'ours.exr')
            m.run(alidade(scene, out, options.threads, more + ['--bits=32']))
            error[name] = errors(out, known)
        for _ in range(options.runs):
            runs['POV-Ray'].append(m.timed(povray('scene.pov', 't.png', options.threads, 'N'), folder))
            for name, more in OURS:
                runs[name].append(m.timed(alidade(scene, os.path.join(folder, 't.png'), options.threads, more)))
    print('%d x %d, %d threads, medians of %d runs in seconds, errors against %s' % (
        SIZE + (options.threads, options.runs, ' and '.join(name for name, _ in known))))
    whole, busy = ({k: m.median([r[i] for r in v]) for k, v in runs.items()} for i in (0, 1))
    m.table([['', 'RMS error'] + [''] * (len(known) - 1) + ['whole run', 'processors', 'ratio']] +
            [[name] + ['%.4f' % e for e in error[name]] +
             ['%.3f' % whole[name], '%.3f' % busy[name], '%.3f' % (busy[name] / busy['POV-Ray'])] for name in runs])
    good = [name for name, _ in OURS if error[name][0] <= error['POV-Ray'][0]]
    if not good:
        sys.exit('none of our settings is as good as POV-Ray')
    best = min(good, key=busy.get)
    for i, what in ((0, 'clock'), (1, 'processor')):
        verdict(best, [(a[i], b[i]) for a, b in zip(runs[best], runs['POV-Ray'])], what)


if __name__ == '__main__':
    main()
