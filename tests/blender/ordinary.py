# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What ordinary Blender files have beyond plain meshes: image textures, every world, lamps with soft
shadows, hair, curves and metaballs as such, depth of field. Only what the stock POV-Ray add-on writes in
a way that POV-Ray accepts (see its source): metaballs without a material, no procedural colour, no tga.
"""
import math
import os

import bpy
import mathutils

import common as c
import kinds
import procedural


def colour(rng, least=0.05, most=0.9):
    return [rng.uniform(least, most) for _ in range(3)]


def painted(rng, folder, name, grey=False):
    """An image file of blobs and stripes; its Blender image."""
    width, height = rng.choice((16, 31, 64, 100)), rng.choice((16, 48, 64))
    image = bpy.data.images.new(name, width, height)
    tones = [[v] * 3 if grey else None for v in (rng.random(), rng.random(), rng.random())]
    tones = [t or colour(rng, 0.0, 1.0) for t in tones]
    stripe, turn = rng.uniform(2, 9), rng.uniform(0, math.pi)
    spots = [(rng.random(), rng.random(), rng.uniform(0.1, 0.35)) for _ in range(4)]
    pixels = []
    for y in range(height):
        for x in range(width):
            u, v = (x + 0.5) / width, (y + 0.5) / height
            wave = 0.5 + 0.5 * math.sin(stripe * 2 * math.pi * (u * math.cos(turn) + v * math.sin(turn)))
            near = any((u - a) ** 2 + (v - b) ** 2 < r * r for a, b, r in spots)
            pixels += [(1 - wave) * tones[0][k] + wave * tones[1][k] if not near else
                       0.7 * tones[2][k] + 0.3 * u for k in range(3)] + [1.0]
    image.pixels = pixels
    kind = rng.choice(('PNG', 'PNG', 'JPEG'))
    image.filepath_raw = os.path.join(folder, name + ('.png' if kind == 'PNG' else '.jpg'))
    image.file_format = kind
    image.save()
    return image


def slot(rng, owner, image, **uses):
    """A texture slot of a material or world that shows the image."""
    texture = bpy.data.textures.new(image.name, 'IMAGE')
    texture.image = image
    texture.use_fake_user = True
    if rng.random() < 0.2:
        texture.extension = 'CLIP'
    made = owner.pov_texture_slots.add()
    made.texture = texture.name
    made.use = True
    for key, value in uses.items():
        setattr(made, key, value)
    if rng.random() < 0.4 and 'use_map_blend' not in uses:
        made.scale = [rng.choice((0.25, 0.5, 0.7, 1, 2)) for _ in range(3)]
        made.offset = [rng.uniform(-0.5, 0.5) for _ in range(3)]
    return made


def picture(rng, folder, mat):
    """One to three image slots on a material."""
    base = 'pic_' + mat.name
    roll = rng.random()
    uses = [{'use_map_color_diffuse': True}]
    if roll < 0.25:
        uses.append({'use_map_color_diffuse': False, 'use_map_normal': True,
                     'normal_factor': rng.uniform(0.2, 1.5)})
    elif roll < 0.4:
        uses.append({'use_map_color_diffuse': False, 'use_map_alpha': True})
    elif roll < 0.5:
        uses.append({'use_map_color_diffuse': False, 'use_map_specular': True})
    elif roll < 0.6:
        uses = [{'use_map_color_diffuse': False, 'use_map_normal': True,
                 'normal_factor': rng.uniform(0.2, 1.5)}]
    for i, use in enumerate(uses):
        slot(rng, mat, painted(rng, folder, '%s_%d' % (base, i), i > 0), **use)


def unwrapped(ob):
    """See that a mesh has texture coordinates."""
    if ob.type != 'MESH' or ob.data.uv_layers:
        return
    layer = ob.data.uv_layers.new(name='UVMap')
    for loop in ob.data.loops:
        p = ob.data.vertices[loop.vertex_index].co
        layer.data[loop.index].uv = (0.3 * p.x + 0.1 * p.z, 0.3 * p.y + 0.17 * p.z)


def world(rng, folder, radius):
    """The sky: plain, blended, an image; and mist."""
    owner, roll = bpy.context.scene.world, rng.random()
    if roll < 0.3:
        owner.pov.use_sky_blend = True
        owner.pov.zenith_color = colour(rng, 0.0, 0.8)
    elif roll < 0.55:
        made = slot(rng, owner, painted(rng, folder, 'sky'), use_map_blend=True,
                    texture_coords=rng.choice(('ANGMAP', 'VIEW', 'TUBE')))
        made.scale = [rng.choice((1, 1, 2)) for _ in range(3)]
    if rng.random() < 0.25:
        mist = owner.mist_settings
        mist.use_mist = True
        mist.start, mist.depth = 0.0, radius * rng.uniform(3, 12)
        mist.falloff = rng.choice(('LINEAR', 'QUADRATIC'))
        mist.intensity = rng.choice((0.0, 1.0, 0.5))
    if rng.random() < 0.15:
        bpy.context.scene.pov.alpha_mode = rng.choice(('STRAIGHT', 'TRANSPARENT'))


def soften(rng):
    """Area lamps as the add-on writes them by default: adaptive and jittered."""
    for ob in bpy.context.scene.objects:
        if ob.type == 'LIGHT' and ob.data.type == 'AREA' and rng.random() < 0.5:
            ob.data.pov.shadow_ray_sample_method = 'ADAPTIVE_QMC'


def blur(rng, target):
    """Depth of field, focused on something; POV-Ray cannot blur orthographic views."""
    if bpy.context.scene.camera.data.type != 'PERSP':
        return
    dof = bpy.context.scene.camera.data.dof
    dof.use_dof = True
    dof.aperture_fstop = rng.uniform(0.3, 1.5)
    dof.focus_object = target


def hair(rng):
    """Strands on a ball; the add-on writes a strand as a sphere_sweep."""
    ob = c.shape('ico_sphere', name='Head', location=(0, 0, 1.3), subdivisions=2)
    mat = c.material('Hair', colour(rng), specular_intensity=0.2)
    mat.strand.root_size, mat.strand.tip_size = rng.uniform(1, 4), rng.uniform(0.25, 1)
    ob.data.materials.append(mat)
    ob.modifiers.new('Hair', 'PARTICLE_SYSTEM')
    settings = ob.particle_systems[0].settings
    settings.type = 'HAIR'
    settings.render_type = 'PATH'
    settings.count, settings.rendered_child_count = rng.randrange(30, 150), 1
    settings.hair_length = rng.uniform(0.4, 1.5)
    settings.display_step = rng.randrange(2, 4)
    settings.use_hair_bspline = rng.random() < 0.5
    settings.brownian_factor = rng.uniform(0, 0.1)
    ob.particle_systems[0].seed = rng.randrange(1000)


def metaballs(rng):
    data = bpy.data.metaballs.new('Meta')
    data.threshold = rng.uniform(0.3, 0.8)
    for i in range(rng.randrange(3, 7)):
        element = data.elements.new(type=rng.choice(('BALL', 'BALL', 'CAPSULE', 'ELLIPSOID')))
        element.co = [rng.uniform(-1, 1) for _ in range(3)]
        element.radius = rng.uniform(0.8, 1.5)
        element.use_negative = i > 0 and rng.random() < 0.2
    c.add('Meta', data, location=(0, 0, 1.6))


def curves(rng):
    """Curves as the add-on writes them when nothing modifies them."""
    for i in range(3):
        kind = rng.choice(('primitive_bezier_curve_add', 'primitive_nurbs_path_add',
                           'primitive_nurbs_curve_add', 'primitive_bezier_circle_add'))
        ob = kinds.fresh(getattr(bpy.ops.curve, kind))
        ob.name = 'Curve%d' % i
        ob.data.dimensions = '3D'
        ob.data.bevel_depth = rng.uniform(0.05, 0.25)
        ob.location = (2.4 * (i - 1), rng.uniform(-0.5, 0.5), 1.2)
        ob.rotation_euler = [rng.uniform(0, 3) for _ in range(3)]


def particles(rng):
    """Many objects that share few meshes, as a converted particle system leaves them."""
    sources = [c.shape('ico_sphere', subdivisions=1, name='Grain'), c.shape('cube', size=1.0, name='Crumb')]
    for i in range(rng.randrange(50, 400)):
        source = rng.choice(sources)
        ob = c.add('Piece%d' % i, source.data,
                   location=[rng.uniform(-2.5, 2.5), rng.uniform(-2.5, 2.5), rng.uniform(0, 2.5)],
                   rotation=[rng.uniform(0, 360) for _ in range(3)])
        ob.scale = [rng.uniform(0.05, 0.2)] * 3
    for source in sources:
        source.location, source.scale = (0, 0, 1), (0.3, 0.3, 0.3)


def corner(rng):
    """Two walls and a floor of strong colours: much of the light is indirect."""
    for i, (location, rotation) in enumerate((((0, 0, 0), (0, 0, 0)), ((0, 3, 3), (90, 0, 0)),
                                              ((-3, 0, 3), (0, 90, 0)))):
        c.shape('plane', size=6, name='Wall%d' % i, location=location, rotation=rotation,
                mat=c.material('Wall%d' % i, colour(rng, 0.3, 0.95), diffuse_intensity=rng.uniform(0.6, 1)))
    kinds.spheres(rng)


KINDS = (hair, metaballs, curves, particles, corner, procedural.procedural)
