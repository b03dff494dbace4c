# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A few hundred objects that share five meshes: the add-on writes each mesh once."""
import os
import random
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(background=(0.3, 0.4, 0.55))
    rng = random.Random(7)
    kinds = [c.shape('cube', size=0.5, mat=c.material('A', (0.6, 0.2, 0.15))),
             c.shape('ico_sphere', subdivisions=2, radius=0.3, smooth=True,
                     mat=c.material('B', (0.15, 0.5, 0.25), specular_intensity=0.6)),
             c.shape('torus', major_segments=18, minor_segments=8, major_radius=0.28, minor_radius=0.1,
                     smooth=True, mat=c.material('C', (0.8, 0.65, 0.2))),
             c.shape('cone', vertices=9, radius1=0.28, depth=0.7, mat=c.material('D', (0.2, 0.25, 0.6))),
             c.shape('monkey', size=0.5, mat=c.material('E', (0.5, 0.3, 0.45)))]
    for ob in kinds:
        ob.location = (0, 0, -50)                     # the originals wait out of sight
    for i in range(280):
        source = kinds[i % len(kinds)]
        turn = [rng.uniform(0, 360) for _ in range(3)]
        size = rng.uniform(0.6, 1.25)
        c.add('Copy%03d' % i, source.data, scale=[size * rng.uniform(0.7, 1.3) for _ in range(3)],
              location=(1.15 * (i % 20 - 9.5), 1.2 * (i // 20 - 4), 0.55 + rng.uniform(0, 0.5)),
              rotation=turn)
    c.floor(size=60, mat=c.material('Ground', (0.4, 0.42, 0.38), specular_intensity=0.0))
    c.camera((5.5, -11.5, 7.0), (0, 0.5, 0), lens=36)
    c.lamp('SUN', (4, -6, 9), colour=(0.85, 0.8, 0.75))
    c.lamp('POINT', (-7, -6, 6), colour=(0.3, 0.35, 0.5), distance=150)


c.run('instances', build)
