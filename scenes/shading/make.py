# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The same bodies smooth, flat and both at once, lit so that terminators show."""
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(background=(0.1, 0.1, 0.12))
    clay = c.material('Clay', (0.55, 0.5, 0.42), specular_shader='PHONG', specular_intensity=0.35,
                      specular_hardness=60)
    for row, kind in enumerate(('smooth', 'flat', 'mixed')):
        y = 2.4 * (row - 1)
        balls = (c.ball(segments=14, rings=8, location=(-2.6, y, 1.1), mat=clay),
                 c.shape('ico_sphere', subdivisions=2, location=(-0.2, y, 1.1), mat=clay),
                 c.shape('torus', major_segments=20, minor_segments=8, major_radius=0.75,
                         minor_radius=0.3, location=(2.2, y, 1.0), rotation=(35, 20, 0), mat=clay))
        for ob in balls:
            ob.name = ob.data.name = '%s%s' % (kind.title(), ob.name.split('.')[0])
            for polygon in ob.data.polygons:
                polygon.use_smooth = kind == 'smooth' or (kind == 'mixed' and polygon.index % 3 > 0)
    c.floor(size=14, mat=clay)
    c.camera((0.3, -9.0, 5.4), (0, 0, 0.5), lens=42)
    c.lamp('SUN', (6, -3, 3), colour=(0.8, 0.75, 0.7))
    c.lamp('POINT', (-5, -4, 4), colour=(0.4, 0.45, 0.6), distance=50)


c.run('shading', build)
