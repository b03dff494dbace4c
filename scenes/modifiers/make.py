# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What modifiers make of simple meshes: the add-on writes the evaluated result."""
import math
import os
import sys

import bpy

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(background=(0.22, 0.24, 0.28))
    mats = [c.material('M%d' % i, rgb, specular_shader='PHONG', specular_intensity=0.3)
            for i, rgb in enumerate(((0.6, 0.3, 0.2), (0.3, 0.5, 0.3), (0.3, 0.35, 0.6), (0.6, 0.55, 0.3)))]
    ob = c.shape('cube', size=0.5, location=(-3.2, 0.2, 0.35), rotation=(0, 0, 8), mat=mats[0], name='Row')
    c.modifier(ob, 'ARRAY', count=5, relative_offset_displace=(0.3, 1.25, 0.35))
    ob = c.shape('cube', size=1.1, location=(-1.4, -0.6, 0.7), rotation=(20, 15, 30), mat=mats[1], name='Soft')
    c.modifier(ob, 'BEVEL', width=0.15, segments=3)
    ob = c.shape('cube', size=1.4, location=(0.6, 1.3, 0.9), rotation=(0, 10, 25), mat=mats[2], name='Pebble')
    c.modifier(ob, 'SUBSURF', levels=2, render_levels=2)
    ob = c.shape('grid', x_subdivisions=4, y_subdivisions=4, size=1.3, location=(0.7, -1.2, 0.5),
                 rotation=(15, -20, 0), mat=mats[3], name='Shell')
    for v in ob.data.vertices:
        v.co.z = 0.5 * (v.co.x ** 2 - v.co.y ** 2)
    c.modifier(ob, 'SOLIDIFY', thickness=0.12)
    ob = c.mesh('Spring', [(0.45 + 0.13 * math.cos(a), 0, 0.13 * math.sin(a)) for a in
                           [k * math.pi / 4 for k in range(8)]], [], mat=mats[0], location=(2.6, -0.6, 0.25))
    ob.data.edges.add(8)
    for k in range(8):
        ob.data.edges[k].vertices = (k, (k + 1) % 8)
    c.modifier(ob, 'SCREW', angle=2 * math.pi, screw_offset=0.42, iterations=3, steps=20,
               render_steps=20)
    ob = c.shape('monkey', size=1.1, location=(2.7, 1.7, 0.9), rotation=(0, 0, -20), mat=mats[1], name='Halves')
    c.modifier(ob, 'DECIMATE', ratio=0.5)
    # A Boolean modifier is applied here: with one in place the add-on would write its operand as a
    # part of a POV-Ray difference, or fail on the operand's materials.
    cutter = c.ball(segments=16, rings=8, radius=0.62, location=(-1.1, 2.3, 1.55), mat=mats[2],
                    name='Cutter')
    ob = c.shape('cube', size=1.2, location=(-1.3, 2.2, 0.75), rotation=(0, 0, 12), mat=mats[2],
                 name='Bitten')
    c.modifier(ob, 'BOOLEAN', object=cutter, operation='DIFFERENCE', solver='EXACT')
    c.apply(ob)
    bpy.data.objects.remove(cutter)
    c.floor(size=16, mat=c.material('Floor', (0.42, 0.42, 0.4), specular_intensity=0.0))
    c.camera((0.4, -8.4, 4.2), (0, 0.3, 0.6), lens=42)
    c.lamp('POINT', (4, -5, 6), distance=80)
    c.lamp('SUN', (-5, -3, 6), colour=(0.3, 0.3, 0.36))


c.run('modifiers', build)
