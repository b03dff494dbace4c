# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""File > Export > POV-Ray scene (Alidade): Blender scenes as POV-Ray and Alidade read them."""

bl_info = {
    'name': 'POV-Ray scene (Alidade)',
    'author': 'The Alidade authors',
    'version': (0, 3, 0),
    'blender': (3, 4, 0),
    'location': 'File > Export',
    'description': 'Write the scene for Alidade and POV-Ray: meshes, instances, hair, lamps, world, Principled materials',
    'category': 'Import-Export',
}

def register():
    from . import engine, interface
    engine.register()
    interface.register()


def unregister():
    from . import engine, interface
    interface.unregister()
    engine.unregister()
