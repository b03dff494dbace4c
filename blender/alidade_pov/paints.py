# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours and factors of a material as pigments.

A Paint is a sum of products of a constant and a socket. Looking at which coordinates, images, procedural textures and
colour layers its sockets use decides what it becomes, the first that fits:

    nothing                             a constant
    one image, as it is                 image_map, with the picture's own file
    one procedural texture              POV-Ray's pattern with a color_map that holds what the other nodes do
    the angle of view (Fresnel, facing) the pattern aoi with a color_map that holds all nodes
    vertex colours                      a texture a corner (textures are made by the mesh's writer)
    images and textures on one UV map   an image_map computed from the nodes
    anything else                       its mean, listed as lost
"""
import math

import numpy as np

from . import pictures, text
from .images import sample
from .values import DISC, Place, Points, Tree, as_colour, as_number, origin

PROBES = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0.3, 0.7, 0.2]], np.float64)
BAKE = 1024             # side of a picture computed over the unit square
MOST = 4096
RAMP = 64               # entries of a computed color_map
MANY = 240              # the most of them: POV-Ray knows 256
WIDE = 64.0             # the period of a gradient that stands for a texture without one, whose middle is at 0


class Paint:
    """terms: list of (three floats, Place or None)."""

    def __init__(self, terms):
        self.terms = [(np.array(m, np.float64), p) for m, p in terms if np.any(np.asarray(m) != 0)]

    @staticmethod
    def constant(rgb):
        return Paint([(np.broadcast_to(np.asarray(rgb, np.float64), 3), None)])

    def times(self, factor):
        return Paint([(m * factor, p) for m, p in self.terms])

    def plus(self, other):
        return Paint(self.terms + other.terms)

    def value(self, tree, points):
        total = np.zeros((points.count, 3))
        for factor, place in self.terms:
            total = total + factor * (1.0 if place is None else as_colour(tree.value(place, points)))
        return total

    def key(self):
        """Equal for paints that differ by a constant factor only; None for constants."""
        places = [(p.node.name, p.node.id_data.name, p.socket.identifier, tuple(g.name for g in p.stack),
                   tuple(np.round(m / max(np.abs(self.terms[0][0]).max(), 1e-20), 6)))
                  for m, p in self.terms if p is not None]
        return tuple(places) or None


def affine(at):
    """The matrix (3 x 4) that takes a coordinate to what was found at PROBES, or None if it is no such matrix."""
    base = at[0]
    matrix = np.column_stack([at[1] - base, at[2] - base, at[3] - base, base])
    expected = matrix[:, :3] @ PROBES[4] + base
    return matrix if np.allclose(expected, at[4], atol=1e-4 * (1 + np.abs(at).max())) else None


class Probe:
    """What a paint depends on."""

    def __init__(self, paint, tree):
        self.images, self.natives, self.colours, self.facing = [], [], set(), []

        def sampler(tree, place, points):
            at = tree.place_vector(place, points)
            self.images.append((place, at))
            return np.full((points.count, 4), 0.5)

        def colours(layer):
            self.colours.add(layer)
            return np.full((len(PROBES), 4), 0.5)
        points = Points(len(PROBES), every=PROBES, sampler=sampler, colours=colours, natives=self.natives,
                        facing=self.facing)
        self.value = paint.value(tree, points)
        self.kinds = sorted(kind for what, kind in points.asked if what == 'coordinate')

    @property
    def constant(self):
        return not (self.facing or self.varies)

    @property
    def varies(self):
        """From place to place."""
        return bool(self.images or self.natives or self.colours or self.kinds)


def _vector_kind(tree, place):
    """The kind of coordinates behind a texture's Vector input: one kind, or None."""
    points = Points(len(PROBES), every=PROBES)
    tree.place_vector(place, points)
    kinds = [k for w, k in points.asked if w == 'coordinate']
    return kinds[0] if len(kinds) == 1 else None


class Pigment:
    """SDL of a pigment's inside; space: 'uv:NAME', 'generated', 'object' or None; corner: a Paint of vertex colours."""

    def __init__(self, body, space=None, constant=None, corner=None, mean=None):
        self.body, self.space, self.constant, self.corner = body, space, constant, corner
        self.mean = constant if mean is None else mean


def _inverse(matrix):
    """The transform that puts a pattern where the coordinates say, or None for a flat one."""
    square = np.vstack([matrix, [0, 0, 0, 1]])
    if abs(np.linalg.det(square[:3, :3])) < 1e-12:
        return None
    return np.linalg.inv(square)


def matrix_text(matrix):
    """matrix<> of a 4 x 4 column matrix; nothing for the identity."""
    if np.allclose(matrix, np.eye(4), atol=1e-9):
        return ''
    values = [matrix[row, column] for column in range(4) for row in range(3)]
    return 'matrix <%s>' % ','.join(text.number(0.0 if abs(v) < 1e-12 else v) for v in values)


def frame_path(node):
    """The file that an image node shows at this frame, where its image is a sequence of them; or None."""
    image = node.image
    if image is None or image.source != 'SEQUENCE' or not hasattr(image, 'filepath_from_user'):
        return None
    return image.filepath_from_user(image_user=node.image_user)


class Painter:
    def __init__(self, store, losses):
        self.store, self.losses = store, losses
        self._made = {}

    def probe(self, paint, where, quiet=True):
        tree = Tree(self.losses, where)
        tree.quiet = quiet
        return Probe(paint, tree)

    def layers(self, paint):
        """Names of the colour layers that a paint asks for; '' is the rendered one."""
        return {name or '' for name in self.probe(paint, '-').colours}

    def constant(self, paint, where):
        """Its value as three floats, or None."""
        probe = self.probe(paint, where, quiet=False)
        return probe.value[0] if probe.constant else None

    def mean(self, paint, where):
        """One colour instead of a paint that varies."""
        tree = Tree(self.losses, where)
        tree.quiet = True

        def sampler(tree, place, points):
            pixels = place.node.image and self.store.linear(place.node.image, frame_path(place.node))
            rgba = np.array([1, 0, 1, 1.0]) if pixels is None else pixels.reshape(-1, 4).mean(axis=0)
            return np.tile(rgba, (points.count, 1))

        def colours(layer):
            return np.full((16, 4), 0.5)
        points = Points(16, every=np.random.RandomState(1).rand(16, 3), sampler=sampler, colours=colours,
                        cosine=DISC[::2])
        return paint.value(tree, points).mean(axis=0)

    def pigment(self, paint, where, socket, data=False):
        """data: numbers, not colours: kept linear in the file."""
        key = (where, data, paint.key(), repr([list(m) for m, p in paint.terms]))
        if paint.key() is None or key not in self._made:
            self._made[key] = self._pigment(paint, where, socket, data)
        return self._made[key]

    def _pigment(self, paint, where, socket, data):
        probe = self.probe(paint, where, quiet=False)
        if probe.constant:
            rgb = probe.value[0]
            return Pigment('rgb %s' % text.vector(rgb), constant=rgb)
        if not probe.varies:
            return self._facing(paint, where, data)
        if probe.facing:
            self.losses.lost(where, socket, probe.facing[0].node.name, 'the angle of view together with what varies '
                             'from place to place; its mean stands for it')
        if probe.colours and not (probe.images or probe.natives or probe.kinds):
            mean = self.mean(paint, where)
            return Pigment('rgb %s' % text.vector(mean), corner=paint, mean=mean)
        found = self._image_as_it_is(paint, probe, where, data) or self._native(paint, probe, where, data) \
            or self._along(paint, probe, where) or self._computed(paint, probe, where, socket, data)
        if found:
            return found
        mean = self.mean(paint, where)
        nodes = sorted({p.node.name for p, _ in probe.images + probe.natives}) or ['-']
        self.losses.lost(where, socket, ' + '.join(nodes), 'textures that do not share one set of coordinates; '
                         'their mean colour stands for them')
        return Pigment('rgb %s' % text.vector(mean), constant=mean)

    # The angle of view alone: aoi is 1 where a surface faces the ray and 1/2 where it is seen from the side
    def _facing(self, paint, where, data):
        tree = Tree(self.losses, where)
        tree.quiet = True
        values = np.linspace(0.5, 1, MANY)
        rgb = paint.value(tree, Points(MANY, cosine=-np.cos(np.pi * values)))
        if data:
            rgb = np.clip(rgb, 0, 1)
        return Pigment('aoi color_map { %s }' % _color_map(values, rgb), mean=self.mean(paint, where))

    # One image, straight from the node
    def _image_as_it_is(self, paint, probe, where, data):
        if len(paint.terms) != 1 or not np.allclose(paint.terms[0][0], 1) or probe.colours or probe.natives:
            return None
        source, _ = origin(paint.terms[0][1])
        if source is None or source.node.bl_idname != 'ShaderNodeTexImage' or source.socket.name != 'Color':
            return None
        place, at = probe.images[0]
        node = place.node
        placed = self._placed(place, at, where)
        if placed is None or node.image is None or node.extension != 'REPEAT':
            return None
        if node.projection != 'FLAT':
            return None
        if data and paint.terms[0][1].socket.type == 'VALUE' and not self.store.is_data(node.image):
            return None         # a coded picture used as a number: computed instead
        self._tiles(node, where)
        name = self.store.file(node.image, frame_path(node))
        if name is None:
            self.losses.lost(where, 'Color', node.name, 'image "%s" has no pixels' % node.image.name)
            return Pigment('rgb <1,0,1>', constant=np.array([1.0, 0, 1]))
        gamma = ' gamma 1' if self.store.is_data(node.image) and not node.image.is_float else ''
        return self._map(name, gamma, placed, node.interpolation == 'Closest', self.mean(paint, where))

    def _map(self, name, gamma, placed, closest, mean):
        space, matrix = placed
        kind = {'.jpg': 'jpeg', '.png': 'png', '.hdr': 'hdr'}[name[-4:]]
        body = '%simage_map { %s %s%s%s }' % ('uv_mapping ' if space.startswith('uv:') else '', kind,
                                              text.quoted(name), gamma, '' if closest else ' interpolate 2')
        transform = matrix_text(_inverse(matrix))
        return Pigment(body + (' ' + transform if transform else ''), space=space, mean=mean)

    def _placed(self, place, at, where):
        """(space, matrix) of a texture, or None if SDL's transforms cannot say it."""
        tree = Tree(self.losses, where)
        tree.quiet = True
        kind = _vector_kind(tree, place)
        matrix = affine(at)
        if kind is None or matrix is None:
            return None
        if kind.startswith('uv:'):
            matrix = matrix.copy()
            matrix[2] = [0, 0, 1, 0]
            matrix[:2, 2] = 0
        if _inverse(matrix) is None:
            return None
        return kind, matrix

    # One procedural texture
    def _native(self, paint, probe, where, data):
        if len({(p.node.name, p.stack) for p, _ in probe.natives}) != 1 or probe.images or probe.colours:
            return None
        place, at = probe.natives[0]
        placed = self._placed(place, at, where)
        if placed is None:
            return None
        space, matrix = placed
        node = place.node
        tree = Tree(self.losses, where)
        tree.quiet = True

        def number(name, default=0.0):
            return float(tree.number(place, name, Points(1), default)[0])
        pattern = self._pattern(node, number, where, place.socket.name)
        if pattern is None:
            return None
        words, scale, entries = pattern
        values = np.linspace(0, 1, RAMP + 1) if entries is None else np.array(entries)
        colours = None
        if node.bl_idname == 'ShaderNodeTexChecker':
            plain = Points(2)
            pair = [tree.colour(place, n, plain)[0] for n in ('Color2', 'Color1')]
            colours = np.array(pair)
        elif node.bl_idname in ('ShaderNodeTexNoise', 'ShaderNodeTexVoronoi', 'ShaderNodeTexWhiteNoise'):
            colours = np.repeat(values[:, None], 3, axis=1)
            if words == 'crackle solid':
                colours = np.random.RandomState(1).rand(len(values), 3)
        points = Points(len(values), scalar=((node.name, place.stack), values, colours), every=np.zeros((len(values), 3)))
        rgb = paint.value(tree, points)
        if data:        # a factor: Blender clamps it, too
            rgb = np.clip(rgb, 0, 1)
        mean = rgb.mean(axis=0)
        whole = np.vstack([matrix, [0, 0, 0, 1]])
        if entries is not None:
            body = '%s rgb %s, rgb %s' % (words, text.vector(rgb[0]), text.vector(rgb[1]))
        elif words == 'gradient x':
            body = '%s color_map { %s }' % (words, _color_map(0.5 + values / WIDE, rgb))
            scale = 1 / WIDE
            whole[0, 3] += 0.5 * WIDE
        else:
            body = '%s color_map { %s }' % (words, _color_map(values, rgb))
        whole[:3] *= scale
        if space.startswith('uv:'):
            body = 'uv_mapping ' + body
            whole[2] = [0, 0, 1, 0]
        if _inverse(whole[:3]) is None:
            return None
        transform = matrix_text(_inverse(whole[:3]))
        return Pigment(body + (' ' + transform if transform else ''), space=space, mean=mean)

    def _pattern(self, node, number, where, socket):
        """POV-Ray's words for a texture node, the scale of its coordinates, and the entries if it has but two."""
        kind = node.bl_idname.replace('ShaderNodeTex', '')
        if kind == 'Checker':
            return 'checker', number('Scale'), (0.0, 1.0)
        if kind == 'Gradient':
            words = {'LINEAR': 'gradient x', 'SPHERICAL': 'spherical'}.get(node.gradient_type)
            return words and (words, 1.0, None)
        if kind == 'Voronoi' and socket == 'Color':
            self.losses.lost(where, 'Color', node.name, 'cells lie elsewhere and have other colours')
            return 'crackle solid', number('Scale', 5.0), None
        if kind == 'Wave' and number('Distortion') != 0:
            self.losses.lost(where, 'Distortion', node.name, 'left out')
        if kind == 'Wave':
            # Bands of sin(20 x) have the period pi / 10; POV-Ray's waves the period 1.
            axis = {'X': 'x', 'Y': 'y', 'Z': 'z'}.get(node.bands_direction)
            wave = {'SIN': 'sine_wave', 'SAW': 'ramp_wave', 'TRI': 'triangle_wave'}[node.wave_profile]
            if node.wave_type != 'BANDS' or axis is None:
                return None
            phase = number('Phase Offset') / (2 * math.pi)
            if wave == 'sine_wave':
                # POV-Ray's sine wave stands at the middle, rising, for 0; Blender's at its lowest.
                phase -= 0.25
            elif wave == 'triangle_wave':
                pass
            return '%s %s phase %s' % ('gradient ' + axis, wave, text.number(phase)), number('Scale') * 10 / math.pi, None
        approximate = {
            'Noise': ('bozo', 'noise is another noise of the same size'),
            'Musgrave': ('bozo', 'noise is another noise of the same size'),
            'Voronoi': ('crackle form <1,0,0>', 'cells lie elsewhere'),
            'Magic': ('marble turbulence 1', 'another turbulent pattern'),
        }.get(kind)
        if approximate:
            self.losses.lost(where, 'Fac', node.name, approximate[1])
            detail = number('Detail') if kind in ('Noise', 'Musgrave') else 0
            words = approximate[0]
            if detail > 0.5 and words == 'bozo':
                words = 'granite scale 4' if detail > 8 else 'bozo warp { turbulence 0.3 octaves %d }' % max(1, round(detail))
            return words, number('Scale', 5.0), None
        return None

    # Coordinates alone, of which one axis counts: a gradient
    def _along(self, paint, probe, where):
        kinds = set(probe.kinds)
        if len(kinds) != 1 or probe.images or probe.natives or probe.colours:
            return None
        space = next(iter(kinds))
        if space not in ('generated', 'object'):
            return None
        tree = Tree(self.losses, where)
        tree.quiet = True
        low, high = (0.0, 1.0) if space == 'generated' else (-8.0, 8.0)

        def at(places):
            return paint.value(tree, Points(len(places), coordinates={space: places}))
        random = low + (high - low) * np.random.RandomState(1).rand(64, 3)
        axes = []
        for axis in range(3):
            moved = random.copy()
            moved[:, axis] = random[::-1, axis]
            if not np.allclose(at(moved), at(random), atol=1e-4):
                axes.append(axis)
        if len(axes) != 1:
            return None
        values = np.linspace(low, high, MANY)
        places = np.zeros((MANY, 3))
        places[:, axes[0]] = values
        rgb = at(places)
        body = 'gradient %s color_map { %s } scale %s translate %s*%s' % (
            'xyz'[axes[0]], _color_map(0.5 + values / WIDE, rgb), text.number(WIDE), text.number(-0.5 * WIDE), 'xyz'[axes[0]])
        return Pigment(body, space=space, mean=rgb.mean(axis=0))

    def _flat(self, paint, tree, space):
        """Whether a paint is the same whatever z is."""
        places = np.random.RandomState(1).rand(256, 3)
        moved = places.copy()
        moved[:, 2] = places[::-1, 2]
        one, two = (paint.value(tree, Points(len(at), coordinates={space: at}, sampler=self.sampler))
                    for at in (places, moved))
        return np.allclose(one, two, atol=1e-4)

    # Several on one UV map, or on Generated coordinates of which z does not count: a picture
    def _computed(self, paint, probe, where, socket, data):
        kinds = set(probe.kinds)
        if len(kinds) != 1 or probe.colours:
            return None
        space = next(iter(kinds))
        if not space.startswith('uv:') and space != 'generated':
            return None
        tree = Tree(self.losses, where)
        tree.quiet = True
        for place, _ in probe.images:
            node = place.node
            if node.projection != 'FLAT' or node.image is None:
                return None
        if any(p.node.bl_idname not in ('ShaderNodeTexChecker', 'ShaderNodeTexGradient', 'ShaderNodeTexWave', 'ShaderNodeTexBrick')
               for p, _ in probe.natives):
            return None
        if any(p.node.bl_idname == 'ShaderNodeTexWave' and p.node.inputs['Distortion'].default_value != 0 for p, _ in probe.natives):
            return None
        if space == 'generated' and not self._flat(paint, tree, space):
            return None
        shared = self._shared(probe)
        width = height = BAKE
        if probe.images:
            sizes = [tuple(p.node.image.size) for p, _ in probe.images]
            width, height = max(s[0] for s in sizes), max(s[1] for s in sizes)
        if shared is None:
            shared = np.eye(4)[:3]
            width = height = min(max(BAKE, width, height), MOST)
            self.losses.nearest(where, socket, '-', 'computed as a picture of the square from (0,0) to (1,1) of "%s"'
                                % ('Generated' if space == 'generated' else space[3:] or 'UV'))
        width, height = min(max(width, 4), MOST), min(max(height, 4), MOST)
        rgb = self.compute(paint, tree, space, shared, width, height)
        stem = '%s-%s' % (where, socket)
        mean = rgb.reshape(-1, 3).mean(axis=0)
        if rgb.max() > 1.001 and not data:
            name, gamma = self.store.put(pictures.hdr(rgb), stem, '.hdr'), ''
        elif data:
            name, gamma = self.store.put(pictures.png(rgb[..., :1], 16), stem, '.png'), ' gamma 1'
        else:
            name, gamma = self.store.put(pictures.png(pictures.to_srgb(rgb), 8), stem, '.png'), ''
        closest = bool(probe.images) and all(p.node.interpolation == 'Closest' for p, _ in probe.images)
        return self._map(name, gamma, (space, shared), closest, mean)

    @staticmethod
    def _shared(probe):
        """The one mapping of all images, or None."""
        if not probe.images or probe.natives:
            return None
        first = affine(probe.images[0][1])
        for place, at in probe.images:
            matrix = affine(at)
            if matrix is None or not np.allclose(matrix, first, atol=1e-6) or place.node.extension != 'REPEAT':
                return None
        matrix = first.copy()
        matrix[2] = [0, 0, 1, 0]
        matrix[:2, 2] = 0
        return matrix if _inverse(matrix) is not None else None

    def _tiles(self, node, where):
        if node.image is not None and node.image.source == 'TILED' and len(node.image.tiles) > 1:
            self.losses.lost(where, 'Color', node.name, 'all tiles of "%s" (UDIM) but the first' % node.image.name)

    def sampler(self, tree, place, points):
        """What an image texture shows, for Points: pink where it has no pixels, as Blender draws it."""
        self._tiles(place.node, tree.where)
        pixels = place.node.image and self.store.linear(place.node.image, frame_path(place.node))
        if pixels is None:
            return np.tile([1.0, 0, 1, 1], (points.count, 1))
        at = tree.place_vector(place, points)
        return sample(pixels, at[:, 0], at[:, 1], place.node.interpolation == 'Closest', place.node.extension)

    def compute(self, paint, tree, space, matrix, width, height):
        """The paint's values on a grid of the texture's own square, top row first."""
        inverse = _inverse(matrix)
        rows = []
        u = (np.arange(width) + 0.5) / width
        for row in range(height - 1, -1, -32):
            lines = np.arange(row, max(row - 32, -1), -1)
            v = (lines + 0.5) / height
            square = np.stack([np.tile(u, len(lines)), np.repeat(v, width), np.zeros(width * len(lines)),
                               np.ones(width * len(lines))], 1)
            uv = square @ inverse[:3].T
            points = Points(len(uv), coordinates={space: uv}, sampler=self.sampler)
            rows.append(paint.value(tree, points).reshape(len(lines), width, 3))
        return np.concatenate(rows)


def _color_map(values, rgb):
    """Entries of a color_map, without those that lie on the line between their neighbours."""
    keep = [0]
    for i in range(1, len(values) - 1):
        a, b = keep[-1], i + 1
        t = (values[i] - values[a]) / (values[b] - values[a])
        if np.abs(rgb[a] + (rgb[b] - rgb[a]) * t - rgb[i]).max() > 2e-4:
            keep.append(i)
    keep.append(len(values) - 1)
    return ' '.join('[%s rgb %s]' % (text.number(values[i]), text.vector(rgb[i])) for i in keep)


def numbers_of(paint, tree, points):
    return as_number(paint.value(tree, points))


__all__ = ['Paint', 'Painter', 'Pigment', 'Place', 'matrix_text', 'affine', 'numbers_of']
