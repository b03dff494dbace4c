# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the exporter writes for small scenes, one a kind of camera, lamp, node and object; and the gallery's scenes."""
import importlib
import math
import os
import re
import sys

import bpy
import numpy as np

sys.dont_write_bytecode = True
folder, work = sys.argv[sys.argv.index('--') + 1:]
sys.path[:0] = [folder, os.path.join(folder, 'gallery')]
gallery = importlib.import_module('gallery')
engine = importlib.import_module('alidade_pov.engine')
engine.register()


def check(name, good, why=''):
    print('ok ' + name if good else 'not ok %s: %s' % (name, str(why).replace('\n', ' ')[:300]))


def export(name, **settings):
    path = os.path.join(work, 'case-%s.pov' % name)
    losses = engine.export(bpy.context.scene, path, engine.Options(**settings))
    with open(path, encoding='utf-8') as file:
        return file.read(), losses


def empty():
    scene = gallery.start()
    gallery.camera((0, -5, 0), (0, 0, 0))
    return scene


def numbers(text, word):
    """The vector behind a word."""
    found = re.search(r'\b%s <([^>]*)>' % word, text)
    return np.array([float(v) for v in found.group(1).split(',')])


def close(a, b, tolerance=1e-5):
    return np.allclose(a, b, atol=tolerance)


def ramp_at(text, value):
    """The colour, to two digits, that a color_map over the angle of view has at a value."""
    found = re.search(r'\baoi color_map \{ (.*?) \}', text)
    if found is None:
        return None
    entries = re.findall(r'\[([^ ]*) rgb <([^>]*)>\]', found.group(1))
    at = [float(e[0]) for e in entries]
    rgb = np.array([[float(x) for x in e[1].split(',')] for e in entries])
    return tuple(round(float(np.interp(value, at, rgb[:, i])), 2) for i in range(3))


def has(name, text, *pieces):
    missing = [p for p in pieces if p not in text]
    check(name, not missing, 'no %s in %s' % (missing, text[-1500:]))


def cameras():
    scene = empty()
    eye = scene.camera.data
    text, _ = export('camera')
    width = 36 / 50
    check('perspective', close(numbers(text, 'direction'), (0, 1, 0)) and close(numbers(text, 'right'), (width, 0, 0))
          and close(numbers(text, 'up'), (0, 0, width * 0.75)), text)
    eye.sensor_fit, eye.sensor_height = 'VERTICAL', 24
    text, _ = export('camera-vertical')
    check('vertical sensor fit', close(numbers(text, 'up'), (0, 0, 24 / 50)))
    eye.sensor_fit = 'HORIZONTAL'
    scene.render.resolution_x, scene.render.resolution_y = 240, 320
    text, _ = export('camera-horizontal')
    check('horizontal sensor fit of a portrait', close(numbers(text, 'right'), (width, 0, 0))
          and close(numbers(text, 'up'), (0, 0, width * 4 / 3)))
    eye.sensor_fit = 'AUTO'
    text, _ = export('camera-auto')
    check('automatic fit takes the longer side', close(numbers(text, 'up'), (0, 0, width)))
    eye.shift_x, eye.shift_y = 0.1, 0.25
    text, _ = export('camera-shift')
    check('shift', close(numbers(text, 'direction'), (0.1 * width, 1, 0.25 * width)), text)
    eye.shift_x = eye.shift_y = 0
    scene.render.pixel_aspect_x = 2
    text, _ = export('camera-pixels')
    check('pixels twice as wide', close(numbers(text, 'right')[0] / numbers(text, 'up')[2], 240 * 2 / 320))
    scene.render.pixel_aspect_x = 1
    scene.render.use_border = scene.render.use_crop_to_border = True
    scene.render.border_min_x, scene.render.border_max_x = 0.5, 1.0
    text, _ = export('camera-border')
    engine.write_ini(scene, os.path.join(work, 'border.ini'))
    check('a cropped border', close(numbers(text, 'right'), (width * 0.75 / 2, 0, 0)) and numbers(text, 'direction')[0] > 0
          and 'Width=120\n' in open(os.path.join(work, 'border.ini')).read())
    scene.render.use_border = False
    eye.type, eye.ortho_scale = 'ORTHO', 4
    text, _ = export('camera-ortho')
    check('orthographic', 'orthographic' in text and close(numbers(text, 'up'), (0, 0, 4))
          and close(numbers(text, 'right'), (3, 0, 0)))
    eye.type = 'PANO'
    eye.cycles.panorama_type = 'EQUIRECTANGULAR'
    text, _ = export('camera-sphere')
    has('equirectangular', text, 'spherical', 'angle 360 180')
    eye.cycles.panorama_type, eye.cycles.fisheye_fov = 'FISHEYE_EQUIDISTANT', math.pi
    text, _ = export('camera-fisheye')
    has('fisheye', text, 'fisheye', 'angle 180')
    eye.cycles.panorama_type = 'MIRRORBALL'
    _, losses = export('camera-mirrorball')
    check('a mirror ball is lost', any('Panorama Type' in l for l in losses.lost_lines()))
    eye.type = 'PERSP'
    eye.dof.use_dof, eye.dof.focus_distance, eye.dof.aperture_fstop = True, 3, 2
    text, _ = export('camera-focus')
    check('focus', close(numbers(text, 'focal_point'), (0, -2, 0)) and 'aperture' in text)


def lamps():
    def lamp(kind, **settings):
        scene = empty()
        ob = gallery.lamp(kind, (0, 0, 3), (0, 0, 0), **settings)
        text, losses = export('lamp-%s-%d' % (kind.lower(), lamp.count))
        lamp.count += 1
        return text[text.index('light_source'):text.index('\n}\n', text.index('light_source'))], losses, scene, ob
    lamp.count = 0
    text, _, _, _ = lamp('POINT', energy=100, shadow_soft_size=0)
    colour = np.array([float(v) for v in re.search(r'rgb <([^>]*)>', text).group(1).split(',')])
    check('a point lamp of 100 W is 100 / (4 pi^2 d^2)', close(colour * 2e-6 / 4, 100 / (16 * math.pi ** 2), 1e-5), colour)
    has('with the inverse square', text, 'fade_power 2')
    check('a point lamp without size casts hard shadows', 'area_light' not in text)
    text, _, _, _ = lamp('POINT', energy=100, shadow_soft_size=0.5)
    has('a ball is soft from all sides', text, 'area_light <1,0,0>, <0,1,0>', 'circular orient', 'area_illumination')
    text, _, _, _ = lamp('SUN', energy=math.pi, angle=0)
    has('a hard sun', text, 'parallel', 'rgb <1,1,1>')
    check('has no falloff', 'fade' not in text)
    text, _, _, _ = lamp('SUN', angle=0.1)
    has('a sun with an angle', text, 'area_light', 'orient')
    text, _, _, _ = lamp('SPOT', spot_size=math.radians(60), spot_blend=1, shadow_soft_size=0)
    has('a spot', text, 'spotlight', 'falloff 30', 'radius 0.001', 'tightness 1', 'point_at')
    text, _, _, _ = lamp('AREA', size=2)
    has('a square lamp', text, 'spotlight radius 90 falloff 90 tightness 1', 'area_light')
    check('is not round', 'circular' not in text)
    text, _, _, _ = lamp('AREA', size=2, shape='DISK')
    has('a disk lamp', text, 'circular')
    text, losses, _, _ = lamp('AREA', size=2, spread=1.0)
    check('a narrowed lamp is told', any('Spread' in l for l in losses.nearest_lines()) and 'falloff 28.6' in text, text)
    text, _, scene, ob = lamp('POINT', shadow_soft_size=0)
    ob.data.use_nodes = True
    ob.data.node_tree.nodes['Emission'].inputs['Strength'].default_value = 3
    stronger, _ = export('lamp-nodes')
    before = float(re.search(r'rgb <([^,>]*)', text).group(1))
    after = float(re.search(r'light_source \{[^}]*?rgb <([^,>]*)', stronger).group(1))
    check('a lamp\'s nodes', close(after / before, 3))
    scene.view_settings.exposure = 1
    brighter, _ = export('lamp-exposure')
    check('the view\'s exposure', close(float(re.search(r'light_source \{[^}]*?rgb <([^,>]*)', brighter).group(1)) / after, 2))
    ob.data.cycles.cast_shadow = False
    has('a lamp without shadows', export('lamp-shadowless')[0], 'shadowless')


def on_ball(build, name):
    """Export a ball with a material that build(new, tree, output) makes."""
    empty()
    mat, tree, output, new = gallery.nodes('Mat')
    build(new, tree, output)
    gallery.ball(mat, segments=8, rings=4)
    text, losses = export(name)
    start = text.find('#declare T_Mat')
    return text[start:text.index('#declare M_', max(start, 0))] if start >= 0 else text, losses, text


def shader(kind, **inputs):
    def build(new, tree, output):
        tree.links.new(new(kind, **inputs).outputs[0], output.inputs[0])
    return on_ball(build, 'shader-' + kind.lower() + '-'.join(str(len(k)) for k in inputs))


def materials():
    text, _, _ = shader('BsdfDiffuse', Color=(0.5, 0.25, 0.125, 1))
    has('diffuse', text, 'pigment { rgb <0.5,0.25,0.125> }', 'diffuse 1')
    text, _, _ = shader('BsdfGlossy', Color=(0.5, 0.25, 0.125, 1), Roughness=0.0)
    has('glossy', text, 'reflection { rgb <0.5,0.25,0.125> }', 'diffuse 0')
    text, _, _ = shader('BsdfGlass', Color=(1, 0.5, 0.5, 1), Roughness=0.0, IOR=1.3)
    has('glass', text, 'rgbf <1,0.5,0.5,1>', 'fresnel', 'conserve_energy')
    has('its interior is the mesh\'s', shader('BsdfGlass', IOR=1.3)[2], 'interior { ior 1.3 }')
    text, _, _ = shader('BsdfTransparent', Color=(1, 0.5, 0.5, 1))
    has('transparent', text, 'rgbf <1,0.5,0.5,1>')
    text, _, _ = shader('BsdfTranslucent', Color=(0.5, 0.5, 0.5, 1))
    has('translucent', text, 'diffuse 0, 1')
    text, _, _ = shader('Emission', Color=(1, 0.5, 0, 1), Strength=4.0)
    has('emission', text, 'pigment { rgb <1,0.5,0> }', 'emission rgb <4,4,0>')
    text, _, _ = shader('BsdfPrincipled', Base_Color=(0.5, 0.5, 0.5, 1), Roughness=0.0, Specular=0.5)
    has('Principled reflects by Schlick\'s formula', text, 'reflection { rgb <0.04,0.04,0.04>, rgb <1,1,1> falloff 5 }')
    text, _, _ = shader('BsdfPrincipled', Base_Color=(0.5, 0.5, 0.5, 1), Alpha=0.25, Specular=0.0)
    has('alpha', text, 'rgbt <0.5,0.5,0.5,0.75>')
    text, _, _ = shader('BsdfPrincipled', Base_Color=(0.5, 0.25, 0.5, 1), Emission=(1, 1, 1, 1), Emission_Strength=2.0,
                         Specular=0.0)
    has('emission beside a colour', text, 'emission rgb <4,8,4>')
    text, _, _ = shader('BsdfPrincipled', Base_Color=(0.8, 0.4, 0.2, 1), Metallic=1.0, Roughness=0.6)
    has('a rough metal keeps its colour for highlights', text, 'pigment { rgb <0.8,0.4,0.2> }', 'metallic')

    def glow(new, tree, output):
        add = new('AddShader')
        tree.links.new(new('BsdfTransparent').outputs[0], add.inputs[0])
        tree.links.new(new('Emission', Strength=0.1).outputs[0], add.inputs[1])
        tree.links.new(add.outputs[0], output.inputs[0])
    has('what glows and is clear', on_ball(glow, 'glow')[0], 'rgbf <1,1,1,0.98>', 'emission rgb <5,5,5>')
    _, losses, _ = shader('BsdfPrincipled', Sheen=1.0)
    check('sheen is lost', losses.lost_lines() == ['Mat, Sheen, Principled BSDF: left out'], losses.lost_lines())
    _, losses, _ = shader('BsdfToon')
    check('toon is lost', any(l.startswith('Mat, Size, Toon BSDF') for l in losses.lost_lines()))

    def mixed(new, tree, output):
        mix = new('MixShader', Fac=0.25)
        tree.links.new(new('BsdfDiffuse', Color=(1, 0, 0, 1)).outputs[0], mix.inputs[1])
        tree.links.new(new('BsdfDiffuse', Color=(0, 0, 1, 1)).outputs[0], mix.inputs[2])
        tree.links.new(mix.outputs[0], output.inputs[0])
    has('mixed by a number', on_ball(mixed, 'mix')[0], 'pigment { rgb <0.75,0,0.25> }')

    def grouped(new, tree, output):
        inner = bpy.data.node_groups.new('Inner', 'ShaderNodeTree')
        inner.inputs.new('NodeSocketColor', 'Paint').default_value = (0, 0, 0, 1)
        inner.outputs.new('NodeSocketShader', 'Surface')
        source, sink = inner.nodes.new('NodeGroupInput'), inner.nodes.new('NodeGroupOutput')
        diffuse = inner.nodes.new('ShaderNodeBsdfDiffuse')
        inner.links.new(source.outputs[0], diffuse.inputs[0])
        inner.links.new(diffuse.outputs[0], sink.inputs[0])
        group = tree.nodes.new('ShaderNodeGroup')
        group.node_tree = inner
        group.inputs[0].default_value = (0.5, 1, 0.25, 1)
        reroute = tree.nodes.new('NodeReroute')
        tree.links.new(group.outputs[0], reroute.inputs[0])
        tree.links.new(reroute.outputs[0], output.inputs[0])
    has('groups and reroutes', on_ball(grouped, 'group')[0], 'pigment { rgb <0.5,1,0.25> }')


def colour_nodes():
    def result(kind, name='Color', prepare=None, **inputs):
        def build(new, tree, output):
            node = new(kind)
            for key, value in inputs.items():
                key = int(key[1:]) if re.match(r'_\d$', key) else key.replace('_', ' ')
                node.inputs[key].default_value = value
            if prepare:
                prepare(node)
            emission = new('Emission')
            tree.links.new(node.outputs[0], emission.inputs[0])
            tree.links.new(emission.outputs[0], output.inputs[0])
        text = on_ball(build, 'node-' + kind.lower())[0]
        pigment = np.array([float(v) for v in re.search(r'rgb <([^>]*)>', text).group(1).split(',')])
        strength = re.search(r'emission rgb <([^>]*)>', text)
        return pigment * np.array([float(v) for v in strength.group(1).split(',')]) if strength else pigment * 0

    def check_node(kind, want, tolerance=2e-3, **more):
        got = result(kind, **more)
        check('node %s' % kind, close(got, want, tolerance), '%s, not %s' % (got, want))
    check_node('MixRGB', (0.5, 0.25, 0.125), prepare=lambda n: setattr(n, 'blend_type', 'MULTIPLY'), Fac=1.0,
               Color1=(1, 0.5, 0.5, 1), Color2=(0.5, 0.5, 0.25, 1))
    check_node('Gamma', (0.25, 0.0625, 1), Color=(0.5, 0.25, 1, 1), Gamma=2.0)
    check_node('Invert', (0.75, 0.5, 0.1), Color=(0.25, 0.5, 0.9, 1), Fac=1.0)
    check_node('BrightContrast', (0.6, 0.35, 0.2), Color=(0.5, 0.25, 0.1, 1), Bright=0.1, Contrast=0.0)
    check_node('HueSaturation', (0.1, 0.8, 0.1), Color=(0.8, 0.1, 0.1, 1), Hue=0.5 + 1 / 3)
    check_node('RGBToBW', (0.2126, 0.2126, 0.2126), Color=(1, 0, 0, 1))
    check_node('Math', (0.5, 0.5, 0.5), _0=0.2, _1=0.3)
    check_node('CombineRGB', (0.1, 0.2, 0.3), R=0.1, G=0.2, B=0.3)
    check_node('CombineHSV', (0, 1, 0), H=1 / 3, S=1.0, V=1.0)
    check_node('MapRange', (0.5, 0.5, 0.5), Value=1.0, From_Min=0.0, From_Max=2.0, To_Min=0.0, To_Max=1.0)
    check_node('ValToRGB', (0.25, 0.25, 0.25), Fac=0.25)
    check_node('RGBCurve', (0.2, 0.4, 0.6), Color=(0.2, 0.4, 0.6, 1))
    check_node('Clamp', (1, 1, 1), Value=3.0)
    warm = result('Blackbody', Temperature=3000.0)
    check('node Blackbody', warm[0] > warm[1] > warm[2] and abs(warm @ np.array([0.2126, 0.7152, 0.0722]) - 1) < 0.05, warm)


def images():
    image_of = lambda: gallery.tiles(size=16)     # noqa: E731

    def textured(name, between=None, prepare=None):
        def build(new, tree, output):
            node, bsdf = new('TexImage'), new('BsdfDiffuse')
            node.image = image_of()
            out = node.outputs[0]
            if prepare:
                prepare(new, tree, node)
            if between:
                out = between(new, tree, out)
            tree.links.new(out, bsdf.inputs[0])
            tree.links.new(bsdf.outputs[0], output.inputs[0])
        return on_ball(build, name)
    text, losses, whole = textured('image')
    has('an image', text, 'uv_mapping image_map { png "case-image-pictures/Tiles.png" interpolate 2 }')
    has('brings the mesh\'s UV map', whole, 'uv_vectors')
    check('and loses nothing', not losses.lost_lines(), losses.lost_lines())

    def scaled(new, tree, node):
        mapping, uv = new('Mapping', Scale=(4, 2, 1)), new('UVMap')
        uv.uv_map = 'UVMap'
        tree.links.new(uv.outputs[0], mapping.inputs[0])
        tree.links.new(mapping.outputs[0], node.inputs[0])
    has('a mapping', textured('image-scaled', prepare=scaled)[0], 'matrix <0.25,0,0,0,0.5,0,0,0,1,0,0,0>')

    def inverted(new, tree, out):
        node = new('Invert')
        tree.links.new(out, node.inputs['Color'])
        return node.outputs[0]
    text, losses, _ = textured('image-inverted', between=inverted)
    has('an image behind a node is computed', text, '"case-image-inverted-pictures/Mat-diffuse.png"')
    has('closest pixels', textured('image-closest', prepare=lambda new, tree, node: setattr(node, 'interpolation', 'Closest'))[0],
        'Tiles.png" }')

    def bent(new, tree, output):
        node, bend, bsdf = new('TexImage'), new('NormalMap', Strength=1.0), new('BsdfDiffuse')
        size = 8
        node.image = gallery.picture('Slope', np.tile([0.5 + 0.5 * 0.6, 0.5, 0.5 + 0.5 * 0.8], (size, size, 1)), data=True)
        tree.links.new(node.outputs[0], bend.inputs['Color'])
        tree.links.new(bend.outputs[0], bsdf.inputs['Normal'])
        tree.links.new(bsdf.outputs[0], output.inputs[0])
    empty()
    mat, tree, output, new = gallery.nodes('Bent')
    bent(new, tree, output)
    gallery.floor(mat, size=2)
    text, losses = export('relief')
    normals = re.search(r'normal_vectors \{\n(\d+),\n<([^>]*)>', text)
    check('a normal map bends the corners of a finer mesh', normals is not None and close(
        [float(v) for v in normals.group(2).split(',')], (0.6, 0, 0.8), 0.01) and not losses.lost_lines(), text[-800:])
    check('as fine as the picture asks for', re.search(r'face_indices \{\n128,', text) is not None, text[:1500])
    text, losses = export('relief-off', relief=0)
    check('or is lost', any('Normal Map' in l for l in losses.lost_lines()) and re.search(r'face_indices \{\n2,', text))

    def checker(new, tree, output):
        node, bsdf = new('TexChecker', Scale=4.0), new('BsdfDiffuse')
        tree.links.new(new('TexCoord').outputs['Object'], node.inputs[0])
        tree.links.new(node.outputs[0], bsdf.inputs[0])
        tree.links.new(bsdf.outputs[0], output.inputs[0])
    has('a checker is a checker', on_ball(checker, 'checker')[0], 'checker rgb', 'matrix <0.25,')

    def noise(new, tree, output):
        node, bsdf = new('TexNoise'), new('BsdfDiffuse')
        tree.links.new(node.outputs['Fac'], bsdf.inputs[0])
        tree.links.new(bsdf.outputs[0], output.inputs[0])
    _, losses, whole = on_ball(noise, 'noise')
    check('noise is another noise, and told', any('Noise Texture' in l for l in losses.lost_lines()) and 'bozo' in whole)
    has('Generated coordinates run over the mesh', whole, 'scale <2,2,2> translate <-1,-1,-1>')


def objects():
    scene = empty()
    box = gallery.box(gallery.principled('A'))
    gallery.add('Again', box.data, (1, 2, 3), scale=(1, 2, 1))
    text, _ = export('shared')
    check('one mesh2 for shared data', text.count('mesh2 {') == 1 and text.count('object { M_Box') == 2)
    has('placed', text, 'matrix <1,0,0,0,2,0,0,0,1,1,2,3>')
    box.hide_render = True
    text, _ = export('hidden')
    check('what is not rendered is not written', text.count('object {') == 1)
    box.hide_render, box.hide_viewport = False, True
    text, _ = export('viewport')
    check('what only the viewport hides is', text.count('object {') == 2)
    modifier = box.modifiers.new('Subdivision', 'SUBSURF')
    modifier.levels, modifier.render_levels = 0, 2
    text, _ = export('levels')
    check('modifiers have their render levels', re.search(r'vertex_vectors \{\n(\d+)', text).group(1) == '98', text[:1500])
    box.modifiers.clear()
    box.data.materials.append(gallery.principled('B', (0.1, 0.2, 0.3)))
    box.data.polygons[0].material_index = 1
    text, _ = export('slots')
    has('two materials', text, 'texture_list {\n2,\ntexture { T_A }\ntexture { T_B }\n}', ',1,\n', ',0,\n')
    box.data.materials[1] = gallery.principled('Glass', Transmission=1.0, Roughness=0.0)
    text, _ = export('interiors')
    check('glass is a mesh of its own', text.count('mesh2 {') == 2 and text.count('interior {') == 1)
    box.data.polygons[2].use_smooth = True
    text, _ = export('smooth')
    check('only smooth faces have normals', len(re.findall(r'normal_indices \{\n2,', text)) == 1, text)
    nan = gallery.mesh('Broken', [(float('nan'), 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    text, losses = export('nan')
    check('no NaN reaches the file', 'nan' not in text.lower().replace('m_broken', '') and any('Broken' in l for l in losses.nearest_lines()))
    bpy.data.objects.remove(nan)
    lawn = gallery.floor(gallery.principled('Grass'), size=1, name='Lawn')
    lawn.modifiers.new('Grass', 'PARTICLE_SYSTEM')
    settings = lawn.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length, settings.render_step = 'HAIR', 1, 1.0, 1
    settings.root_radius, settings.tip_radius, settings.radius_scale = 1.0, 1.0, 0.2
    text, _ = export('hair')
    block = text[text.index('#declare M_Lawn_20_'):]
    rows = np.array([[float(v) for v in m.split(',')] for m in re.findall(r'\n<([^>]*)>', block[:block.index('}')])])
    wide = np.linalg.norm(rows[:4, :2] - rows[:4, :2].mean(axis=0), axis=1)
    check('a strand is half as wide in radius as its setting says', close(wide, 0.1 * (math.pi / 2) ** 0.5, 1e-3), rows[:4])
    bpy.data.objects.remove(lawn)
    volume = bpy.data.objects.new('Smoke', bpy.data.volumes.new('Smoke'))
    scene.collection.objects.link(volume)
    _, losses = export('volume')
    check('volumes are lost', any(l.startswith('Smoke, -, -') for l in losses.lost_lines()), losses.lost_lines())


def seen():
    """What rays see, what a camera clips, and what is left of a picture's afterlife."""
    scene = empty()
    ball = gallery.ball(gallery.principled('A'), segments=8, rings=4)
    ball.visible_camera = ball.visible_shadow = False
    has('hidden from camera and shadow rays', export('rays')[0], 'object { M_Ball no_image no_shadow }')
    ball.visible_camera = ball.visible_shadow = True
    group = bpy.data.collections.new('Group')
    scene.collection.children.link(group)
    scene.collection.objects.unlink(ball)
    group.objects.link(ball)
    in_layer = bpy.context.view_layer.layer_collection.children['Group']
    in_layer.holdout = True
    _, losses = export('holdout')
    check('a collection that holds out is lost', losses.lost_lines() == [
        'Ball, Holdout, -: a hole in the picture\'s alpha; drawn as it is'], losses.lost_lines())
    in_layer.holdout, in_layer.indirect_only = False, True
    has('one of indirect light only', export('indirect-only')[0], 'object { M_Ball no_image }')
    in_layer.indirect_only = False
    bpy.context.view_layer.material_override = gallery.principled('Clay', (0.1, 0.2, 0.3))
    text, _ = export('override')
    check('a view layer\'s material overrides all', 'texture { T_Clay }' in text and 'T_A' not in text, text)
    bpy.context.view_layer.material_override = None
    eye = scene.camera.data
    eye.clip_end = 5.5
    check('what is beyond the clip end is told', export('clip')[1].lost_lines() == [
        'Camera, Clip End, -: what lies farther is drawn'])
    eye.clip_start, eye.clip_end = 4.5, 100
    check('and what is before its start', export('clip-start')[1].lost_lines() == [
        'Camera, Clip Start, -: what lies nearer is drawn'])
    eye.clip_start = 0.1
    before, _ = export('film')
    scene.cycles.film_exposure = 2
    after, _ = export('film-brighter')
    check('Cycles\' exposure', close(numbers(after, 'background { rgb'), 2 * numbers(before, 'background { rgb')))
    scene.cycles.film_exposure = 1
    scene.use_nodes = True
    scene.node_tree.nodes.new('CompositorNodeGlare')
    sketch = gallery.add('Sketch', bpy.data.grease_pencils.new('Sketch'))
    lines = export('afterwards')[1].lost_lines()
    check('compositing and grease pencil are lost', [l.split(':')[0] for l in lines] == [
        'Scene, Compositing, Glare', 'Sketch, -, -'], lines)
    bpy.data.objects.remove(sketch)


def attributes():
    """Whatever geometry nodes or people store under a name."""
    def painted(name, kind, domain, values, field, output='Color'):
        empty()
        mat, tree, out, new = gallery.nodes('Mat')
        node, glow = new('Attribute'), new('BsdfDiffuse')
        node.attribute_name = name
        tree.links.new(node.outputs[output], glow.inputs[0])
        tree.links.new(glow.outputs[0], out.inputs[0])
        ob = gallery.mesh('Two', [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)], mat)
        ob.data.uv_layers.new(name='UVMap').data.foreach_set('uv', [0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1])
        if kind:
            ob.data.attributes.new(name, kind, domain).data.foreach_set(field, values)
        text, losses = export('attribute-%s-%s' % (kind, domain))
        return {tuple(np.round([float(v) for v in m.split(',')], 2)) for m in re.findall(r'pigment \{ rgb <([^>]*)>', text)}, losses
    found, losses = painted('heat', 'FLOAT', 'POINT', [0, 0.25, 0.5, 1], 'value', 'Fac')
    check('a number at vertices', close(sorted(f[0] for f in found), (0, 0.25, 0.5, 1), 0.01) and not losses.lost_lines(), found)
    found, _ = painted('side', 'FLOAT', 'FACE', [0.25, 0.5], 'value', 'Fac')
    check('a number at faces', close(sorted(f[0] for f in found), (0.25, 0.5), 0.01), found)
    found, _ = painted('place', 'FLOAT_VECTOR', 'CORNER', [0.25, 0.5, 0] * 6, 'vector')
    check('a vector at corners', len(found) == 1 and close(found.pop(), (0.25, 0.5, 0), 0.01))
    found, _ = painted('on', 'BOOLEAN', 'FACE', [False, True], 'value', 'Fac')
    check('yes and no', sorted(found) == [(0, 0, 0), (1, 1, 1)], found)
    found, _ = painted('UVMap', None, None, None, None)
    check('a UV map', sorted(found) == [(0, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0)], found)
    _, losses = painted('nothing', None, None, None, None)
    check('what is not there is told', any('nothing' in l for l in losses.lost_lines()))


def textures():
    def into_diffuse(build):
        def whole(new, tree, output):
            bsdf = new('BsdfDiffuse')
            tree.links.new(build(new, tree), bsdf.inputs[0])
            tree.links.new(bsdf.outputs[0], output.inputs[0])
        return whole

    def ramp(new, tree):
        part = new('SeparateXYZ')
        tree.links.new(new('TexCoord').outputs['Generated'], part.inputs[0])
        return part.outputs[2]
    text, losses, _ = on_ball(into_diffuse(ramp), 'axis')
    has('one axis of Generated is a gradient', text, 'gradient z color_map { [0.5 rgb <0,0,0>] [0.515625 rgb <1,1,1>] } '
        'scale 64 translate -32*z')
    check('and nothing is lost', not losses.lost_lines(), losses.lost_lines())

    def linear(new, tree):
        return new('TexGradient').outputs[0]
    has('a linear gradient ends where it ends', on_ball(into_diffuse(linear), 'linear')[0],
        'gradient x color_map { [0.5 rgb <0,0,0>] [0.515625 rgb <1,1,1>] } matrix <64,0,0,0,64,0,0,0,64,-32,')

    def bricks(new, tree):
        node = new('TexBrick', Scale=4.0, Color1=(1, 0, 0, 1), Color2=(1, 0, 0, 1), Mortar=(0, 0, 1, 1))
        tree.links.new(new('TexCoord').outputs['UV'], node.inputs[0])
        return node.outputs[0]
    text, losses, _ = on_ball(into_diffuse(bricks), 'bricks')
    has('bricks are computed', text, 'uv_mapping image_map', 'case-bricks-pictures/Mat-diffuse.png')
    values = importlib.import_module('alidade_pov.values')
    tree = bpy.data.materials['Mat'].node_tree
    node = next(n for n in tree.nodes if n.bl_idname == 'ShaderNodeTexBrick')
    node.inputs['Color2'].default_value = (0, 1, 0, 1)
    # In Cycles' picture of these bricks: rows 0 and 1 of a map of 20 rows, red of brick 1 to 3.
    at = np.array([[x, y, 0] for y, x in ((0.025, 0.11), (0.025, 0.21), (0.075, 0.16), (0.075, 0.26))]) * 1.25
    points = values.Points(len(at), coordinates={'uv:': at})
    red = values.Tree(None, '-').node_TexBrick(values.Place(node, node.outputs[0]), points)[:, 0]
    check('with Cycles\' tints', close(red, (0.9225, 0.9375, 0.89125, 0.70625), 2e-3), red)

    def voronoi(new, tree):
        return new('TexVoronoi').outputs['Color']
    text, losses, _ = on_ball(into_diffuse(voronoi), 'cells')
    check('cells have colours of their own', 'crackle solid' in text and any('Voronoi' in l for l in losses.lost_lines()), text)

    def path(new, tree, output):
        mix, node = new('MixShader'), new('LightPath')
        tree.links.new(node.outputs['Is Shadow Ray'], mix.inputs[0])
        tree.links.new(new('BsdfGlass', Roughness=0.0).outputs[0], mix.inputs[1])
        tree.links.new(new('BsdfTransparent').outputs[0], mix.inputs[2])
        tree.links.new(mix.outputs[0], output.inputs[0])
    text, losses, _ = on_ball(path, 'light-path')
    check('light paths: what the camera sees, and told', 'rgbf <1,1,1,1>' in text and any('Light Path' in l for l in losses.lost_lines()),
          (text, losses.lost_lines()))

    def facing(new, tree, output):
        mix, node = new('MixShader'), new('LayerWeight', Blend=0.5)
        tree.links.new(node.outputs['Facing'], mix.inputs[0])
        tree.links.new(new('BsdfDiffuse', Color=(1, 0, 0, 1)).outputs[0], mix.inputs[1])
        tree.links.new(new('BsdfDiffuse', Color=(0, 0, 1, 1)).outputs[0], mix.inputs[2])
        tree.links.new(mix.outputs[0], output.inputs[0])
    text, losses, _ = on_ball(facing, 'facing')
    # Seen from the front the first shader, from the side the second, of 1 - cos between: 0.75 of it at acos(0.25).
    check('facing mixes by the angle of view', ramp_at(text, 1 - math.acos(0.25) / math.pi) == (0.75, 0.75, 0.75)
          and ramp_at(text, 1) == (0, 0, 0) and not losses.lost_lines(), (text, losses.lost_lines()))

    def film(new, tree):
        ramp, node = new('MixRGB', Color1=(1, 0, 0, 1), Color2=(0, 0, 1, 1)), new('Fresnel', IOR=1.5)
        tree.links.new(node.outputs[0], ramp.inputs[0])
        return ramp.outputs[0]
    text, losses, _ = on_ball(into_diffuse(film), 'film')
    check('colours by Fresnel too: 0.04 from the front, 1 from the side', ramp_at(text, 1) == (0.96, 0, 0.04)
          and ramp_at(text, 0.5) == (0, 0, 1) and not losses.lost_lines(), (text, losses.lost_lines()))

    def facing_dot(new, tree, output):
        mix, dot, node = new('MixShader'), new('VectorMath'), new('NewGeometry')
        dot.operation = 'DOT_PRODUCT'
        tree.links.new(node.outputs['Incoming'], dot.inputs[0])
        tree.links.new(node.outputs['Normal'], dot.inputs[1])
        tree.links.new(dot.outputs['Value'], mix.inputs[0])
        tree.links.new(new('BsdfRefraction', Color=(1, 0.5, 1, 1), IOR=0.0).outputs[0], mix.inputs[1])
        tree.links.new(new('BsdfDiffuse', Color=(0, 0, 1, 1)).outputs[0], mix.inputs[2])
        tree.links.new(mix.outputs[0], output.inputs[0])
    text, losses, whole = on_ball(facing_dot, 'facing-dot')
    check('and by the product of Incoming and Normal', ramp_at(text, 1) == (1, 1, 1) and ramp_at(text, 0.5) == (0, 0, 0),
          (text, losses.lost_lines()))
    check('refraction has no reflection of its own, and an index as in Cycles', 'rgbf <1,0.5,1,1>' in text
          and 'reflection' not in text and re.search(r'interior \{ ior (1e-05|0.00001) \}', whole), whole)

    def stained(new, tree, output):
        node, mix, film = new('BsdfTransparent'), new('MixRGB', Color1=(1, 0, 0, 1), Color2=(0, 0, 1, 1)), new('LayerWeight')
        tree.links.new(film.outputs['Facing'], mix.inputs[0])
        tree.links.new(mix.outputs[0], node.inputs[0])
        tree.links.new(node.outputs[0], output.inputs[0])
    text, losses, _ = on_ball(stained, 'stained')
    check('what is transparent in a colour that varies filters by it', '[1 rgbf <1,0,0,1>]' in text and not losses.lost_lines(),
          (text, losses.lost_lines()))
    _, losses, _ = shader('BsdfPrincipled', Specular_Tint=0.5)
    check('a tint of specular is lost', losses.lost_lines() == ['Mat, Specular Tint, Principled BSDF: left out'])
    _, losses, _ = shader('BsdfAnisotropic', Anisotropy=0.5)
    check('anisotropy too', losses.lost_lines() == ['Mat, Anisotropy, Anisotropic BSDF: left out'], losses.lost_lines())

    # Images of several files
    folder = os.path.join(work, 'files')
    os.makedirs(folder, exist_ok=True)
    for number, name in ((1, 'seq0001'), (2, 'seq0002'), (3, 'u.1001'), (4, 'u.1002')):
        image = gallery.picture('x', np.full((4, 4, 3), number / 4))
        image.filepath_raw, image.file_format = os.path.join(folder, name + '.png'), 'PNG'
        image.save()

    def image_of(file, source):
        def build(new, tree):
            node = new('TexImage')
            node.image = bpy.data.images.load(os.path.join(folder, file))
            node.image.source = source
            if source == 'TILED':
                node.image.tiles.new(1002)
            node.image_user.frame_duration = 2
            return node.outputs[0]
        return build
    empty()
    mat, tree, output, new = gallery.nodes('Mat')
    into_diffuse(image_of('seq0001.png', 'SEQUENCE'))(new, tree, output)
    gallery.ball(mat, segments=8, rings=4)
    bpy.context.scene.frame_set(2)
    text, losses = export('sequence')
    written = re.search(r'image_map \{ png "([^"]*)"', text)
    same = written and bpy.data.images.load(os.path.join(work, written.group(1)))
    check('an image sequence shows its frame', same and abs(same.pixels[0] - 0.5) < 0.01 and not losses.lost_lines(),
          (text[-900:], losses.lost_lines()))
    _, losses, _ = on_ball(into_diffuse(image_of('u.1001.png', 'TILED')), 'tiles')
    check('tiles of an image are told', any('UDIM' in l for l in losses.lost_lines()), losses.lost_lines())


def worlds():
    scene = empty()
    text, _ = export('world')
    has('a colour', text, 'background { rgb <0.05,0.05,0.05> }')
    sky = scene.world.node_tree.nodes.new('ShaderNodeTexGradient')
    scene.world.node_tree.links.new(sky.outputs[0], scene.world.node_tree.nodes['Background'].inputs[0])
    text, losses = export('world-gradient')
    has('nodes become a picture', text, 'sky_sphere', 'hdr "case-world-gradient-pictures/world-World.hdr" map_type 1')
    check('and nothing is lost', not losses.lost_lines())
    scene.world.node_tree.nodes['Background'].inputs[1].default_value = 0


def strict_file():
    """A file for the command line's tests: it moves, and holds something that cannot be said."""
    scene = empty()
    mat, tree, output, new = gallery.nodes('Fog')
    tree.links.new(new('BsdfDiffuse').outputs[0], output.inputs[0])
    tree.links.new(new('VolumeScatter').outputs[0], output.inputs[1])
    ob = gallery.ball(mat, segments=8, rings=4)
    for frame in (1, 3):
        ob.location.x = frame
        ob.keyframe_insert('location', frame=frame)
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(work, 'cases.blend'))


try:
    for part in (cameras, lamps, materials, colour_nodes, images, textures, attributes, objects, seen, worlds, strict_file):
        part()
    for name in gallery.SCENES:
        gallery.SCENES[name]()
        path = os.path.join(work, 'gallery-%s.pov' % name)
        losses = engine.export(bpy.context.scene, path, engine.Options(strict=True, lamp_grid=1, blur_samples=4))
        check('gallery %s loses nothing' % name, not losses.lost_lines())
    print('done')
except Exception:
    import traceback
    traceback.print_exc()
