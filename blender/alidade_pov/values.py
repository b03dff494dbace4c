# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees as values: follow sockets through groups and reroutes, and compute what colour nodes compute.

Values are numpy arrays, one row a point: (n, 3) for colours and vectors, (n,) for numbers. The same code gives a
constant (one point that depends on nothing), a picture (a point a pixel) and vertex colours (a point a corner); a
Points object says what is known at the points, and remembers what was asked for.
"""
import numpy as np


class Unsupported(Exception):
    def __init__(self, node, why):
        super().__init__(why)
        self.node = node
        self.why = why


class Points:
    """What is known where values are computed. coordinates: (n, 3) by kind ('uv:NAME', 'generated', 'object')."""

    def __init__(self, count=1, coordinates=None, colours=None, scalar=None, sampler=None, every=None,
                 natives=None, cosine=None, facing=None):
        self.count = count
        self.coordinates = coordinates or {}
        self.colours = colours          # function: layer name -> (n, 4) or None
        self.scalar = scalar            # (native node's name, (n,) values): see materials.native
        self.sampler = sampler          # function: (tree, node, stack, coordinates) -> (n, 4)
        self.every = every              # one answer for every kind of coordinate, while probing
        self.natives = natives          # list, while probing: (place, coordinates) of each procedural texture
        self.cosine = cosine            # (n,) of the angle between the ray and the normal, where that is known
        self.facing = facing            # list, while probing: nodes that ask for it
        self.asked = set()

    def coordinate(self, node, kind):
        self.asked.add(('coordinate', kind))
        if self.every is not None:
            return self.every
        if kind not in self.coordinates:
            raise Unsupported(node, 'coordinates "%s" are not known here' % kind)
        return self.coordinates[kind]


class Place:
    """An input or output of a node, and the group nodes it was reached through."""
    __slots__ = ('node', 'socket', 'stack')

    def __init__(self, node, socket, stack=()):
        self.node, self.socket, self.stack = node, socket, stack


def _group_output(tree):
    outputs = [n for n in tree.nodes if n.bl_idname == 'NodeGroupOutput']
    return next((n for n in outputs if n.is_active_output), outputs[0] if outputs else None)


def origin(place):
    """The output that feeds an input, as a Place; or None and the Place of the input whose own value counts."""
    for _ in range(1000):
        socket = place.socket
        if not socket.is_linked or not socket.links:
            return None, place
        link = socket.links[0]
        if not link.is_valid or link.is_muted:
            return None, place
        node, output = link.from_node, link.from_socket
        if node.mute:
            inner = next((l for l in node.internal_links if l.to_socket == output), None)
            if inner is None:
                return None, place
            place = Place(node, inner.from_socket, place.stack)
        elif node.bl_idname == 'NodeReroute':
            place = Place(node, node.inputs[0], place.stack)
        elif node.bl_idname == 'ShaderNodeGroup' and node.node_tree:
            end = _group_output(node.node_tree)
            inner = end and next((s for s in end.inputs if s.identifier == output.identifier), None)
            if inner is None:
                return None, place
            place = Place(end, inner, place.stack + (node,))
        elif node.bl_idname == 'NodeGroupInput' and place.stack:
            group = place.stack[-1]
            outer = next((s for s in group.inputs if s.identifier == output.identifier), None)
            if outer is None:
                return None, place
            place = Place(group, outer, place.stack[:-1])
        else:
            return Place(node, output, place.stack), None
    return None, place


def own_value(place):
    """What stands in an input without a link: float or three floats."""
    value = getattr(place.socket, 'default_value', 0.0)
    try:
        return np.array(list(value)[:3], np.float64)
    except TypeError:
        return np.float64(value)


LUMA = np.array([0.2126, 0.7152, 0.0722])


def as_colour(values):
    return values if values.ndim == 2 else np.repeat(values[:, None], 3, axis=1)


def as_number(values, vector=False):
    if values.ndim == 1:
        return values
    return values.mean(axis=1) if vector else values @ LUMA


def hsv(rgb):
    most, least = rgb.max(axis=1), rgb.min(axis=1)
    span = most - least
    safe = np.where(span == 0, 1, span)
    r, g, b = rgb.T
    hue = np.where(most == r, ((g - b) / safe) % 6, np.where(most == g, (b - r) / safe + 2, (r - g) / safe + 4)) / 6
    return np.stack([np.where(span == 0, 0, hue), np.where(most == 0, 0, span / np.where(most == 0, 1, most)), most], 1)


def rgb_of_hsv(values):
    h, s, v = values.T
    parts = [np.clip(np.abs((h * 6 + k) % 6 - 3) - 1, 0, 1) for k in (0, 4, 2)]
    return np.stack([v * (1 + s * (p - 1)) for p in parts], 1)


BLENDS = {
    'MIX': lambda a, b: b,
    'DARKEN': np.minimum,
    'MULTIPLY': lambda a, b: a * b,
    'BURN': lambda a, b: np.clip(1 - (1 - a) / np.maximum(b, 1e-6), 0, 1),
    'LIGHTEN': np.maximum,
    'SCREEN': lambda a, b: 1 - (1 - a) * (1 - b),
    'DODGE': lambda a, b: np.where(a == 0, 0, np.minimum(a / np.maximum(1 - b, 1e-6), 1)),
    'ADD': lambda a, b: a + b,
    'OVERLAY': lambda a, b: np.where(a < 0.5, 2 * a * b, 1 - 2 * (1 - a) * (1 - b)),
    'SOFT_LIGHT': lambda a, b: (1 - a) * a * b + a * (1 - (1 - a) * (1 - b)),
    'LINEAR_LIGHT': lambda a, b: a + 2 * (b - 0.5),
    'DIFFERENCE': lambda a, b: np.abs(a - b),
    'EXCLUSION': lambda a, b: a + b - 2 * a * b,
    'SUBTRACT': lambda a, b: a - b,
    'DIVIDE': lambda a, b: np.where(b == 0, a, a / np.where(b == 0, 1, b)),
}


def blend(kind, factor, a, b):
    factor = factor[:, None]
    if kind in ('HUE', 'SATURATION', 'COLOR', 'VALUE'):
        x, y = hsv(a), hsv(b)
        if kind == 'VALUE':
            x[:, 2] = y[:, 2]
        else:
            if kind != 'SATURATION':
                x[:, 0] = y[:, 0]
            if kind != 'HUE':
                x[:, 1] = y[:, 1]
        return a + (rgb_of_hsv(x) - a) * factor
    if kind == 'DARKEN' or kind == 'LIGHTEN':
        return a + (BLENDS[kind](a, b) - a) * factor
    if kind in ('ADD', 'SUBTRACT', 'LINEAR_LIGHT'):
        return a + (BLENDS[kind](a, b) - a) * factor
    if kind == 'SCREEN':
        return 1 - (1 - factor + factor * (1 - b)) * (1 - a)
    if kind == 'MULTIPLY':
        return a * (1 - factor + factor * b)
    if kind not in BLENDS:
        return None
    return a * (1 - factor) + BLENDS[kind](a, b) * factor


def _power(a, b):
    with np.errstate(all='ignore'):
        return np.nan_to_num(np.where(a < 0, np.sign(a) * 0, np.power(np.abs(a), b)), posinf=0.0)


MATH = {
    'ADD': lambda a, b, c: a + b, 'SUBTRACT': lambda a, b, c: a - b, 'MULTIPLY': lambda a, b, c: a * b,
    'DIVIDE': lambda a, b, c: np.where(b == 0, 0, a / np.where(b == 0, 1, b)),
    'MULTIPLY_ADD': lambda a, b, c: a * b + c, 'POWER': lambda a, b, c: _power(a, b),
    'LOGARITHM': lambda a, b, c: np.where((a > 0) & (b > 0) & (b != 1), np.log(np.maximum(a, 1e-30))
                                          / np.where((b > 0) & (b != 1), np.log(np.maximum(b, 1e-30)), 1), 0),
    'SQRT': lambda a, b, c: np.sqrt(np.maximum(a, 0)), 'ABSOLUTE': lambda a, b, c: np.abs(a),
    'INVERSE_SQRT': lambda a, b, c: np.where(a > 0, 1 / np.sqrt(np.maximum(a, 1e-30)), 0),
    'EXPONENT': lambda a, b, c: np.exp(np.minimum(a, 700)), 'MINIMUM': lambda a, b, c: np.minimum(a, b),
    'MAXIMUM': lambda a, b, c: np.maximum(a, b), 'LESS_THAN': lambda a, b, c: (a < b) * 1.0,
    'GREATER_THAN': lambda a, b, c: (a > b) * 1.0, 'SIGN': lambda a, b, c: np.sign(a),
    'COMPARE': lambda a, b, c: (np.abs(a - b) <= np.maximum(c, 1e-5)) * 1.0,
    'ROUND': lambda a, b, c: np.floor(a + 0.5), 'FLOOR': lambda a, b, c: np.floor(a),
    'CEIL': lambda a, b, c: np.ceil(a), 'TRUNC': lambda a, b, c: np.trunc(a),
    'FRACT': lambda a, b, c: a - np.floor(a),
    'MODULO': lambda a, b, c: np.where(b == 0, 0, np.fmod(a, np.where(b == 0, 1, b))),
    'WRAP': lambda a, b, c: np.where(b == c, c, a - (b - c) * np.floor((a - c) / np.where(b == c, 1, b - c))),
    'SNAP': lambda a, b, c: np.where(b == 0, 0, np.floor(a / np.where(b == 0, 1, b)) * b),
    'PINGPONG': lambda a, b, c: np.where(b == 0, 0, np.abs(((a - b) / np.where(b == 0, 1, b * 2) % 1) * b * 2 - b)),
    'SINE': lambda a, b, c: np.sin(a), 'COSINE': lambda a, b, c: np.cos(a), 'TANGENT': lambda a, b, c: np.tan(a),
    'ARCSINE': lambda a, b, c: np.arcsin(np.clip(a, -1, 1)), 'ARCCOSINE': lambda a, b, c: np.arccos(np.clip(a, -1, 1)),
    'ARCTANGENT': lambda a, b, c: np.arctan(a), 'ARCTAN2': lambda a, b, c: np.arctan2(a, b),
    'SINH': lambda a, b, c: np.sinh(a), 'COSH': lambda a, b, c: np.cosh(a), 'TANH': lambda a, b, c: np.tanh(a),
    'RADIANS': lambda a, b, c: np.radians(a), 'DEGREES': lambda a, b, c: np.degrees(a),
}


def fresnel(cosine, eta):
    """Mean reflection of the two polarisations at a surface of a dielectric; eta: its index of refraction."""
    g = eta * eta - 1 + cosine * cosine
    root = np.sqrt(np.maximum(g, 0))
    with np.errstate(all='ignore'):
        a = (root - cosine) / (root + cosine)
        b = (cosine * (root + cosine) - 1) / (cosine * (root - cosine) + 1)
        part = 0.5 * a * a * (1 + b * b)
    return np.where(g > 0, np.nan_to_num(part, nan=1.0), 1.0)      # g <= 0: total reflection


# Cosines of equal parts of the disc that a ball is seen as.
DISC = np.sqrt((np.arange(32) + 0.5) / 32)


def blackbody(kelvin):
    """Linear Rec.709 colour of a temperature, of luminance 1 like Blender's node, by Planck's law and CIE 1931.

    The colour matching functions are the sums of lobes that Wyman, Sloan and Shirley fitted (JCGT 2013).
    """
    wave = np.arange(380.0, 781.0, 5.0)

    def lobe(at, low, high):
        return np.exp(-0.5 * ((wave - at) / np.where(wave < at, low, high)) ** 2)
    x = 1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2)
    y = 0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1)
    z = 1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)
    kelvin = np.clip(kelvin, 800, 12000)[:, None]
    power = (wave / 560.0) ** -5 / (np.exp(np.minimum(1.4388e7 / (wave * kelvin), 600)) - 1)
    xyz = np.stack([(power * f).sum(axis=1) for f in (x, y, z)], 1)
    xyz /= xyz[:, 1:2]
    rgb = xyz @ np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]]).T
    return np.maximum(rgb, 0)


def _brick_noise(number):
    """Blender's tint of a brick, 0 to 1, from the number of its row and place: a hash of 32 bits."""
    n = (number + 1013) & 0x7fffffff
    n = (n >> 13) ^ n
    n = n.astype(np.uint64)
    n = (n * (n * n * np.uint64(60493) + np.uint64(19990303)) + np.uint64(1376312589)) & np.uint64(0x7fffffff)
    return 0.5 * (n.astype(np.float64) / 1073741824.0)


class Tree:
    """Evaluates sockets; losses and where: what to tell when a node cannot be followed."""

    def __init__(self, losses, where):
        self.losses = losses
        self.where = where
        self.quiet = False

    def lost(self, place, node, why):
        if not self.quiet:
            self.losses.lost(self.where, place, node.name, why)

    # Inputs, by name; the value of a missing input is the default given.
    def colour(self, place, name, points, default=0.0):
        return as_colour(self.input(place, name, points, default))

    def number(self, place, name, points, default=0.0):
        return as_number(self.input(place, name, points, default))

    def input(self, place, name, points, default=0.0):
        socket = name if not isinstance(name, (str, int)) else (
            place.node.inputs[name] if isinstance(name, int) else place.node.inputs.get(name))
        if socket is None:
            return np.full(points.count, float(default))
        return self.value(Place(place.node, socket, place.stack), points)

    def value(self, place, points):
        """The value at an input."""
        source, own = origin(place)
        if source is None:
            value = own_value(own)
            if getattr(own.socket, 'type', '') == 'SHADER':
                value = np.zeros(3)
            result = np.broadcast_to(value, (points.count,) + value.shape).astype(np.float64)
        else:
            result = self.output(source, points)
            if getattr(source.socket, 'type', '') == 'VECTOR' and place.socket.type == 'VALUE':
                result = as_number(result, vector=True)
        if place.socket.type == 'VALUE':
            return as_number(result)
        if place.socket.type in ('RGBA', 'VECTOR'):
            return as_colour(result)
        return result

    def output(self, place, points):
        """The value at an output: by a method named after the node's type."""
        if points.scalar is not None and points.scalar[0] == (place.node.name, place.stack):
            if place.socket.name == 'Color' and points.scalar[2] is not None:
                return points.scalar[2]
            return points.scalar[1]
        method = getattr(self, 'node_' + place.node.bl_idname.replace('ShaderNode', ''), None)
        try:
            if method is None:
                raise Unsupported(place.node, 'no such node in the scene language')
            return method(place, points)
        except Unsupported as stop:
            self.lost(place.socket.name, stop.node, stop.why)
            return np.full((points.count, 3) if place.socket.type != 'VALUE' else points.count, 0.5)

    # Leaves
    def node_RGB(self, p, points):
        return np.tile(np.array(p.node.outputs[0].default_value[:3], np.float64), (points.count, 1))

    def node_Value(self, p, points):
        return np.full(points.count, float(p.node.outputs[0].default_value))

    def node_UVMap(self, p, points):
        if p.node.from_instancer:
            raise Unsupported(p.node, 'coordinates of the instancer')
        return points.coordinate(p.node, 'uv:' + p.node.uv_map)

    def node_TexCoord(self, p, points):
        kind = p.socket.name
        if kind == 'UV':
            return points.coordinate(p.node, 'uv:')
        if kind == 'Generated':
            return points.coordinate(p.node, 'generated')
        if kind == 'Object' and p.node.object is None:
            return points.coordinate(p.node, 'object')
        raise Unsupported(p.node, 'coordinates "%s"' % kind)

    def node_NewGeometry(self, p, points):
        raise Unsupported(p.node, 'geometry "%s"' % p.socket.name)

    def _layer(self, p, points, layer):
        if points.colours is None:
            points.asked.add(('colour', layer))
            raise Unsupported(p.node, 'vertex colours together with coordinates')
        values = points.colours(layer)
        points.asked.add(('colour', layer))
        if values is None:
            self.lost(p.socket.name, p.node, 'the mesh has no colour layer "%s"' % layer)
            values = np.zeros((points.count, 4))
        return values[:, 3] if p.socket.name == 'Alpha' else values[:, :3]

    def node_VertexColor(self, p, points):
        return self._layer(p, points, p.node.layer_name)

    def node_Attribute(self, p, points):
        if p.node.attribute_type != 'GEOMETRY':
            raise Unsupported(p.node, 'attribute of the %s' % p.node.attribute_type.lower())
        values = self._layer(p, points, p.node.attribute_name)
        return as_number(values) if p.socket.name == 'Fac' else values

    def node_TexImage(self, p, points):
        if points.sampler is None:
            raise Unsupported(p.node, 'an image where a constant is needed')
        values = points.sampler(self, p, points)
        return values[:, 3] if p.socket.name == 'Alpha' else values[:, :3]

    def place_vector(self, p, points):
        """What an unlinked Vector input of a texture means: generated coordinates; an image: the UV map."""
        socket = p.node.inputs['Vector']
        if socket.is_linked:
            return self.colour(p, socket, points)
        return points.coordinate(p.node, 'uv:' if p.node.bl_idname == 'ShaderNodeTexImage' else 'generated')

    def native(self, p, points):
        """While probing: remember a procedural texture and where it is evaluated."""
        if points.natives is None:
            return False
        at = self.place_vector(p, points)
        points.natives.append((p, at))
        return True

    def node_TexNoise(self, p, points):
        if self.native(p, points):
            return np.full(points.count, 0.5)
        raise Unsupported(p.node, 'a procedural texture together with others')

    node_TexVoronoi = node_TexMusgrave = node_TexMagic = node_TexWhiteNoise = node_TexGabor = node_TexNoise

    def node_TexBrick(self, p, points):
        """Rows of bricks in x and y, each of a tint of its own."""
        if self.native(p, points):
            middle = 0.5 * (self.colour(p, 'Color1', points) + self.colour(p, 'Color2', points))
            return middle if p.socket.name == 'Color' else np.full(points.count, 0.5)
        at = self.place_vector(p, points) * self.number(p, 'Scale', points)[:, None]
        joint, soft, bias, width, high = (self.number(p, name, points) for name in (
            'Mortar Size', 'Mortar Smooth', 'Bias', 'Brick Width', 'Row Height'))
        high = np.where(high == 0, 1e-6, high)
        row = np.floor(at[:, 1] / high).astype(np.int64)
        offset = np.zeros(points.count)
        if p.node.offset_frequency and p.node.squash_frequency:
            width = np.where(row % p.node.squash_frequency, width, width * p.node.squash)
            offset = np.where(row % p.node.offset_frequency, 0.0, width * p.node.offset)
        width = np.where(width == 0, 1e-6, width)
        brick = np.floor((at[:, 0] + offset) / width).astype(np.int64)
        x, y = at[:, 0] + offset - width * brick, at[:, 1] - high * row
        tint = np.clip(_brick_noise((row << 16) + (brick & 0xffff)) + bias, 0, 1)
        edge = np.minimum(np.minimum(x, y), np.minimum(width - x, high - y))
        share = 1 - edge / np.where(joint == 0, 1, joint)
        smooth = np.clip(share / np.where(soft == 0, 1, soft), 0, 1)
        mortar = np.where(edge >= joint, 0.0, np.where(soft == 0, 1.0, smooth * smooth * (3 - 2 * smooth)))
        if p.socket.name == 'Fac':
            return mortar
        one, two, three = (self.colour(p, name, points) for name in ('Color1', 'Color2', 'Mortar'))
        face = one + (two - one) * tint[:, None]
        return face + (three - face) * mortar[:, None]

    def node_TexChecker(self, p, points):
        if self.native(p, points):
            # Its colours may hold further textures.
            return 0.5 * (self.colour(p, 'Color1', points) + self.colour(p, 'Color2', points)) \
                if p.socket.name == 'Color' else np.full(points.count, 0.5)
        at = self.place_vector(p, points) * self.number(p, 'Scale', points)[:, None]
        cell = np.floor((at + 0.000001) * 0.999999)
        odd = (np.abs(cell).sum(axis=1) % 2) == 1
        if p.socket.name == 'Fac':
            return odd * 1.0
        return np.where(odd[:, None], self.colour(p, 'Color1', points), self.colour(p, 'Color2', points))

    def node_TexGradient(self, p, points):
        if self.native(p, points):
            return np.full(points.count, 0.5)
        x, y, z = self.place_vector(p, points).T
        kind = p.node.gradient_type
        radius = np.maximum(1.0 - np.sqrt(x * x + y * y + z * z), 0.0)
        r = np.maximum(x, 0.0)
        t = np.clip(x, 0.0, 1.0)
        value = {'LINEAR': x, 'QUADRATIC': r * r, 'EASING': 3 * t * t - 2 * t ** 3, 'DIAGONAL': (x + y) * 0.5,
                 'RADIAL': np.arctan2(y, x) / (2 * np.pi) + 0.5, 'QUADRATIC_SPHERE': radius ** 2,
                 'SPHERICAL': radius}[kind]
        return np.clip(value, 0.0, 1.0)

    def node_TexWave(self, p, points):
        if self.native(p, points):
            return np.full(points.count, 0.5)
        if np.any(self.number(p, 'Distortion', points) != 0):
            raise Unsupported(p.node, 'a wave with distortion')
        at = (self.place_vector(p, points) * self.number(p, 'Scale', points)[:, None] + 0.000001) * 0.999999
        x, y, z = at.T
        if p.node.wave_type == 'BANDS':
            n = {'X': x * 20, 'Y': y * 20, 'Z': z * 20, 'DIAGONAL': (x + y + z) * 10}[p.node.bands_direction]
        else:
            keep = {'X': (0, 1, 1), 'Y': (1, 0, 1), 'Z': (1, 1, 0), 'SPHERICAL': (1, 1, 1)}[p.node.rings_direction]
            n = np.linalg.norm(at * np.array(keep), axis=1) * 20
        n = n + self.number(p, 'Phase Offset', points)
        if p.node.wave_profile == 'SIN':
            return 0.5 + 0.5 * np.sin(n - np.pi / 2)
        n = n / (2 * np.pi)
        return n - np.floor(n) if p.node.wave_profile == 'SAW' else np.abs(n - np.floor(n + 0.5)) * 2

    def node_LightPath(self, p, points):
        """As a camera ray finds it: what other rays would see is lost."""
        self.lost(p.socket.name, p.node, 'seen as by camera rays, whatever the ray')
        first = {'Is Camera Ray': 1.0, 'Ray Length': 1.0}
        return np.full(points.count, first.get(p.socket.name, 0.0))

    # By the angle of view
    def _seen(self, p, points, of):
        """of(cosine), or its mean over a ball where angles are not known."""
        if points.facing is not None:
            points.facing.append(p)
        normal = p.node.inputs.get('Normal')
        if normal is not None and normal.is_linked:
            self.lost('Normal', p.node, 'the angle to a bent normal; taken to the surface\'s own')
        if points.cosine is not None:
            return of(points.cosine)
        return sum(of(np.full(points.count, c)) for c in DISC) / len(DISC)

    def node_Fresnel(self, p, points):
        eta = np.maximum(self.number(p, 'IOR', points, 1.45), 1e-5)
        return self._seen(p, points, lambda cosine: fresnel(cosine, eta))

    def node_LayerWeight(self, p, points):
        blend = self.number(p, 'Blend', points, 0.5)
        if p.socket.name == 'Fresnel':
            eta = 1 / np.maximum(1 - blend, 1e-5)
            return self._seen(p, points, lambda cosine: fresnel(cosine, eta))
        blend = np.clip(blend, 0, 1 - 1e-5)
        power = np.where(blend < 0.5, 2 * blend, 0.5 / (1 - blend))
        return self._seen(p, points, lambda cosine: 1 - np.abs(cosine) ** power)

    def node_ObjectInfo(self, p, points):
        raise Unsupported(p.node, 'object info "%s"' % p.socket.name)

    # Vectors
    def node_Mapping(self, p, points):
        from mathutils import Euler
        vector = self.colour(p, 'Vector', points)
        location, rotation, scale = (self.colour(p, n, points, 1 if n == 'Scale' else 0)[0]
                                     for n in ('Location', 'Rotation', 'Scale'))
        turn = np.array(Euler(rotation).to_matrix())
        kind = p.node.vector_type
        if kind == 'POINT':
            return (vector * scale) @ turn.T + location
        if kind == 'TEXTURE':
            return ((vector - location) @ turn) / np.where(scale == 0, 1, scale)
        if kind == 'VECTOR':
            return (vector * scale) @ turn.T
        raise Unsupported(p.node, 'mapping of normals')

    def _is_facing(self, p):
        """A dot product of where the ray comes from and the normal."""
        ends = [origin(Place(p.node, p.node.inputs[i], p.stack))[0] for i in (0, 1)]
        return p.node.operation == 'DOT_PRODUCT' and all(
            e is not None and e.node.bl_idname == 'ShaderNodeNewGeometry' for e in ends) \
            and {e.socket.name for e in ends} == {'Incoming', 'Normal'}

    def node_VectorMath(self, p, points):
        if self._is_facing(p):
            return self._seen(p, points, lambda cosine: cosine)
        a, b = self.colour(p, 0, points), self.colour(p, 1, points)
        kind = p.node.operation
        simple = {'ADD': a + b, 'SUBTRACT': a - b, 'MULTIPLY': a * b, 'ABSOLUTE': np.abs(a), 'FLOOR': np.floor(a),
                  'CEIL': np.ceil(a), 'FRACTION': a - np.floor(a), 'MINIMUM': np.minimum(a, b),
                  'MAXIMUM': np.maximum(a, b), 'DIVIDE': np.where(b == 0, 0, a / np.where(b == 0, 1, b)),
                  'DOT_PRODUCT': (a * b).sum(axis=1), 'CROSS_PRODUCT': np.cross(a, b),
                  'LENGTH': np.linalg.norm(a, axis=1), 'DISTANCE': np.linalg.norm(a - b, axis=1),
                  'NORMALIZE': a / np.maximum(np.linalg.norm(a, axis=1, keepdims=True), 1e-20)}
        if kind == 'SCALE':
            return a * self.number(p, 'Scale', points)[:, None]
        if kind == 'MULTIPLY_ADD':
            return a * b + self.colour(p, 2, points)
        if kind not in simple:
            raise Unsupported(p.node, 'vector %s' % kind.lower())
        return simple[kind]

    # Colours
    def node_MixRGB(self, p, points):
        factor = self.number(p, 'Fac', points)
        result = blend(p.node.blend_type, np.clip(factor, 0, 1), self.colour(p, 'Color1', points),
                       self.colour(p, 'Color2', points))
        if result is None:
            raise Unsupported(p.node, 'mixing by %s' % p.node.blend_type.lower())
        return np.clip(result, 0, 1) if p.node.use_clamp else result

    def node_Mix(self, p, points):
        inputs = [s for s in p.node.inputs if s.enabled]
        factor = self.value(Place(p.node, inputs[0], p.stack), points)
        a, b = (self.value(Place(p.node, s, p.stack), points) for s in inputs[1:3])
        if p.node.clamp_factor:
            factor = np.clip(factor, 0, 1)
        if p.node.data_type == 'RGBA':
            result = blend(p.node.blend_type, factor, as_colour(a), as_colour(b))
            if result is None:
                raise Unsupported(p.node, 'mixing by %s' % p.node.blend_type.lower())
            return np.clip(result, 0, 1) if p.node.clamp_result else result
        if a.ndim == 2 and factor.ndim == 1:
            factor = factor[:, None]
        return a + (b - a) * factor

    def node_Math(self, p, points):
        a, b, c = (self.number(p, i, points) if i < len(p.node.inputs) else 0.0 for i in range(3))
        if p.node.operation not in MATH:
            raise Unsupported(p.node, 'math %s' % p.node.operation.lower())
        with np.errstate(all='ignore'):
            result = np.nan_to_num(MATH[p.node.operation](a, b, c) * 1.0)
        return np.clip(result, 0, 1) if p.node.use_clamp else result

    def node_Gamma(self, p, points):
        colour, gamma = self.colour(p, 'Color', points), self.number(p, 'Gamma', points)
        return np.where(colour > 0, np.power(np.maximum(colour, 1e-30), gamma[:, None]), colour)

    def node_BrightContrast(self, p, points):
        bright, contrast = self.number(p, 'Bright', points), self.number(p, 'Contrast', points)
        return np.maximum(self.colour(p, 'Color', points) * (1 + contrast)[:, None]
                          + (bright - contrast * 0.5)[:, None], 0)

    def node_HueSaturation(self, p, points):
        colour = self.colour(p, 'Color', points)
        turned = hsv(colour)
        turned[:, 0] = (turned[:, 0] + self.number(p, 'Hue', points) + 0.5) % 1.0
        turned[:, 1] = np.clip(turned[:, 1] * self.number(p, 'Saturation', points), 0, 1)
        turned[:, 2] *= self.number(p, 'Value', points)
        factor = self.number(p, 'Fac', points)[:, None]
        return np.maximum(colour * (1 - factor) + rgb_of_hsv(turned) * factor, 0)

    def node_Invert(self, p, points):
        colour, factor = self.colour(p, 'Color', points), self.number(p, 'Fac', points, 1)[:, None]
        return colour + (1 - 2 * colour) * factor

    def node_RGBToBW(self, p, points):
        return as_number(self.colour(p, 'Color', points))

    def node_Clamp(self, p, points):
        value, low, high = (self.number(p, n, points) for n in ('Value', 'Min', 'Max'))
        if p.node.clamp_type == 'RANGE':
            low, high = np.minimum(low, high), np.maximum(low, high)
        return np.minimum(np.maximum(value, low), high)

    def node_MapRange(self, p, points):
        if p.node.data_type != 'FLOAT':
            raise Unsupported(p.node, 'map range of vectors')
        value, a, b, c, d = (self.number(p, i, points) for i in range(5))
        t = np.where(a == b, 0, (value - a) / np.where(a == b, 1, b - a))
        kind = p.node.interpolation_type
        if kind == 'STEPPED':
            steps = self.number(p, 'Steps', points)
            t = np.floor(t * (steps + 1)) / np.maximum(steps, 1e-6)
        elif kind == 'SMOOTHSTEP':
            t = np.clip(t, 0, 1)
            t = t * t * (3 - 2 * t)
        elif kind == 'SMOOTHERSTEP':
            t = np.clip(t, 0, 1)
            t = t ** 3 * (t * (t * 6 - 15) + 10)
        result = c + t * (d - c)
        return np.minimum(np.maximum(result, np.minimum(c, d)), np.maximum(c, d)) if p.node.clamp else result

    def node_ValToRGB(self, p, points):
        factor = np.clip(self.number(p, 'Fac', points), 0, 1)
        steps = np.linspace(0, 1, 1025)
        table = np.array([p.node.color_ramp.evaluate(float(s)) for s in steps])
        if p.node.color_ramp.interpolation == 'CONSTANT':
            values = table[np.rint(factor * 1024).astype(int)]
        else:
            values = np.stack([np.interp(factor, steps, table[:, i]) for i in range(4)], 1)
        return values[:, 3] if p.socket.name == 'Alpha' else values[:, :3]

    def _curve(self, node, which, values):
        mapping = node.mapping
        mapping.initialize()
        low, high = float(values.min()), float(values.max())
        steps = np.linspace(low, high, 513) if high > low else np.array([low])
        table = np.array([mapping.evaluate(mapping.curves[which], float(s)) for s in steps])
        return np.interp(values, steps, table) if high > low else np.full(values.shape, table[0])

    def node_RGBCurve(self, p, points):
        colour, factor = self.colour(p, 'Color', points), self.number(p, 'Fac', points, 1)[:, None]
        curved = np.stack([self._curve(p.node, i, self._curve(p.node, 3, colour[:, i])) for i in range(3)], 1)
        return colour + (curved - colour) * factor

    def node_FloatCurve(self, p, points):
        value, factor = self.number(p, 'Value', points), self.number(p, 'Factor', points, 1)
        return value + (self._curve(p.node, 0, value) - value) * factor

    def _separate(self, p, points, name):
        values = self.colour(p, name, points)
        if getattr(p.node, 'mode', 'RGB') == 'HSV' or p.node.bl_idname.endswith('HSV'):
            values = hsv(values)
        elif getattr(p.node, 'mode', 'RGB') == 'HSL':
            raise Unsupported(p.node, 'HSL')
        return values[:, [s.name for s in p.node.outputs].index(p.socket.name)]

    def node_SeparateColor(self, p, points):
        return self._separate(p, points, 'Color')

    def node_SeparateRGB(self, p, points):
        return self._separate(p, points, 'Image')

    def node_SeparateHSV(self, p, points):
        return self._separate(p, points, 'Color')

    def node_SeparateXYZ(self, p, points):
        return self._separate(p, points, 'Vector')

    def _combine(self, p, points):
        values = np.stack([self.number(p, i, points) for i in range(3)], 1)
        if getattr(p.node, 'mode', 'RGB') == 'HSV' or p.node.bl_idname.endswith('HSV'):
            return rgb_of_hsv(values)
        if getattr(p.node, 'mode', 'RGB') == 'HSL':
            raise Unsupported(p.node, 'HSL')
        return values

    node_CombineColor = node_CombineRGB = node_CombineHSV = node_CombineXYZ = _combine

    def node_Blackbody(self, p, points):
        return blackbody(self.number(p, 'Temperature', points))
