# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Glossy spheres and mirrors that see each other on a mirroring floor."""
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(background=(0.25, 0.32, 0.45))
    red = c.material('Red', (0.7, 0.08, 0.05), specular_shader='BLINN', specular_ior=6.0,
                     specular_intensity=0.5, specular_hardness=120)
    blue = c.material('Blue', (0.06, 0.12, 0.6), specular_shader='PHONG', specular_intensity=0.9,
                      specular_hardness=300, mirror=(0.15, 0.15, 0.15))
    chrome = c.material('Chrome', (0.05, 0.05, 0.05), mirror=(0.9, 0.9, 0.92), diffuse_intensity=0.2)
    gold = c.material('Gold', (0.55, 0.38, 0.08), mirror=(0.8, 0.6, 0.2), diffuse_intensity=0.3,
                      fresnel={'fresnel': 1.0, 'fresnel_factor': 1.0})
    tile = c.material('Tile', (0.3, 0.3, 0.32), mirror=(0.25, 0.25, 0.25), specular_intensity=0.0,
                      fresnel={'fresnel': 2.0, 'fresnel_factor': 1.25})
    for mat, x, y, r in ((chrome, -1.3, 0.3, 1.0), (gold, 1.15, 0.6, 0.9), (red, 0.0, -1.2, 0.55),
                         (blue, 0.25, 2.2, 1.1)):
        c.ball(location=(x, y, r + 0.02), scale=(r, r, r), mat=mat,
                segments=28, rings=14, name=mat.name + 'Ball')
    c.floor(size=14, mat=tile)
    c.camera((0.4, -6.4, 2.9), (0, 0.3, 0.75), lens=40)
    c.lamp('POINT', (3, -5, 6), distance=100)
    c.lamp('SUN', (-5, -4, 6), colour=(0.35, 0.33, 0.3))


c.run('spheres', build)
