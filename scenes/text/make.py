# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Letters: a font's curves, filled, extruded and bevelled, which the add-on meshes."""
import os
import sys

import bpy

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(size=(320, 180), background=(0.08, 0.1, 0.14))
    ink = c.material('Ink', (0.85, 0.55, 0.15), specular_shader='PHONG', specular_intensity=0.5)
    side = c.material('Small', (0.25, 0.45, 0.7), specular_intensity=0.2)
    for name, words, mat, where in (('Title', 'alidade', ink, (-2.0, 0, 0.03)),
                                    ('Below', 'sight along a line', side, (-2.0, -1.0, 0.03))):
        data = bpy.data.curves.new(name, 'FONT')
        data.body = words
        data.extrude = 0.12 if name == 'Title' else 0.03
        data.bevel_depth = 0.02 if name == 'Title' else 0.0
        data.bevel_resolution = 1
        data.resolution_u = 3
        data.size = 1.3 if name == 'Title' else 0.52
        data.materials.append(mat)
        c.add(name, data, location=where, rotation=(35 if name == 'Title' else 20, 0, 0))
    c.floor(size=20, z=-0.7, mat=c.material('Desk', (0.3, 0.27, 0.25), mirror=(0.15, 0.15, 0.15)))
    c.camera((0.6, -5.2, 3.0), (0.0, -0.2, 0.15), lens=45)
    c.lamp('POINT', (-3, -4, 5), distance=70)
    c.lamp('AREA', (3, 1, 4), (0, 0, 0), colour=(0.6, 0.55, 0.5), size=1.0, distance=20,
           shape='SQUARE', samples=(3, 3))


c.run('text', build)
