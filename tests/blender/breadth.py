# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Many varied Blender files, each exported by the stock POV-Ray add-on and drawn by both renderers: run by
breadth.sh.

    breadth.py [ordinary] [NUMBER...]

Environment: ALIDADE, ALIDADE_SRC, ALIDADE_BUILD; ALIDADE_BREADTH is how many (75, ordinary 100),
ALIDADE_BREADTH_SEED chooses others (1). The files stay in ALIDADE_BUILD/tests/breadth, the report is
ALIDADE_BUILD/tests/breadth.html.

Ordinary files have what Blender users have beyond plain meshes, and radiosity as the add-on writes it by
default: against.py compares them.

Sizes go down to where POV-Ray's fixed distances (1e-3 and so on) show in its pictures. A file that misses
the figure because of these, and only these, passes with a note; that it is these is shown by POV-Ray's own
picture of the same file made 100 times larger.
"""
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import traceback

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, 'images'))
import against
import measure
import picture
import renderers
import report
import tap

SIZE = (160, 120)
LEAST = 99.8


class Outcome:
    def __init__(self, number):
        self.number, self.name = number, 'file %d' % number
        self.problem = self.figures = None
        self.classes, self.complaints, self.notes = {}, [], []


def export(number, seed, folder, ordinary):
    """The .pov of one file, and what Blender said about it."""
    out = os.path.join(folder, '%d.pov' % number)
    if os.path.exists(out):
        os.remove(out)
    shutil.rmtree(os.path.join(folder, str(number)), ignore_errors=True)
    os.makedirs(os.path.join(folder, str(number))) # its images
    script = os.path.join(os.environ['ALIDADE_SRC'], 'tests', 'blender', 'make.py')
    done = subprocess.run(['blender', '-b', '--factory-startup', '-P', script, '--', folder, str(number),
                           str(seed)] + ['ordinary'] * ordinary, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=300, stdin=subprocess.DEVNULL, check=False)
    text = done.stdout.decode('utf-8', 'replace')
    said = re.search(r'^scene \d+: (.*)$', text, re.M)
    if not re.search(r'^exported ', text, re.M) or not os.path.exists(out):
        raise renderers.Failed('Blender did not export it:\n' + text[-1500:])
    return out, said.group(1)


def compare(outcome, pov, folder):
    """Both renderers, and if they differ POV-Ray again on the larger scene."""
    base = os.path.join(folder, str(outcome.number))
    os.makedirs(base, exist_ok=True)
    theirs = renderers.povray(pov, os.path.join(base, 'povray.exr'), SIZE)
    ours = os.path.join(base, 'alidade.pfm')
    renderers.alidade(pov, ours, SIZE, threads=1)
    ours = picture.read(ours)
    outcome.figures = measure.Figures(ours, theirs)
    outcome.complaints = outcome.figures.complaints(LEAST)
    if not outcome.figures.count and not outcome.complaints:
        return
    larger = renderers.povray(pov, os.path.join(base, 'larger.exr'), SIZE, factor=100)
    outcome.classes = measure.classify(outcome.figures, larger)
    if outcome.complaints and not measure.Figures(ours, larger).complaints(LEAST):
        outcome.notes = ['POV-Ray\'s own tolerances, as its picture of the scene made 100 times larger shows: ' +
                         sentence for sentence in outcome.complaints]
        outcome.complaints = []


def attempt(number, seed, folder, ordinary):
    outcome = Outcome(number)
    try:
        pov, said = export(number, seed, folder, ordinary)
        outcome.name = 'file %d: %s' % (number, said)
        if ordinary:
            against.compare(outcome, pov, os.path.join(folder, str(number)))
        else:
            compare(outcome, pov, folder)
    except (renderers.Failed, picture.Unreadable, OSError, subprocess.TimeoutExpired) as failure:
        outcome.problem = str(failure)
    except Exception:
        outcome.problem = traceback.format_exc()
    return outcome


def tell(outcome, page):
    if outcome.problem:
        tap.ok(False, outcome.name, outcome.problem)
        page.fail(outcome.name, outcome.problem)
        return
    tap.ok(not outcome.complaints, outcome.name, *outcome.complaints)
    if outcome.figures.count:
        kinds = ', '.join('%s %d' % (kind, mask.sum()) for kind, mask in outcome.classes.items())
        tap.note(outcome.figures.text(), kinds)
    tap.note(*outcome.notes)
    page.add(outcome.name, outcome.figures, outcome.classes, outcome.complaints, ' '.join(outcome.notes))


def main():
    ordinary = sys.argv[1:2] == ['ordinary']
    folder = os.path.join(os.environ['ALIDADE_BUILD'], 'tests', 'ordinary' if ordinary else 'breadth')
    os.makedirs(folder, exist_ok=True)
    seed = int(os.environ.get('ALIDADE_BREADTH_SEED', '1'))
    numbers = [int(n) for n in sys.argv[1 + ordinary:]]
    numbers = numbers or range(int(os.environ.get('ALIDADE_BREADTH', '100' if ordinary else '75')))
    page = report.Report()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        for outcome in pool.map(lambda n: attempt(n, seed, folder, ordinary), numbers):
            tell(outcome, page)
    page.write(folder + '.html')
    tap.note('report: %s.html' % folder, '%.0f s of processor time' % sum(os.times()[:4]))
    tap.done()


if __name__ == '__main__':
    main()
