# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Solid glass, a hollow bubble, stained panes and a filter, with their shadows."""
import os
import sys

import bpy

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(background=(0.35, 0.42, 0.55))
    # Five, the add-on's default, ends black behind two bodies of glass.
    bpy.context.scene.pov.max_trace_level = 6
    clear = c.material('Clear', (0.95, 0.97, 1.0), alpha=0.05, filter=0.3, ior=1.5,
                       mirror=(0.1, 0.1, 0.1), diffuse_intensity=0.1)
    water = c.material('Water', (0.5, 0.75, 0.9), alpha=0.1, filter=0.8, ior=1.33, diffuse_intensity=0.2,
                       interior_fade_color=(0.4, 0.6, 0.9))
    water.pov_raytrace_transparency.depth_max = 98.0
    fresnel = c.material('Fresnel', (0.9, 0.95, 0.9), alpha=0.0, filter=1.0, ior=1.52,
                         mirror=(1, 1, 1), mirror_use_IOR=True, conserve_energy=True,
                         diffuse_intensity=0.05)
    stained = c.material('Stained', (0.9, 0.15, 0.05), alpha=0.25, filter=0.9, ior=1.0,
                         diffuse_intensity=0.3)
    veil = c.material('Veil', (0.2, 0.6, 0.25), alpha=0.4, diffuse_intensity=0.7)
    c.ball(location=(-1.6, -0.3, 0.93), scale=(0.9, 0.9, 0.9), mat=clear,
            segments=24, rings=14, name='Ball')
    c.shape('cube', size=1.3, location=(0.35, 0.1, 0.75), rotation=(0, 0, 28), mat=water, name='Block')
    c.shape('cone', vertices=5, radius1=0.8, radius2=0.0, depth=1.7, location=(2.05, -0.4, 0.88),
            rotation=(0, 0, 11), mat=fresnel, name='Prism')
    c.shape('plane', size=1.6, location=(-0.7, 1.7, 1.0), rotation=(80, 0, 14), mat=stained, name='Pane')
    c.shape('plane', size=1.8, location=(1.2, 1.9, 1.1), rotation=(97, 5, -17), mat=veil, name='Veil')
    stripes = [c.material('Stripe%d' % i, rgb, specular_intensity=0.0)
               for i, rgb in enumerate(((0.8, 0.8, 0.78), (0.25, 0.1, 0.08)))]
    for i in range(12):
        c.shape('plane', size=1.0, location=(i - 5.5, 0.6, 0.0), scale=(1, 11, 1), mat=stripes[i % 2],
                name='Board%02d' % i)
    c.camera((0.2, -6.0, 2.3), (0.1, 0.3, 0.75), lens=40)
    c.lamp('POINT', (-3, -4, 7), distance=120)
    c.lamp('SPOT', (4, 3, 6), (0, 0, 0), colour=(0.7, 0.6, 0.5), distance=80, spot_size=1.2)


c.run('glass', build)
