# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Alidade with its default accelerator against POV-Ray on the same file: 250,000 triangles, 800 x 600, the same
threads, no anti-aliasing, both writing PNG. Whole runs take turns; the ratio is that of the medians.

Parse, build and trace apart come from each program's own report, of further runs: POV-Ray prints them, in
Alidade they need the counters on. POV-Ray builds its bounding hierarchies while it parses.

    povray.py [--runs N] [--threads N] [SCENE.pov]
"""
import argparse
import os
import re
import shutil
import tempfile

import measure_runs as m


def povray_times(text):
    """Seconds of parsing (with bounding) and tracing, as POV-Ray prints them."""
    found = dict(re.findall(r'(Parse|Bounding|Trace) Time:.*?\(([0-9.]+) seconds\)', text))
    return float(found.get('Parse', 0)), float(found.get('Bounding', 0)), float(found.get('Trace', 0))


def main():
    options = argparse.ArgumentParser(description='Alidade against POV-Ray')
    options.add_argument('--runs', type=int, default=5, help='runs of each (5)')
    options.add_argument('--threads', type=int, default=os.cpu_count() or 1, help='threads of each')
    options.add_argument('scene', nargs='?', default=os.path.join(
        os.environ['ALIDADE_BUILD'], 'scenes', 'landscape', 'landscape.pov'))
    options = options.parse_args()
    ours, theirs, parts, povray_parts = [], [], [], []
    with tempfile.TemporaryDirectory(prefix='alidade-bench.') as folder:
        scene = os.path.join(folder, 'scene.pov')     # Debian's POV-Ray opens files below here only
        shutil.copyfile(options.scene, scene)
        fixed = ['-s', '800x600', '-t', str(options.threads), '--aa', 'none', '-o',
                 os.path.join(folder, 'ours.png'), scene]
        povray = ['povray', '+Iscene.pov', '+Otheirs.png', '+W800', '+H600', '+FN', '-D', '-P', '-UA', '-A',
                  '-J', '+WT%d' % options.threads]
        for _ in range(options.runs):
            ours.append(m.run([os.environ['ALIDADE'], '-q'] + fixed)[0])
            seconds, text = m.run(povray, cwd=folder)
            theirs.append(seconds)
            povray_parts.append(povray_times(text))
            parts.append(m.alidade(fixed, folder)['seconds'])
    print('%s, 800 x 600, %d threads, medians of %d runs, in seconds' % (
        os.path.basename(options.scene), options.threads, options.runs))
    read, build, trace = (m.median([p[k] for p in parts]) for k in ('read', 'build', 'render'))
    parse, bound, traced = (m.median([p[k] for p in povray_parts]) for k in range(3))
    m.table([['', 'parse', 'build', 'trace', 'whole run'],
             ['alidade', '%.3f' % read, '%.3f' % build, '%.3f' % trace, '%.3f' % m.median(ours)],
             ['povray', '%.3f' % parse, '%.3f' % bound if bound else '(in parse)', '%.3f' % traced,
              '%.3f' % m.median(theirs)]])
    print('alidade takes %.3f of POV-Ray\'s time' % (m.median(ours) / m.median(theirs)))


if __name__ == '__main__':
    main()
