# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every kind of lamp the add-on writes: points of each falloff, spots, suns, areas."""
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(background=(0.01, 0.01, 0.02), text='indented')
    white = c.material('White', (0.8, 0.8, 0.8), diffuse_shader='LAMBERT', specular_shader='BLINN',
                       specular_intensity=0.3)
    c.floor(size=16, mat=white)
    c.shape('plane', size=16, location=(0, 5, 0), rotation=(90, 0, 0), mat=white, name='Wall')
    for i in range(5):
        x = 2.2 * (i - 2)
        c.shape('cylinder', vertices=24, radius=0.35, depth=1.1, location=(x, 0.2, 0.57), mat=white,
                smooth=False, name='Post%d' % i)
        c.ball(segments=20, rings=10, radius=0.45, location=(x, 0.2, 1.65),
                mat=white, smooth=True, name='Ball%d' % i)
    c.lamp('POINT', (-5.2, -1.5, 2.6), colour=(1, 0.25, 0.2), name='Square', distance=3,
           falloff_type='INVERSE_SQUARE')
    c.lamp('POINT', (-3.0, -2.0, 2.9), colour=(0.5, 0.45, 0.1), name='Linear', distance=6,
           falloff_type='INVERSE_LINEAR')
    c.lamp('POINT', (-4.2, 3.0, 3.4), colour=(0.3, 0.5, 0.2), name='Constant', distance=8,
           falloff_type='CONSTANT')
    c.lamp('POINT', (0.2, 2.8, 4.6), colour=(0.08, 0.08, 0.1), name='NoShadow', distance=9,
           falloff_type='CUSTOM_CURVE', shadowless=True)
    c.lamp('SPOT', (-0.6, -3.0, 4.0), (0, 0.2, 1.0), colour=(0.2, 1, 0.4), name='SoftSpot',
           distance=30, spot_size=0.65, spot_blend=0.7)
    c.lamp('SPOT', (1.2, -2.0, 5.0), (2.0, 0.4, 0), colour=(0.2, 0.5, 1), name='HardSpot',
           distance=30, spot_size=0.5, spot_blend=0.0)
    c.lamp('SUN', (6, -6, 8), (0, 0, 0), colour=(0.16, 0.14, 0.12))
    c.lamp('AREA', (4.6, -2.2, 3.4), (4.2, 0.2, 0.8), colour=(0.9, 0.4, 0.9), name='Square5', size=1.2,
           distance=7, shape='SQUARE', samples=(5, 5))
    c.lamp('AREA', (3.0, 3.2, 3.6), (3.4, 0, 0), colour=(0.3, 0.6, 0.6), name='Oblong', size=2.0,
           size_y=0.5, distance=9, shape='RECTANGLE', samples=(6, 2))
    c.camera((0, -10.5, 3.6), (0, 0, 1.2), lens=32)


c.run('lamps', build)
