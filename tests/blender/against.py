# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""An ordinary scene of Blender's against POV-Ray's pictures of it: used by breadth.py and gallery.py.

A scene is drawn three times.
(a) Without its radiosity block, all else as it is. Where nothing is random 99.5 % of the pixels have to be
    within 1/255; where a lamp jitters or a lens blurs, both programs take many samples a pixel, and RMSE and mean
    signed error are judged. What is missed with 16 samples gets 576: file 59 is 0.0055 off with 64, as are two of
    our own pictures of other seeds from one another; without jitter 99.9 % of its pixels are within 1/255. Of lenses
    the second try is the mean of four pictures of ours: in files 9 and 80 two of them differ by 0.0050 and 0.0061;
    and POV-Ray takes 2400 rays a pixel instead of 600, of which file 43's picture is 0.0044 from ours.
(b) With radiosity, and without what makes noise or multiplies rays in both programs and which (a) has judged:
    focal blur, jitter, grain, anti-aliasing. POV-Ray works at high quality: RMSE and mean signed error again, for
    both methods.
(c) As it is: there has to be a picture, of numbers.

How good POV-Ray's picture of (b) is. The issue of it is high quality: count 1600, error_bound 0.1, nearest_count 10, or
what converges. LEVELS has what is tried in turn until both methods have passed; their bounds are always the same.
First a small picture of count 250. Where light bounces once, as in the add-on's files, pictures of count 400 were
0.0003 to 0.0007 (RMSE) from those of 1600 in five files; that 250 is nearer than 0.001 is measured in one file in
twenty in each run. Then one of the add-on's scene made 100 times larger, where POV-Ray's fixed distances, which at an
edge can put one pixel of another thing into the picture, are as good as nothing. Then the mean of two larger pictures,
whose difference tells its noise, which is said and part of what is judged: in larger pictures a pixel at an edge
counts for less and the cache's places lie closer. And they have error_bound 0.03: at 0.1 POV-Ray evens out the dark
below things (gallery's focus: RMSE 0.0045 from ours, 0.0024 with 0.03). At last counts of 6400 out of ten times as
many directions, as lights need that are small things which glow (gallery's colours, one bounce, 64x48: RMSE from ours
0.015, 0.007 and 0.005 with counts of 250, 1600 and 6400 and error_bound 0.1, and with 6400 and 0.03 it is 0.0023).

How good ours is. A picture is the mean of two with other seeds, whose difference tells its noise; they take more rays
until that is below half the bound.

POV-Ray 3.7 forgets, after it has gathered light at a point, that the rays to come are no longer gathering ones: as
the last of those it asks for objects of full importance, and all with less, which is what the add-on gives to each,
are black in the rest of that pixel's tree of mirrored and refracted rays. Importance only saves rays, so POV-Ray gets
the scene without. Ours has it. Where a mirror's exponent makes no numbers of negative light, POV-Ray's cache spreads
these over its picture: such a file is compared without exponents. And POV-Ray's rays go on without end between
surfaces of ior 1, which it does not count: where it takes minutes for a picture of a second, both programs get an ior
of 1.000001, as which such surfaces count. Where a picture takes POV-Ray too long all the same, as of
glass, it is a quarter as large; and where that does too, as of hair, both draw one bounce.
"""
import os
import re

import numpy

import measure
import picture
import renderers

SIZE = (160, 120)
SMALL = (96, 72) # where POV-Ray needs minutes for a picture without noise, and figures are statistics
TINY = (64, 48)
TINIEST = (32, 24) # where POV-Ray needs even more
LEAST = 99.5
RMSE, MEAN = 0.004, 0.001
METHODS = (('exact', RMSE, MEAN), ('cache', 1.5 * RMSE, 2 * MEAN))
RADIOSITY = re.compile(r'\bradiosity\s*\{[^{}]*\}')
# What the add-on's coarse cache is an approximation of.
HIGH = {'error_bound': '0.1', 'nearest_count': '10', 'pretrace_start': '0.08', 'minimum_reuse': '0.002'}
FINER = dict(HIGH, error_bound='0.03', minimum_reuse='0.0005')
# Size, counts of the pictures, other settings, how many times larger the scene is for POV-Ray.
LEVELS = ((TINY, (250,), HIGH, 1), (TINY, (250,), HIGH, 100), (SMALL, (250, 258), FINER, 1),
          (SIZE, (250, 258), FINER, 1), (SMALL, ('6400, 64000', '6401, 65536'), FINER, 1))
TINIEST_LEVELS = ((TINIEST, (250,), HIGH, 1), (TINIEST, (250, 258), FINER, 1))
ADDON = re.compile(r'\bcamLookAt\b') # enlarge.py knows its files
CONVERGED = 0.001
EVERY = 20
RAYS, MOST_RAYS = 256, 16384 # a picture, of two
# Focal blur is its own anti-aliasing; the add-on's few rays are noise of up to 0.02.
BLURRED = 'blur_samples 600 600'
BLUR = {r'blur_samples\s+\d+(\s+\d+)?': BLURRED, r'variance\s+1/\d+': 'variance 1/10000000',
        r'confidence\s+[\d.]+': 'confidence 0.99'}
NUMBER = r'[-+.\deE]+'
LENS = re.compile(r'\b(?:aperture\s+%s|blur_samples\s+\d+(?:\s+\d+)?|variance\s+1/\d+|confidence\s+%s|'
                  r'focal_point\s*<[^<>]*>)' % (NUMBER, NUMBER))
GRAIN = re.compile(r'\bcrand\s+%s' % NUMBER)
JITTER = re.compile(r'\bjitter\b')
IMPORTANCE = re.compile(r'\bradiosity\s*\{\s*importance\s+%s\s*\}' % NUMBER)
EXPONENT = re.compile(r'\bexponent\s+%s' % NUMBER)
IOR_ONE = re.compile(r'\bior\s+1(?:\.0*)?(?![.\d])')
PATIENCE = 300 # s
BOUNCES = re.compile(r'\brecursion_limit\s+(\d+)')
MOST_VOID = 0.03 # of a picture of POV-Ray's may be no numbers
RANDOM = re.compile(r'\b(?:jitter|aperture|crand)\b')
SLOW = 'one bounce only, as POV-Ray takes too long for more'
ENDLESS = 'with ior 1.000001 for 1, where POV-Ray\'s rays have no end'
EXPONENTS = 'without mirrors\' exponents, which make no numbers of much of POV-Ray\'s picture'


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


def deviation(one, other):
    """Of the mean of two pictures, of numbers."""
    difference = numpy.nan_to_num(picture.encode(one) - picture.encode(other))
    return 0.5 * float(numpy.sqrt((difference ** 2).mean()))


def allowed(theirs):
    """Where POV-Ray's colours are no numbers (a mirror's exponent on negative light), ours may be none."""
    return (0,) if numpy.isfinite(theirs).all() else (0, renderers.NONFINITE)


def void(theirs, text):
    """Are there so many pixels that are no numbers, as a mirror's exponent makes of negative light?"""
    return (~numpy.isfinite(theirs)).any(axis=2).mean() > MOST_VOID and EXPONENT.search(text)


def converging(text, noisy):
    """The scene for POV-Ray so that nothing random is left to see, and both programs' anti-aliasing."""
    if not re.search(r'\baperture\b', text):
        return text, 'many' if noisy else None
    for words, better in BLUR.items():
        text = re.sub(r'\b' + words, better, text)
    return text, None


def shrunk(light, times):
    """A picture so many times smaller."""
    height, width, _ = light.shape
    return light.reshape(height // times, times, width // times, times, 3).mean(axis=(1, 3))


def plain(outcome, pov, ours, base):
    """(a) where nothing is random: the figures, and if they are bad what POV-Ray makes of a larger scene."""
    outcome.complaints = outcome.figures.complaints(LEAST)
    if not outcome.complaints:
        return
    larger = renderers.povray(pov, os.path.join(base, 'larger.exr'), SIZE, factor=100)
    outcome.classes = measure.classify(outcome.figures, larger)
    if not measure.Figures(ours, larger).complaints(LEAST):
        outcome.notes += ['POV-Ray\'s own tolerances, as its picture of the scene made 100 times larger '
                          'shows: ' + sentence for sentence in outcome.complaints]
        outcome.complaints = []


def seen(pov, out, size, aa, good, seed):
    """Ours, with one set of random numbers."""
    renderers.alidade(pov, out, size, aa=aa, threads=1, good=good, more=['--seed=%d' % seed])
    return picture.read(out)


def direct(outcome, text, base):
    """(a)"""
    text = RADIOSITY.sub('', text, count=1)
    pov = written(os.path.join(base, 'direct.pov'), text)
    noisy = RANDOM.search(text) is not None
    better, aa = converging(text, noisy)
    for aa, times, seeds in ((aa, 1, 1), ('most', 3, 1) if aa else (aa, 1, 4)) if noisy else ((aa, 1, 1),):
        rays = 'blur_samples %d %d' % (600 * seeds, 600 * seeds)
        many = written(os.path.join(base, 'many.pov'), better.replace(BLURRED, rays))
        size = tuple(n * times for n in (SMALL if noisy else SIZE))
        theirs = renderers.povray(many, os.path.join(base, 'direct.exr'), size, aa, limit=1800 if noisy else PATIENCE)
        if void(theirs, text):
            outcome.notes.append(EXPONENTS)
            direct(outcome, EXPONENT.sub('', text), base)
            return
        ours = sum(seen(pov, os.path.join(base, 'direct.pfm'), size, aa, allowed(theirs), seed)
                   for seed in range(seeds)) / seeds
        ours = shrunk(ours, times)
        outcome.figures = measure.Figures(ours, shrunk(theirs, times))
        if not noisy:
            plain(outcome, pov, ours, base)
            return
        found = alike(outcome.figures, RMSE, MEAN)
        if not found:
            return
        outcome.notes += ['missed with fewer samples: ' + c for c in found if times == seeds]
    outcome.complaints += found


def quiet(text):
    """Without what makes noise or multiplies rays."""
    return JITTER.sub('', GRAIN.sub('', LENS.sub('', text)))


def high(text, count, settings):
    """The scene with a radiosity block of high quality, and no object that importance makes black."""
    text = IMPORTANCE.sub('', text)
    block = RADIOSITY.search(text).group(0)
    better = block
    for word, value in dict(settings, count=count).items():
        better = re.sub(r'\b%s\s+%s' % (word, NUMBER), '%s %s' % (word, value), better)
    return text.replace(block, better)


def once(text):
    return BOUNCES.search(text).group(1) == '1'


def best(text, base, size, count, settings, factor=1):
    return renderers.povray(written(os.path.join(base, 'high.pov'), high(text, count, settings)),
                            os.path.join(base, 'high-%s-%d-%d.exr' % (
                                str(count).replace(', ', '-'), size[0], factor)), size,
                            factor=factor, limit=PATIENCE if IOR_ONE.search(text) or not once(text) else 1800)


class Ours:
    """Our pictures of a scene, of each size and method made once."""

    def __init__(self, pov, base, good):
        self.pov, self.base, self.good, self.known = pov, base, good, {}

    def draw(self, method, size, rays, seed):
        out = os.path.join(self.base, '%s-%d.pfm' % (method, seed))
        renderers.alidade(self.pov, out, size, threads=1, good=self.good, more=[
            '--indirect=' + method, '--indirect-samples=%d' % rays, '--seed=%d' % seed])
        return picture.read(out)

    def get(self, method, rmse, size):
        """The picture, and how many rays and how much noise along the sRGB curve it has."""
        rays = RAYS
        while (method, size) not in self.known:
            one, other = (self.draw(method, size, rays, seed) for seed in (1, 2))
            noise = deviation(one, other)
            if noise <= 0.5 * rmse or rays >= MOST_RAYS:
                self.known[method, size] = 0.5 * (one + other), '%d rays, noise %.6f' % (2 * rays, noise)
            rays *= 4
        return self.known[method, size]


def converged(text, base, theirs):
    """Is the picture of the least count near that of high quality?"""
    size, (count,), settings, _ = LEVELS[0]
    figures = measure.Figures(theirs, best(text, base, size, 1600, settings))
    said = 'POV-Ray\'s picture of count %s from its own of count 1600: %s' % (count, figures.text())
    return [said] if figures.rmse > CONVERGED else [], [said]


def indirect(outcome, text, base, check=False, levels=LEVELS):
    """(b), without what has no end in POV-Ray, smaller and with less bounces of light if these take it too long."""
    text = quiet(text)
    try:
        bounced(outcome, text, base, check, levels)
    except renderers.TooLong:
        if IOR_ONE.search(text):
            outcome.notes.append(ENDLESS)
            text = IOR_ONE.sub('ior 1.000001', text)
        elif levels is LEVELS:
            levels = TINIEST_LEVELS
        elif not once(text):
            outcome.notes.append(SLOW)
            text, levels = BOUNCES.sub('recursion_limit 1', text), LEVELS
        else:
            raise
        indirect(outcome, text, base, check, levels)


def bounced(outcome, text, base, check, levels):
    """(b)"""
    ours, left = None, METHODS
    for size, counts, settings, factor in levels:
        if factor != 1 and not ADDON.search(text):
            continue
        pictures = [best(text, base, size, count, settings, factor) for count in counts]
        theirs, noise = sum(pictures) / len(pictures), deviation(*pictures) if len(pictures) == 2 else 0.0
        if void(theirs, text):
            outcome.notes.append(EXPONENTS)
            bounced(outcome, EXPONENT.sub('', text), base, check, levels)
            return
        ours = ours or Ours(written(os.path.join(base, 'indirect.pov'), text), base, allowed(theirs))
        if check:
            more, said = converged(text, base, theirs)
            outcome.complaints += more
            outcome.notes += said
            check = False
        outcome.notes.append('POV-Ray: %dx%d, count %s%s%s' % (size + (
            ' and '.join(map(str, counts)), ', noise %.6f' % noise if noise else '',
            ', the scene made %d times larger' % factor if factor != 1 else '')))
        complaints, missed = [], []
        for method, rmse, mean in left:
            made, about = ours.get(method, rmse, size)
            figures = measure.Figures(made, theirs)
            found = ['%s: %s' % (method, c) for c in alike(figures, rmse, mean)]
            outcome.notes.append('%s: %s, %s' % (method, figures.text(), about))
            complaints += found
            missed += [(method, rmse, mean)] * bool(found)
        if not missed:
            return
        outcome.notes += ['missed: ' + c for c in complaints]
        left = missed
    outcome.complaints += complaints


def as_it_is(pov, text, base):
    """(c)"""
    renderers.alidade(pov, os.path.join(base, 'as-it-is.pfm'), (48, 36), aa='pov2', threads=1,
                      good=(0, renderers.NONFINITE) if EXPONENT.search(text) else (0,))


def read(path):
    with open(path, encoding='utf-8') as file:
        return file.read()


def compare(outcome, pov, base, hard=None):
    """All three; hard: what to take for (b), of a scene whose lamps are no end of work."""
    text, lit = read(pov), read(hard or pov)
    try:
        direct(outcome, text, base)
    except renderers.TooLong:
        if not IOR_ONE.search(text):
            raise
        outcome.notes.append(ENDLESS)
        lit = IOR_ONE.sub('ior 1.000001', lit)
        direct(outcome, IOR_ONE.sub('ior 1.000001', text), base)
    if not os.environ.get('ALIDADE_BREADTH_DIRECT'):
        indirect(outcome, lit, base, outcome.number % EVERY == 0)
        as_it_is(pov, text, base)
