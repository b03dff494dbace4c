# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scripts that make our scenes share.

A scene is a script scenes/NAME/make.py. Blender runs it as

    blender -b --factory-startup -P scenes/NAME/make.py -- FOLDER

and it leaves FOLDER/NAME.pov and FOLDER/NAME.ini there, both as Blender's own POV-Ray add-on
(render_povray) wrote them: no byte is edited afterwards. The names inside the .ini are relative
because the add-on is called from inside FOLDER with relative names.

Only what the add-on writes correctly is used (materials without nodes, lamps without jitter), and
radiosity is off: indirect light is compared elsewhere.
"""
import math
import os
import sys

import addon_utils
import bpy
import mathutils

sys.dont_write_bytecode = True


def start(size=(320, 240), background=(0.05, 0.06, 0.08), ambient=(0.0, 0.0, 0.0), text='compact'):
    """An empty scene of that size, set up for the POV-Ray add-on.

    text: 'compact' is the add-on's default; 'indented' is what it writes when its temporary files
    are switched off (indentation and comments), 'lines' also breaks vertex lists into lines.
    """
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable('render_povray', default_set=True)
    scene = bpy.context.scene
    scene.render.engine = 'POVRAY_RENDER'
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.pov.radio_enable = False
    scene.pov.tempfiles_enable = text == 'compact'
    scene.pov.list_lf_enable = text == 'lines'
    world = bpy.data.worlds.new('World')
    scene.world = world
    world.pov.horizon_color = background
    world.pov.ambient_color = ambient
    return scene


def aim(ob, target):
    """Turn an object so that its -Z axis, a camera's or lamp's direction, meets target."""
    direction = mathutils.Vector(target) - ob.location
    ob.rotation_euler = direction.to_track_quat('-Z', 'Y').to_euler()


def camera(location, target, lens=50.0, ortho=None):
    """The scene's camera; ortho is the orthographic width in units, None for perspective."""
    data = bpy.data.cameras.new('Camera')
    data.lens = lens
    if ortho is not None:
        data.type = 'ORTHO'
        data.ortho_scale = ortho
    ob = add('Camera', data, location)
    aim(ob, target)
    bpy.context.scene.camera = ob
    return ob


def add(name, data, location=(0, 0, 0), rotation=(0, 0, 0), scale=(1, 1, 1), parent=None):
    """A new object in the scene; rotation in degrees."""
    ob = bpy.data.objects.new(name, data)
    ob.location = location
    ob.rotation_euler = [math.radians(a) for a in rotation]
    ob.scale = scale
    ob.parent = parent
    bpy.context.collection.objects.link(ob)
    return ob


def lamp(kind, location, target=(0, 0, 0), colour=(1, 1, 1), name=None, **settings):
    """A lamp: kind is POINT, SPOT, SUN or AREA; settings are those of Blender's lamp.

    samples: an area lamp's grid. CONSTANT_JITTERED with jitter unticked is the one method of the
    add-on that writes neither jitter nor adaptive.
    """
    samples = settings.pop('samples', None)
    shadowless = settings.pop('shadowless', False)
    data = bpy.data.lights.new(name or kind.title(), kind)
    data.color = colour
    for key, value in settings.items():
        setattr(data, key, value)
    if kind == 'AREA':
        data.pov.shadow_ray_sample_method = 'CONSTANT_JITTERED'
        data.pov.use_jitter = False
        if samples is not None:
            data.pov.shadow_ray_samples_x, data.pov.shadow_ray_samples_y = samples
    if shadowless:
        data.pov.shadow_method = 'NOSHADOW'
    ob = add(name or kind.title(), data, location)
    aim(ob, target)
    return ob


def material(name, rgb, alpha=None, filter=None, ior=None, mirror=None, fresnel=None, **pov):
    """A material of the add-on (without nodes).

    pov: settings of material.pov (diffuse_intensity, specular_shader, specular_hardness, ...).
    alpha: transparent; with ior as raytraced glass (filter is its coloured share), else alone.
    mirror: reflected colour; fresnel: dict of the mirror's own settings (fresnel, fresnel_factor).
    """
    mat = bpy.data.materials.new(name)
    mat.use_nodes = False
    mat.diffuse_color = tuple(rgb) + (1.0,)
    if alpha is not None:
        mat.pov.use_transparency = True
        mat.pov.alpha = alpha
        mat.pov.transparency_method = 'Z_TRANSPARENCY' if ior is None else 'RAYTRACE'
    if filter is not None:
        mat.pov_raytrace_transparency.filter = filter
    if ior is not None:
        mat.pov_raytrace_transparency.ior = ior
    if mirror is not None:
        mat.pov_raytrace_mirror.use = True
        mat.pov.mirror_color = mirror
    for key, value in (fresnel or {}).items():
        setattr(mat.pov_raytrace_mirror, key, value)
    for key, value in pov.items():
        owner = mat if key in ('roughness', 'metallic') else mat.pov
        setattr(owner, key, value)
    return mat


def shape(kind, location=(0, 0, 0), rotation=(0, 0, 0), scale=(1, 1, 1), mat=None, smooth=False,
          name=None, **settings):
    """One of Blender's mesh primitives: cube, ico_sphere, plane, cone, torus, monkey...

    Not uv_sphere: Blender numbers its vertices differently in every run. ball() makes that shape.
    """
    getattr(bpy.ops.mesh, 'primitive_%s_add' % kind)(**settings)
    ob = bpy.context.object
    ob.name = name or kind.title().replace('_', '')
    ob.data.name = ob.name
    ob.location = location
    ob.rotation_euler = [math.radians(a) for a in rotation]
    ob.scale = scale
    for polygon in ob.data.polygons:
        polygon.use_smooth = smooth
    if mat is not None:
        ob.data.materials.append(mat)
    return ob


def mesh(name, vertices, faces, mat=None, smooth=False, **where):
    """An object from lists of vertices and faces."""
    data = bpy.data.meshes.new(name)
    data.from_pydata(vertices, [], faces)
    data.update()
    for polygon in data.polygons:
        polygon.use_smooth = smooth
    if mat is not None:
        data.materials.append(mat)
    return add(name, data, **where)


def ball(location=(0, 0, 0), radius=1.0, segments=20, rings=10, name='Ball', mat=None, smooth=True,
         **where):
    """A sphere of rings and segments, without UV coordinates."""
    vertices = [(0, 0, radius)]
    for i in range(1, rings):
        a = math.pi * i / rings
        for j in range(segments):
            b = 2 * math.pi * j / segments
            vertices.append((radius * math.sin(a) * math.cos(b), radius * math.sin(a) * math.sin(b),
                             radius * math.cos(a)))
    vertices.append((0, 0, -radius))
    last = len(vertices) - 1
    faces = []
    for j in range(segments):
        k = (j + 1) % segments
        faces.append((0, 1 + j, 1 + k))
        for i in range(rings - 2):
            r = 1 + i * segments
            faces.append((r + j, r + segments + j, r + segments + k, r + k))
        faces.append((last - segments + k, last - segments + j, last))
    return mesh(name, vertices, faces, mat, smooth, location=location, **where)


def floor(size=12.0, z=0.0, mat=None):
    """A square floor that nothing touches: what stands on it should hover by 0.01 or more."""
    return shape('plane', size=size, location=(0, 0, z), mat=mat, name='Floor')


def modifier(ob, kind, **settings):
    """A modifier; the add-on writes the evaluated mesh."""
    mod = ob.modifiers.new(kind.title(), kind)
    for key, value in settings.items():
        setattr(mod, key, value)
    return mod


def apply(ob):
    """Put the evaluated mesh in place of an object's own and drop its modifiers."""
    bpy.context.view_layer.update()
    graph = bpy.context.evaluated_depsgraph_get()
    data = bpy.data.meshes.new_from_object(ob.evaluated_get(graph))
    data.name = ob.name
    ob.modifiers.clear()
    ob.data = data


def count():
    """Triangles of the evaluated scene, instances counted as often as they are drawn."""
    total = 0
    graph = bpy.context.evaluated_depsgraph_get()
    for ob in bpy.context.scene.objects:
        if ob.type in {'MESH', 'CURVE', 'FONT', 'SURFACE'} and not ob.hide_render:
            data = ob.evaluated_get(graph).to_mesh()
            data.calc_loop_triangles()
            total += len(data.loop_triangles)
    return total


def export(name):
    """Write NAME.pov and NAME.ini into the folder named behind "--"."""
    from render_povray import render

    arguments = sys.argv[sys.argv.index('--') + 1:] if '--' in sys.argv else []
    if len(arguments) != 1 or not os.path.isdir(arguments[0]):
        sys.exit('%s: name one existing folder to write to behind "--"' % name)
    bpy.context.view_layer.update()
    triangles = count()
    os.chdir(arguments[0])
    render.write_pov(name + '.pov', bpy.context.scene, None)
    render.write_pov_ini(name + '.ini', name + '.log', name + '.pov', name + '.png')
    print('exported %s: %d triangles, %d bytes' % (name, triangles, os.path.getsize(name + '.pov')))


def run(name, build):
    """Build and export; Blender itself exits 0 when a script raises, so leave with the status."""
    try:
        build()
        export(name)
    except Exception:
        import traceback
        traceback.print_exc()
        sys.stdout.flush()
        os._exit(1)
