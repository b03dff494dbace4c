# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours painted on the corners of meshes, blended across each triangle."""
import math
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def by_height(co, loop):
    return (0.5 + 0.5 * co.z, 0.15, 0.5 - 0.5 * co.z, 1)


def by_corner(co, loop):
    return (co.x > 0, co.y > 0, co.z > 0, 1)


def by_place(co, loop):
    return ((0.5 + 0.5 * math.sin(3 * co.x)), 0.4, (0.5 + 0.5 * math.cos(2 * co.y)), 1)


def build():
    c.start(background=(0.2, 0.2, 0.22))
    mat = c.material('Paint', (1, 1, 1), specular_intensity=0.0)
    ball = c.ball(segments=16, rings=10, location=(-1.2, 0, 1.05), mat=mat, smooth=True)
    cube = c.shape('cube', size=1.5, location=(1.2, -0.2, 0.85), rotation=(0, 0, 33), mat=mat)
    sheet = c.shape('grid', x_subdivisions=9, y_subdivisions=9, size=9, mat=mat, name='Sheet')
    for ob, colour in ((ball, by_height), (cube, by_corner), (sheet, by_place)):
        layer = ob.data.vertex_colors.new(name='Col')
        for loop in ob.data.loops:
            layer.data[loop.index].color = colour(ob.data.vertices[loop.vertex_index].co, loop.index)
    c.camera((0.6, -6.0, 3.4), (0, 0, 0.6), lens=42)
    c.lamp('POINT', (2.5, -4, 5), distance=90)
    c.lamp('SUN', (-4, -2, 5), colour=(0.3, 0.3, 0.35))


c.run('vertexcolours', build)
