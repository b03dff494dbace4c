# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Whole pictures at all sizes and far from the origin: run by pictures.sh.

    pictures.py [leak] [scale] [far]

leak: a closed black mesh around the camera, white behind: no pixel may be white. scale: shapes, camera and
lamp made larger and smaller together: no pixel may change by more than 2/255. far: all of them moved.
Environment: ALIDADE, ALIDADE_SRC, ALIDADE_ALL (all accelerators and more sizes).
"""
import math
import os
import random
import sys
import tempfile

import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, 'images'))
import picture
import renderers
import tap

ALL = bool(os.environ.get('ALIDADE_ALL'))
ACCELS = ('octree', 'box', 'sphere', 'none', 'bvh8') if ALL else ('octree', 'bvh8')
AWAY = (0.6, -0.64, 0.48)


def vec(v):
    return '<%s>' % ', '.join('%.17g' % x for x in v)


def mad(a, s, offset):
    return [x * s + o for x, o in zip(a, offset)]


def bumpy(bump, seed=1):
    """A sphere of 24 x 48 quads about the origin, its radius varied; its vertices and faces."""
    rings, segments = 24, 48
    dice = random.Random(seed)
    vertices = []
    for i in range(rings + 1):
        for k in range(1 if i in (0, rings) else segments):
            a, b, r = math.pi * i / rings, 2 * math.pi * k / segments, 1 + bump * dice.uniform(-1, 1)
            vertices.append((r * math.sin(a) * math.cos(b), r * math.cos(a), r * math.sin(a) * math.sin(b)))
    faces = []
    first = lambda i: 0 if i == 0 else 1 + (i - 1) * segments
    for k in range(segments):
        l = (k + 1) % segments
        faces.append((0, 1 + k, 1 + l))
        for i in range(1, rings - 1):
            a, b = first(i), first(i + 1)
            faces += [(a + k, b + k, b + l), (a + k, b + l, a + l)]
        faces.append((len(vertices) - 1, first(rings - 1) + l, first(rings - 1) + k))
    return vertices, faces


def lattice(cells=8):
    """The cube [-1, 1]^3, cells by cells quads a face, with vertices that faces share."""
    faces, index = [], {}
    for axis in range(3):
        for side in (-1, 1):
            for i in range(cells):
                for k in range(cells):
                    quad = []
                    for a, b in ((i, k), (i + 1, k), (i + 1, k + 1), (i, k + 1)):
                        v = [side, side, side]
                        v[(axis + 1) % 3], v[(axis + 2) % 3] = 2 * a / cells - 1, 2 * b / cells - 1
                        quad.append(index.setdefault(tuple(v), len(index)))
                    faces += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
    return list(index), faces


def mesh(vertices, faces, scale, offset, texture):
    return 'mesh2 { vertex_vectors { %d, %s } face_indices { %d, %s } %s }\n' % (
        len(vertices), ', '.join(vec(mad(v, scale, offset)) for v in vertices), len(faces),
        ', '.join('<%d,%d,%d>' % f for f in faces), texture)


def draw(folder, text, size, accel='octree'):
    scene, out = os.path.join(folder, 'scene.pov'), os.path.join(folder, 'out.pfm')
    with open(scene, 'w', encoding='utf-8') as file:
        file.write(text)
    renderers.alidade(scene, out, size, accel=accel)
    return picture.read(out)


def leaks(folder, scale, k, accel, size, shape, holes=0):
    offset = [a * k * scale for a in AWAY]
    vertices, faces = bumpy(0.15) if shape == 'bumpy' else lattice()
    faces = faces[holes:]
    black = 'pigment { rgb 0 } finish { ambient 0 diffuse 0 }'
    count = 0
    for view in ((1, 0.1, 0.2), (-0.3, 1, 0.1), (0.2, -0.7, 1), (-1, -0.2, -0.5)):
        text = ('#version 3.7;\nglobal_settings { assumed_gamma 1 }\nbackground { rgb 1 }\n'
                'camera { location %s direction %s right %s up %s }\n' % (
                    vec(mad((0.05, 0.1, -0.07), scale, offset)), vec(view),
                    vec(numpy.cross(view, (0.1, 0.2, 1))), vec(numpy.cross(view, (1, -0.1, 0.2))))
                + mesh(vertices, faces, scale, offset, black))
        count += int((draw(folder, text, size, accel) != 0).any(axis=2).sum())
    return count


BLOB = ('blob { threshold 0.5 sphere { <-0.3, 0, 0>, 0.9, 1 } cylinder { 0, <0.7, 0.4, 0.2>, 0.6, 1 } '
        'sphere { <0.2, 0.5, 0>, 0.6, -0.7 } ')
LATHE = 'lathe { cubic_spline 6, <0.2, -1.2>, <0.6, -0.9>, <0.9, -0.2>, <0.3, 0.3>, <0.6, 0.9>, <0.4, 1.2> '
SWEEP = ('sphere_sweep { b_spline 5, <-0.6, -0.6, 0>, 0.3 <-0.6, 0.6, 0>, 0.4 <0.6, 0.6, 0>, 0.2 <0.6, -0.6, 0>, 0.3 '
         '<0, -0.7, 0.5>, 0.3 ')
CUT = 'difference { box { -0.7, 0.7 } sphere { <0.5, 0.5, -0.5>, 0.7 } cylinder { -x, x, 0.3 } rotate <20, 30, 0> '
SHAPES = {
    'sphere': lambda p, s: 'sphere { %s, %.17g' % (p((0, 1, 0)), s),
    'box': lambda p, s: 'box { %s, %s' % (p((-0.8, 0.1, -0.8)), p((0.7, 1.3, 0.9))),
    'cylinder': lambda p, s: 'cylinder { %s, %s, %.17g' % (p((-0.7, 0.6, 0)), p((0.6, 1, 0.3)), 0.5 * s),
    'cone': lambda p, s: 'cone { %s, %.17g, %s, %.17g' % (p((0, 0.1, 0)), 0.9 * s, p((0.2, 1.7, 0)), 0.1 * s),
    'torus': lambda p, s: 'torus { %.17g, %.17g rotate 40*x translate %s' % (0.8 * s, 0.3 * s, p((0, 0.9, 0))),
    'blob': lambda p, s: BLOB + 'scale %.17g translate %s' % (s, p((0, 0.9, 0))),
    'lathe': lambda p, s: LATHE + 'scale %.17g translate %s' % (s, p((0, 1.2, 0))),
    'sphere_sweep': lambda p, s: SWEEP + 'scale %.17g translate %s' % (s, p((0, 1, 0))),
    'superellipsoid': lambda p, s: 'superellipsoid { <0.3, 1.7> scale %.17g translate %s' % (s, p((0, 1, 0))),
    'difference': lambda p, s: CUT + 'scale %.17g translate %s' % (s, p((0, 0.9, 0))),
}


def shaded(shape, s, offset):
    p = lambda v: vec(mad(v, s, offset))
    texture = 'pigment { rgb <0.8, 0.5, 0.3> } finish { ambient 0.1 diffuse 0.7 phong 0.4 }'
    text = ('#version 3.7;\nglobal_settings { assumed_gamma 1 }\nbackground { rgb <0.2, 0.3, 0.4> }\n'
            'camera { location %s right x*4/3 up y direction %s }\nlight_source { %s, rgb 1 }\n'
            'polygon_floor\n' % (p((0, 2, -5)), vec((0, -0.22, 1)), p((-4, 6, -3))))
    floor = mesh([(-9, 0, -9), (9, 0, -9), (9, 0, 9), (-9, 0, 9)], [(0, 1, 2), (0, 2, 3)], s, offset, texture)
    if shape == 'mesh':
        vertices, faces = bumpy(0.05)
        thing = mesh(vertices, faces, s, mad((0, 1, 0), s, offset), texture)
    else:
        thing = SHAPES[shape](p, s) + ' %s }\n' % texture
    return text.replace('polygon_floor\n', floor) + thing


def moved(scale):
    """What to replace so that the camera of a shaded() scene stands where it did at scale 1."""
    return ['location ' + vec(mad((0, 2, -5), s, (0, 0, 0))) for s in (scale, 1)]


def changed(a, b):
    return int((numpy.abs(picture.encode(a) - picture.encode(b)) > 2 / 255).any(axis=2).sum())


def test_leak(folder):
    size = (256, 256) if ALL else (64, 64)
    cases = [(10.0 ** e, 0) for e in range(-6, 9, 1 if ALL else 7)]
    cases += [(1, 10.0 ** e) for e in ((3, 5, 6, 7, 8) if ALL else (5, 8))]
    for shape in ('bumpy', 'box'):
        tap.ok(leaks(folder, 1, 0, 'octree', size, shape, 200) > 0, 'light leaks into a %s mesh with holes' % shape)
        for accel in ACCELS:
            for scale, k in cases:
                count = leaks(folder, scale, k, accel, size, shape)
                tap.ok(count == 0, 'no light leaks into a closed %s mesh: %s, scale %g, %g radii off' % (
                    shape, accel, scale, k), '%d pixels' % count)


def test_scale(folder):
    for shape in list(SHAPES) + ['mesh']:
        still = draw(folder, shaded(shape, 1, (0, 0, 0)), (160, 160))
        n = changed(still, draw(folder, shaded(shape, 1.05, (0, 0, 0)).replace(*moved(1.05)), (160, 160)))
        tap.ok(n > 100, '%s looks otherwise when the camera does not move with it' % shape, '%d pixels' % n)
        for accel in ACCELS:
            for e in (range(-6, 10) if ALL else (-6, 9)):
                n = changed(still, draw(folder, shaded(shape, 10.0 ** e, (0, 0, 0)), (160, 160), accel))
                tap.ok(n == 0, '%s looks the same at 1e%d times its size: %s' % (shape, e, accel),
                       '%d pixels' % n)


def test_far(folder):
    for shape in list(SHAPES) + ['mesh']:
        still = draw(folder, shaded(shape, 1, (0, 0, 0)), (160, 160))
        for accel in ACCELS:
            for e in ((2, 4, 5, 6, 7, 8) if ALL else (6, 8)):
                n = changed(still, draw(folder, shaded(shape, 1, [a * 10.0 ** e for a in AWAY]), (160, 160), accel))
                most = 0 if e <= 6 else 25
                tap.ok(n <= most, '%s looks the same 1e%d units off: %s (%d pixels, at most %d)' % (
                    shape, e, accel, n, most))


def main():
    want = sys.argv[1:] or ['leak', 'scale', 'far']
    with tempfile.TemporaryDirectory() as folder:
        for name in want:
            globals()['test_' + name](folder)
    tap.done()


if __name__ == '__main__':
    main()
