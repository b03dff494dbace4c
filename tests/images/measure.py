# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""How alike two pictures are, and what kind of pixels are not.

Differences are taken after clamping to 0..1 and the sRGB curve. POV-Ray's reference holds half floats,
whose rounding is at most an eighth of 1/255 there. Signed errors are ours minus POV-Ray's.
"""
import numpy

import picture

LEVEL = 1 / 255


class Figures:
    """What is said about a pair of pictures."""

    def __init__(self, ours, theirs):
        if ours.shape != theirs.shape:
            raise picture.Unreadable('sizes differ: %dx%d and %dx%d' % (
                ours.shape[1], ours.shape[0], theirs.shape[1], theirs.shape[0]))
        # POV-Ray's picture may have pixels that are no numbers: these say nothing.
        void = (~numpy.isfinite(theirs)).any(axis=2)
        self.void = int(void.sum())
        if self.void:
            ours, theirs = ours.copy(), theirs.copy()
            ours[void] = theirs[void] = 0
        self.ours, self.theirs = picture.encode(ours), picture.encode(theirs)
        self.error = self.ours - self.theirs
        worst = numpy.abs(self.error).max(axis=2)
        self.missed = worst > LEVEL
        self.nonfinite = int((~numpy.isfinite(ours)).any(axis=2).sum())
        self.missed |= (~numpy.isfinite(ours)).any(axis=2)
        self.within = 100.0 * (1.0 - self.missed.mean())
        self.mean = float(self.error.mean())
        self.rmse = float(numpy.sqrt((self.error ** 2).mean()))
        self.max = float(worst.max())
        self.count = int(self.missed.sum())

    def complaints(self, least, mean=0.0005):
        """What is worse than allowed: at least that percentage within a level, and no bias."""
        found = []
        if self.nonfinite:
            found.append('%d pixels are not finite' % self.nonfinite)
        if self.void > 0.03 * self.missed.size:
            found.append('%d pixels of POV-Ray\'s are not finite' % self.void)
        if self.within < least:
            found.append('%.3f %% of the pixels are within 1/255, %g %% are wanted' % (self.within, least))
        if abs(self.mean) >= mean:
            found.append('mean signed error %+.6f, below %g is wanted' % (self.mean, mean))
        return found

    def text(self):
        void = ', %d of POV-Ray\'s pixels not finite' % self.void if self.void else ''
        return 'within 1/255: %.3f %% (%d not), mean error %+.6f, RMSE %.6f, max %.4f%s' % (
            self.within, self.count, self.mean, self.rmse, self.max, void)


def _neighbours(shown, itself=True):
    """Least and greatest of each pixel's 3 x 3 surroundings, a channel."""
    padded = numpy.pad(shown, ((1, 1), (1, 1), (0, 0)), mode='edge')
    h, w, _ = shown.shape
    around = [padded[y:y + h, x:x + w] for y in range(3) for x in range(3) if itself or (y, x) != (1, 1)]
    return numpy.minimum.reduce(around), numpy.maximum.reduce(around)


CLASSES = {
    'edge': 'edges: within the range of the neighbouring pixels of POV-Ray\'s picture, so a silhouette, '
            'crease or shadow line lies a fraction of a pixel elsewhere',
    'tolerance': 'POV-Ray\'s own tolerance: its rendering of the same scene made 100 times larger, where '
                 'its fixed distances of 1e-3 are as good as nothing, agrees with ours',
    'leak': 'leaks: in POV-Ray\'s picture the pixel stands out from all its neighbours by more than 16/255, in '
            'ours it is one of them; its rays slip through between triangles that share an edge',
    'busy': 'beside an edge or in a mirrored, refracted or finely divided part: neighbours differ by more '
            'than 16/255 but ours is none of them',
    'level': 'two levels: off by at most 2/255',
    'shade': 'shading: a smooth neighbourhood and a different colour',
}


def classify(figures, larger=None):
    """Name -> mask for the missed pixels, each in one class. larger: POV-Ray's picture of the scene
    made 100 times larger, in linear light."""
    least, most = _neighbours(figures.theirs)
    left = figures.missed.copy()
    classes = {}

    def take(name, mask):
        classes[name] = left & mask
        left[classes[name]] = False

    if larger is not None:
        near = numpy.abs(figures.ours - picture.encode(larger)).max(axis=2) <= LEVEL * 1.01
        take('tolerance', near)
    low, high = _neighbours(figures.theirs, False)
    outlier = ((figures.theirs < low - 16 * LEVEL) | (figures.theirs > high + 16 * LEVEL)).any(axis=2)
    take('leak', outlier & ((figures.ours >= low - LEVEL) & (figures.ours <= high + LEVEL)).all(axis=2))
    inside = ((figures.ours >= least - LEVEL) & (figures.ours <= most + LEVEL)).all(axis=2)
    step = (most - least).max(axis=2)
    take('edge', inside & (step > 4 * LEVEL))
    take('level', numpy.abs(figures.error).max(axis=2) <= 2 * LEVEL * 1.01)
    take('busy', step > 16 * LEVEL)
    take('shade', left)
    return {name: mask for name, mask in classes.items() if mask.any()}
