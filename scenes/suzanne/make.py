# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's monkey in three materials, one of them a mirror, with her brother in flat shading."""
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(background=(0.12, 0.14, 0.18), ambient=(0.05, 0.05, 0.06))
    fur = c.material('Fur', (0.45, 0.22, 0.10), specular_shader='PHONG', specular_intensity=0.15,
                     diffuse_shader='OREN_NAYAR', roughness=0.6)
    eye = c.material('Eye', (0.02, 0.02, 0.03), mirror=(0.6, 0.6, 0.65), specular_intensity=0.8,
                     specular_hardness=200)
    ear = c.material('Ear', (0.75, 0.35, 0.30), diffuse_shader='LAMBERT', specular_intensity=0.0)
    suzanne = c.shape('monkey', location=(-0.6, 0, 1.1), rotation=(-12, 0, 18), mat=fur, smooth=True)
    suzanne.data.materials.append(eye)
    suzanne.data.materials.append(ear)
    for polygon in suzanne.data.polygons:
        x, y, z = polygon.center
        if abs(x) > 0.85:
            polygon.material_index = 2
        elif y < -0.55 and 0.15 < z < 0.45 and 0.1 < abs(x) < 0.5:
            polygon.material_index = 1
    c.shape('monkey', location=(1.5, 1.3, 0.75), rotation=(0, 0, -35), scale=(0.7, 0.7, 0.7), mat=ear,
            name='Brother')
    c.floor(mat=c.material('Floor', (0.35, 0.38, 0.40), specular_intensity=0.0))
    c.camera((0.9, -6.2, 2.6), (0.2, 0, 0.9), lens=42)
    c.lamp('POINT', (3.5, -4, 5), distance=60)
    c.lamp('POINT', (-4, -2, 3), colour=(0.3, 0.35, 0.5), distance=40)


c.run('suzanne', build)
