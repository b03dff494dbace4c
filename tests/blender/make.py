# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make one varied Blender file and export it with Blender's own POV-Ray add-on.

    blender -b --factory-startup -P make.py -- FOLDER NUMBER SEED [ordinary]

writes FOLDER/NUMBER.pov, and always the same scene for the same NUMBER and SEED (up to the order in which
Blender numbers vertices). NUMBER chooses the kind of thing in kinds.py, and with SEED everything else:
materials, lamps, world, floor, camera and the scale of the whole, 1e-2 to 1e3 times.
ordinary: also what ordinary.py has, and radiosity as the add-on has it by default.
"""
import math
import os
import random
import sys

import bpy
import mathutils

sys.dont_write_bytecode = True
here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [here, os.path.join(here, os.pardir, os.pardir, 'scenes')]
import common as c
import kinds
import ordinary


def colour(rng, least=0.05, most=0.9):
    return [rng.uniform(least, most) for _ in range(3)]


def dress(rng, i, unit):
    """A material: mostly plain finishes, now and then a mirror, glass or something transparent."""
    pov = {'diffuse_shader': rng.choice(('LAMBERT', 'OREN_NAYAR')),
           'specular_shader': rng.choice(('COOKTORR', 'PHONG', 'BLINN', 'TOON', 'WARDISO')),
           'diffuse_intensity': rng.uniform(0.3, 1.0), 'specular_intensity': rng.choice((0, 0.1, 0.5, 0.9)),
           'specular_hardness': rng.randrange(5, 400), 'specular_ior': rng.uniform(1, 8),
           'specular_slope': rng.uniform(0.05, 0.4), 'emit': rng.choice((0, 0, 0, 0.3)),
           'translucency': rng.choice((0, 0, 0.4)), 'ambient': rng.random(),
           'conserve_energy': rng.random() < 0.3, 'roughness': rng.random()}
    if rng.random() < 0.2:
        pov['specular_color'] = colour(rng, 0.1, 1.0)
    kind = rng.random()
    if kind < 0.2:
        pov.update(mirror=colour(rng, 0.1, 0.8), metallic=rng.choice((0, 0, 0.7, 1.0)),
                   mirror_use_IOR=rng.random() < 0.3,
                   fresnel={'fresnel': rng.choice((0, 1.0, 3.0)),
                            'fresnel_factor': rng.choice((1.0, 1.25, 1.25, 2.0))})
    elif kind < 0.28:
        pov.update(alpha=rng.uniform(0, 0.3), filter=rng.random(), ior=rng.uniform(1.0, 1.8),
                   interior_fade_color=colour(rng))
    elif kind < 0.36:
        pov.update(alpha=rng.uniform(0.2, 0.8))
    return c.material('Mat%d' % i, colour(rng), **pov)


def extent():
    """Middle and half extent of all that has a surface and is not endless."""
    bpy.context.view_layer.update()
    points = []
    for ob in bpy.context.scene.objects:
        if ob.type in {'MESH', 'FONT', 'CURVE', 'META'} and not (ob.type == 'MESH' and not ob.data.vertices):
            points += [ob.matrix_world @ mathutils.Vector(corner) for corner in ob.bound_box]
    least = mathutils.Vector([min(p[a] for p in points) for a in range(3)])
    most = mathutils.Vector([max(p[a] for p in points) for a in range(3)])
    return 0.5 * (least + most), 0.5 * (most - least).length, least.z


def around(rng, middle, distance, low=15, high=60):
    turn, rise = rng.uniform(0, 2 * math.pi), math.radians(rng.uniform(low, high))
    return middle + distance * mathutils.Vector((math.cos(turn) * math.cos(rise),
                                                 math.sin(turn) * math.cos(rise), math.sin(rise)))


def light(rng, middle, radius):
    """One to four lamps of any kind, without jitter."""
    for i in range(rng.randrange(1, 5)):
        kind = rng.choice(('POINT', 'POINT', 'SUN', 'SPOT', 'AREA'))
        settings = {'distance': radius * rng.uniform(4, 30), 'shadowless': rng.random() < 0.1}
        if kind in ('POINT', 'SPOT'):
            settings['falloff_type'] = rng.choice(('INVERSE_SQUARE', 'INVERSE_LINEAR', 'CONSTANT'))
        if kind == 'SPOT':
            settings.update(spot_size=rng.uniform(0.4, 1.5), spot_blend=rng.random())
        if kind == 'AREA':
            settings.update(size=radius * rng.uniform(0.1, 0.6), shape=rng.choice(('SQUARE', 'RECTANGLE')),
                            size_y=radius * rng.uniform(0.1, 0.6),
                            samples=(rng.randrange(1, 5), rng.randrange(1, 5)))
        c.lamp(kind, around(rng, middle, radius * rng.uniform(2, 4), 20, 85), middle,
               colour=colour(rng, 0.3, 1.0), name='%s%d' % (kind.title(), i), **settings)


def resize(factor):
    """Everything times that: the matrices of what has no parent; lamps' own lengths besides."""
    for ob in bpy.context.scene.objects:
        if ob.parent is None:
            ob.location *= factor
            if ob.type not in {'CAMERA', 'LIGHT'}:
                ob.scale *= factor
        if ob.type == 'LIGHT':
            ob.data.distance *= factor
            if ob.data.type == 'AREA':
                ob.data.size *= factor
                ob.data.size_y *= factor
        if ob.type == 'CAMERA':
            ob.data.ortho_scale *= factor


def look(rng, is_ordinary, radius):
    """Materials for what has none."""
    i = 0
    for ob in bpy.context.scene.objects:
        if ob.type in {'MESH', 'FONT', 'CURVE'} and not ob.data.materials and rng.random() < 0.9:
            mat = dress(rng, i, radius)
            ob.data.materials.append(mat)
            i += 1
            if is_ordinary and ob.type == 'MESH' and rng.random() < 0.5:
                ordinary.unwrapped(ob)
                ordinary.picture(rng, os.path.join(folder, number), mat)


def build(number, seed, is_ordinary):
    rng = random.Random('%d %d' % (seed, number))
    c.start(size=(160, 120), background=colour(rng, 0.0, 0.7), ambient=colour(rng, 0.0, 0.2),
            text=rng.choice(('compact', 'compact', 'indented', 'lines')))
    bpy.context.scene.pov.max_trace_level = rng.choice((3, 5, 5, 7))
    kinds.enable()
    every = kinds.KINDS + list(ordinary.KINDS) if is_ordinary else kinds.KINDS
    kind = every[number % len(every)]
    kind(rng)
    middle, radius, bottom = extent()
    if rng.random() < 0.7:
        c.floor(size=rng.uniform(3, 12) * radius, z=bottom - 0.02 * radius)
    look(rng, is_ordinary, radius)
    ortho = 2.2 * radius if rng.random() < 0.15 else None
    c.camera(around(rng, middle, 2.6 * radius), middle, lens=rng.uniform(35, 60), ortho=ortho)
    light(rng, middle, radius)
    if is_ordinary:
        bpy.context.scene.pov.radio_enable = True
        ordinary.world(rng, os.path.join(folder, str(number)), radius)
        ordinary.soften(rng)
        if rng.random() < 0.15:
            ordinary.blur(rng, rng.choice([ob for ob in bpy.context.scene.objects
                                              if ob.type not in {'CAMERA', 'LIGHT'}]))
    factor = 10 ** rng.choice((-1.5, -0.5, 0, 0, 0, 0, 0.5, 1, 2, 2.8))
    resize(factor)
    print('scene %d: %s, %d objects, %.3g units' % (number, kind.__name__, len(bpy.data.objects),
                                                   2 * radius * factor))


folder, number, seed, *more = sys.argv[sys.argv.index('--') + 1:]
sys.argv = sys.argv[:sys.argv.index('--')] + ['--', folder]
c.run(number, lambda: build(int(number), int(seed), more == ['ordinary']))
