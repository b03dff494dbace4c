# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A finish of POV-Ray (manual 3.4.6.3) while lobes are added to it, and its words."""
import numpy as np

from . import text


class Finish:
    def __init__(self):
        self.diffuse = self.behind = 0.0
        self.emission = np.zeros(3)
        self.low = self.high = 0.0          # Schlick mirror, facing and grazing
        self.metal_weight = 0.0
        self.metal_colour = None
        self.specular, self.size, self.metallic = 0.0, 0.0, False
        self.refracts = 0.0
        self.rough_metal = []
        self.haze = 0.0                     # white that blurred reflections add, on average over directions
        self.hue, self.hues = np.zeros(3), 0.0      # the metals' colour and weight

    def mirror(self, low, high):
        self.low += low
        self.high += high

    def metal(self, weight, colour):
        self.metal_weight += weight
        if colour is not None:
            self.metal_colour = weight * colour if self.metal_colour is None else self.metal_colour + weight * colour

    def shine(self, lobe, weight, metallic=False):
        """Only one highlight: the strongest."""
        peak, size = lobe
        if peak * weight > self.specular:
            self.specular, self.size, self.metallic = peak * weight, size, metallic

    def glass(self, weight):
        self.refracts = weight

    def text(self):
        words = ['ambient 0', 'diffuse %s' % text.number(self.diffuse)
                 + (', %s' % text.number(self.behind) if self.behind else '')]
        if np.any(self.emission):
            words.append('emission rgb %s' % text.vector(self.emission))
        if self.specular > 1e-3:
            words.append('specular %s roughness %s' % (text.number(_short(self.specular)), text.number(_short(self.size)))
                         + (' metallic' if self.metallic else ''))
        words += self._reflection()
        return 'finish { %s }' % ' '.join(words)

    def _reflection(self):
        if self.refracts:
            return ['reflection { 0, %s fresnel on } conserve_energy' % text.number(min(self.refracts, 1.0))]
        low = np.full(3, self.low)
        high = np.full(3, self.high)
        if self.metal_weight:
            if self.metal_colour is None:
                # The pigment's colour, by the keyword; what a coat adds is left to it.
                return ['reflection { %s metallic }' % text.number(_short(self.metal_weight))]
            low = low + self.metal_colour
            high = np.maximum(high, self.metal_colour) if self.high == 0 else low + self.high * (1 - low)
        if high.max() < 5e-3:
            return []
        low, high = _short(low), _short(high)
        if np.allclose(low, high):
            return ['reflection { rgb %s }' % text.vector(low)]
        return ['reflection { rgb %s, rgb %s falloff 5 }' % (text.vector(low), text.vector(high))]


def _short(value):
    """Six digits are more than a mapping by eye deserves."""
    return np.array([float('%.6g' % v) for v in np.ravel(value)]).reshape(np.shape(value)) if np.ndim(value) \
        else float('%.6g' % value)
