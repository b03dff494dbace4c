# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The exporter's parts that need no Blender: numbers as text, pictures, and what differs between versions."""
import importlib
import io
import os
import struct
import sys
import tempfile
import types
import zlib

import numpy as np

sys.path.insert(0, sys.argv[1])
text, pictures, versions, geometry, images, visible, lossy, relief, materials, paints, trees = (importlib.import_module('alidade_pov.' + n) for n in (
    'text', 'pictures', 'versions', 'geometry', 'images', 'visible', 'losses', 'relief', 'materials',
    'paints', 'values'))


def check(name, good, why=''):
    print('ok ' + name if good else 'not ok %s: %s' % (name, why))


random = np.random.RandomState(1)
special = [0, -0.0, 1, -1, 0.1, 0.5, 100, 999999.9, 1e9, 123456789, 1e-30, 9.9999999, 0.99999999, 1e-6, 1e-7, 0.001,
           3.4e38, 1.2e-38, 1e-45, 16777216, 16777217, 33554431, 0.3333333333]
values = np.concatenate([random.normal(size=20000), 10.0 ** random.uniform(-30, 30, 20000)
                         * random.choice([-1, 1], 20000), special]).astype(np.float32)
texts = [bytes(row).replace(b'\0', b'').decode() for row in text.tokens(values)]
wrong = [(t, v) for t, v in zip(texts, values) if np.float32(t) != v]
check('numbers read back as the same 32-bit floats', not wrong, wrong[:3])
longer = [(t, np.format_float_scientific(v)) for t, v in zip(texts, values)
          if len(t.replace('.', '').replace('-', '').split('e')[0].strip('0'))
          > len(np.format_float_scientific(v, trim='-').replace('.', '').replace('-', '').split('e')[0].strip('0'))]
check('with hardly ever a digit more than needed', len(longer) < len(values) / 200, (len(longer), len(values)))
check('and as people write them', [text.number(v) for v in (0.5, 100, -0.25, 1e-9, 0)] == ['0.5', '100', '-0.25', '1e-9', '0'])
out = io.BytesIO()
text.write_vectors(out, np.array([[1, 2.5, -3], [0, 0.1, 1e10]], np.float32))
check('vectors', out.getvalue() == b'<1,2.5,-3>,\n<0,0.1,1e10>\n', out.getvalue())
out = io.BytesIO()
text.Integers(1234567).write(out, np.array([[0, 10, 1234567], [999, 1000, 1001]]), np.array([[3], [0]]))
check('indices', out.getvalue() == b'<0,10,1234567>,3,\n<999,1000,1001>,0\n', out.getvalue())
many = random.randint(0, 70000, (text.CHUNK + 7, 3))
out = io.BytesIO()
text.Integers(70000).write(out, many)
check('more than a chunk', out.getvalue() == b',\n'.join(b'<%d,%d,%d>' % tuple(r) for r in many.tolist()) + b'\n')
check('names that differ stay different', len({text.name('M_', n) for n in ('a b', 'a_b', 'a.b', 'ä', 'a')}) == 5)
check('no number becomes zero', text.sane(np.array([np.nan, np.inf, 1e31, 2]))[0].tolist() == [0, 0, 0, 2])

rgb = random.rand(5, 7, 3)
data = pictures.png(rgb, 8)
raw = zlib.decompress(data[data.index(b'IDAT') + 4:-12])
check('PNG', data[:8] == b'\x89PNG\r\n\x1a\n' and struct.unpack('>II', data[16:24]) == (7, 5)
      and raw[1:22] == np.rint(rgb[0] * 255).astype(np.uint8).tobytes())
check('a PNG of ours counts as plain', images.plain_png(data) and not images.plain_png(pictures.png(random.rand(2, 2, 4))))
light = 10.0 ** random.uniform(-3, 3, (4, 64, 3))
light[1] = 0
light[2] = 3.5
coded = pictures.hdr(light)
body = coded[coded.index(b'+X 64\n') + 6:]


def decode(body, width, height):
    at, rows = 0, []
    for _ in range(height):
        assert body[at:at + 4] == bytes((2, 2, 0, width))
        at += 4
        channels = []
        for _ in range(4):
            row = bytearray()
            while len(row) < width:
                n = body[at]
                if n > 128:
                    row += bytes([body[at + 1]]) * (n - 128)
                    at += 2
                else:
                    row += body[at + 1:at + 1 + n]
                    at += 1 + n
            channels.append(row)
        rows.append(np.array([list(c) for c in channels]).T)
    return np.array(rows)


rgbe = decode(body, 64, 4).astype(np.float64)
back = (rgbe[..., :3] + 0.5) * 2.0 ** (rgbe[..., 3:] - 136)
close = np.abs(back - light).max(axis=2) <= light.max(axis=2) / 200
check('Radiance pictures', close[light.max(axis=2) > 0].all() and not rgbe[1].any())
with tempfile.TemporaryDirectory() as folder:
    store = images.Store(folder, 'p')
    names = [store.put(b'one', 'a/b', '.png'), store.put(b'two', 'a b', '.png'), store.put(b'one', 'c', '.png')]
    check('pictures are written once, under names of their own', names[0] == names[2] == 'p/a_b.png'
          and names[1] == 'p/a_b-2.png' and sorted(os.listdir(os.path.join(folder, 'p'))) == ['a_b-2.png', 'a_b.png'])
check('JPEG components', images.jpeg_components(b'\xff\xd8\xff\xe0\x00\x04ab\xff\xc0\x00\x11\x08\x00\x10\x00\x10\x03\x01') == 3)
grid = np.arange(8.0).reshape(2, 4, 1) * np.ones(4)
check('samples repeat', np.allclose(images.sample(grid, np.array([0.125, 1.125]), np.array([0.25, 0.25]))[:, 0], 0))

# Versions of Blender, with stand-ins.
Socket = types.SimpleNamespace


def node(*names):
    return Socket(inputs=[Socket(name=n, enabled=True) for n in names])


old = node('Base Color', 'Specular', 'Transmission', 'Emission', 'Clearcoat', 'Sheen', 'Subsurface', 'Subsurface Color')
new = node('Base Color', 'Specular IOR Level', 'Transmission Weight', 'Emission Color', 'Coat Weight', 'Sheen Weight',
           'Subsurface Weight', 'Emission Strength')
for what, before, after in (('specular', 'Specular', 'Specular IOR Level'), ('transmission', 'Transmission', 'Transmission Weight'),
                            ('emission', 'Emission', 'Emission Color'), ('coat', 'Clearcoat', 'Coat Weight'),
                            ('sheen', 'Sheen', 'Sheen Weight'), ('subsurface', 'Subsurface', 'Subsurface Weight')):
    check('Principled %s, 3.4 and 4.0' % what, versions.principled(old, what).name == before
          and versions.principled(new, what).name == after)
check('a socket that only one has', versions.principled(new, 'subsurface_color') is None
      and versions.principled(old, 'subsurface_color').name == 'Subsurface Color')
check('specular level 0.5 is 4 % in 3.4, and in 4.0 with an IOR of 1.5',
      abs(versions.specular_f0((3, 4, 1), None, 2.0, 0.5) - 0.04) < 1e-9
      and abs(versions.specular_f0((4, 0, 0), None, 1.5, 0.5) - 0.04) < 1e-9)


class Fill:
    def __init__(self, value):
        self.value, self.asked = value, []

    def __len__(self):
        return 2

    def foreach_get(self, name, buffer):
        self.asked.append(name)
        buffer[:] = self.value


loops, corners = Fill(1), Fill(2)
mesh34 = Socket(loops=loops, calc_normals_split=lambda: None, free_normals_split=lambda: None)
mesh41 = Socket(loops=loops, corner_normals=corners)
check('corner normals of 3.4', versions.corner_normals(mesh34, (3, 4, 1), np.empty).tolist() == [1] * 6
      and loops.asked == ['normal'])
check('corner normals of 4.1', versions.corner_normals(mesh41, (4, 1, 0), np.empty).tolist() == [2] * 6
      and corners.asked == ['vector'])
check('a spot has its cosine until 4.0', versions.spot_has_cosine((3, 6, 0)) and not versions.spot_has_cosine((4, 0, 0)))

old34 = Socket(has_custom_normals=False, use_auto_smooth=False)
check('corners differ in 3.4 with auto smooth or normals of their own', not versions.has_own_normals(old34, (3, 4, 1))
      and versions.has_own_normals(Socket(has_custom_normals=False, use_auto_smooth=True), (3, 4, 1)))
check('and in 4.1 where Blender says so', [versions.has_own_normals(Socket(normals_domain=d), (4, 1, 0))
                                           for d in ('POINT', 'FACE', 'CORNER')] == [False, False, True])
check('a lamp of 4.5: exposure and temperature', versions.lamp_factor(Socket()) == [1, 1, 1]
      and versions.lamp_factor(Socket(exposure=1.0, use_temperature=True, temperature_color=(1, 0.5, 0.25))) == [2, 1, 0.5]
      and versions.lamp_factor(Socket(use_temperature=False, temperature_color=(1, 0.5, 0.25))) == [1, 1, 1])
check('or its energy by area', versions.lamp_is_normalized(Socket()) and not versions.lamp_is_normalized(Socket(normalize=False)))



# The Principled BSDF whole, as 3.4 and as 4.2 have it.
class Inputs(list):
    def get(self, name):
        return next((s for s in self if s.name == name), None)


def surface(version, **inputs):
    sockets = Inputs()
    for name, value in inputs.items():
        kind = 'RGBA' if isinstance(value, tuple) and 'Normal' not in name else 'VECTOR' if isinstance(value, tuple) else 'VALUE'
        sockets.append(Socket(name=name.replace('_', ' '), identifier=name, enabled=True, is_linked=False, links=[], type=kind,
                              default_value=value))
    fake = Socket(name='Principled BSDF', bl_idname='ShaderNodeBsdfPrincipled', inputs=sockets, distribution='GGX',
                  id_data=Socket(name='tree'))
    losses = lossy.Losses()
    maker = materials.Materials(paints.Painter(None, losses), losses, version)
    maker.where = 'Mat'
    return maker.texture(maker.shader_BsdfPrincipled(trees.Place(fake, None)), materials.Look('T'))[0], losses.lost_lines()


NEW = dict(Base_Color=(0.5, 0.5, 0.5, 1), Metallic=0.0, Roughness=0.0, IOR=1.5, Alpha=1.0, Normal=(0, 0, 0), Diffuse_Roughness=0.0,
           Subsurface_Weight=0.0, Specular_IOR_Level=0.5, Specular_Tint=(1, 1, 1, 1), Anisotropic=0.0, Transmission_Weight=0.0,
           Coat_Weight=0.0, Coat_Roughness=0.03, Coat_IOR=1.5, Coat_Tint=(1, 1, 1, 1), Sheen_Weight=0.0, Emission_Color=(1, 1, 1, 1),
           Emission_Strength=0.0, Thin_Film_Thickness=0.0)
OLD = dict(Base_Color=(0.5, 0.5, 0.5, 1), Subsurface=0.0, Subsurface_Color=(1, 1, 1, 1), Metallic=0.0, Specular=0.5, Specular_Tint=0.0,
           Roughness=0.0, Anisotropic=0.0, Sheen=0.0, Clearcoat=0.0, Clearcoat_Roughness=0.03, IOR=1.45, Transmission=0.0,
           Transmission_Roughness=0.0, Emission=(0, 0, 0, 1), Emission_Strength=1.0, Alpha=1.0, Normal=(0, 0, 0))
before, after = surface((3, 4, 1), **OLD), surface((4, 2, 0), **NEW)
check('the default Principled BSDF is the same in 3.4 and 4.2', before == after and not after[1]
      and 'reflection { rgb <0.04,0.04,0.04>, rgb <1,1,1> falloff 5 }' in after[0] and 'emission' not in after[0], (before, after))
for what, old_inputs, new_inputs, word in (
        ('emission', {'Emission': (0.5, 0, 0, 1), 'Emission_Strength': 2.0}, {'Emission_Color': (0.5, 0, 0, 1), 'Emission_Strength': 2.0},
         'emission rgb <2,0,0>'),
        ('glass', {'Transmission': 1.0}, {'Transmission_Weight': 1.0, 'IOR': 1.45}, 'fresnel'),
        ('alpha', {'Alpha': 0.5}, {'Alpha': 0.5}, 'rgbt <'),
        ('coat', {'Clearcoat': 1.0}, {'Coat_Weight': 0.25}, 'reflection { rgb <0.05,0.05,0.05>'),
        ('metal', {'Metallic': 1.0}, {'Metallic': 1.0}, 'reflection { rgb <0.5,0.5,0.5> }')):
    before, after = surface((3, 4, 1), **dict(OLD, **old_inputs)), surface((4, 2, 0), **dict(NEW, **new_inputs))
    check('Principled %s in 3.4 and 4.2' % what, before == after and word in after[0], (before, after))
check('an IOR is what 4.2 reflects by', 'rgb <0.111111,' in surface((4, 2, 0), **dict(NEW, IOR=2.0))[0]
      and 'rgb <0.04,' in surface((3, 4, 1), **dict(OLD, IOR=2.0))[0])
for name, value in (('Specular_Tint', (1, 0, 0, 1)), ('Coat_Tint', (1, 0, 0, 1)), ('Sheen_Weight', 1.0), ('Anisotropic', 0.5),
                    ('Diffuse_Roughness', 0.5), ('Thin_Film_Thickness', 300.0)):
    lines = surface((4, 2, 0), **dict(NEW, Coat_Weight=1.0, **{name: value}))[1]
    check('%s of 4.2 is told' % name.replace('_', ' '), lines == ['Mat, %s, Principled BSDF: left out' % name.replace('_', ' ')], lines)

check('but no tint of a coat that is not there', not surface((4, 2, 0), **dict(NEW, Coat_Tint=(1, 0, 0, 1)))[1])

# What rays see of an object, and what is done to a picture afterwards.
losses = lossy.Losses()
check('an object that all rays see needs no word', visible.words([Socket()], None, losses, 'A') == [] and not losses.lost_lines())
check('hidden from camera and shadow rays', visible.words([Socket(visible_camera=False), Socket(visible_shadow=False)], None,
                                                          losses, 'A') == ['no_image', 'no_shadow'])
check('from mirrors and diffuse rays', visible.words([Socket(visible_glossy=False, visible_diffuse=False)], None, losses, 'A')
      == ['no_reflection', 'no_radiosity'])
check('from all', visible.words([Socket(**{'visible_' + n: False for n in (
    'camera', 'shadow', 'glossy', 'diffuse', 'transmission')})], None, losses, 'A') is None and not losses.lost_lines())
layer = object()
asked = Socket(original=Socket(indirect_only_get=lambda view_layer: view_layer is layer, holdout_get=lambda view_layer: False))
check('in a collection that is indirect only', visible.words([asked], layer, losses, 'A') == ['no_image'])
for name, thing, why in (('Holdout', Socket(is_holdout=True), 'a hole in the picture\'s alpha; drawn as it is'),
                         ('Shadow Catcher', Socket(is_shadow_catcher=True), 'drawn as it is'),
                         ('Light Linking', Socket(light_linking=Socket(receiver_collection=1, blocker_collection=None)),
                          'a lamp that lights or is blocked by some objects only'),
                         ('Ray Visibility', Socket(visible_transmission=False),
                          'seen through glass, though it is hidden from such rays')):
    losses = lossy.Losses()
    check('%s is told' % name, visible.words([thing], None, losses, 'A') == [] and losses.lost_lines() == [
        'A, %s, -: %s' % (name, why)], losses.lost_lines())
losses = lossy.Losses()
render = Socket(use_compositing=True, use_sequencer=True, use_multiview=True, use_freestyle=True)
tree = Socket(nodes=[Socket(bl_idname='CompositorNodeRLayers', name='R', mute=False),
                     Socket(bl_idname='CompositorNodeGlare', name='Glare', mute=False),
                     Socket(bl_idname='CompositorNodeBlur', name='Blur', mute=True)])
scene = Socket(name='S', render=render, node_tree=tree, use_nodes=True, sequence_editor=Socket(sequences=[1]),
               view_layers=[Socket(name='L1', use=True), Socket(name='L2', use=False), Socket(name='L3', use=True)],
               view_settings=Socket(gamma=1.0, use_curve_mapping=True))
visible.afterwards(scene, losses)
check('what is done to a picture afterwards is told', [l.split(':')[0] for l in losses.lost_lines()] == [
    'S, Compositing, Glare', 'S, Freestyle, -', 'S, Sequencer, -', 'S, Stereoscopy, -', 'S, View Layer, L3']
    and len(losses.nearest_lines()) == 1, losses.lost_lines())
losses = lossy.Losses()
scene.use_nodes, scene.sequence_editor, scene.view_layers = False, None, scene.view_layers[:1]
render.use_multiview = render.use_freestyle = scene.view_settings.use_curve_mapping = False
visible.afterwards(scene, losses)
check('and nothing else', not losses.lost_lines() + losses.nearest_lines())

rows, where = geometry.distinct(np.array([[0, 0, 1], [1, 0, 0], [0, 0, 1.0], [0, 0, -1]], np.float32))
check('each normal once', len(rows) == 3 and np.array_equal(rows[where][:3], [[0, 0, 1], [1, 0, 0], [0, 0, 1]]))
flat, places = np.tile([0, 0, 1.0], (500, 1)), random.rand(500, 3) * [4, 4, 0]
bent = random.normal(size=(500, 3)) * [2, 2, 0] + flat
bent /= np.linalg.norm(bent, axis=1, keepdims=True)
turned = relief.facing(bent, flat, np.array([2, -6, 1.0, 1]), places)
to_eye = np.array([2, -6, 1.0]) - places
to_eye /= np.linalg.norm(to_eye, axis=1, keepdims=True)


def seen(normal):
    return (normal * to_eye).sum(axis=1), (2 * (normal * to_eye).sum(axis=1)[:, None] * normal - to_eye)[:, 2]


same = (turned == bent).all(axis=1)
check('bent normals face the eye, and so do their mirrors', (seen(bent)[0] < 0).any() and (seen(turned)[0] > 0).all()
      and (seen(turned)[1] > 0).all())
check('others stay', 50 < same.sum() < 450 and (seen(bent)[1][~same] < 0.0101).all())
check('as do faces seen from behind', np.array_equal(relief.facing(bent, flat, np.array([0, 0, -1.0, 0]), places), bent))
points, normals, faces = geometry.tubes([[0, 0, 0], [0, 0, 1], [5, 0, 0], [5, 1, 0], [5, 2, 0]], [2, 3], np.full(5, 0.1), 4)
check('tubes stand round their strand', len(points) == 20 and len(faces) == 3 * 8
      and np.allclose(np.linalg.norm(points[:4, :2], axis=1), 0.1 * (2 * np.pi / 4) ** 0.5, atol=1e-6)
      and faces.max() == 19 and not np.any((faces < 8).any(axis=1) & (faces >= 8).any(axis=1)))
print('done')
