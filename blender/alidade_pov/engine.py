# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How an export gets the scene as a render would see it, and the files of a range of frames.

Blender gives a script the scene as the viewport shows it: other subdivision levels, other particle counts, what is
hidden there. A render engine gets it as rendered; so an export is a render with an engine that writes a file.
"""
import os
import tempfile

import bpy
import numpy as np

from . import camera, visible
from .losses import Losses
from .scene import Export, Lost, Options


class Job:
    """What the engine does next; set for the length of one render."""
    path = options = losses = error = draw_world = known = None


class AlidadeExportEngine(bpy.types.RenderEngine):
    bl_idname = 'ALIDADE_EXPORT'
    bl_label = 'POV-Ray scene (Alidade)'
    bl_use_preview = False
    bl_use_postprocess = False

    def update(self, data, depsgraph):
        pass

    def render(self, depsgraph):
        if Job.path is None or Job.losses is not None or Job.error is not None:
            return
        try:
            Job.losses = Export(depsgraph, Job.path, Job.options, bpy.app.version, Job.draw_world, Job.known).run()
        except Exception as error:      # Blender would print it and go on
            Job.error = error


def draw_world(world):
    """The world by itself as Cycles draws it: pixels of all directions, or None without Cycles."""
    scene = bpy.data.scenes.new('Alidade world')
    eye = bpy.data.cameras.new('Alidade world')
    ob = bpy.data.objects.new('Alidade world', eye)
    folder = tempfile.mkdtemp()
    path = os.path.join(folder, 'world.exr')
    try:
        scene.render.engine = 'CYCLES'
        scene.collection.objects.link(ob)
        scene.camera = ob
        scene.world = bpy.data.worlds.get(world.name) if world.name in bpy.data.worlds else world
        eye.type = 'PANO'
        (eye if hasattr(eye, 'panorama_type') else eye.cycles).panorama_type = 'EQUIRECTANGULAR'
        # The middle of an equirectangular picture is where the camera looks: +x for a world's picture.
        ob.rotation_euler = (np.pi / 2, 0, -np.pi / 2)
        scene.cycles.samples = 16
        scene.cycles.use_denoising = False
        scene.cycles.use_adaptive_sampling = False
        scene.render.resolution_x, scene.render.resolution_y = 1024, 512
        scene.render.resolution_percentage = 100
        scene.render.image_settings.file_format = 'OPEN_EXR'
        scene.render.image_settings.color_depth = '32'
        scene.render.filepath = path
        bpy.ops.render.render(write_still=True, scene=scene.name)
        image = bpy.data.images.load(path)
        pixels = np.empty(1024 * 512 * image.channels, np.float32)
        image.pixels.foreach_get(pixels)
        pixels = pixels.reshape(512, 1024, -1)[::-1, :, :3].copy()
        bpy.data.images.remove(image)
        return pixels
    except (TypeError, RuntimeError, AttributeError):
        return None
    finally:
        bpy.data.scenes.remove(scene)
        bpy.data.cameras.remove(eye)
        if os.path.exists(path):
            os.remove(path)
        os.rmdir(folder)


def _worlds_beyond_us(scene):
    """Whether the world holds a node that only Cycles can draw."""
    def nodes(tree):
        for node in tree.nodes:
            yield node
            if getattr(node, 'node_tree', None):
                yield from nodes(node.node_tree)
    world = scene.world
    if not world or not world.use_nodes or not world.node_tree:
        return False
    known = {'TexSky', 'TexNoise', 'TexVoronoi', 'TexMusgrave', 'TexMagic', 'TexBrick', 'TexWhiteNoise'}
    return any(n.bl_idname.replace('ShaderNode', '') in known for n in nodes(world.node_tree))


def export(scene, path, options=None):
    """Write one frame, the scene's current one. Returns the losses."""
    drawn = draw_world(scene.world) if _worlds_beyond_us(scene) else None
    render = scene.render
    before = (render.engine, render.use_compositing, render.use_sequencer, render.use_single_layer,
              render.use_motion_blur, render.use_multiview)
    Job.path, Job.options, Job.losses, Job.error = os.path.abspath(path), options or Options(), None, None
    Job.draw_world = (lambda world: drawn) if drawn is not None else None
    Job.known = Losses()
    visible.afterwards(scene, Job.known)
    try:
        render.engine = 'ALIDADE_EXPORT'
        render.use_compositing = render.use_sequencer = render.use_multiview = False
        if scene.camera is None:
            raise Lost('%s, Camera, -: the scene has no camera' % scene.name)
        bpy.ops.render.render(scene=scene.name)
        if Job.error is not None:
            raise Job.error
        if Job.losses is None:
            raise RuntimeError('Blender did not render the scene "%s"' % scene.name)
        return Job.losses
    finally:
        (render.engine, render.use_compositing, render.use_sequencer, render.use_single_layer,
         render.use_motion_blur, render.use_multiview) = before
        Job.path = None


def write_ini(scene, path, first=None, last=None):
    """The .ini beside a scene: its size, and the frames of an animation."""
    width, height = camera.size(scene)
    stem = os.path.splitext(os.path.basename(path))[0]
    lines = ['; Written by Alidade\'s exporter for Blender', 'Version=3.7', 'Input_File_Name="%s.pov"' % stem,
             'Output_File_Name="%s.png"' % stem, 'Width=%d' % width, 'Height=%d' % height, 'Output_File_Type=N',
             'Output_Alpha=%s' % ('on' if scene.render.film_transparent else 'off'),
             'Antialias=on', 'Antialias_Depth=3', 'Antialias_Threshold=0.1', 'Sampling_Method=2', 'Jitter=off']
    render = scene.render
    if render.use_border and not render.use_crop_to_border:
        lines += ['Start_Column=%.6g' % render.border_min_x, 'End_Column=%.6g' % render.border_max_x,
                  'Start_Row=%.6g' % (1 - render.border_max_y), 'End_Row=%.6g' % (1 - render.border_min_y)]
    if first is not None:
        span = max(last - first, 1)
        lines += ['Initial_Frame=%d' % first, 'Final_Frame=%d' % last, 'Initial_Clock=0', 'Final_Clock=%d' % span]
    with open(os.path.splitext(path)[0] + '.ini', 'w', encoding='utf-8', newline='\n') as out:
        out.write('\n'.join(lines) + '\n')


def numbered(path, frame, digits):
    stem, extension = os.path.splitext(path)
    return '%s%0*d%s' % (stem, digits, frame, extension)


def export_frames(scene, path, first, last, step=1, options=None):
    """A file a frame, PATH0001.pov ..., and PATH.pov, which includes the one of frame_number."""
    digits = max(4, len(str(last)))
    all_losses = []
    kept = scene.frame_current, scene.frame_subframe
    try:
        for frame in range(first, last + 1, step):
            scene.frame_set(frame)
            all_losses.append((frame, export(scene, numbered(path, frame, digits), options)))
    finally:
        scene.frame_set(kept[0], subframe=kept[1])
    stem = os.path.splitext(os.path.basename(path))[0]
    with open(path, 'w', encoding='utf-8', newline='\n') as out:
        out.write('// Written by Alidade\'s exporter for Blender: frame frame_number of %d to %d.\n' % (first, last))
        out.write('#version 3.7;\n#include concat("%s", str(frame_number, -%d, 0), ".pov")\n' % (stem, digits))
    write_ini(scene, path, first, last)
    return all_losses


def register():
    bpy.utils.register_class(AlidadeExportEngine)


def unregister():
    bpy.utils.unregister_class(AlidadeExportEngine)
