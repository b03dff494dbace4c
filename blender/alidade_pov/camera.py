# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The camera. Its vectors are written out, so that Blender's axes and units stay as they are: nothing is turned."""
import math

import numpy as np

from . import text


def _frame(camera, scene):
    """Lower left, lower right and upper left corner of the picture in the camera's own space."""
    upper_right, lower_right, lower_left, upper_left = (np.array(v) for v in camera.view_frame(scene=scene))
    if scene.render.use_border and scene.render.use_crop_to_border:
        render = scene.render
        across, up = lower_right - lower_left, upper_left - lower_left
        corner = lower_left
        lower_left = corner + across * render.border_min_x + up * render.border_min_y
        lower_right = corner + across * render.border_max_x + up * render.border_min_y
        upper_left = corner + across * render.border_min_x + up * render.border_max_y
    return lower_left, lower_right, upper_left


def size(scene):
    """The picture's size in pixels."""
    render = scene.render
    width = render.resolution_x * render.resolution_percentage // 100
    height = render.resolution_y * render.resolution_percentage // 100
    if render.use_border and render.use_crop_to_border:
        width = int(width * render.border_max_x) - int(width * render.border_min_x)
        height = int(height * render.border_max_y) - int(height * render.border_min_y)
    return max(int(width), 1), max(int(height), 1)


def _upright(axes):
    """The camera's axes without its scale, perpendicular to the last digit."""
    back = axes[:, 2] / max(np.linalg.norm(axes[:, 2]), 1e-20)
    right = axes[:, 0] - back * np.dot(back, axes[:, 0])
    right /= max(np.linalg.norm(right), 1e-20)
    return np.column_stack([right, np.cross(back, right), back])


def write(out, ob, scene, context):
    camera = ob.data
    matrix = np.array(ob.matrix_world)
    # Blender leaves a camera's scale out.
    turn = _upright(matrix[:3, :3])
    location = matrix[:3, 3]
    if context.farthest > camera.clip_end:
        context.losses.lost(ob.name_full, 'Clip End', '-', 'what lies farther is drawn')
    if context.nearest < camera.clip_start:
        context.losses.lost(ob.name_full, 'Clip Start', '-', 'what lies nearer is drawn')
    if camera.type == 'PANO':
        return _panorama(out, camera, turn, location, context, ob.name_full)
    lower_left, lower_right, upper_left = _frame(camera, scene)
    across, up = lower_right - lower_left, upper_left - lower_left
    middle = lower_left + 0.5 * (across + up)
    lines = []
    if camera.type == 'ORTHO':
        # Rays start on the frame; Blender's frame lies before the camera, ours where the camera stands.
        start = location + turn @ np.array([middle[0], middle[1], 0.0])
        lines += ['orthographic', 'location %s' % text.precise(start),
                  'direction %s' % text.precise(turn @ np.array([0, 0, -1.0]))]
    else:
        depth = abs(middle[2])
        middle, across, up = middle / depth, across / depth, up / depth
        lines += ['perspective', 'location %s' % text.vector(location), 'direction %s' % text.precise(turn @ middle)]
    lines += ['right %s' % text.precise(turn @ across), 'up %s' % text.precise(turn @ up)]
    lines += _focus(camera, matrix, turn, location, context)
    out.append('camera { // %s\n%s\n}\n' % (text.comment(ob.name_full), '\n'.join(lines)))


def _focus(camera, matrix, turn, location, context):
    dof = camera.dof
    if not dof.use_dof:
        return []
    if camera.type == 'ORTHO':
        context.losses.lost(camera.name_full, 'Depth of Field', '-', 'focus of an orthographic camera')
        return []
    if dof.focus_object is not None:
        target = dof.focus_object
        if dof.focus_subtarget and target.pose and dof.focus_subtarget in target.pose.bones:
            point = target.matrix_world @ target.pose.bones[dof.focus_subtarget].matrix.translation
        else:
            point = target.matrix_world.translation
        distance = abs(float(np.dot(np.array(point) - location, turn[:, 2])))
    else:
        distance = dof.focus_distance
    if distance <= 0 or dof.aperture_fstop <= 0:
        return []
    radius = camera.lens * 1e-3 / (2 * dof.aperture_fstop)
    if dof.aperture_blades or dof.aperture_ratio != 1.0:
        context.losses.lost(camera.name_full, 'Aperture', '-', 'blades and ratio of the aperture; drawn round')
    focal = location - turn[:, 2] * distance
    return ['focal_point %s' % text.vector(focal), 'aperture %s' % text.number(aperture(radius)),
            'blur_samples %d confidence 0.99 variance 1/100000' % context.options.blur_samples]


def aperture(radius):
    """POV-Ray's word for a lens (measured: its rays start on a disc whose radius is a quarter of it)."""
    return 4.0 * radius


def _panorama(out, camera, turn, location, context, label):
    settings = getattr(camera, 'cycles', camera)
    kind = getattr(settings, 'panorama_type', None) or getattr(camera, 'panorama_type', 'EQUIRECTANGULAR')
    forward, right, up = -turn[:, 2], turn[:, 0], turn[:, 1]
    lines = []
    if kind == 'EQUIRECTANGULAR':
        low_u, high_u = settings.longitude_min, settings.longitude_max
        low_v, high_v = settings.latitude_min, settings.latitude_max
        across, high = high_u - low_u, high_v - low_v
        lines = ['spherical', 'angle %s %s' % (text.number(math.degrees(across)), text.number(math.degrees(high)))]
        if abs(low_u + high_u) > 1e-5 or abs(low_v + high_v) > 1e-5:
            context.losses.lost(label, 'Longitude, Latitude', '-', 'a window that is not around the middle')
    elif kind in ('FISHEYE_EQUIDISTANT', 'FISHEYE_EQUISOLID'):
        angle = settings.fisheye_fov
        if kind == 'FISHEYE_EQUISOLID':
            context.losses.lost(label, 'Panorama Type', '-', 'an equisolid fisheye; drawn equidistant')
        lines = ['fisheye', 'angle %s' % text.number(math.degrees(angle))]
    else:
        context.losses.lost(label, 'Panorama Type', '-', '%s; drawn as a sphere' % kind.lower())
        lines = ['spherical', 'angle 360 180']
    lines += ['location %s' % text.vector(location), 'direction %s' % text.precise(forward),
              'right %s' % text.precise(right), 'up %s' % text.precise(up)]
    out.append('camera { // %s\n%s\n}\n' % (text.comment(label), '\n'.join(lines)))
