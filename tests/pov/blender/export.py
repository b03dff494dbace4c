# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the exports of this folder with Blender's own POV-Ray add-on (Blender 3.4):

    for what in default ortho many; do blender -b --factory-startup -P export.py -- $what; done
"""
import os
import sys

import addon_utils
import bpy

addon_utils.enable("render_povray", default_set=True)
what = sys.argv[sys.argv.index("--") + 1]
scene = bpy.context.scene
scene.render.engine = "POVRAY_RENDER"
scene.pov.tempfiles_enable = False  # indented, with comments


def material(name, **settings):
    m = bpy.data.materials.new(name)
    m.use_nodes = False
    for key, value in settings.items():
        setattr(m.pov, key, value)
    return m


def many():
    """All lamps, shared and mirrored mesh data, two materials, colours of corners, smooth and flat."""
    for o in list(bpy.data.objects):
        if o.type != "CAMERA":
            bpy.data.objects.remove(o)
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=2)
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    red = material("Red")
    red.diffuse_color = (0.8, 0.1, 0.1, 1)
    glass = material("Glass", use_transparency=True, transparency_method="RAYTRACE", alpha=0.2)
    glass.specular_intensity = 0.7
    ball.data.materials.append(red)
    ball.data.materials.append(glass)
    for i, face in enumerate(ball.data.polygons):
        face.material_index = i % 2
    linked = bpy.data.objects.new("linked", ball.data)
    linked.location = (2.5, 0, 0)
    linked.scale = (1, -1, 0.5)
    scene.collection.objects.link(linked)
    bpy.ops.mesh.primitive_cube_add(location=(-2.5, 0, 0))
    cube = bpy.context.object
    cube.data.materials.append(material("Vcol"))
    for i, corner in enumerate(cube.data.vertex_colors.new(name="Col").data):
        corner.color = ((i % 3) / 2, (i % 5) / 4, (i % 7) / 6, 1)
    bpy.ops.mesh.primitive_plane_add(size=20, location=(0, 0, -1))
    for kind, place in (("SPOT", (4, 0, 6)), ("SUN", (0, 0, 9)), ("AREA", (-4, 0, 5)), ("POINT", (-4, -6, 5))):
        bpy.ops.object.light_add(type=kind, location=place)
    scene.pov.radio_enable = False


if what == "many":
    many()
elif what == "ortho":
    scene.camera.data.type = "ORTHO"
from render_povray import render  # noqa: E402

render.write_pov(os.path.join(os.path.dirname(os.path.abspath(__file__)), what + ".pov"), scene, None)
