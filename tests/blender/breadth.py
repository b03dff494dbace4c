# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Many varied Blender files, each exported by the stock POV-Ray add-on and drawn by both renderers: run by
breadth.sh.

    breadth.py [ordinary] [NUMBER...]

Environment: ALIDADE, ALIDADE_SRC, ALIDADE_BUILD; ALIDADE_BREADTH is how many (75, ordinary 100),
ALIDADE_BREADTH_SEED chooses others (1). The files stay in ALIDADE_BUILD/tests/breadth, the report is
ALIDADE_BUILD/tests/breadth.html.

Ordinary files have what Blender users have beyond plain meshes, and radiosity as the add-on writes it by
default. They are drawn twice: without the radiosity block, pixel by pixel as the plain ones are (but where
something is random, by RMSE, both sides with many samples a pixel), and with it, against POV-Ray's
picture at high quality: RMSE and mean signed error in sRGB. Where POV-Ray has to take a sample of indirect
light after its pretrace, deep in a tree of mirrored and refracted rays, it loses the rest of that pixel's
light: pixels that its picture shows darker than its own picture without any indirect light are
left out, and there may be few of them. Where a mirror's exponent makes no numbers of negative light, POV-Ray's
cache spreads these over its picture: such a file is compared without exponents.

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

import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, 'images'))
import measure
import picture
import renderers
import report
import tap

SIZE = (160, 120)
SMALL = (96, 72) # where POV-Ray needs minutes for a picture without noise, and figures are statistics
LEAST = 99.8
ORDINARY_LEAST = 99.5
RMSE, MEAN = 0.004, 0.001
SOUND = 0.97 # of a picture of POV-Ray's
RADIOSITY = re.compile(r'\bradiosity\s*\{[^{}]*\}')
# What the add-on's coarse cache is an approximation of.
HIGH = {'count': '1600', 'error_bound': '0.1', 'nearest_count': '10', 'pretrace_start': '0.08',
        'minimum_reuse': '0.002'}
# Focal blur is its own anti-aliasing; the add-on's few rays are noise of up to 0.02.
BLUR = {r'blur_samples\s+\d+(\s+\d+)?': 'blur_samples 600 600', r'variance\s+1/\d+': 'variance 1/10000000',
        r'confidence\s+[\d.]+': 'confidence 0.99'}
EXPONENT = re.compile(r'\bexponent\s+[-+.\deE]+')
MOST_VOID = 0.03 # of a picture of POV-Ray's may be no numbers
RANDOM = re.compile(r'\b(?:jitter|aperture|crand)\b')


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


def written(path, text):
    with open(path, 'w', encoding='utf-8') as file:
        file.write(text)
    return path


def alike(figures, rmse, mean):
    """What is worse than allowed of a picture with random numbers in it."""
    found = figures.complaints(0, mean)
    if figures.rmse > rmse:
        found.append('RMSE %.6f, at most %g is wanted' % (figures.rmse, rmse))
    return found


def allowed(theirs):
    """Where POV-Ray's colours are no numbers (a mirror's exponent on negative light), ours may be none."""
    return (0,) if numpy.isfinite(theirs).all() else (0, renderers.NONFINITE)


def converging(text, noisy):
    """The scene for POV-Ray so that nothing random is left to see, and both programs' anti-aliasing."""
    if not re.search(r'\baperture\b', text):
        return text, 'many' if noisy else None
    for words, better in BLUR.items():
        text = re.sub(r'\b' + words, better, text)
    return text, None


def void(theirs, text):
    """Are there so many pixels that are no numbers, as a mirror's exponent makes of negative light?"""
    return (~numpy.isfinite(theirs)).any(axis=2).mean() > MOST_VOID and EXPONENT.search(text)


def direct(outcome, text, base):
    """Without indirect light."""
    text = RADIOSITY.sub('', text, count=1)
    pov = written(os.path.join(base, 'direct.pov'), text)
    noisy = RANDOM.search(text) is not None
    text, aa = converging(text, noisy)
    size = SMALL if noisy else SIZE
    theirs = renderers.povray(written(os.path.join(base, 'many.pov'), text), os.path.join(base, 'direct.exr'),
                              size, aa)
    if void(theirs, text):
        outcome.notes.append('without mirrors\' exponents, which make no numbers of much of POV-Ray\'s picture')
        direct(outcome, EXPONENT.sub('', text), base)
        return
    renderers.alidade(pov, os.path.join(base, 'direct.pfm'), size, aa=aa, threads=1, good=allowed(theirs))
    ours = picture.read(os.path.join(base, 'direct.pfm'))
    outcome.figures = measure.Figures(ours, theirs)
    if noisy:
        outcome.complaints += alike(outcome.figures, RMSE, MEAN)
        return
    outcome.complaints = outcome.figures.complaints(ORDINARY_LEAST)
    if not outcome.complaints:
        return
    larger = renderers.povray(pov, os.path.join(base, 'larger.exr'), SIZE, factor=100)
    outcome.classes = measure.classify(outcome.figures, larger)
    if not measure.Figures(ours, larger).complaints(ORDINARY_LEAST):
        outcome.notes += ['POV-Ray\'s own tolerances, as its picture of the scene made 100 times larger '
                          'shows: ' + sentence for sentence in outcome.complaints]
        outcome.complaints = []


def soundness(text, theirs, base, aa):
    """Pixels that are not darker than without indirect light, which only adds."""
    text = re.sub(r'\bambient_light\s+rgb\s*<[^<>]*>', 'ambient_light rgb 0', RADIOSITY.sub('', text, count=1))
    least = renderers.povray(written(os.path.join(base, 'least.pov'), text),
                             os.path.join(base, 'least.exr'), SMALL, aa)
    theirs = numpy.nan_to_num(theirs, nan=1e9)
    return (picture.encode(theirs) > picture.encode(least) - 2 * measure.LEVEL).all(axis=2)


def indirect(outcome, text, base):
    """With it, by both methods."""
    block = RADIOSITY.search(text).group(0)
    high = block
    for word, value in HIGH.items():
        high = re.sub(r'\b%s\s+[-+.\deE]+' % word, '%s %s' % (word, value), high)
    pov = written(os.path.join(base, 'indirect.pov'), text)
    text, aa = converging(text, RANDOM.search(text.replace(block, '')))
    theirs = renderers.povray(written(os.path.join(base, 'high.pov'), text.replace(block, high)),
                              os.path.join(base, 'high.exr'), SMALL, aa)
    if void(theirs, text):
        outcome.notes.append('without mirrors\' exponents, which make no numbers of much of POV-Ray\'s picture')
        indirect(outcome, EXPONENT.sub('', text), base)
        return
    sound = soundness(text, theirs, base, aa)
    if not sound.all():
        outcome.notes.append('%d pixels of POV-Ray\'s lost light' % (~sound).sum())
    if sound.mean() < SOUND:
        outcome.complaints.append('POV-Ray lost light in %d pixels' % (~sound).sum())
    for method, rmse, mean in (('exact', RMSE, MEAN), ('cache', 1.5 * RMSE, 2 * MEAN)):
        out = os.path.join(base, method + '.pfm')
        renderers.alidade(pov, out, SMALL, aa=aa, threads=1, more=['--indirect=' + method],
                          good=allowed(theirs))
        ours = picture.read(out)
        figures = measure.Figures(numpy.where(sound[:, :, None], ours, 0), numpy.where(sound[:, :, None], theirs, 0))
        outcome.notes.append('%s: %s' % (method, figures.text()))
        outcome.complaints += ['%s: %s' % (method, c) for c in alike(figures, rmse, mean)]


def compare_ordinary(outcome, pov, folder):
    base = os.path.join(folder, str(outcome.number))
    with open(pov, encoding='utf-8') as file:
        text = file.read()
    direct(outcome, text, base)
    if not os.environ.get('ALIDADE_BREADTH_DIRECT'):
        indirect(outcome, text, base)


def attempt(number, seed, folder, ordinary):
    outcome = Outcome(number)
    try:
        pov, said = export(number, seed, folder, ordinary)
        outcome.name = 'file %d: %s' % (number, said)
        (compare_ordinary if ordinary else compare)(outcome, pov, folder)
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
    tap.note('report: %s.html' % folder)
    tap.done()


if __name__ == '__main__':
    main()
