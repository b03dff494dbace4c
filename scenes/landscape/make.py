# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Hills of exactly 250,000 triangles in one smooth mesh. Large: generated, not committed."""
import math
import os
import random
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(size=(400, 300), background=(0.45, 0.6, 0.85))
    # 500 x 250 quadrilaterals. Heights are sums of sines of fixed frequencies and phases, so that the
    # export does not depend on any noise function's version.
    wide, deep = 500, 250
    rng = random.Random(5)
    waves = []
    for octave in range(9):
        for _ in range(4):
            angle = rng.uniform(0, 2 * math.pi)
            f = 0.16 * 1.72 ** octave
            waves.append((f * math.cos(angle), f * math.sin(angle), rng.uniform(0, 2 * math.pi),
                          0.62 / 1.8 ** octave))
    vertices = []
    for j in range(deep + 1):
        for i in range(wide + 1):
            x, y = 40.0 * (i / wide - 0.5), 40.0 * j / deep
            z = sum(a * math.sin(u * x + v * y + p) for u, v, p, a in waves)
            vertices.append((x, y, z + 0.02 * abs(x) * math.sin(0.3 * y)))
    row = wide + 1
    faces = [(j * row + i, j * row + i + 1, (j + 1) * row + i + 1, (j + 1) * row + i)
             for j in range(deep) for i in range(wide)]
    grass = c.material('Grass', (0.28, 0.36, 0.14), specular_intensity=0.05)
    c.mesh('Hills', vertices, faces, mat=grass, smooth=True)
    c.camera((0, -6, 6.5), (0, 14, -0.5), lens=30)
    c.lamp('SUN', (10, 2, 7), colour=(0.95, 0.85, 0.7))
    c.lamp('SUN', (-6, -3, 8), colour=(0.15, 0.18, 0.25), shadowless=True)


c.run('landscape', build)
