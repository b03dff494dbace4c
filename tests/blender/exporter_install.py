# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The zip in a Blender that has never been used: install, enable, export from the menu's operator, disable."""
import os
import sys

import bpy

archive, out = sys.argv[sys.argv.index('--') + 1:]


def check(name, good, why=''):
    print('ok ' + name if good else 'not ok %s: %s' % (name, why))


try:
    check('Blender starts with an empty user folder', not os.path.exists(bpy.utils.user_resource('SCRIPTS', path='addons')
                                                                         + '/alidade_pov'))
    bpy.ops.preferences.addon_install(filepath=archive)
    bpy.ops.preferences.addon_enable(module='alidade_pov')
    check('the add-on is enabled', 'alidade_pov' in bpy.context.preferences.addons)
    check('the operator is there', hasattr(bpy.ops.export_scene, 'alidade_pov')
          and bpy.ops.export_scene.alidade_pov.get_rna_type().name == 'Export POV-Ray scene (Alidade)')
    menus = [f.__module__ for f in bpy.types.TOPBAR_MT_file_export._dyn_ui_initialize()]
    check('File > Export has an entry', 'alidade_pov.interface' in menus, menus)
    before = bpy.context.scene.render.engine
    result = bpy.ops.export_scene.alidade_pov(filepath=out, lamp_grid=1)
    with open(out, encoding='utf-8') as file:
        written = file.read()
    check('the default scene is exported', result == {'FINISHED'} and 'M_Cube' in written and 'light_source' in written)
    check('its .ini too', os.path.exists(out[:-4] + '.ini'))
    check('the scene\'s render engine is left as it was', bpy.context.scene.render.engine == before)
    bpy.ops.preferences.addon_disable(module='alidade_pov')
    check('the add-on is disabled', 'alidade_pov' not in bpy.context.preferences.addons
          and not hasattr(bpy.types, 'EXPORT_SCENE_OT_alidade_pov'))
    print('done')
except Exception:
    import traceback
    traceback.print_exc()
