# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The lecture's case: one mesh of exactly 3,072 triangles which about 7.5 % of the camera rays hit."""
import os
import sys

import mathutils

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(size=(512, 512), background=(0.02, 0.03, 0.06))
    mat = c.material('Brass', (0.72, 0.47, 0.16), specular_shader='PHONG', specular_intensity=0.4)
    # 64 x 24 quadrilaterals, modelled in world coordinates: the object's matrix is the identity.
    torus = c.shape('torus', mat=mat, smooth=True, major_segments=64, minor_segments=24,
                    major_radius=1.0, minor_radius=0.36)
    torus.data.transform(mathutils.Euler((0.5, -0.35, 0.2)).to_matrix().to_4x4())
    c.camera((0.0, -9.78, 2.25), (0, 0, 0), lens=50)
    c.lamp('POINT', (4, -6, 6), distance=200)
    c.lamp('SUN', (-4, -3, 2), colour=(0.2, 0.25, 0.35))


c.run('lecture', build)
