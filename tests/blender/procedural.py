# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's procedural textures, and POV-Ray's patterns as the stock add-on offers them, as bumps: it
declares a pigment and a function of it, and writes normal { function { f(x, y, z).grey } bump_size ... }.
Colours by them are written in a way that POV-Ray refuses, and so are left out.
"""
import bpy

import common as c

EMULATED = ('CLOUDS', 'WOOD', 'MARBLE', 'STUCCI', 'MUSGRAVE', 'VORONOI', 'NOISE', 'DISTORTED_NOISE', 'MAGIC')
# Those whose export POV-Ray takes.
PATTERNS = ('agate', 'bozo', 'bumps', 'crackle', 'dents', 'granite', 'leopard', 'marble', 'onion', 'quilted',
            'radial', 'ripples', 'spiral1', 'spotted', 'waves', 'wood', 'wrinkles', 'gradient', 'boxed',
            'cells', 'spherical', 'planar', 'cylindrical')
CHOICES = {'CLOUDS': ('noise_type',), 'WOOD': ('wood_type', 'noise_basis_2'), 'MARBLE': ('noise_basis_2',),
           'STUCCI': ('noise_type',), 'VORONOI': ('distance_metric', 'color_mode'),
           'DISTORTED_NOISE': ('noise_distortion',)}


def texture(rng, name):
    if rng.random() < 0.4:
        made = bpy.data.textures.new(name, 'NONE') # of others patterns are not declared
        made.use_fake_user = True
        made.pov.tex_pattern_type = rng.choice(PATTERNS)
        return made
    made = bpy.data.textures.new(name, rng.choice(EMULATED))
    made.use_fake_user = True
    for choice in CHOICES.get(made.type, ()):
        items = made.bl_rna.properties[choice].enum_items
        setattr(made, choice, rng.choice([item.identifier for item in items]))
    if made.type == 'MARBLE':
        made.marble_type = rng.choice(('SOFT', 'SHARP')) # SHARPER lacks a brace
    if made.type == 'WOOD':
        made.turbulence = rng.uniform(1, 20)
    if made.type == 'DISTORTED_NOISE':
        made.distortion = rng.uniform(0.1, 2)
    if rng.random() < 0.3:
        made.use_color_ramp = True
    return made


def bump(rng, mat, name):
    """A slot of the material that bends its normals."""
    made = mat.pov_texture_slots.add()
    made.texture = texture(rng, name).name
    made.use = True
    made.use_map_color_diffuse = False
    made.use_map_normal = True
    made.normal_factor = rng.uniform(0.02, 0.5)
    if rng.random() < 0.4:
        made.scale = [rng.choice((0.5, 1, 2)) for _ in range(3)]
        made.offset = [rng.uniform(-0.5, 0.5) for _ in range(3)]


def procedural(rng):
    """Balls and blocks with bumps; now and then a mirror, which the bumps blur."""
    for i in range(rng.randrange(2, 5)):
        mat = c.material('Bumpy%d' % i, [rng.uniform(0.2, 0.9) for _ in range(3)],
                         specular_intensity=rng.choice((0, 0.5)))
        if rng.random() < 0.3:
            mat.pov_raytrace_mirror.use = True
            mat.pov_raytrace_mirror.reflect_factor = rng.uniform(0.1, 0.5)
        bump(rng, mat, 'Bumps%d' % i)
        kind = rng.choice((dict(kind='torus'), dict(kind='cube'), dict(kind='ico_sphere', subdivisions=3)))
        c.shape(name='Bumpy%d' % i, location=(2.2 * i, rng.uniform(-1, 1), 1), mat=mat,
                rotation=[rng.uniform(0, 90) for _ in range(3)], **kind)
