# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Things to put into a Blender file, each a function of a random generator: what Blender's own add-ons,
curves, text and modifiers make. Every one is a few units large and stands near the origin.

Nothing here asks for what the POV-Ray add-on cannot export: empties, instancers, booleans in place,
metaballs with a material (see its source for each).
"""
import math

import addon_utils
import bpy
import mathutils

import common as c

ADDONS = ('add_mesh_BoltFactory', 'add_mesh_extra_objects', 'add_mesh_geodesic_domes', 'ant_landscape',
          'add_curve_sapling')


def enable():
    for name in ADDONS:
        addon_utils.enable(name)


def fresh(call, **settings):
    """Run an operator that adds an object; gives the object, made a mesh and smooth or not."""
    bpy.ops.object.select_all(action='DESELECT')
    bpy.context.view_layer.objects.active = None
    before = set(bpy.data.objects)
    call(**settings)
    return bpy.context.object or (set(bpy.data.objects) - before).pop()


def meshed(ob):
    """An object of curves, text or balls turned into a mesh."""
    bpy.context.view_layer.update()
    data = bpy.data.meshes.new_from_object(ob.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    data.name = ob.name
    new = c.add(ob.name + 'Mesh', data)
    new.matrix_world = ob.matrix_world.copy()
    bpy.data.objects.remove(ob)
    return new


def smooth(rng, ob, chance=0.5):
    on = rng.random() < chance
    for polygon in ob.data.polygons:
        polygon.use_smooth = on
    return ob


def fit(ob, size=2.5):
    """Scale an object's mesh to that extent and put its middle on the origin."""
    corners = [v.co for v in ob.data.vertices]
    if not corners:
        return ob
    least = mathutils.Vector([min(v[a] for v in corners) for a in range(3)])
    most = mathutils.Vector([max(v[a] for v in corners) for a in range(3)])
    factor = size / (max(most - least) or 1.0)
    ob.data.transform(mathutils.Matrix.Translation(-0.5 * (least + most)))
    ob.data.transform(mathutils.Matrix.Scale(factor, 4))
    ob.location, ob.scale = (0, 0, 0), (1, 1, 1)
    return ob


def row(rng, makers, gap=2.8):
    """Several things side by side, each turned a little."""
    for i, maker in enumerate(makers):
        ob = smooth(rng, fit(maker(), 2.2))
        ob.location = (gap * (i - 0.5 * (len(makers) - 1)), rng.uniform(-0.5, 0.5), 1.3)
        ob.rotation_euler = [rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), rng.uniform(0, 6.28)]


def bolts(rng):
    def bolt():
        return fresh(bpy.ops.mesh.bolt_add, bf_Model_Type='bf_Model_Bolt',
                     bf_Head_Type=rng.choice(('bf_Head_Hex', 'bf_Head_Cap', 'bf_Head_Dome', 'bf_Head_Pan')),
                     bf_Bit_Type=rng.choice(('bf_Bit_None', 'bf_Bit_Allen', 'bf_Bit_Philips')),
                     bf_Div_Count=rng.choice((12, 18, 24)))

    def nut():
        # Not bf_Nut_Lock: it has coincident faces, of which POV-Ray's shadow rays miss one.
        return fresh(bpy.ops.mesh.bolt_add, bf_Model_Type='bf_Model_Nut', bf_Div_Count=18,
                     bf_Nut_Type=rng.choice(('bf_Nut_Hex', 'bf_Nut_12Pnt')))
    row(rng, (bolt, nut))


def tree(rng):
    ob = fresh(bpy.ops.curve.tree_add, do_update=True, bevel=True, levels=2, seed=rng.randrange(1000),
               showLeaves=False, resU=1, bevelRes=1, branches=(0, rng.randrange(10, 20), 6, 1),
               curveRes=(4, 3, 2, 1), useArm=False)
    trunk = bpy.data.objects['tree'] if 'tree' in bpy.data.objects else ob
    smooth(rng, fit(meshed(trunk), 4.0)).location = (0, 0, 2.1)


def terrain(rng):
    ob = fresh(bpy.ops.mesh.landscape_add, refresh=True, subdivision_x=rng.choice((24, 40)), subdivision_y=32,
               random_seed=rng.randrange(1000), mesh_size_x=6, mesh_size_y=6, height=rng.uniform(0.4, 1.5),
               noise_type=rng.choice(('hetero_terrain', 'multi_fractal', 'ridged_multi_fractal')))
    smooth(rng, ob, 0.7).location = (0, 0, 0.8)


def dome(rng):
    def geodesic():
        return fresh(bpy.ops.mesh.generate_geodesic_dome, geodesic_types='Geodesic',
                     base_type=rng.choice(('Tetrahedron', 'Octahedron', 'Icosahedron')),
                     frequency=rng.randrange(1, 5), eccentricity=rng.uniform(0.9, 1.1))
    row(rng, (geodesic, geodesic))


def gears(rng):
    row(rng, (lambda: fresh(bpy.ops.mesh.primitive_gear, number_of_teeth=rng.randrange(8, 20)),
              lambda: fresh(bpy.ops.mesh.primitive_worm_gear, number_of_teeth=rng.randrange(4, 10))))


EXTRAS = ('beam', 'brilliant', 'cross_joint', 'diamond', 'elbow_joint', 'gem', 'honeycomb', 'n_joint',
          'round_cube', 'solid', 'star', 'steppyramid', 'supertoroid', 'teapot', 'tee_joint', 'torusknot',
          'twisted_torus', 'wye_joint', 'z_function_surface', 'menger_sponge', 'wall')


def extras(rng):
    def maker(name):
        for spelling in ('primitive_%s_add', 'primitive_%s', '%s_add', 'add_%s'):
            call = getattr(bpy.ops.mesh, spelling % name)
            if (spelling % name) in dir(bpy.ops.mesh):
                return lambda: fresh(call)
        raise KeyError(name)
    row(rng, [maker(name) for name in rng.sample(EXTRAS, 3)])


def text(rng):
    words = rng.choice(('Alidade', 'ray & box', 'octree 8', 'Qy%g@', 'sphere'))
    data = bpy.data.curves.new('Words', 'FONT')
    data.body = words
    data.extrude = rng.choice((0.0, 0.05, 0.2))
    data.bevel_depth = rng.choice((0.0, 0.02))
    data.resolution_u = rng.randrange(1, 5)
    ob = c.add('Words', data, rotation=(rng.uniform(20, 90), 0, rng.uniform(-20, 20)))
    if rng.random() < 0.5:
        ob = fit(meshed(ob), 4.0)
        ob.rotation_euler = (rng.uniform(0.4, 1.5), 0, 0)
    ob.location = (-0.5 * (len(words) - 3) * (ob.type == 'FONT'), 0, 0.9)


def curves(rng):
    for i in range(3):
        kind = rng.choice(('primitive_bezier_curve_add', 'primitive_bezier_circle_add',
                           'primitive_nurbs_circle_add', 'primitive_nurbs_path_add'))
        ob = fresh(getattr(bpy.ops.curve, kind))
        ob.data.dimensions = '3D'
        ob.data.bevel_depth = rng.uniform(0.05, 0.25)
        ob.data.bevel_resolution = rng.randrange(1, 4)
        ob.data.resolution_u = rng.randrange(4, 10)
        ob.data.use_fill_caps = True
        ob = smooth(rng, fit(meshed(ob), 2.4))
        ob.location = (2.4 * (i - 1), rng.uniform(-0.5, 0.5), 1.2)
        ob.rotation_euler = [rng.uniform(0, 3) for _ in range(3)]


def surfaces(rng):
    def maker(kind):
        return lambda: meshed(fresh(getattr(bpy.ops.surface, 'primitive_nurbs_surface_%s_add' % kind)))
    row(rng, [maker(k) for k in rng.sample(('cylinder', 'sphere', 'torus', 'surface'), 2)])


def balls(rng):
    """Metaballs as a mesh: the add-on fails on a metaball with a material."""
    data = bpy.data.metaballs.new('Meta')
    data.resolution = data.render_resolution = rng.uniform(0.15, 0.3)
    for _ in range(rng.randrange(3, 7)):
        element = data.elements.new(type=rng.choice(('BALL', 'CAPSULE', 'ELLIPSOID')))
        element.co = [rng.uniform(-1, 1) for _ in range(3)]
        element.radius = rng.uniform(0.6, 1.2)
    smooth(rng, fit(meshed(c.add('Meta', data)), 3.0)).location = (0, 0, 1.6)


def array(rng, ob):
    c.modifier(ob, 'ARRAY', count=rng.randrange(2, 5), relative_offset_displace=(
        rng.uniform(-0.3, 0.3), rng.uniform(1.05, 1.4), rng.uniform(0, 0.4)))


def screw(rng, ob):
    ob.data = bpy.data.meshes.new('Line')
    ob.data.from_pydata([(0.3, 0, 0), (0.5, 0, 0.2), (0.35, 0, 0.5), (0.6, 0, 0.9)],
                        [(0, 1), (1, 2), (2, 3)], [])
    c.modifier(ob, 'SCREW', steps=rng.randrange(8, 20), render_steps=rng.randrange(8, 20),
               screw_offset=rng.uniform(0, 0.5))


def boolean(rng, ob):
    mat = c.material('Cut', (0.6, 0.5, 0.4))
    cutter = c.ball(radius=0.6, location=(0.5, 0.4, 0.5), segments=12, rings=6, mat=mat)
    ob.data.materials.append(mat)
    c.modifier(ob, 'BOOLEAN', object=cutter, operation=rng.choice(('DIFFERENCE', 'UNION', 'INTERSECT')))
    c.apply(ob)
    bpy.data.objects.remove(cutter)


def mirror(rng, ob):
    ob.data.transform(mathutils.Matrix.Translation((0.9, 0.2, 0.1)))
    c.modifier(ob, 'MIRROR', use_axis=(True, rng.random() < 0.5, False))


MODIFIERS = [
    array, screw, boolean, mirror,
    lambda rng, ob: c.modifier(ob, 'BEVEL', width=rng.uniform(0.05, 0.2), segments=rng.randrange(1, 4)),
    lambda rng, ob: c.modifier(ob, 'SUBSURF', levels=2, render_levels=rng.randrange(1, 3)),
    lambda rng, ob: c.modifier(ob, 'SOLIDIFY', thickness=rng.uniform(0.05, 0.2)),
    lambda rng, ob: c.modifier(ob, 'WIREFRAME', thickness=rng.uniform(0.08, 0.2)),
    lambda rng, ob: c.modifier(ob, 'DECIMATE', ratio=rng.uniform(0.3, 0.8)),
    lambda rng, ob: c.modifier(ob, 'SIMPLE_DEFORM', deform_method=rng.choice(('TWIST', 'BEND', 'TAPER')),
                               angle=rng.uniform(0.5, 1.5), deform_axis='Z'),
    lambda rng, ob: c.modifier(ob, 'CAST', factor=rng.uniform(0.3, 0.9)),
    lambda rng, ob: c.modifier(ob, 'REMESH', mode='VOXEL', voxel_size=rng.uniform(0.12, 0.2)),
    lambda rng, ob: c.modifier(ob, 'TRIANGULATE'),
    lambda rng, ob: c.modifier(ob, 'WAVE', height=0.2, width=0.6, narrowness=1.2),
    lambda rng, ob: c.modifier(ob, 'EDGE_SPLIT', split_angle=0.4),
]


def modifiers(rng):
    for i in range(3):
        kind = rng.choice(('cube', 'monkey', 'torus', 'grid', 'cylinder'))
        settings = {'major_segments': 16, 'minor_segments': 8} if kind == 'torus' else {}
        if kind == 'cylinder':
            settings = {'vertices': 12}
        ob = smooth(rng, c.shape(kind, name='Body%d' % i, **settings))
        rng.choice(MODIFIERS)(rng, ob)
        ob.location = (2.6 * (i - 1), rng.uniform(-0.7, 0.7), 1.4)
        ob.rotation_euler = [rng.uniform(0, 1) for _ in range(3)]
        ob.scale = [rng.uniform(0.6, 0.9) for _ in range(3)]


def monkeys(rng):
    for i in range(4):
        ob = smooth(rng, c.shape('monkey', name='Monkey%d' % i, size=1.3), 0.7)
        ob.location = (1.9 * (i - 1.5), rng.uniform(-0.6, 0.6), 1.0)
        ob.rotation_euler = (rng.uniform(-0.4, 0.4), 0, rng.uniform(-0.8, 0.8))


def spheres(rng):
    for i in range(5):
        r = rng.uniform(0.4, 0.9)
        c.ball(location=(1.7 * (i - 2), rng.uniform(-1, 1), r + 0.05), radius=r, name='Ball%d' % i,
               segments=rng.randrange(12, 24), rings=rng.randrange(6, 12), smooth=rng.random() < 0.8)


def slots(rng):
    """Many materials on one mesh, also an unused one and one used by two slots."""
    ob = c.shape(rng.choice(('monkey', 'grid', 'ico_sphere')), location=(0, 0, 1.4), name='Slots')
    ob.scale = (1.4, 1.4, 1.4)
    count = rng.randrange(2, 7)
    for i in range(count):
        ob.data.materials.append(c.material('Slot%d' % i, [rng.random() for _ in range(3)],
                                            specular_intensity=rng.random()))
    for polygon in ob.data.polygons:
        polygon.material_index = rng.randrange(max(1, count - 1))
        polygon.use_smooth = rng.random() < 0.7


def colours(rng):
    for i in range(2):
        ob = smooth(rng, c.shape(rng.choice(('ico_sphere', 'monkey', 'cube')), name='Painted%d' % i))
        ob.location = (2.6 * (i - 0.5), 0, 1.3)
        ob.data.materials.append(c.material('Paint%d' % i, (1, 1, 1)))
        layer = ob.data.vertex_colors.new(name='Col')
        one = [[rng.random() for _ in range(3)] for _ in ob.data.vertices]
        for loop in ob.data.loops:
            layer.data[loop.index].color = one[loop.vertex_index] + [1.0]


def oddities(rng):
    """Meshes with nothing in them, loose vertices and edges, and faces without area, among others."""
    c.mesh('Nothing', [], [], location=(3, 3, 1))
    loose = bpy.data.meshes.new('Loose')
    loose.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0.5)], [(0, 1), (1, 2)], [])
    c.add('Loose', loose, location=(-1, 0, 1))
    mixed = bpy.data.meshes.new('Mixed')
    mixed.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0.5), (0, 1, 0.2), (2, 2, 2), (3, 3, 3), (0.5, 0, 0)],
                      [(4, 5)], [(0, 1, 2), (0, 2, 3), (0, 6, 1)])
    c.add('Mixed', mixed, location=(0.4, 0.2, 1), scale=(1.5, 1.5, 1.5))
    spheres(rng)


def mirrored(rng):
    hub = c.shape('cube', size=0.8, name='Hub', location=(0, 0, 1.6), rotation=(10, 20, 30),
                  scale=(-1.2, 0.8, 1.1))
    above = hub
    for i in range(4):
        arm = smooth(rng, c.shape(rng.choice(('monkey', 'cone', 'torus')), name='Arm%d' % i))
        arm.parent = above if rng.random() < 0.5 else hub
        arm.location = [rng.uniform(-1.4, 1.4) for _ in range(3)]
        arm.rotation_euler = [rng.uniform(0, 6) for _ in range(3)]
        arm.scale = [rng.choice((-1, 1)) * rng.uniform(0.4, 0.9) for _ in range(3)]
        above = arm


def shared(rng):
    sources = [c.shape('monkey', size=0.7, name='One'), c.shape('cone', vertices=6, depth=0.7, radius1=0.3,
                                                                name='Two')]
    for i in range(rng.randrange(10, 40)):
        c.add('Copy%d' % i, rng.choice(sources).data, rotation=[rng.uniform(0, 360) for _ in range(3)],
              location=[rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(0.8, 2.8)],
              scale=[rng.uniform(0.4, 1.0)] * 3)


def beams(rng):
    for i in range(rng.randrange(15, 40)):
        c.shape('cube', size=1.0, name='Beam%d' % i, rotation=[rng.uniform(0, 360) for _ in range(3)],
                location=[rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(1, 3)],
                scale=(rng.uniform(0.03, 0.1), rng.uniform(0.03, 0.1), rng.uniform(1, 5)))


def glassware(rng):
    """Transparent bodies of every kind the add-on knows, some inside one another."""
    for i in range(3):
        ior = rng.choice((None, 1.0, 1.33, 1.5, 2.0))
        mat = c.material('Glass%d' % i, [rng.uniform(0.4, 1) for _ in range(3)], alpha=rng.uniform(0, 0.3),
                         filter=None if ior is None else rng.random(), ior=ior,
                         diffuse_intensity=rng.uniform(0, 0.4), conserve_energy=rng.random() < 0.5,
                         interior_fade_color=[rng.random() for _ in range(3)])
        mat.pov_raytrace_transparency.depth_max = rng.uniform(90, 99)
        x = 2.2 * (i - 1)
        if rng.random() < 0.5:
            c.ball(location=(x, 0, 1.3), radius=0.95, mat=mat, name='Glass%d' % i)
            c.shape('cube', size=0.7, location=(x, 0, 1.3), rotation=(20, 30, 40), name='Heart%d' % i)
        else:
            c.shape('cube', size=1.5, location=(x, 0, 1.3), rotation=(0, 0, rng.uniform(0, 90)), mat=mat,
                    name='Glass%d' % i)
    c.shape('monkey', location=(0, 2.5, 1.2), name='Behind')


def primitives(rng):
    def add(call, location, scale=1.0, **settings):
        ob = fresh(getattr(bpy.ops.pov, call), **settings)
        ob.location = location
        ob.rotation_euler = [rng.uniform(0, 3) for _ in range(3)]
        ob.scale = [scale * rng.uniform(0.7, 1.2) for _ in range(3)]
        ob.update_tag()
    add('addsphere', (-2.6, 0, 1.2), sphe_rad=0.8)
    add('addbox', (-0.8, 0.3, 1.3), 0.6)
    add('addcone', (0.9, -0.3, 1.3), base=0.7, cap=rng.choice((0.0, 0.3)), height=1.3)
    add('addtorus', (2.6, 0.2, 1.3), mar=0.7, mir=rng.uniform(0.1, 0.3))


KINDS = [bolts, monkeys, terrain, extras, modifiers, spheres, dome, text, gears, curves, extras, slots,
         modifiers, tree, surfaces, mirrored, balls, colours, shared, oddities, modifiers, beams, extras,
         primitives, glassware]
