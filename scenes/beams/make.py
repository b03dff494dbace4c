# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A hall of long thin beams turned every way: the bounding volumes' hard case."""
import os
import random
import sys

import mathutils

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(background=(0.02, 0.02, 0.03))
    rng = random.Random(11)
    woods = [c.material('Wood%d' % i, rgb, specular_shader='PHONG', specular_intensity=0.2)
             for i, rgb in enumerate(((0.5, 0.33, 0.18), (0.35, 0.2, 0.1), (0.62, 0.5, 0.33)))]
    # Each beam is two to seven units long and a few hundredths thick. Three meshes of 110 beams each:
    # beams in a mesh overlap one another's boxes everywhere, as the beams of one roof do.
    for m, mat in enumerate(woods):
        vertices, faces = [], []
        for _ in range(110):
            turn = mathutils.Euler([rng.uniform(0, 6.28) for _ in range(3)]).to_matrix()
            middle = mathutils.Vector((rng.uniform(-6, 6), rng.uniform(1, 14), rng.uniform(0.5, 6)))
            half = (rng.uniform(0.015, 0.05), rng.uniform(0.015, 0.05), rng.uniform(1, 3.5))
            first = len(vertices)
            for k in range(8):
                corner = [half[a] if k >> a & 1 else -half[a] for a in range(3)]
                vertices.append(middle + turn @ mathutils.Vector(corner))
            faces += [[first + k for k in side] for side in
                      ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))]
        c.mesh('Beams%d' % m, vertices, faces, mat=mat)
    # Rafters are objects of their own, stretched and turned by their matrices.
    cube = c.shape('cube', size=1.0, mat=woods[1], name='Rafter')
    cube.location, cube.scale, cube.rotation_euler = (0, 16, 6.7), (12, 0.2, 0.25), (0, 0, 0.01)
    for k in range(16):
        for side in (-1, 1):
            c.add('Rafter%02d%s' % (k, 'LR'[side > 0]), cube.data, location=(3.1 * side, k, 7.6),
                  rotation=(2, 28 * side, 0.7), scale=(7.0, 0.12, 0.2))
    hall = c.material('Stone', (0.6, 0.6, 0.62), specular_intensity=0.0)
    c.shape('cube', size=1.0, location=(0, 6, 4.5), scale=(16, 24, 9.02), mat=hall, name='Hall')
    c.camera((1.2, -5.2, 2.2), (-0.3, 6, 3.4), lens=26)
    c.lamp('POINT', (-5.0, -3, 7), colour=(1, 0.9, 0.75), distance=60)
    c.lamp('POINT', (5, 11, 2), colour=(0.6, 0.7, 1), distance=40)


c.run('beams', build)
