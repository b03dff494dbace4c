# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps, with Cycles' units (docs/exporter.md, "Lamps").

A white diffuse surface in POV-Ray sends back the lamp's colour times the cosine; in Cycles irradiance / pi. So a lamp
of P watts is, at the distance d, P / (4 pi^2 d^2) as a point and P / (4 pi d^2) in front of a small area. POV-Ray's fade
2 / (1 + (d / f)^2) is 2 (f / d)^2 to a part in a million where f is a thousandth of d: that is the inverse square.
"""
import math

import numpy as np

from . import text, versions
from .paints import Paint
from .values import Place, origin

FADE = 1e-3


def _strength(lamp, painter, losses, where):
    """Colour times energy, with what a lamp's nodes do to it."""
    rgb = np.array(lamp.color[:3], np.float64) * lamp.energy * np.array(versions.lamp_factor(lamp))
    if not versions.lamp_is_normalized(lamp):
        losses.lost(where, 'Normalize', '-', 'energy for each area of the lamp; drawn as that of the whole lamp')
    if not lamp.use_nodes or lamp.node_tree is None:
        return rgb
    output = next((n for n in lamp.node_tree.nodes if n.bl_idname == 'ShaderNodeOutputLight' and n.is_active_output), None)
    if output is None:
        return rgb * 0
    source, _ = origin(Place(output, output.inputs['Surface']))
    if source is None:
        return rgb * 0
    node = source.node
    if node.bl_idname != 'ShaderNodeEmission':
        losses.lost(where, 'Surface', node.name, 'no emission of a lamp')
        return rgb
    factor = 1.0
    for name in ('Color', 'Strength'):
        socket = node.inputs[name]
        inner, _ = origin(Place(node, socket, source.stack))
        if inner is not None and inner.node.bl_idname == 'ShaderNodeLightFalloff':
            if inner.socket.name != 'Quadratic' or inner.node.inputs['Smooth'].default_value:
                losses.lost(where, name, inner.node.name, 'another falloff than the square')
            factor = factor * float(inner.node.inputs['Strength'].default_value)
            continue
        if inner is not None and inner.node.bl_idname == 'ShaderNodeTexIES':
            losses.lost(where, name, inner.node.name, 'the shape of a measured lamp')
            continue
        paint = Paint([(np.ones(3), Place(node, socket, source.stack))])
        value = painter.constant(paint, where)
        if value is None:
            losses.lost(where, name, node.name, 'a lamp with a texture: its mean stands for it')
            value = painter.mean(paint, where)
        factor = factor * value
    return rgb * factor


def _grid(first, second, count, words=''):
    return 'area_light %s, %s, %d, %d %sadaptive 1 area_illumination on' % (
        text.vector(first), text.vector(second), count, count, words)


def _ball(radius, count):
    """A soft lamp that is a ball: a disc that turns to what it lights, whatever its two axes are."""
    return _grid((2 * radius, 0, 0), (0, 2 * radius, 0), count, 'circular orient ')


def spread(half):
    """Exponent of the cosine that comes nearest to Cycles' 1 - tan(a) / tan(half), and what an axis gets more."""
    inner = math.tan(half)
    gain = inner / (inner - half)
    middle = math.atan(0.5 * inner)
    t = (math.cos(middle) - math.cos(half)) / (1 - math.cos(half))
    smooth = t * t * (3 - 2 * t)
    want = math.cos(middle) * 0.5
    return max(math.log(want / smooth) / math.log(math.cos(middle)), 0.0), gain


def write(out, lamp, matrix, label, context):
    """One light_source. context: Export, for its painter, losses, options, exposure and extent."""
    options, losses = context.options, context.losses
    rgb = _strength(lamp, context.painter, losses, label) * context.exposure
    if not np.any(rgb > 0):
        return
    if np.any(rgb < 0):
        losses.nearest(label, '-', '-', 'a lamp that takes light away')
    matrix = np.array(matrix)
    position = matrix[:3, 3]
    axes = matrix[:3, :3]
    along = -axes[:, 2] / max(np.linalg.norm(axes[:, 2]), 1e-20)
    words = []
    radius = getattr(lamp, 'shadow_soft_size', 0.0)
    count = options.lamp_grid
    inverse_square = 'fade_distance %s fade_power 2' % text.number(FADE)

    def target():
        return 'point_at %s' % text.vector(position + along * max(context.radius * 0.01, 1.0))
    if lamp.type == 'SUN':
        colour = rgb / math.pi
        angle = lamp.angle
        distance = 1000.0 * context.radius
        position = context.middle - along * distance
        if angle > math.radians(0.1) and count > 1:
            words.append(_ball(distance * math.tan(min(angle, 3.0) / 2), count))
        else:
            words.append('parallel point_at %s' % text.vector(context.middle))
    elif lamp.type == 'AREA':
        colour = rgb / (4 * math.pi) / (2 * FADE * FADE)
        across = lamp.size
        high = lamp.size_y if lamp.shape in ('RECTANGLE', 'ELLIPSE') else lamp.size
        tightness = 1.0
        falloff = 90.0
        inner = 90.0
        if lamp.spread < math.pi * 0.999:
            half = lamp.spread / 2
            tightness, gain = spread(half)
            colour = colour * gain
            falloff, inner = math.degrees(half), 1e-3
            losses.nearest(label, 'Spread', '-', 'a narrowed area lamp is a spotlight of nearly its shape')
        words.append('spotlight radius %s falloff %s tightness %s %s'
                     % (text.number(inner), text.number(falloff), text.number(tightness), target()))
        words.append(inverse_square)
        if count > 1:
            round_ = 'circular ' if lamp.shape in ('DISK', 'ELLIPSE') else ''
            words.append(_grid(axes[:, 0] * across, axes[:, 1] * high, count, round_))
    else:
        colour = rgb / (4 * math.pi * math.pi) / (2 * FADE * FADE)
        if lamp.type == 'SPOT':
            half = lamp.spot_size / 2
            # Both blend by a smooth step between two cosines.
            inner = math.cos(half) + (1 - math.cos(half)) * lamp.spot_blend
            angle = math.degrees(math.acos(min(inner, 1.0)))
            words.append('spotlight radius %s falloff %s tightness %d %s' % (
                text.number(max(angle, 1e-3)), text.number(math.degrees(half)),
                1 if versions.spot_has_cosine(context.version) else 0, target()))
        words.append(inverse_square)
        if radius > 0 and count > 1:
            words.append(_ball(radius, count))
    if not getattr(lamp, 'use_shadow', True) or not getattr(getattr(lamp, 'cycles', None), 'cast_shadow', True):
        words.append('shadowless')
    out.append('light_source { // %s\n%s rgb %s\n%s\n}\n' % (
        text.comment(label), text.vector(position), text.vector(colour), '\n'.join(words)))
