# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The world: a colour is a background, everything else a picture of all directions on a sky_sphere.

The picture is computed from the nodes with numpy (images, mappings, gradients, colour nodes). Only where a node is
beyond that (the sky models, noise) Cycles is asked to draw the world by itself.
"""
import math

import numpy as np

from . import images, pictures, text
from .values import Place, Points, Tree, Unsupported, origin

WIDTH = 1024


class Sky(Tree):
    """Evaluates a world's nodes: every kind of coordinate is the direction."""

    def __init__(self, losses, where, store):
        super().__init__(losses, where)
        self.store = store
        self.failed = []

    def lost(self, place, node, why):
        self.failed.append((place, node.name, why))

    def node_TexEnvironment(self, p, points):
        image = p.node.image
        pixels = image and self.store.linear(image)
        if pixels is None:
            raise Unsupported(p.node, 'an image without pixels')
        socket = p.node.inputs['Vector']
        at = self.colour(p, socket, points) if socket.is_linked else points.coordinate(p.node, 'generated')
        x, y, z = (at / np.maximum(np.linalg.norm(at, axis=1, keepdims=True), 1e-20)).T
        if p.node.projection == 'MIRROR_BALL':
            depth = 2 * np.sqrt(np.maximum(0.5 - 0.5 * y, 0))
            depth = np.where(depth > 0, depth, 1)
            u, v = (x / depth + 1) * 0.5, (z / depth + 1) * 0.5
        else:
            u = -np.arctan2(y, x) / (2 * math.pi) + 0.5
            v = np.arctan2(z, np.hypot(x, y)) / math.pi + 0.5
        return images.sample(pixels, u, v, p.node.interpolation == 'Closest')[:, :3]

    def node_LightPath(self, p, points):
        raise Unsupported(p.node, 'light paths: the camera sees another world than surfaces')


def directions(width, height):
    """Blender's directions of an equirectangular picture's pixels, top row first."""
    u = (np.arange(width) + 0.5) / width
    v = 1 - (np.arange(height) + 0.5) / height
    turn = (0.5 - u) * 2 * math.pi
    rise = (v - 0.5) * math.pi
    turn, rise = np.meshgrid(turn, rise)
    return np.stack([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)], -1)


def _environments(tree):
    for node in tree.nodes:
        if node.bl_idname == 'ShaderNodeTexEnvironment' and node.image:
            yield node
        elif node.bl_idname == 'ShaderNodeGroup' and node.node_tree:
            yield from _environments(node.node_tree)


def _radiance(sky, place, points):
    """Light of a world's shader: backgrounds, mixed and added."""
    source, _ = origin(place)
    if source is None:
        return np.zeros((points.count, 3))
    node = source.node
    if node.bl_idname in ('ShaderNodeBackground', 'ShaderNodeEmission'):
        return sky.colour(source, 'Color', points) * sky.number(source, 'Strength', points)[:, None]
    if node.bl_idname == 'ShaderNodeMixShader':
        share = np.clip(sky.value(Place(node, node.inputs[0], source.stack), points), 0, 1)[:, None]
        a, b = (_radiance(sky, Place(node, node.inputs[i], source.stack), points) for i in (1, 2))
        return a + (b - a) * share
    if node.bl_idname == 'ShaderNodeAddShader':
        return sum(_radiance(sky, Place(node, node.inputs[i], source.stack), points) for i in (0, 1))
    sky.lost('Surface', node, 'no light of a world')
    return np.zeros((points.count, 3))


# POV-Ray's sphere map has y up and u = atan2(z, x) / 2 pi (measured); this turns it to Blender's 1/2 - atan2(y, x) / 2 pi.
TURN = 'matrix <-1,0,0, 0,0,1, 0,1,0, 0,0,0>'


def write(out, world, context):
    """background or sky_sphere. Returns whether the world lights the scene."""
    if world is None:
        out.append('background { rgb 0 }\n')
        return False
    label = world.name_full
    losses = context.losses
    if not world.use_nodes or world.node_tree is None:
        rgb = np.array(world.color[:3]) * context.exposure
        out.append('background { rgb %s }\n' % text.vector(rgb))
        return bool(rgb.max() > 0)
    output = next((n for n in world.node_tree.nodes if n.bl_idname == 'ShaderNodeOutputWorld' and n.is_active_output), None)
    if output is None:
        out.append('background { rgb 0 }\n')
        return False
    if output.inputs['Volume'].is_linked:
        losses.lost(label, 'Volume', output.name, 'volumes are not written')
    sky = Sky(losses, label, context.store)
    place = Place(output, output.inputs['Surface'])
    probe = directions(16, 8).reshape(-1, 3)
    points = Points(len(probe), every=probe)
    light = _radiance(sky, place, points) * context.exposure
    varies = bool(points.asked)
    if sky.failed:
        drawn = context.draw_world(world) if context.draw_world else None
        for where, node, why in sky.failed:
            if drawn is None:
                losses.lost(label, where, node, why)
            else:
                losses.nearest(label, where, node, 'drawn by Cycles as a picture')
        if drawn is not None:
            return _sphere(out, drawn * context.exposure, context, label)
    if not varies:
        out.append('background { rgb %s }\n' % text.vector(light[0]))
        return bool(light.max() > 0)
    width = WIDTH
    for node in _environments(world.node_tree):
        width = max(width, min(node.image.size[0], 4096))
    grid = directions(width, width // 2)
    rows = []
    for start in range(0, len(grid), 64):
        part = grid[start:start + 64].reshape(-1, 3)
        rows.append(_radiance(sky, place, Points(len(part), every=part)).reshape(-1, width, 3))
    return _sphere(out, np.concatenate(rows) * context.exposure, context, label)


def _sphere(out, pixels, context, label):
    name = context.store.put(pictures.hdr(pixels), 'world-' + label, '.hdr')
    out.append('sky_sphere { // %s\npigment {\nimage_map { hdr %s map_type 1 interpolate 2 }\n%s\n}\n}\n'
               % (text.comment(label), text.quoted(name), TURN))
    return bool(pixels.max() > 0)


