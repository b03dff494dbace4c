# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Mirrored, sheared and nested: parents with uneven and negative scales."""
import math
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def place(ob, location, rotation, scale, parent=None):
    ob.location = location
    ob.rotation_euler = [math.radians(a) for a in rotation]
    ob.scale = scale
    ob.parent = parent


def build():
    c.start(background=(0.2, 0.25, 0.3))
    mats = [c.material('M%d' % i, rgb, specular_shader='PHONG', specular_intensity=0.4)
            for i, rgb in enumerate(((0.6, 0.25, 0.2), (0.25, 0.55, 0.3), (0.25, 0.3, 0.65)))]
    # A parent's uneven scale shears its turned children; a negative one turns normals inside out.
    hub = c.shape('cube', size=0.5, mat=mats[0], name='Hub')
    arm = c.shape('monkey', size=0.9, mat=mats[1], smooth=True, name='Arm')
    tip = c.shape('cone', vertices=7, radius1=0.25, depth=0.6, mat=mats[2], name='Tip')
    for i, scale in enumerate(((1, 1, 1), (-1, 1, 1), (1.4, 0.6, -0.9), (-0.8, -1.2, -1))):
        if i > 0:
            hub, arm, tip = (c.add('%s%d' % (ob.name[:3], i), ob.data) for ob in (hub, arm, tip))
        place(hub, (2.3 * (i - 1.5), 0.3, 1.55 + 0.25 * (i > 1)), (10 * i, 15, 20 * i), scale)
        place(arm, (0.1, -0.5, 0.55), (20, 0, 30), (1, 0.8, 1), hub)
        place(tip, (0.55, 0, 0.45), (0, 60, 15), (1, -1.4, 0.7), arm)
    c.ball(segments=20, rings=10, location=(0, 2.6, 1.2), scale=(-3.0, 0.2, 0.9),
            rotation=(0, 12, 8), mat=mats[2], smooth=True, name='Disc')
    c.floor(size=16, mat=c.material('Floor', (0.45, 0.45, 0.45), specular_intensity=0.0))
    c.camera((0.4, -7.6, 3.4), (0, 0, 1.2), lens=36)
    c.lamp('POINT', (4, -5, 6), distance=80)
    c.lamp('SPOT', (-5, -3, 6), (0, 0, 1), colour=(0.4, 0.4, 0.5), distance=60, spot_size=1.0)


c.run('transforms', build)
