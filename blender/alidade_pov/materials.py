# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shaders to textures: what a surface does is gathered as lobes, then said in the words of POV-Ray's finish.

A shader is a Leaf (lobes with constant weights) or a Blend of two by a factor that varies, which becomes a texture_map.
Lobes: diffuse, translucent, glossy, glass, refraction (without its reflection), transparent, emission. docs/exporter.md derives the numbers.
"""
import math
import re

import numpy as np

from . import text, versions
from .finish import Finish
from .paints import Paint, Pigment
from .relief import Relief
from .values import Place, Points, Tree, as_number, origin

LEAST_IOR = 1e-5        # as in Cycles
SHARPEST = 0.02         # alpha of the narrowest highlight: a lamp's own size is about as wide
WHITE = np.ones(3)
# White that a blurred reflection of F0 adds to diffuse, in F0. In Cycles a black ball of roughness 0.6 to 1 and F0 = 0.04
# sends back 0.047 to 0.027 of a white world and 0.013 to 0.007 of a sun (diffuse 0.024 would), most of which is the
# highlight; a grey one 0.01 less than its colour, since its diffuse lobe is less too.
HAZE = 0.6
CLEAR = ('transparent', 'glass', 'refraction')


class Lobe:
    def __init__(self, kind, paint, weight=1.0, roughness=0.0, ior=1.45, f0=None):
        self.kind, self.paint, self.weight = kind, paint, weight
        self.roughness, self.ior, self.f0 = roughness, ior, f0

    def times(self, factor):
        return Lobe(self.kind, self.paint, self.weight * factor, self.roughness, self.ior, self.f0)


class Leaf:
    def __init__(self, lobes):
        self.lobes = [l for l in lobes if l.weight != 0]

    def times(self, factor):
        return Leaf([l.times(factor) for l in self.lobes])


class Blend:
    """a where the factor is 0, b where it is 1."""

    def __init__(self, factor, socket, a, b):
        self.factor, self.socket, self.a, self.b = factor, socket, a, b

    def times(self, factor):
        return Blend(self.factor, self.socket, self.a.times(factor), self.b.times(factor))


def add(a, b):
    if isinstance(a, Blend):
        return Blend(a.factor, a.socket, add(a.a, b), add(a.b, b))
    if isinstance(b, Blend):
        return Blend(b.factor, b.socket, add(a, b.a), add(a, b.b))
    return Leaf(a.lobes + b.lobes)


class Look:
    """A material as the meshes' writer needs it."""

    def __init__(self, name):
        self.name = name                # identifier of the declared texture
        self.interior = None            # SDL or None
        self.spaces = set()
        self.corner = None              # Paint of vertex colours
        self.corner_text = None         # function: colour text -> texture
        self.relief = None              # what bends its normals

    @property
    def uv(self):
        return next((s[3:] for s in sorted(self.spaces) if s.startswith('uv:')), None)

    def texture(self, bounds=None):
        """The texture as an entry of texture_list; Generated coordinates run over the mesh's bounds."""
        if 'generated' not in self.spaces or bounds is None:
            return 'texture { %s }' % self.name
        low, high = bounds
        size = np.where(high - low < 1e-9, 1.0, high - low)
        return 'texture { %s scale %s translate %s }' % (self.name, text.vector(size), text.vector(low))


def mirror_share(roughness):
    """How much of a reflection is sharp enough to be said by a mirror; the rest can only be said by diffuse."""
    t = min(max((roughness - 0.1) / 0.5, 0.0), 1.0)
    return 1.0 - t * t * (3.0 - 2.0 * t)


def highlight(roughness, f0):
    """specular and roughness of POV-Ray for a GGX lobe, whose alpha is roughness squared.

    A normalised Blinn lobe with the exponent n = 2 / alpha^2 - 2 has the peak f0 (n + 2) / 8 in units of what a white
    diffuse surface sends back.
    """
    alpha = max(roughness * roughness, SHARPEST)
    exponent = max(2.0 / (alpha * alpha) - 2.0, 1.0)
    return f0 * (exponent + 2.0) / 8.0, 1.0 / exponent


class Materials:
    """Looks by material, made when first asked for; text gathers their declarations."""

    def __init__(self, painter, losses, version):
        self.painter, self.losses, self.version = painter, losses, version
        self.text = []
        self.bake_normals = True
        self._looks = {}

    def look(self, material):
        key = material.name_full if material else None
        if key not in self._looks:
            self._looks[key] = self._make(material)
        return self._looks[key]

    def _make(self, material):
        look = Look(text.name('T_', material.name_full) if material else 'T')
        self.where = material.name_full if material else '-'
        self.relief = None
        if material is None:
            shader = Leaf([Lobe('diffuse', Paint.constant((0.8, 0.8, 0.8)))])
        elif not material.use_nodes or material.node_tree is None:
            shader = self._plain(material)
        else:
            shader = self._tree(material)
        body, interior = self.texture(shader, look)
        look.relief = self.relief
        if look.relief is not None:
            look.spaces.add(look.relief.space)
        look.interior = interior
        if look.corner is None:
            self.text.append('#declare %s = %s\n' % (look.name, body))
        if 'generated' in look.spaces and look.uv is not None:
            self.losses.lost(self.where, '-', '-', 'Generated coordinates and UV maps in one material')
        if len([s for s in look.spaces if s.startswith('uv:')]) > 1:
            self.losses.lost(self.where, '-', '-', 'several UV maps in one material: a mesh2 has one')
        return look

    def _plain(self, material):
        f0 = 0.08 * material.specular_intensity
        base = Paint.constant(material.diffuse_color[:3])
        metallic = material.metallic
        return Leaf([Lobe('diffuse', base, 1 - metallic), Lobe('glossy', base, metallic, material.roughness),
                     Lobe('glossy', Paint.constant(WHITE), 1 - metallic, material.roughness, f0=f0)])

    def _tree(self, material):
        tree = material.node_tree
        outputs = [n for n in tree.nodes if n.bl_idname == 'ShaderNodeOutputMaterial']
        best = None
        for target in ('CYCLES', 'ALL', 'EEVEE'):
            best = best or next((n for n in outputs if n.target == target and n.is_active_output), None) \
                or next((n for n in outputs if n.target == target), None)
        if best is None:
            self.losses.lost(self.where, 'Surface', '-', 'no output node')
            return Leaf([])
        for name, why in (('Volume', 'volumes are not written'), ('Displacement', 'displacement by a shader')):
            socket = best.inputs.get(name)
            if socket is not None and socket.is_linked:
                self.losses.lost(self.where, name, best.name, why)
        return self.shader(Place(best, best.inputs['Surface']))

    # Sockets
    def constant(self, place, name, default=0.0):
        """A number that does not vary, or None."""
        paint = self.paint(place, name, default)
        value = self.painter.constant(paint, self.where)
        return None if value is None else float(value[0]) if paint.number else value

    def paint(self, place, name, default=0.0):
        socket = name if not isinstance(name, (str, int)) else place.node.inputs.get(name)
        if socket is None:
            paint = Paint.constant(default)
            paint.number = True
            return paint
        inner = Place(place.node, socket, place.stack)
        paint = Paint([(WHITE, inner)])
        paint.number = socket.type == 'VALUE'
        return paint

    def number(self, place, name, default=0.0, what=None):
        """A number; where it varies, its mean, which is told."""
        value = self.constant(place, name, default)
        if value is None:
            paint = self.paint(place, name, default)
            value = float(self.painter.mean(paint, self.where)[0])
            label = what or (name if isinstance(name, str) else getattr(name, 'name', str(name)))
            self.losses.lost(self.where, label, place.node.name, 'a texture for this number: its mean stands for it')
        return value if np.ndim(value) == 0 else float(np.mean(value))

    # Shaders
    def shader(self, place):
        source, _ = origin(place)
        if source is None:
            return Leaf([])
        node = source.node
        method = getattr(self, 'shader_' + node.bl_idname.replace('ShaderNode', ''), None)
        if method is None:
            self.losses.lost(self.where, place.socket.name, node.name, 'no such shader in the scene language')
            return Leaf([Lobe('diffuse', Paint.constant((0.5, 0.5, 0.5)))])
        self._normal(source)
        return method(source)

    def _normal(self, place):
        for name in ('Normal', 'Coat Normal', 'Clearcoat Normal', 'Tangent'):
            socket = place.node.inputs.get(name)
            if socket is None or not socket.is_linked:
                continue
            source, _ = origin(Place(place.node, socket, place.stack))
            if source is None:
                continue
            relief = self._relief(source) if name == 'Normal' and self.bake_normals else None
            if relief is None:
                self.losses.lost(self.where, name, source.node.name, 'no normals in a surface\'s own frame')
            elif self.relief is None:
                self.relief = relief
                self.losses.nearest(self.where, name, source.node.name, 'normals are put into a finer mesh')
            elif self.relief.node != source.node.name:
                self.losses.lost(self.where, name, source.node.name, 'a second normal map in one material')

    def _relief(self, source):
        """A normal or bump map on a UV map, or None."""
        node = source.node
        if node.bl_idname == 'ShaderNodeNormalMap' and node.space == 'TANGENT':
            kind, paint = 'map', self.paint(source, 'Color')
        elif node.bl_idname == 'ShaderNodeBump' and not node.inputs['Normal'].is_linked:
            kind, paint = 'bump', self.paint(source, 'Height')
        else:
            return None
        probe = self.painter.probe(paint, self.where)
        if len(probe.kinds) != 1 or not probe.kinds[0].startswith('uv:') or not probe.images or probe.colours:
            return None
        if any(p.node.image is None or p.node.projection != 'FLAT' for p, _ in probe.images):
            return None
        width = max(p.node.image.size[0] for p, _ in probe.images)
        height = max(p.node.image.size[1] for p, _ in probe.images)
        places = [at for _, at in probe.images]
        scale = max(np.abs(at[1:3] - at[0]).max() for at in places)
        strength = self.number(source, 'Strength', 1.0)
        distance = self.number(source, 'Distance', 1.0) if kind == 'bump' else 0.0
        if kind == 'bump' and node.invert:
            distance = -distance
        return Relief(kind, paint, strength, distance, probe.kinds[0], node.name,
                      (max(width * scale, 1), max(height * scale, 1)))

    def mix(self, factor, socket, a, b):
        """Two shaders by a factor that may vary."""
        value = self.painter.constant(factor, self.where)
        if value is None:
            return Blend(factor, socket, a, b)
        value = min(max(float(as_number(value[None, :])[0]), 0.0), 1.0)
        return add(a.times(1 - value), b.times(value))

    def shader_MixShader(self, p):
        a, b = (self.shader(Place(p.node, p.node.inputs[i], p.stack)) for i in (1, 2))
        return self.mix(Paint([(WHITE, Place(p.node, p.node.inputs[0], p.stack))]), 'Fac', a, b)

    def shader_AddShader(self, p):
        return add(*(self.shader(Place(p.node, p.node.inputs[i], p.stack)) for i in (0, 1)))

    def shader_BsdfDiffuse(self, p):
        return Leaf([Lobe('diffuse', self.paint(p, 'Color'))])

    def shader_SubsurfaceScattering(self, p):
        self.losses.lost(self.where, 'Radius', p.node.name, 'light that scatters below the surface; drawn as diffuse')
        return self.shader_BsdfDiffuse(p)

    def shader_BsdfVelvet(self, p):
        self.losses.lost(self.where, 'Sigma', p.node.name, 'velvet; drawn as diffuse')
        return self.shader_BsdfDiffuse(p)

    shader_BsdfSheen = shader_BsdfVelvet

    def shader_BsdfToon(self, p):
        self.losses.lost(self.where, 'Size', p.node.name, 'toon shading; drawn as diffuse')
        return self.shader_BsdfDiffuse(p)

    def shader_BsdfTranslucent(self, p):
        return Leaf([Lobe('translucent', self.paint(p, 'Color'))])

    def shader_BsdfTransparent(self, p):
        return Leaf([Lobe('transparent', self.paint(p, 'Color'))])

    def shader_Holdout(self, p):
        self.losses.lost(self.where, '-', p.node.name, 'a hole in the picture\'s alpha; drawn black')
        return Leaf([])

    def shader_BsdfGlossy(self, p):
        def at(roughness):
            return Leaf([Lobe('glossy', self.paint(p, 'Color'), 1.0, roughness)])
        if getattr(p.node, 'distribution', '') == 'SHARP':
            return at(0.0)
        return self._rough(p, p.node.inputs['Roughness'], at)

    def shader_BsdfAnisotropic(self, p):
        socket = p.node.inputs.get('Anisotropy')
        if socket is not None and (socket.is_linked or socket.default_value != 0):
            self.losses.lost(self.where, socket.name, p.node.name, 'left out')
        return self.shader_BsdfGlossy(p)

    def shader_BsdfMetallic(self, p):
        """A node of 4.3."""
        socket = p.node.inputs.get('Edge Tint')
        if socket is not None and getattr(p.node, 'fresnel_type', 'F82') == 'F82' and self._says(socket):
            self.losses.lost(self.where, socket.name, p.node.name, 'left out')
        if getattr(p.node, 'fresnel_type', 'F82') != 'F82':
            self.losses.lost(self.where, 'IOR', p.node.name, 'a metal by its indices of refraction; drawn in its base colour')
        socket = p.node.inputs.get('Anisotropy')
        if socket is not None and self._says(socket):
            self.losses.lost(self.where, socket.name, p.node.name, 'left out')
        return self._rough(p, p.node.inputs['Roughness'],
                           lambda r: Leaf([Lobe('glossy', self.paint(p, 'Base Color'), 1.0, r)]))

    def shader_BsdfGlass(self, p):
        return Leaf([self._clear('glass', p)])

    def shader_BsdfRefraction(self, p):
        return Leaf([self._clear('refraction', p)])

    def _clear(self, kind, p):
        roughness = 0.0 if getattr(p.node, 'distribution', '') == 'SHARP' else self.number(p, 'Roughness')
        return self._glass(kind, p, self.paint(p, 'Color'), roughness, self.number(p, 'IOR', 1.45))

    def _glass(self, kind, p, paint, roughness, ior, weight=1.0):
        if roughness > 0.05 and weight:
            self.losses.lost(self.where, 'Roughness', p.node.name, 'light scattered as it is refracted; drawn clear')
        return Lobe(kind, paint, weight, roughness, max(ior, LEAST_IOR))

    def shader_Emission(self, p):
        return Leaf([Lobe('emission', self.paint(p, 'Color'), self.number(p, 'Strength', 1.0))])

    def shader_Background(self, p):
        return self.shader_Emission(p)

    def shader_BsdfHair(self, p):
        self.losses.nearest(self.where, '-', p.node.name, 'hair is drawn as diffuse strands with a highlight')
        return Leaf([Lobe('diffuse', self.paint(p, 'Color'), 0.7),
                     Lobe('glossy', Paint.constant(WHITE), 1.0, 0.4, f0=0.05)])

    def shader_BsdfHairPrincipled(self, p):
        self.losses.nearest(self.where, '-', p.node.name, 'hair is drawn as diffuse strands with a highlight')
        parametrization = getattr(p.node, 'parametrization', 'COLOR')
        if parametrization == 'MELANIN':
            melanin = self.number(p, 'Melanin', 0.8)
            red = self.number(p, 'Melanin Redness', 1.0)
            amount = -math.log(max(1.0 - melanin, 1e-4))
            sigma = amount * ((1 - red) * np.array([0.506, 0.841, 1.653]) + red * np.array([0.343, 0.733, 1.924]))
            rough = 0.3
            paint = Paint.constant(np.exp(-np.sqrt(sigma) * (5.969 - 0.215 * rough + 2.532 * rough ** 2) * 0.3))
        elif parametrization == 'ABSORPTION':
            socket = p.node.inputs.get('Absorption Coefficient')
            paint = Paint.constant(np.exp(-np.sqrt(np.maximum(np.array(socket.default_value[:3]), 0)) * 2))
        else:
            paint = self.paint(p, 'Color')
        return Leaf([Lobe('diffuse', paint, 1.0), Lobe('glossy', Paint.constant(WHITE), 1.0, 0.4, f0=0.05)])

    def _rough(self, p, socket, build):
        """A surface whose roughness may vary: then the lower and upper end of it, blended."""
        place = Place(p.node, socket, p.stack)
        paint = Paint([(WHITE, place)])
        value = self.painter.constant(paint, self.where)
        if value is not None:
            return build(min(max(float(value[0]), 0.0), 1.0))
        low, high = 0.1, 0.7
        # factor = (roughness - low) / (high - low); the texture_map clamps what lies beyond.
        factor = Paint([(WHITE / (high - low), place), (-WHITE * low / (high - low), None)])
        return Blend(factor, socket.name, build(low), build(high))

    @staticmethod
    def _says(socket):
        """Whether an input that is left out would do something: not where it is 0, or a tint that is white."""
        if socket.is_linked:
            return True
        if socket.type == 'RGBA':
            return min(socket.default_value[:3]) < 0.999
        return socket.default_value > 0

    def shader_BsdfPrincipled(self, p):
        node = p.node

        def find(what):
            return versions.principled(node, what)

        def varying(what):
            """(constant, None) or (None, paint)."""
            socket = find(what)
            if socket is None:
                return 0.0, None
            paint = Paint([(WHITE, Place(node, socket, p.stack))])
            value = self.painter.constant(paint, self.where)
            return (None, paint) if value is None else (min(max(float(value[0]), 0.0), 1.0), None)

        def number(what, default=0.0):
            socket = find(what)
            return default if socket is None else self.number(p, socket, default, socket.name)
        for what in ('anisotropic', 'sheen', 'thin_film', 'diffuse_roughness', 'specular_tint', 'coat_tint'):
            socket = find(what)
            coated = what != 'coat_tint' or self._says(find('coat'))
            if socket is not None and self._says(socket) and coated:
                self.losses.lost(self.where, socket.name, node.name, 'left out')
        socket = find('transmission_roughness')
        if socket is not None and getattr(node, 'distribution', '') == 'GGX' and self._says(socket):
            self.losses.lost(self.where, socket.name, node.name, 'light scattered as it is refracted; drawn clear')
        base = self.paint(p, find('base_color'))
        base.number = False
        scatter = number('subsurface')
        if scatter > 0:
            self.losses.lost(self.where, find('subsurface').name, node.name,
                             'light that scatters below the surface; drawn as diffuse')
            colour = find('subsurface_color')
            if colour is not None:
                base = base.times(1 - scatter).plus(self.paint(p, colour).times(scatter))
        ior = number('ior', 1.45)
        f0 = min(versions.specular_f0(self.version, node, ior, number('specular', 0.5)), 1.0)
        coat, coat_rough = number('coat'), number('coat_roughness')
        coat *= 0.25 if self.version < (4, 0, 0) else 1.0
        coat_f0 = ((number('coat_ior', 1.5) - 1) / (number('coat_ior', 1.5) + 1)) ** 2

        def build(metallic, transmission, roughness):
            opaque = (1 - metallic) * (1 - transmission)
            lobes = [Lobe('diffuse', base, opaque),
                     Lobe('glossy', Paint.constant(WHITE), opaque if f0 else 0.0, roughness, f0=f0),
                     Lobe('glossy', base, metallic, roughness)]
            through = (1 - metallic) * transmission
            if through:
                lobes.append(self._glass('glass', p, base, roughness, ior, through))
            if coat:
                lobes.append(Lobe('glossy', Paint.constant(WHITE), coat, coat_rough, f0=coat_f0))
            return Leaf(lobes)

        metallic, metal_paint = varying('metallic')
        transmission, glass_paint = varying('transmission')

        def roughened(m, t):
            return self._rough(p, find('roughness'), lambda r: build(m, t, r))

        def through(m):
            if glass_paint is None:
                return roughened(m, transmission)
            return Blend(glass_paint, find('transmission').name, roughened(m, 0.0), roughened(m, 1.0))
        shader = through(metallic) if metal_paint is None else \
            Blend(metal_paint, find('metallic').name, through(0.0), through(1.0))
        shader = self._emission(p, find, shader)
        alpha, alpha_paint = varying('alpha') if find('alpha') is not None else (1.0, None)
        clear = Leaf([Lobe('transparent', Paint.constant(WHITE))])
        if alpha_paint is not None:
            return Blend(alpha_paint, find('alpha').name, clear, shader)
        return shader if alpha == 1.0 else add(shader.times(alpha), clear.times(1 - alpha))

    def _emission(self, p, find, shader):
        strength_socket = find('emission_strength')
        strength = 1.0 if strength_socket is None else self.number(p, strength_socket, 1.0, strength_socket.name)
        socket = find('emission')
        if not strength or socket is None:
            return shader
        paint = self.paint(p, socket)
        value = self.painter.constant(paint, self.where)
        if value is not None and not np.any(value):
            return shader
        return add(shader, Leaf([Lobe('emission', paint, strength)]))

    # Textures
    def texture(self, shader, look):
        """SDL of a texture, and of the interior that its object needs."""
        if isinstance(shader, Blend):
            factor = self.painter.pigment(shader.factor, self.where, shader.socket, data=True)
            a, inside_a = self.texture(shader.a, look)
            b, inside_b = self.texture(shader.b, look)
            if inside_a and inside_b and inside_a != inside_b:
                self.losses.lost(self.where, shader.socket, '-', 'two indices of refraction in one material')
            self._space(factor, look)
            if factor.corner is not None:
                self.losses.lost(self.where, shader.socket, '-', 'vertex colours as a factor: their mean stands for them')
            if factor.constant is not None or factor.corner is not None:
                weight = min(max(float(np.mean(factor.mean)), 0.0), 1.0)
                return self.texture(add(shader.a.times(1 - weight), shader.b.times(weight)), look) \
                    if not isinstance(shader.a, Blend) and not isinstance(shader.b, Blend) else (b, inside_b)
            body = ('texture {\npigment_pattern { %s }\ntexture_map {\n[0 %s]\n[1 %s]\n}\n}'
                    % (factor.body, _inner(a), _inner(b)))
            return body, inside_a or inside_b
        return self._leaf(shader, look)

    @staticmethod
    def _space(pigment, look):
        if pigment.space is not None:
            look.spaces.add(pigment.space)

    def _leaf(self, leaf, look):
        groups = self._groups(leaf)
        if len(groups) == 1:
            return self._single(groups[0], look)
        # What one pigment cannot say: the mean of several textures, each as much stronger.
        total = float(len(groups))
        parts, interior = [], None
        self.losses.nearest(self.where, '-', '-', 'several colours that vary: a mean of textures')
        for lobes in groups:
            body, inside = self._single([l.times(total) for l in lobes], look)
            interior = interior or inside
            parts.append('[1 %s]' % _inner(body))
        return 'texture {\naverage\ntexture_map {\n%s\n}\n}' % '\n'.join(parts), interior

    def _groups(self, leaf):
        """Lobes that can share one pigment: those that vary in the same way, and those that are constant."""
        varying, plain = {}, []
        for lobe in leaf.lobes:
            if self.painter.constant(lobe.paint, self.where) is None:
                varying.setdefault(lobe.paint.key(), []).append(lobe)
            else:
                plain.append(lobe)
        if not varying:
            return [plain]
        groups = list(varying.values())
        # Mirrors and highlights have a colour of their own; what else is constant needs its own pigment.
        own = [l for l in plain if l.kind == 'glossy']
        rest = [l for l in plain if l.kind != 'glossy']
        groups[0] = groups[0] + own
        if rest:
            groups.append(rest)
        return groups

    def _single(self, lobes, look):
        """One texture of lobes that share a pigment."""
        amount = {}
        paints = {}
        for lobe in lobes:
            paints.setdefault(lobe.kind, Paint([]))
            paints[lobe.kind] = paints[lobe.kind].plus(lobe.paint.times(lobe.weight))
            amount[lobe.kind] = amount.get(lobe.kind, 0.0) + lobe.weight
        glossy = [l for l in lobes if l.kind == 'glossy']
        values = {kind: self.painter.constant(paint, self.where) for kind, paint in paints.items()}
        finish = Finish()
        for lobe in glossy:
            self._gloss(lobe, finish)
        varying = [k for k, v in values.items() if v is None and k != 'glossy']
        if varying or any(l.f0 is None and self.painter.constant(l.paint, self.where) is None for l in glossy):
            pigment = self._shared(lobes, varying, finish, look)
        else:
            pigment = self._constant(values, finish)
        interior = None
        bending = [l for l in lobes if l.kind in ('glass', 'refraction')]
        if bending:
            interior = 'interior { ior %s }' % text.number(max(bending, key=lambda l: l.weight).ior)
        if 'glass' in amount:
            heaviest = max((l for l in lobes if l.kind == 'glass'), key=lambda l: l.weight)
            finish.glass(amount['glass'])
            finish.shine(highlight(heaviest.roughness, ((heaviest.ior - 1) / (heaviest.ior + 1)) ** 2),
                         amount['glass'])
        body = 'texture {\n%s\n%s\n}' % (pigment, finish.text())
        return body, interior

    def _gloss(self, lobe, finish):
        """A mirror, as far as it is sharp; a highlight for the lamps; the rest is diffuse."""
        share = mirror_share(lobe.roughness)
        metal = lobe.f0 is None
        f0 = 1.0 if metal else lobe.f0
        colour = self.painter.constant(lobe.paint, self.where)
        if metal:
            finish.metal(lobe.weight * share, colour)
            if colour is not None:
                finish.hue = finish.hue + lobe.weight * colour
                finish.hues += lobe.weight
            # What a blurred mirror shows of its surroundings is said by diffuse, but that answers to lamps as well, so
            # both it and the highlight are less. Tuned beside Cycles; a rough GGX lobe loses light.
            blurred = (1 - share) * 0.45 * (1 - 0.45 * lobe.roughness ** 3)
            finish.rough_metal.append((lobe.weight * blurred, lobe))
            finish.shine(highlight(lobe.roughness, 1.0 if colour is None else float(max(colour.max(), 1e-6))),
                         lobe.weight * (1 - 0.5 * (1 - share)), metallic=True)
            return
        finish.mirror(lobe.weight * share * f0, lobe.weight * share)
        finish.haze += lobe.weight * (1 - share) * min(HAZE * f0, 1.0)
        finish.shine(highlight(lobe.roughness, f0), lobe.weight)

    def _constant(self, values, finish):
        """Everything is constant: one colour for the pigment, the rest relative to it."""
        diffuse = values.get('diffuse', np.zeros(3)).copy()
        for weight, lobe in finish.rough_metal:
            diffuse += weight * self.painter.constant(lobe.paint, self.where)
        if diffuse.max() > 0:
            diffuse += finish.haze
        behind = values.get('translucent')
        clear = sum((values[kind] for kind in CLEAR if kind in values), np.zeros(3))
        emission = values.get('emission')
        through = float(clear.max())
        colour = diffuse if behind is None else np.maximum(diffuse, behind)
        if np.any(finish.hue > 0):
            # Highlights of metal have the pigment's colour, so that is the metal's wherever the rest is like it.
            metal = finish.hue / finish.hues
            part = colour.max() / metal.max()
            if np.allclose(colour, part * metal, atol=0.02):
                colour = metal
        if through > 0 and colour.max() > 0:
            transmit, filtered = min(float(clear.mean()), 1.0), 0.0
            if clear.max() - clear.min() > 0.02:
                self.losses.lost(self.where, 'Color', '-', 'colour of the light let through beside a surface of '
                                 'another colour; its grey stands for it')
        else:
            transmit, filtered = 0.0, min(through, 1.0)
            if through > 0:
                colour = clear / through
        if colour.max() <= 0 and emission is not None and emission.max() > 0:
            colour = emission / emission.max()
        if emission is not None and emission.max() > 0:
            # Emission is weighed by what is opaque (measured), so something must be.
            transmit, filtered = min(transmit, 0.98), min(filtered, 0.98)
        opaque = max(1.0 - transmit, 1e-3)
        if emission is not None:
            colour = np.where(emission > 0, np.maximum(colour, 2e-3), colour)
        base = np.maximum(colour, 1e-9)
        if emission is not None:
            finish.emission = np.where(emission > 0, emission / base, 0.0) / (1.0 - transmit - filtered)
        finish.diffuse = float((diffuse / base).max()) / opaque
        if behind is not None:
            finish.behind = float((behind / base).max()) / opaque
        if not filtered and finish.diffuse > 1 and not finish.hues and behind is None:
            # A brighter pigment instead, so that diffuse is 1 as in most materials.
            colour, finish.emission, finish.diffuse = colour * finish.diffuse, finish.emission / finish.diffuse, 1.0
        return 'pigment { rgb%s }' % _rgbft(colour, filtered, transmit)

    def _shared(self, lobes, varying, finish, look):
        """One colour that varies, for all lobes of it."""
        main = next((l for l in lobes if self.painter.constant(l.paint, self.where) is None))
        pigment = self.painter.pigment(main.paint, self.where, main.kind)
        self._space(pigment, look)
        clear = 0.0
        for lobe in lobes:
            if lobe.kind == 'glossy':
                continue
            if lobe.kind == 'diffuse':
                finish.diffuse += lobe.weight
            elif lobe.kind == 'translucent':
                finish.behind += lobe.weight
            elif lobe.kind == 'emission':
                finish.emission = finish.emission + lobe.weight
            elif lobe.kind in CLEAR:
                clear += lobe.weight
        for weight, lobe in finish.rough_metal:
            finish.diffuse += weight
        if finish.diffuse > 0 and pigment.mean is not None:
            finish.diffuse += finish.haze / max(float(np.mean(pigment.mean)), 0.1)
        finish.metal_colour = None if finish.metal_weight else finish.metal_colour
        if clear:
            finish.diffuse /= max(1.0 - min(clear, 1.0), 1e-3) if clear < 1 else 1.0
            share = text.number(min(clear, 1.0))
            if 'image_map' in pigment.body:
                body = pigment.body.replace('interpolate 2', 'interpolate 2 filter all %s' % share)
            else:
                body = re.sub(r'\brgb <([^>]*)>', r'rgbf <\1,%s>' % share, pigment.body)
            if body == pigment.body:
                self.losses.lost(self.where, 'Color', '-', 'transparent in a colour that varies; drawn opaque')
                finish.diffuse += clear
            return 'pigment { %s }' % body
        if pigment.corner is not None:
            look.corner = pigment.corner
            frozen = finish.text()
            look.corner_text = lambda rgb: 'texture { pigment { rgb %s } %s }' % (rgb, frozen)
        return 'pigment { %s }' % pigment.body


def _inner(texture):
    """A texture as an entry of texture_map: without its own braces where that is allowed."""
    return texture[len('texture {'):-1].strip()


def _rgbft(rgb, filter_, transmit):
    if filter_ and transmit:
        return 'ft <%s>' % ','.join(text.number(v) for v in (*rgb, filter_, transmit))
    if filter_ or transmit:
        return ('f' if filter_ else 't') + ' <%s>' % ','.join(text.number(v) for v in (*rgb, filter_ or transmit))
    return ' ' + text.vector(rgb)
