# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The menu entry and its file dialogue."""
import bpy
from bpy.props import BoolProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from . import engine


class EXPORT_SCENE_OT_alidade_pov(bpy.types.Operator, ExportHelper):
    """Write the scene for Alidade and POV-Ray"""
    bl_idname = 'export_scene.alidade_pov'
    bl_label = 'Export POV-Ray scene (Alidade)'
    bl_options = {'PRESET'}

    filename_ext = '.pov'
    filter_glob: StringProperty(default='*.pov', options={'HIDDEN'})
    animation: BoolProperty(name='All frames', default=False,
                            description='A numbered file for each frame, and one that includes them')
    radiosity: BoolProperty(name='Indirect light', default=True, description='Write a radiosity block')
    strict: BoolProperty(name='Strict', default=False,
                         description='Fail if the scene language cannot say something')
    lamp_grid: IntProperty(name='Lamp grid', default=9, min=1, max=65,
                           description='Points a side of soft lamps; 1 makes all shadows hard')
    blur_samples: IntProperty(name='Blur samples', default=256, min=4, max=4096,
                              description='Samples a pixel for a camera that is out of focus')

    relief: IntProperty(name='Normal maps', default=200000, min=0,
                        description='Triangles that a mesh with a normal map may become; 0 leaves such maps out')

    def execute(self, context):
        scene = context.scene
        options = engine.Options(strict=self.strict, radiosity='auto' if self.radiosity else 'off',
                                 lamp_grid=self.lamp_grid, blur_samples=self.blur_samples,
                                 relief=self.relief)
        try:
            if self.animation:
                frames = engine.export_frames(scene, self.filepath, scene.frame_start, scene.frame_end,
                                              scene.frame_step, options)
                lines = sorted({line for _, losses in frames for line in losses.lost_lines()})
            else:
                lines = engine.export(scene, self.filepath, options).lost_lines()
                engine.write_ini(scene, self.filepath)
        except engine.Lost as lost:
            for line in str(lost).splitlines():
                self.report({'ERROR'}, 'Lost: ' + line)
            return {'CANCELLED'}
        except OSError as error:
            self.report({'ERROR'}, '%s: %s' % (self.filepath, error.strerror or error))
            return {'CANCELLED'}
        for line in lines:
            self.report({'WARNING'}, 'Lost: ' + line)
        return {'FINISHED'}


def menu(self, context):
    self.layout.operator(EXPORT_SCENE_OT_alidade_pov.bl_idname, text='POV-Ray scene (Alidade)')


def register():
    bpy.utils.register_class(EXPORT_SCENE_OT_alidade_pov)
    bpy.types.TOPBAR_MT_file_export.append(menu)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(menu)
    bpy.utils.unregister_class(EXPORT_SCENE_OT_alidade_pov)
