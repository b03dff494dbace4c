# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes that show the exporter's mapping: Principled materials, instances, lamps of every kind, worlds.

    blender -b --factory-startup -P gallery.py -- SCENE FILE.blend

saves the scene, set up for Cycles at 320 by 240. docs/exporter.md shows what Cycles, POV-Ray and Alidade make of them.
Everything is built here; nothing is random, and pictures are generated and packed.
"""
import math
import os
import sys

import bpy
import mathutils
import numpy as np

sys.dont_write_bytecode = True


def start(world=(0.05, 0.05, 0.05), strength=1.0):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = 'CYCLES'
    scene.cycles.device = 'CPU'
    scene.cycles.samples = 400
    scene.cycles.use_denoising = False
    scene.cycles.sample_clamp_indirect = 4
    scene.render.resolution_x, scene.render.resolution_y = 320, 240
    scene.view_settings.view_transform = 'Standard'
    scene.world = bpy.data.worlds.new('World')
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes['Background']
    background.inputs[0].default_value = (*world, 1)
    background.inputs[1].default_value = strength
    return scene


def add(name, data, location=(0, 0, 0), rotation=(0, 0, 0), scale=(1, 1, 1), collection=None):
    ob = bpy.data.objects.new(name, data)
    ob.location = location
    ob.rotation_euler = [math.radians(a) for a in rotation]
    ob.scale = scale
    (collection or bpy.context.scene.collection).objects.link(ob)
    return ob


def aim(ob, target):
    ob.rotation_euler = (mathutils.Vector(target) - ob.location).to_track_quat('-Z', 'Y').to_euler()


def camera(location, target, lens=50.0, **settings):
    data = bpy.data.cameras.new('Camera')
    data.lens = lens
    for key, value in settings.items():
        setattr(data, key, value)
    ob = add('Camera', data, location)
    aim(ob, target)
    bpy.context.scene.camera = ob
    return ob


def lamp(kind, location, target=(0, 0, 0), energy=100.0, colour=(1, 1, 1), name=None, **settings):
    data = bpy.data.lights.new(name or kind.title(), kind)
    data.energy = energy
    data.color = colour
    for key, value in settings.items():
        setattr(data, key, value)
    ob = add(name or kind.title(), data, location)
    aim(ob, target)
    return ob


def principled(name, colour=(0.8, 0.8, 0.8), **inputs):
    """A new material's Principled BSDF with these inputs: Metallic=1, Emission_Strength=3, ..."""
    mat = bpy.data.materials.new(name)
    mat.use_nodes = True
    node = mat.node_tree.nodes['Principled BSDF']
    node.inputs['Base Color'].default_value = (*colour, 1)
    for key, value in inputs.items():
        socket = node.inputs[key.replace('_', ' ')]
        socket.default_value = (*value, 1) if isinstance(value, tuple) else value
    return mat


def nodes(name):
    """A material without nodes but an output, its tree and a way to add a node."""
    mat = bpy.data.materials.new(name)
    mat.use_nodes = True
    tree = mat.node_tree
    tree.nodes.clear()
    output = tree.nodes.new('ShaderNodeOutputMaterial')

    def new(kind, **inputs):
        node = tree.nodes.new('ShaderNode' + kind)
        for key, value in inputs.items():
            node.inputs[key.replace('_', ' ')].default_value = value
        return node
    return mat, tree, output, new


def mesh(name, vertices, faces, mat=None, smooth=False, **where):
    data = bpy.data.meshes.new(name)
    data.from_pydata(vertices, [], faces)
    data.update()
    data.polygons.foreach_set('use_smooth', [smooth] * len(data.polygons))
    if mat is not None:
        data.materials.append(mat)
    return add(name, data, **where)


def ball(mat, location=(0, 0, 0), radius=1.0, segments=48, rings=24, name='Ball', **where):
    """A smooth sphere with a UV map (Blender's own numbers its vertices differently in every run)."""
    vertices = [(radius * math.sin(math.pi * i / rings) * math.cos(2 * math.pi * j / segments),
                 radius * math.sin(math.pi * i / rings) * math.sin(2 * math.pi * j / segments),
                 radius * math.cos(math.pi * i / rings)) for i in range(1, rings) for j in range(segments)]
    top, bottom = len(vertices), len(vertices) + 1
    vertices += [(0, 0, radius), (0, 0, -radius)]
    faces, uvs = [], []
    for j in range(segments):
        k = (j + 1) % segments
        u, w, m = j / segments, (j + 1) / segments, (j + 0.5) / segments
        faces.append((top, j, k))
        uvs += [(m, 1), (u, 1 - 1 / rings), (w, 1 - 1 / rings)]
        for i in range(rings - 2):
            r = i * segments
            v, t = 1 - (i + 1) / rings, 1 - (i + 2) / rings
            faces.append((r + j, r + segments + j, r + segments + k, r + k))
            uvs += [(u, v), (u, t), (w, t), (w, v)]
        r = (rings - 2) * segments
        faces.append((bottom, r + k, r + j))
        uvs += [(m, 0), (w, 1 / rings), (u, 1 / rings)]
    ob = mesh(name, vertices, faces, mat, True, location=location, **where)
    layer = ob.data.uv_layers.new(name='UVMap')
    layer.data.foreach_set('uv', np.array(uvs, np.float32).ravel())
    return ob


def box(mat, location=(0, 0, 0), size=(1, 1, 1), name='Box', **where):
    x, y, z = (0.5 * s for s in size)
    vertices = [(a * x, b * y, c * z) for c in (-1, 1) for b in (-1, 1) for a in (-1, 1)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    ob = mesh(name, vertices, faces, mat, location=location, **where)
    ob.data.uv_layers.new(name='UVMap').data.foreach_set('uv', [0, 0, 0, 1, 1, 1, 1, 0] * 6)
    return ob


def floor(mat, size=20.0, z=0.0, name='Floor', tiles=1.0):
    s = size / 2
    ob = mesh(name, [(-s, -s, 0), (s, -s, 0), (s, s, 0), (-s, s, 0)], [(0, 1, 2, 3)], mat, location=(0, 0, z))
    ob.data.uv_layers.new(name='UVMap').data.foreach_set('uv', [0, 0, tiles, 0, tiles, tiles, 0, tiles])
    return ob


def picture(name, pixels, data=False, is_float=False):
    """A generated, packed image; pixels: height x width x 3 or 4, bottom row first."""
    height, width, channels = pixels.shape
    image = bpy.data.images.new(name, width, height, alpha=channels == 4, float_buffer=is_float, is_data=data)
    full = np.ones((height, width, 4), np.float32)
    full[..., :channels] = pixels
    image.pixels.foreach_set(full.ravel())
    image.update()
    image.pack()
    return image


def tiles(name='Tiles', size=128):
    """Tiles of changing colour with grey joints and a letter-like mark, so that turning it shows."""
    y, x = np.mgrid[0:size, 0:size] / size
    cell = (np.floor(x * 4) * 3 + np.floor(y * 4) * 5) % 7 / 7
    rgb = np.stack([0.35 + 0.5 * cell, 0.75 - 0.5 * cell, 0.3 + 0.3 * np.sin(cell * 6) ** 2], -1)
    joint = (np.minimum(x * 4 % 1, y * 4 % 1) < 0.08)
    rgb[joint] = 0.5
    mark = (x > 0.05) & (x < 0.2) & (y > 0.05) & (y < 0.45) & ~((x > 0.1) & (y > 0.1) & (y < 0.4))
    rgb[mark] = (0.9, 0.1, 0.1)
    return picture(name, rgb)


def spheres():
    """Principled: metallic and rough from left to right, three kinds of surface from front to back."""
    scene = start((0.4, 0.5, 0.7), 0.6)
    floor(principled('Ground', (0.35, 0.33, 0.3), Roughness=0.9))
    for i in range(5):
        rough = (0.0, 0.2, 0.4, 0.6, 1.0)[i]
        x = (i - 2) * 1.25
        ball(principled('Plastic%d' % i, (0.7, 0.08, 0.06), Roughness=rough), (x, -1.3, 0.55), 0.55, name='Plastic%d' % i)
        ball(principled('Metal%d' % i, (0.95, 0.65, 0.25), Metallic=1.0, Roughness=rough), (x, 0.2, 0.55), 0.55,
             name='Metal%d' % i)
        ball(principled('Half%d' % i, (0.1, 0.35, 0.7), Metallic=0.5, Roughness=rough, Clearcoat=1.0), (x, 1.7, 0.55), 0.55,
             name='Half%d' % i)
    lamp('AREA', (-3, -4, 5), (0, 0, 0), 400, size=2.0)
    lamp('POINT', (4, -2, 3), energy=150, colour=(1, 0.9, 0.8), shadow_soft_size=0.25)
    camera((0, -8.2, 4.2), (0, 0, 0.4), 50)
    return scene


def lamps():
    """Point, spot and sun, hard and soft, on white ground."""
    start((0.02, 0.02, 0.03))
    floor(principled('Ground', (0.7, 0.7, 0.7), Roughness=1.0, Specular=0.0))
    white = principled('White', (0.8, 0.8, 0.8), Roughness=0.7)
    for i, x in enumerate((-3, -1, 1, 3)):
        box(white, (x, 0, 0.5), (0.4, 0.4, 1.0), name='Post%d' % i)
    lamp('POINT', (-3, -1.2, 1.5), energy=40, colour=(1, 0.5, 0.3), shadow_soft_size=0.0, name='Hard')
    lamp('POINT', (-1, -1.4, 1.6), energy=40, colour=(0.4, 1, 0.4), shadow_soft_size=0.3, name='Soft')
    lamp('SPOT', (1, -2, 3), (1, 0.3, 0), 250, (0.4, 0.6, 1), spot_size=math.radians(50), spot_blend=0.3,
         shadow_soft_size=0.0, name='Spot')
    lamp('SPOT', (3, -2, 3), (3, 0.3, 0), 250, (1, 0.4, 1), spot_size=math.radians(45), spot_blend=1.0,
         shadow_soft_size=0.15, name='SpotSoft')
    lamp('SUN', (0, 0, 5), (3, 4, 0), 0.4, (1, 1, 0.8), angle=math.radians(3))
    return camera((0, -9, 5), (0, 0.2, 0.2), 45)


def areas():
    """Area lamps: square, rectangle, disk, ellipse; the last one narrowed."""
    start((0.02, 0.02, 0.02))
    floor(principled('Ground', (0.7, 0.7, 0.7), Roughness=1.0, Specular=0.0))
    mesh('Wall', [(-10, 3, 0), (10, 3, 0), (10, 3, 8), (-10, 3, 8)], [(0, 1, 2, 3)],
         principled('Back', (0.6, 0.6, 0.65), Roughness=1.0, Specular=0.0))
    white = principled('White', (0.8, 0.8, 0.8), Roughness=0.5)
    shapes = (('SQUARE', 1.0, 1.0, math.pi), ('RECTANGLE', 1.6, 0.3, math.pi), ('DISK', 0.8, 0.8, math.pi),
              ('ELLIPSE', 0.4, 1.2, math.radians(100)))
    colours = ((1, 0.8, 0.6), (0.6, 1, 0.7), (0.6, 0.7, 1), (1, 0.6, 0.9))
    for i, (shape, x, y, spread) in enumerate(shapes):
        at = (i - 1.5) * 2.2
        ball(white, (at, 0, 0.5), 0.5, name='Ball%d' % i)
        lamp('AREA', (at, -1.5, 2.2), (at, 0, 0.3), 25, colours[i], shape=shape, size=x, size_y=y, spread=spread,
             name='Area%d' % i)
    camera((0, -9, 4), (0, 0, 0.8), 42)


def sky():
    """An image of the world: gradient sky with a bright patch, seen in metal and lighting the ground."""
    scene = start()
    height, width = 128, 256
    v, u = np.mgrid[0:height, 0:width]
    v, u = (v + 0.5) / height, (u + 0.5) / width
    up = np.clip((v - 0.5) * 2, 0, 1)[..., None]
    rgb = np.where(v[..., None] > 0.5, (1 - up) * np.array([0.8, 0.85, 0.9]) + up * np.array([0.15, 0.3, 0.7]),
                   np.array([0.2, 0.17, 0.12]))
    sun = np.exp(-(((u - 0.3) / 0.06) ** 2 + ((v - 0.7) / 0.1) ** 2))[..., None]
    rgb = rgb + 6 * sun * np.array([1, 0.85, 0.6])
    rgb[(np.abs(u - 0.62) < 0.02) & (v > 0.5) & (v < 0.75)] = (0.9, 0.1, 0.1)
    image = picture('Sky', rgb.astype(np.float32), is_float=True)
    tree = scene.world.node_tree
    node = tree.nodes.new('ShaderNodeTexEnvironment')
    node.image = image
    tree.links.new(node.outputs[0], tree.nodes['Background'].inputs[0])
    tree.nodes['Background'].inputs[1].default_value = 0.9
    floor(principled('Ground', (0.5, 0.5, 0.48), Roughness=0.9), 8)
    ball(principled('Chrome', (0.9, 0.9, 0.9), Metallic=1.0, Roughness=0.0), (-1.3, 0, 0.9), 0.9, name='Chrome')
    ball(principled('Clay', (0.7, 0.4, 0.3), Roughness=0.8), (0.6, 0.8, 0.7), 0.7, name='Clay')
    ball(principled('Gloss', (0.05, 0.3, 0.1), Roughness=0.1), (1.4, -0.6, 0.5), 0.5, name='Gloss')
    camera((1, -7, 2.4), (0, 0, 0.8), 45)


def glass():
    """Glass, coloured glass, a glass of Principled, and what lets light through without refracting."""
    start((0.6, 0.65, 0.7), 0.8)
    ground, tree, output, new = nodes('Squares')
    coordinates = new('TexCoord')
    checker = new('TexChecker', Color1=(0.7, 0.7, 0.7, 1), Color2=(0.2, 0.22, 0.3, 1), Scale=1.0)
    surface = new('BsdfPrincipled', Roughness=0.8)
    tree.links.new(coordinates.outputs['Object'], checker.inputs['Vector'])
    tree.links.new(checker.outputs[0], surface.inputs['Base Color'])
    tree.links.new(surface.outputs[0], output.inputs[0])
    floor(ground, z=-0.001)
    mat, tree, output, new = nodes('Glass')
    node = new('BsdfGlass', Color=(1, 1, 1, 1), Roughness=0.0, IOR=1.45)
    tree.links.new(node.outputs[0], output.inputs[0])
    ball(mat, (-2.1, 0, 0.8), 0.8, name='Clear')
    ball(principled('Amber', (0.95, 0.6, 0.2), Transmission=1.0, Roughness=0.0, IOR=1.5), (-0.3, 0.4, 0.8), 0.8,
         name='Amber')
    mat, tree, output, new = nodes('Veil')
    clear, solid, mix = new('BsdfTransparent'), new('BsdfDiffuse', Color=(0.2, 0.5, 0.9, 1)), new('MixShader', Fac=0.5)
    tree.links.new(clear.outputs[0], mix.inputs[1])
    tree.links.new(solid.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], output.inputs[0])
    box(mat, (1.4, 0, 0.7), (1.0, 1.0, 1.4), name='Veil', rotation=(0, 0, 20))
    mat, tree, output, new = nodes('Filter')
    clear = new('BsdfTransparent', Color=(0.9, 0.3, 0.3, 1))
    tree.links.new(clear.outputs[0], output.inputs[0])
    mesh('Pane', [(-0.5, 0, 0), (0.5, 0, 0), (0.5, 0, 1.6), (-0.5, 0, 1.6)], [(0, 1, 2, 3)], mat, location=(2.7, -0.2, 0),
         rotation=(0, 0, 30))
    ball(principled('Alpha', (0.2, 0.7, 0.3), Alpha=0.4, Roughness=0.4), (0.5, -1.4, 0.45), 0.45, name='Alpha')
    lamp('SUN', (0, 0, 5), (2, 3, 0), 2.5, angle=math.radians(2))
    camera((0, -8, 3.2), (0.2, 0, 0.6), 48)


def textures():
    """Images on UV maps: as they are, scaled, coloured by nodes, as roughness, as alpha; generated patterns."""
    start((0.5, 0.55, 0.6))
    image = tiles()

    def textured(name, scale=None, rotate=0.0, between=None, to='Base Color'):
        mat = principled(name, Roughness=0.6)
        tree = mat.node_tree
        node = tree.nodes.new('ShaderNodeTexImage')
        node.image = image
        if scale:
            coordinates, mapping = tree.nodes.new('ShaderNodeTexCoord'), tree.nodes.new('ShaderNodeMapping')
            mapping.inputs['Scale'].default_value = (scale, scale, 1)
            mapping.inputs['Rotation'].default_value = (0, 0, rotate)
            tree.links.new(coordinates.outputs['UV'], mapping.inputs['Vector'])
            tree.links.new(mapping.outputs[0], node.inputs['Vector'])
        output = node.outputs['Color']
        if between:
            output = between(tree, output)
        tree.links.new(output, tree.nodes['Principled BSDF'].inputs[to])
        return mat

    def coloured(tree, output):
        turn = tree.nodes.new('ShaderNodeHueSaturation')
        turn.inputs['Hue'].default_value = 0.8
        turn.inputs['Saturation'].default_value = 1.4
        tree.links.new(output, turn.inputs['Color'])
        return turn.outputs[0]
    floor(textured('Ground', 5, 0.3), 10)
    ball(textured('Plain'), (-2, 0, 0.8), 0.8, name='Plain')
    box(textured('Turned', between=coloured), (0, 0.2, 0.7), (1.2, 1.2, 1.4), name='Turned', rotation=(0, 0, 30))
    size = 64
    y, x = np.mgrid[0:size, 0:size] / size
    rgba = np.zeros((size, size, 4))
    rgba[..., :3] = (0.9, 0.8, 0.1)
    rgba[..., 3] = ((x * 4 % 1 - 0.5) ** 2 + (y * 4 % 1 - 0.5) ** 2 > 0.12) * 1.0
    leaf = principled('Holes', Roughness=0.5)
    tree = leaf.node_tree
    node = tree.nodes.new('ShaderNodeTexImage')
    node.image = picture('Holes', rgba)
    tree.links.new(node.outputs['Color'], tree.nodes['Principled BSDF'].inputs['Base Color'])
    tree.links.new(node.outputs['Alpha'], tree.nodes['Principled BSDF'].inputs['Alpha'])
    ball(leaf, (2, 0, 0.8), 0.8, name='Holes')
    metal = principled('Worn', (0.9, 0.6, 0.3), Roughness=0.3)
    tree = metal.node_tree
    node, grey = tree.nodes.new('ShaderNodeTexImage'), tree.nodes.new('ShaderNodeRGBToBW')
    node.image = picture('Mask', np.repeat((((x * 6).astype(int) + (y * 6).astype(int)) % 2)[..., None], 3, 2) * 1.0,
                         data=True)
    tree.links.new(node.outputs['Color'], grey.inputs[0])
    tree.links.new(grey.outputs[0], tree.nodes['Principled BSDF'].inputs['Metallic'])
    ball(metal, (-0.9, -1.6, 0.5), 0.5, name='Worn')
    stripes = principled('Ramp', Roughness=0.8)
    tree = stripes.node_tree
    coordinates, gradient = tree.nodes.new('ShaderNodeTexCoord'), tree.nodes.new('ShaderNodeTexGradient')
    ramp = tree.nodes.new('ShaderNodeValToRGB')
    ramp.color_ramp.elements[0].color = (0.8, 0.05, 0.02, 1)
    ramp.color_ramp.elements[1].color = (0.02, 0.1, 0.7, 1)
    ramp.color_ramp.elements.new(0.5).color = (0.9, 0.9, 0.8, 1)
    tree.links.new(coordinates.outputs['Generated'], gradient.inputs[0])
    tree.links.new(gradient.outputs[0], ramp.inputs[0])
    tree.links.new(ramp.outputs[0], tree.nodes['Principled BSDF'].inputs['Base Color'])
    ball(stripes, (0.9, -1.6, 0.5), 0.5, name='Ramp')
    lamp('SUN', (0, 0, 5), (2, 3, 0), 2.0, angle=math.radians(1))
    camera((0, -7, 3.2), (0, 0, 0.5), 45)


def colours():
    """Vertex colours and emission, in a dark room."""
    start((0.01, 0.01, 0.02))
    floor(principled('Ground', (0.5, 0.5, 0.5), Roughness=0.9))
    mat = principled('Painted', Roughness=0.7)
    tree = mat.node_tree
    node = tree.nodes.new('ShaderNodeVertexColor')
    node.layer_name = 'Col'
    tree.links.new(node.outputs['Color'], tree.nodes['Principled BSDF'].inputs['Base Color'])
    n = 24
    vertices = [(3 * i / n - 1.5, 3 * j / n - 1.5, 0.5 + 0.4 * math.sin(i * 0.6) * math.cos(j * 0.5))
                for j in range(n + 1) for i in range(n + 1)]
    faces = [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i)
             for j in range(n) for i in range(n)]
    ob = mesh('Cloth', vertices, faces, mat, True, location=(-1, 0, 0.2), rotation=(20, 0, 15))
    layer = ob.data.color_attributes.new('Col', 'FLOAT_COLOR', 'POINT')
    layer.data.foreach_set('color', np.array([(0.5 + 0.5 * math.sin(v[0] * 3), 0.5 + 0.5 * math.sin(v[1] * 3 + 2),
                                               0.5 - 0.5 * math.sin(v[0] * 2 + v[1] * 2), 1) for v in vertices],
                                              np.float32).ravel())
    glow = principled('Glow', (0, 0, 0), Emission=(1.0, 0.55, 0.2), Emission_Strength=6.0)
    ball(glow, (1.9, -0.8, 0.6), 0.35, name='Glow')
    mat, tree, output, new = nodes('Neon')
    node = new('Emission', Color=(0.2, 0.6, 1.0, 1), Strength=8.0)
    tree.links.new(node.outputs[0], output.inputs[0])
    box(mat, (1.0, 1.9, 1.0), (3.0, 0.12, 0.12), name='Neon')
    lamp('AREA', (-2, -3, 4), (-1, 0, 0), 60, size=1.5)
    camera((0, -6.5, 3.4), (0.1, 0, 0.5), 42)


def instances():
    """Copies of every kind: linked data, a collection, vertices, faces, particles, geometry nodes."""
    start((0.5, 0.6, 0.8), 0.7)
    floor(principled('Ground', (0.3, 0.4, 0.25), Roughness=0.9))
    red, blue = principled('Red', (0.7, 0.1, 0.08), Roughness=0.4), principled('Blue', (0.1, 0.2, 0.7), Roughness=0.4)
    gold = principled('Gold', (0.9, 0.65, 0.2), Metallic=1.0, Roughness=0.3)
    source = ball(red, (-3.6, -1.5, 0.25), 0.25, 16, 8, name='Source')
    for i in range(1, 6):
        ob = add('Copy%d' % i, source.data, (-3.6 + 0.7 * i, -1.5, 0.25), scale=(1, 1, 0.6 + 0.15 * i))
        if i == 3:
            ob.material_slots[0].link = 'OBJECT'
            ob.material_slots[0].material = blue
    group = bpy.data.collections.new('Tree')
    box(principled('Bark', (0.2, 0.12, 0.06)), (0, 0, 0.4), (0.16, 0.16, 0.8), name='Trunk').users_collection[0].objects.unlink(
        bpy.data.objects['Trunk'])
    group.objects.link(bpy.data.objects['Trunk'])
    crown = ball(principled('Leaves', (0.1, 0.4, 0.1), Roughness=0.8), (0, 0, 1.1), 0.45, 16, 8, name='Crown')
    bpy.context.scene.collection.objects.unlink(crown)
    group.objects.link(crown)
    for i in range(4):
        ob = add('Tree%d' % i, None, (-3 + 1.2 * i, 2.2, 0), (0, 0, 30 * i), (1 + 0.2 * i,) * 3)
        ob.instance_type = 'COLLECTION'
        ob.instance_collection = group
    ring = [(0.9 * math.cos(i * math.pi / 4), 0.9 * math.sin(i * math.pi / 4), 0) for i in range(8)]
    parent = mesh('Ring', ring, [], None, location=(-2.6, 0.3, 0.2))
    parent.instance_type = 'VERTS'
    child = box(gold, (0, 0, 0), (0.25, 0.25, 0.4), name='Bead')
    child.parent = parent
    faces = mesh('Stairs', [(i * 0.5, j * 0.9, i * 0.3) for i in range(4) for j in range(2)],
                 [(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1) for i in range(3)], None, location=(-0.6, -0.2, 0.2))
    faces.instance_type = 'FACES'
    faces.show_instancer_for_render = False
    step = box(blue, (0, 0, 0), (0.4, 0.7, 0.1), name='Step')
    step.parent = faces
    emitter = mesh('Emitter', [(-0.9, -0.9, 0), (0.9, -0.9, 0), (0.9, 0.9, 0), (-0.9, 0.9, 0)], [(0, 1, 2, 3)],
                   principled('Moss', (0.2, 0.5, 0.2)), location=(2.2, 0.3, 0.05))
    seed = box(red, (0, 0, -5), (0.1, 0.1, 0.5), name='Seed')
    emitter.modifiers.new('Seeds', 'PARTICLE_SYSTEM')
    settings = emitter.particle_systems[0].settings
    settings.type = 'HAIR'
    settings.count = 60
    settings.hair_length = 1.0
    settings.render_type = 'OBJECT'
    settings.instance_object = seed
    settings.particle_size = 0.6
    settings.size_random = 0.5
    # Geometry nodes: an instance on every point of a grid.
    base = add('Points', bpy.data.meshes.new('Points'), (1.2, 2.4, 0.25))
    tree = bpy.data.node_groups.new('Scatter', 'GeometryNodeTree')
    tree.outputs.new('NodeSocketGeometry', 'Geometry')
    grid, on, info, out = (tree.nodes.new(k) for k in ('GeometryNodeMeshGrid', 'GeometryNodeInstanceOnPoints',
                                                      'GeometryNodeObjectInfo', 'NodeGroupOutput'))
    grid.inputs['Size X'].default_value, grid.inputs['Size Y'].default_value = 2.4, 1.2
    grid.inputs['Vertices X'].default_value, grid.inputs['Vertices Y'].default_value = 6, 3
    info.inputs[0].default_value = child
    tree.links.new(grid.outputs[0], on.inputs['Points'])
    tree.links.new(info.outputs['Geometry'], on.inputs['Instance'])
    tree.links.new(on.outputs[0], out.inputs[0])
    base.modifiers.new('Scatter', 'NODES').node_group = tree
    lamp('SUN', (0, 0, 5), (2, 3, 0), 3.0, angle=math.radians(2))
    camera((0.3, -8.5, 4.6), (-0.2, 0.3, 0.4), 42)


def hair():
    """Strands: a particle system with children, in the material of its slot."""
    start((0.4, 0.45, 0.5))
    floor(principled('Ground', (0.4, 0.38, 0.35), Roughness=0.9))
    ob = ball(principled('Skin', (0.75, 0.5, 0.4), Roughness=0.6), (-0.9, 0, 1.0), 0.8, 24, 12, name='Head')
    ob.data.materials.append(principled('Fur', (0.35, 0.16, 0.05), Roughness=0.5))
    ob.modifiers.new('Fur', 'PARTICLE_SYSTEM')
    settings = ob.particle_systems[0].settings
    settings.type = 'HAIR'
    settings.count = 400
    settings.hair_length = 0.45
    settings.hair_step = 4
    settings.render_step = 3
    settings.material = 2
    settings.root_radius, settings.tip_radius, settings.radius_scale = 1.0, 0.2, 0.015
    settings.child_type = 'SIMPLE'
    settings.rendered_child_count = 4
    settings.child_radius = 0.08
    settings.roughness_2 = 0.03
    lawn = mesh('Lawn', [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2, 3)],
                principled('Grass', (0.12, 0.4, 0.06), Roughness=0.7), location=(1.3, 0, 0.02))
    lawn.modifiers.new('Grass', 'PARTICLE_SYSTEM')
    settings = lawn.particle_systems[0].settings
    settings.type = 'HAIR'
    settings.count = 900
    settings.hair_length = 0.4
    settings.brownian_factor = 0.05
    settings.root_radius, settings.tip_radius, settings.radius_scale = 1.0, 0.0, 0.012
    lamp('AREA', (-3, -4, 5), (0, 0, 0.5), 500, size=2.0)
    camera((0, -6, 2.6), (0.1, 0, 0.7), 42)


def shapes():
    """Curves, text, NURBS, metaballs and modifiers: everything that becomes a mesh when drawn."""
    start((0.5, 0.5, 0.55))
    floor(principled('Ground', (0.5, 0.48, 0.45), Roughness=0.9))
    curve = bpy.data.curves.new('Ring', 'CURVE')
    curve.dimensions = '3D'
    curve.bevel_depth = 0.08
    spline = curve.splines.new('BEZIER')
    spline.bezier_points.add(3)
    for i, point in enumerate(spline.bezier_points):
        a = i * math.pi / 2
        point.co = (0.8 * math.cos(a), 0.8 * math.sin(a), 0.3 * (-1) ** i)
        point.handle_left_type = point.handle_right_type = 'AUTO'
    spline.use_cyclic_u = True
    curve.materials.append(principled('Copper', (0.8, 0.4, 0.2), Metallic=1.0, Roughness=0.2))
    add('Ring', curve, (-2.2, 0.5, 0.7))
    font = bpy.data.curves.new('Word', 'FONT')
    font.body = 'Alidade'
    font.extrude, font.bevel_depth, font.size = 0.06, 0.015, 0.9
    font.align_x = 'CENTER'
    font.materials.append(principled('Letters', (0.1, 0.25, 0.6), Roughness=0.3))
    add('Word', font, (0, -1.4, 0.1), (75, 0, 0))
    surface = bpy.data.curves.new('Sail', 'SURFACE')
    surface.dimensions = '3D'
    for j in range(4):
        spline = surface.splines.new('NURBS')
        spline.points.add(3)
        for i, point in enumerate(spline.points):
            point.co = ((i - 1.5) * 0.5, (j - 1.5) * 0.5, 0.5 * math.sin(i + j), 1)
            point.select = True
    surface.materials.append(principled('Sail', (0.8, 0.75, 0.6), Roughness=0.6))
    sail = add('Sail', surface, (2.2, 0.6, 0.9), (30, 0, 20))
    bpy.context.view_layer.objects.active = sail
    bpy.ops.object.mode_set(mode='EDIT')
    bpy.ops.curve.make_segment()
    bpy.ops.object.mode_set(mode='OBJECT')
    for spline in surface.splines:
        spline.use_endpoint_u = spline.use_endpoint_v = True
    balls = bpy.data.metaballs.new('Drops')
    balls.resolution = balls.render_resolution = 0.06
    for x, z, r in ((-0.4, 0, 0.6), (0.3, 0.1, 0.5), (0, 0.5, 0.45)):
        element = balls.elements.new()
        element.co, element.radius = (x, 0, z), r
    balls.materials.append(principled('Drops', (0.2, 0.6, 0.4), Roughness=0.15))
    add('Drops', balls, (0, 0.8, 0.5))
    cube = box(principled('Round', (0.7, 0.2, 0.3), Roughness=0.4), (1.3, -0.2, 0.35), (0.6, 0.6, 0.6), name='Round')
    modifier = cube.modifiers.new('Bevel', 'BEVEL')
    modifier.width, modifier.segments = 0.08, 3
    modifier = cube.modifiers.new('Array', 'ARRAY')
    modifier.count = 3
    lamp('AREA', (-3, -4, 5), (0, 0, 0.5), 500, size=1.5)
    camera((0, -7, 2.8), (0, 0, 0.6), 42)


def room():
    """Indirect light: a room with coloured walls, lit by a lamp in the ceiling; a shifted camera."""
    start((0, 0, 0))
    white = principled('White', (0.75, 0.75, 0.75), Roughness=1.0, Specular=0.0)
    red = principled('Red', (0.65, 0.06, 0.05), Roughness=1.0, Specular=0.0)
    green = principled('Green', (0.1, 0.5, 0.1), Roughness=1.0, Specular=0.0)
    q = 2.0
    for name, corners, mat in (
            ('Floor', [(-q, -q, 0), (q, -q, 0), (q, q, 0), (-q, q, 0)], white),
            ('Ceiling', [(-q, -q, 4), (-q, q, 4), (q, q, 4), (q, -q, 4)], white),
            ('Back', [(-q, q, 0), (q, q, 0), (q, q, 4), (-q, q, 4)], white),
            ('Left', [(-q, -q, 0), (-q, q, 0), (-q, q, 4), (-q, -q, 4)], red),
            ('Right', [(q, -q, 0), (q, -q, 4), (q, q, 4), (q, q, 0)], green)):
        mesh(name, corners, [(0, 1, 2, 3)], mat)
    box(white, (-0.7, 0.6, 1.2), (1.1, 1.1, 2.4), name='Tall', rotation=(0, 0, 20))
    box(white, (0.75, -0.5, 0.6), (1.1, 1.1, 1.2), name='Short', rotation=(0, 0, -18))
    lamp('AREA', (0, 0, 3.98), (0, 0, 0), 60, (1, 0.9, 0.7), shape='RECTANGLE', size=1.0, size_y=0.8)
    camera((0, -8.3, 1.2), (0, 0, 1.2), 46, shift_y=0.1)


def focus():
    """A camera out of focus: near and far balls on both sides of what is sharp."""
    start((0.5, 0.55, 0.6), 0.8)
    floor(principled('Ground', (0.4, 0.4, 0.4), Roughness=0.9))
    for i in range(7):
        colour = [(0.8, 0.1, 0.1), (0.8, 0.5, 0.1), (0.6, 0.7, 0.1), (0.1, 0.6, 0.2), (0.1, 0.5, 0.7), (0.2, 0.2, 0.8),
                  (0.6, 0.1, 0.6)][i]
        ball(principled('Ball%d' % i, colour, Roughness=0.5), ((i - 3) * 0.8, (i - 3) * 1.5, 0.4), 0.4, name='Ball%d' % i)
    lamp('SUN', (0, 0, 5), (2, 3, 0), 2.0, angle=math.radians(2))
    ob = camera((0.8, -8, 1.6), (0, 0, 0.5), 60)
    ob.data.dof.use_dof = True
    ob.data.dof.focus_object = bpy.data.objects['Ball3']
    ob.data.dof.aperture_fstop = 0.3


def nodes_scene():
    """The simple shaders: diffuse, glossy, translucent, mixed by a number, by Fresnel, by a picture; added."""
    start((0.5, 0.55, 0.65), 0.7)
    floor(principled('Ground', (0.4, 0.4, 0.42), Roughness=0.9))

    def simple(name, kind, **inputs):
        mat, tree, output, new = nodes(name)
        tree.links.new(new(kind, **inputs).outputs[0], output.inputs[0])
        return mat

    def mixed(name, factor=0.5, how='MixShader', fresnel=None, image=None):
        mat, tree, output, new = nodes(name)
        a, b = new('BsdfDiffuse', Color=(0.1, 0.3, 0.7, 1)), new('BsdfGlossy', Color=(0.9, 0.9, 0.9, 1), Roughness=0.0)
        if how == 'AddShader':
            b = new('Emission', Color=(0.6, 0.1, 0.1, 1), Strength=0.5)
        mix = new(how)
        first = 1 if how == 'MixShader' else 0
        tree.links.new(a.outputs[0], mix.inputs[first])
        tree.links.new(b.outputs[0], mix.inputs[first + 1])
        if how == 'MixShader':
            mix.inputs[0].default_value = factor
        if fresnel:
            tree.links.new(new('Fresnel', IOR=fresnel).outputs[0], mix.inputs[0])
        if image:
            node = new('TexImage')
            node.image = image
            tree.links.new(node.outputs[0], mix.inputs[0])
        tree.links.new(mix.outputs[0], output.inputs[0])
        return mat
    size = 64
    y, x = np.mgrid[0:size, 0:size] / size
    stripes = picture('Stripes', np.repeat(((x * 12 + y * 6) % 1 > 0.5)[..., None], 3, 2) * 1.0, data=True)
    looks = [simple('Diffuse', 'BsdfDiffuse', Color=(0.7, 0.3, 0.1, 1)),
             simple('Glossy', 'BsdfGlossy', Color=(0.8, 0.8, 0.6, 1), Roughness=0.0),
             simple('Satin', 'BsdfGlossy', Color=(0.8, 0.7, 0.6, 1), Roughness=0.4),
             simple('Translucent', 'BsdfTranslucent', Color=(0.4, 0.7, 0.3, 1)),
             mixed('Half'), mixed('Fresnel', fresnel=1.6), mixed('Picture', image=stripes), mixed('Added', how='AddShader')]
    for i, mat in enumerate(looks):
        ball(mat, ((i % 4 - 1.5) * 1.5, (i // 4) * 1.9 - 1.0, 0.6), 0.6, name=mat.name)
    lamp('AREA', (-3, -3, 5), (0, 0, 0), 450, size=1.5)
    camera((0, -7.5, 4.0), (0, 0, 0.4), 48)


def relief():
    """Normal and bump maps, which are put into finer meshes."""
    start((0.3, 0.32, 0.36))
    size = 64
    y, x = (np.mgrid[0:size, 0:size] + 0.5) / size

    def height(x, y):
        r = np.hypot((x * 4) % 1 - 0.5, (y * 4) % 1 - 0.5)
        return np.sqrt(np.maximum(0.16 - r * r, 0)) / 0.4
    step = 1e-4
    slope = np.stack([height(x + step, y) - height(x, y), height(x, y + step) - height(x, y)], -1) / step * 0.06
    normal = np.concatenate([-slope, np.ones((size, size, 1))], -1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    normals = picture('Normals', normal * 0.5 + 0.5, data=True)
    heights = picture('Heights', np.repeat(height(x, y)[..., None], 3, 2), data=True)

    def bent(name, kind, image, to, **inputs):
        mat = principled(name, (0.5, 0.35, 0.25), Roughness=0.4)
        tree = mat.node_tree
        node, bend = tree.nodes.new('ShaderNodeTexImage'), tree.nodes.new(kind)
        node.image = image
        for key, value in inputs.items():
            bend.inputs[key].default_value = value
        tree.links.new(node.outputs[0], bend.inputs[to])
        tree.links.new(bend.outputs[0], tree.nodes['Principled BSDF'].inputs['Normal'])
        return mat
    floor(bent('Studs', 'ShaderNodeNormalMap', normals, 'Color'), 8, tiles=4)
    ball(bent('Golf', 'ShaderNodeNormalMap', normals, 'Color', Strength=1.0), (-1.2, 0, 1.0), 1.0, name='Golf')
    box(bent('Bumps', 'ShaderNodeBump', heights, 'Height', Strength=1.0, Distance=0.05), (1.2, 0, 0.8), (1.6, 1.6, 1.6),
        name='Bumps', rotation=(0, 0, 35))
    lamp('SUN', (0, 0, 5), (3, 2, 0), 2.5, angle=math.radians(1))
    camera((0, -6.5, 3.5), (0, 0, 0.6), 45)


SCENES = {'spheres': spheres, 'lamps': lamps, 'areas': areas, 'sky': sky, 'glass': glass, 'textures': textures,
          'colours': colours, 'instances': instances, 'hair': hair, 'shapes': shapes, 'room': room, 'focus': focus,
          'shaders': nodes_scene, 'relief': relief}

if __name__ == '__main__':
    try:
        which, path = sys.argv[sys.argv.index('--') + 1:]
        SCENES[which]()
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(path), compress=True)
    except Exception:
        import traceback
        traceback.print_exc()
        sys.stdout.flush()
        os._exit(1)
