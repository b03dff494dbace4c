# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""An orthographic camera over a small town of blocks, columns and a dome."""
import os
import random
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(size=(320, 200), background=(0.5, 0.55, 0.6), text='lines')
    rng = random.Random(3)
    walls = [c.material('Wall%d' % i, rgb, specular_intensity=0.0)
             for i, rgb in enumerate(((0.7, 0.62, 0.5), (0.6, 0.4, 0.3), (0.5, 0.5, 0.52)))]
    roof = c.material('Roof', (0.55, 0.15, 0.1), specular_intensity=0.1)
    for i in range(7):
        for j in range(5):
            if (i, j) in ((3, 2), (5, 1)):
                continue
            high = rng.uniform(0.5, 1.9)
            c.shape('cube', size=1.0, location=(1.5 * (i - 3), 1.5 * (j - 2), high / 2 + 0.01),
                    rotation=(0, 0, rng.uniform(-9, 9)), scale=(1, rng.uniform(0.6, 1), high),
                    mat=walls[(i + j) % 3], name='House%d%d' % (i, j))
            c.shape('cone', vertices=4, radius1=0.82, depth=0.5, rotation=(0, 0, 45),
                    location=(1.5 * (i - 3), 1.5 * (j - 2), high + 0.28), mat=roof,
                    name='Roof%d%d' % (i, j))
    c.ball(segments=24, rings=16, radius=0.8, location=(0, 0, 0.85), smooth=True,
            mat=c.material('Dome', (0.3, 0.5, 0.45), mirror=(0.2, 0.2, 0.2)), name='Dome')
    for k in range(3):
        c.shape('cylinder', vertices=12, radius=0.16, depth=2.4, location=(2.6 + 0.4 * k, -1.5, 1.22),
                mat=walls[2], name='Column%d' % k)
    c.floor(size=40, mat=c.material('Ground', (0.45, 0.5, 0.35), specular_intensity=0.0))
    c.camera((9, -11, 9), (0, 0, 0.4), ortho=12.0)
    c.lamp('SUN', (-3, -6, 7), colour=(0.9, 0.85, 0.75))
    c.lamp('SUN', (6, -2, 4), colour=(0.15, 0.18, 0.25), shadowless=True)


c.run('ortho', build)
