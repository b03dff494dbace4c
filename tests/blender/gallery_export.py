# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Export scenes of the gallery with our own exporter, each into a folder of its own: run by gallery.py.
scene.pov is as users get it; hard.pov has lamps without size, as with their 9 x 9 points POV-Ray's indirect light at high
quality takes hours.

    blender -b --factory-startup -P gallery_export.py -- BLENDER-FOLDER OUT NAME...
"""
import importlib
import os
import sys

import bpy

sys.dont_write_bytecode = True
folder, out, *names = sys.argv[sys.argv.index('--') + 1:]
sys.path[:0] = [folder, os.path.join(folder, 'gallery')]
try:
    gallery = importlib.import_module('gallery')
    engine = importlib.import_module('alidade_pov.engine')
    engine.register()
    for name in names or gallery.SCENES:
        os.makedirs(os.path.join(out, name), exist_ok=True)
        gallery.SCENES[name]()
        for file, settings in (('scene.pov', {}), ('hard.pov', {'lamp_grid': 1})):
            engine.export(bpy.context.scene, os.path.join(out, name, file), engine.Options(strict=True, **settings))
        print('exported %s' % name)
except Exception:
    import traceback
    traceback.print_exc()
