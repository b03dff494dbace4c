# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""An ordinary still life of about 15,000 triangles with the add-on's default radiosity, for ./dev bench indirect.

Smooth things of all sizes on a floor before two walls, a sun, a point lamp and a coloured world. Generated, not
committed.
"""
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c

import bpy


def still_life():
    clay = c.material('Clay', (0.75, 0.33, 0.2), specular_intensity=0.2)
    chalk = c.material('Chalk', (0.85, 0.83, 0.78), specular_intensity=0.05)
    moss = c.material('Moss', (0.25, 0.5, 0.16), specular_intensity=0.1)
    ink = c.material('Ink', (0.12, 0.2, 0.55), specular_intensity=0.5)
    gold = c.material('Gold', (0.8, 0.6, 0.2), specular_intensity=0.4)
    monkey = c.shape('monkey', location=(-0.2, 0.3, 1.05), rotation=(-20, 0, 12), mat=clay, smooth=True, size=2)
    c.modifier(monkey, 'SUBSURF', levels=1, render_levels=1)
    c.apply(monkey)
    c.ball((2.1, -0.6, 0.76), 0.75, 48, 28, 'Large', ink)
    c.ball((-2.2, -0.9, 0.56), 0.55, 40, 24, 'Middle', moss)
    for i, place in enumerate(((0.9, -1.9), (-0.9, -2.2), (3.1, 0.9), (-3.0, 0.7))):
        c.ball((place[0], place[1], 0.31), 0.3, 24, 16, 'Small%d' % i, (gold, chalk, clay, ink)[i])
    c.shape('torus', location=(1.3, 2.0, 0.36), mat=gold, smooth=True, name='Lying', major_segments=48,
            minor_segments=16, major_radius=0.95, minor_radius=0.35)
    c.shape('torus', location=(-2.3, 1.6, 1.2), rotation=(75, 0, 30), mat=chalk, smooth=True, name='Standing',
            major_segments=40, minor_segments=16, major_radius=0.9, minor_radius=0.25)
    c.ball((-3.6, 3.0, 0.71), 0.7, 24, 20, 'Far', gold)
    c.shape('cube', location=(3.2, 2.6, 1.01), rotation=(0, 0, 25), mat=moss, size=2)
    return chalk


def build():
    scene = c.start(size=(640, 480), background=(0.30, 0.42, 0.65))
    scene.pov.radio_enable = True               # as it is unless somebody unticks it
    chalk = still_life()
    sand = c.material('Sand', (0.65, 0.58, 0.46), specular_intensity=0.0)
    c.floor(14, 0, sand)
    c.shape('plane', location=(0, 4.2, 3), rotation=(90, 0, 0), mat=chalk, size=12, name='Wall')
    c.camera((0.6, -8.2, 3.4), (0.1, 0, 0.8), lens=38)
    c.lamp('SUN', (5, -4, 8), energy=1.0, colour=(0.9, 0.85, 0.75))
    c.lamp('POINT', (-3.2, -2.4, 3.6), colour=(0.55, 0.6, 0.7))
    print('radiosity: %s' % bpy.context.scene.pov.radio_enable)


c.run('radiosity', build)
