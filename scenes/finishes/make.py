# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A shelf of every finish the add-on's shader settings lead to."""
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(background=(0.3, 0.35, 0.4), ambient=(0.1, 0.1, 0.12))
    coloured = {'specular_color': (1.0, 0.6, 0.1), 'specular_intensity': 0.7}
    finishes = [
        c.material('Lambert', (0.6, 0.2, 0.2), diffuse_shader='LAMBERT', specular_intensity=0.0),
        c.material('OrenNayar', (0.6, 0.4, 0.2), diffuse_shader='OREN_NAYAR', roughness=1.0),
        c.material('Phong', (0.2, 0.5, 0.2), specular_shader='PHONG', specular_intensity=0.8,
                   specular_hardness=90),
        c.material('Blinn', (0.2, 0.3, 0.6), specular_shader='BLINN', specular_ior=8.0,
                   specular_intensity=0.7, specular_hardness=400),
        c.material('Ward', (0.5, 0.3, 0.5), specular_shader='WARDISO', specular_slope=0.15,
                   specular_intensity=0.1),
        c.material('Toon', (0.3, 0.6, 0.6), specular_shader='TOON', specular_intensity=0.4,
                   specular_toon_smooth=0.4),
        c.material('Layered', (0.3, 0.1, 0.05), specular_shader='PHONG', **coloured),
        c.material('LayeredBlinn', (0.1, 0.1, 0.3), specular_shader='BLINN', specular_ior=5.0,
                   specular_color=(0.3, 0.9, 0.5), specular_intensity=0.6),
        c.material('LayeredMirror', (0.2, 0.2, 0.2), specular_shader='PHONG', mirror=(0.4, 0.4, 0.4),
                   metallic=0.8, **coloured),
        c.material('Mirror', (0.1, 0.1, 0.1), mirror=(0.7, 0.75, 0.8), diffuse_intensity=0.2,
                   fresnel={'fresnel': 0.0, 'fresnel_factor': 1.0}),
        c.material('Falloff', (0.3, 0.05, 0.05), mirror=(0.9, 0.9, 0.9),
                   fresnel={'fresnel': 3.0, 'fresnel_factor': 1.25}),
        c.material('Fresnel', (0.05, 0.2, 0.1), mirror=(1, 1, 1), mirror_use_IOR=True,
                   fresnel={'fresnel': 0.0, 'fresnel_factor': 1.0}),
        c.material('Metal', (0.75, 0.5, 0.2), mirror=(0.8, 0.8, 0.8), metallic=1.0,
                   diffuse_intensity=0.3),
        c.material('Emit', (0.8, 0.7, 0.2), emit=0.5),
        c.material('Translucent', (0.7, 0.7, 0.5), translucency=0.5, conserve_energy=True),
    ]
    ball = c.ball(segments=18, rings=10, radius=0.55, smooth=True, name='Ball')
    ball.location = (0, 0, -40)
    ball.data.materials.append(finishes[0])
    for i, mat in enumerate(finishes):
        # One mesh, its material linked to the object: the add-on then writes the mesh once a material.
        ob = c.add('Ball%02d' % i, ball.data.copy(), location=(1.4 * (i % 5 - 2), 0.4 * (i // 5),
                                                              0.62 + 1.35 * (i // 5)))
        ob.data.name = 'Ball' + mat.name
        ob.data.materials[0] = mat
    c.floor(size=14, mat=c.material('Floor', (0.4, 0.4, 0.42), specular_intensity=0.0))
    c.camera((0, -8.2, 3.0), (0, 0.3, 1.9), lens=42)
    c.lamp('POINT', (3, -5, 6), distance=80)
    c.lamp('POINT', (-4, -4, 3), colour=(0.4, 0.4, 0.5), distance=60)
    c.lamp('SUN', (1, 6, 4), colour=(0.25, 0.22, 0.2))


c.run('finishes', build)
