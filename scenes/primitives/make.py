# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's own primitives, which it writes as POV-Ray's solids and not as meshes."""
import math
import os
import sys

import bpy

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import common as c


def build():
    c.start(background=(0.35, 0.45, 0.6))


    def primitive(operator, data=None, location=(0, 0, 0), rotation=(0, 0, 0), scale=(1, 1, 1), **pov):
        # With an object active, two of the operators expect it to come from the add-on's importer.
        bpy.context.view_layer.objects.active = None
        getattr(bpy.ops.pov, operator)(**(data or {}))
        ob = bpy.context.object
        ob.location = location
        ob.rotation_euler = [math.radians(a) for a in rotation]
        ob.scale = scale
        for key, value in pov.items():
            setattr(ob.pov, key, value)
        ob.update_tag()
        return ob


    primitive('addplane', location=(0, 0, -0.02))
    primitive('addsphere', {'sphe_rad': 0.8}, location=(-2.6, 0.5, 0.85))
    primitive('addsphere', {'sphe_rad': 0.5}, location=(-1.0, -1.3, 0.6), scale=(1.6, 0.7, 1.0),
              rotation=(0, 20, 30))
    primitive('addbox', location=(-0.4, 1.2, 0.65), rotation=(0, 0, 25), scale=(0.6, 0.7, 0.6))
    primitive('addbox', location=(2.9, 2.0, 1.2), rotation=(10, 40, 25), scale=(0.2, 1.4, -0.3))
    primitive('addcylinder', location=(1.2, -0.4, 0.05), rotation=(0, 0, 0),
              cylinder_radius=0.45, cylinder_location_cap=(0.4, 0.2, 1.5))
    primitive('addcone', {'base': 0.7, 'cap': 0.25, 'height': 1.4}, location=(2.6, -0.6, 0.75))
    primitive('addcone', {'base': 0.5, 'cap': 0.0, 'height': 1.0}, location=(-2.9, -1.4, 0.55),
              rotation=(0, -15, 0))
    primitive('addtorus', {'mar': 0.7, 'mir': 0.22}, location=(0.6, 2.9, 0.95), rotation=(70, 15, 0))
    primitive('addtorus', {'mar': 0.45, 'mir': 0.15}, location=(1.1, -2.0, 0.3), rotation=(8, 0, 0),
              scale=(1.3, 0.8, 1.2))
    c.camera((0.6, -7.2, 3.3), (0, 0.2, 0.6), lens=38)
    c.lamp('POINT', (3, -5, 6), distance=90)
    c.lamp('SUN', (-5, -3, 6), colour=(0.35, 0.35, 0.42))


c.run('primitives', build)
