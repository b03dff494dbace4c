# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One frame to one file: walks over what the dependency graph draws and puts it in order.

The order in the file is that of names, never that of Blender's memory, so the same scene gives the same bytes.
"""
import hashlib
import io
import os

import numpy as np

from . import camera, geometry, lamps, text, visible, world
from .images import Store
from .losses import Losses
from .materials import Materials
from .paints import Painter, matrix_text
from .relief import Refined
from .values import Points, Tree

MESHES = {'MESH', 'CURVE', 'SURFACE', 'FONT', 'META'}
SILENT = {'EMPTY', 'CAMERA', 'ARMATURE', 'LATTICE', 'SPEAKER', 'LIGHT_PROBE'}


class Options:
    def __init__(self, **settings):
        self.strict = False
        self.radiosity = 'auto'         # auto, on, off
        self.lamp_grid = 9              # points a side of soft lamps; 1: all lamps are hard
        self.hair_sides = 4
        self.blur_samples = 256
        self.relief = 200000            # triangles that a mesh with a normal map may become; 0: such maps are lost
        self.exposure = True            # scale light by the view's exposure
        for key, value in settings.items():
            if not hasattr(self, key):
                raise TypeError('no setting %s' % key)
            setattr(self, key, value)


class Lost(Exception):
    """With --strict: the scene has what SDL cannot say."""


class Export:
    """State of one export: what the parts (lamps, materials, ...) share."""

    def __init__(self, graph, path, options, version, draw_world=None, losses=None):
        self.graph, self.path, self.options, self.version = graph, path, options, version
        self.scene = graph.scene_eval
        self.losses = losses or Losses()
        self.layer = getattr(graph, 'view_layer', None)
        stem = os.path.splitext(os.path.basename(path))[0]
        self.store = Store(os.path.dirname(os.path.abspath(path)), stem + '-pictures')
        self.painter = Painter(self.store, self.losses)
        self.materials = Materials(self.painter, self.losses, version)
        self.materials.bake_normals = options.relief > 0
        self.draw_world = draw_world
        film = getattr(getattr(self.scene, 'cycles', None), 'film_exposure', 1.0)
        self.exposure = film * 2.0 ** self.scene.view_settings.exposure if options.exposure else 1.0
        self.materials.exposure = self.exposure
        self.meshes = io.BytesIO()
        self.declared = {}              # digest of a mesh and its looks -> list of (identifier, interior)
        self.cached = {}                # while the graph stands still: what was made of a data-block
        self.names = set()
        self.low, self.high = np.full(3, np.inf), np.full(3, -np.inf)
        self.nearest, self.farthest = np.inf, 0.0       # of boxes before the camera, along its axis

    # What the graph holds, sorted
    def gather(self):
        things, lights, strands, self.emitters = [], [], [], []
        for instance in self.graph.object_instances:
            ob = instance.object
            matrix = np.array(instance.matrix_world, np.float64)
            key = ob.name_full
            if instance.is_instance:
                parent = instance.parent.name_full if instance.parent else ''
                key = '%s/%s' % (parent, key)
            order = (key, tuple(instance.persistent_id))
            whole = [ob] + ([instance.parent] if instance.is_instance and instance.parent else [])
            if ob.type == 'LIGHT':
                visible.lamp(whole, self.losses, key)
                lights.append((order, ob.data, matrix, key))
            elif instance.show_self and (ob.type in MESHES or ob.type in ('CURVES', 'HAIR', 'POINTCLOUD')):
                words = visible.words(whole, self.layer, self.losses, ob.name_full)
                if words is not None:
                    things.append((order, self.made(ob, None if instance.is_instance else matrix), matrix, words))
            elif ob.type not in SILENT and ob.type not in MESHES:
                self.losses.lost(ob.name_full, '-', '-', 'objects of the kind %s' % ob.type.lower())
            if instance.show_particles and not instance.is_instance:
                words = visible.words(whole, self.layer, self.losses, ob.name_full)
                if words is not None:
                    strands += self.hair(ob, order, words)
        self.lights = sorted(lights, key=lambda l: l[0])
        things.sort(key=lambda t: t[0])
        return things + sorted(strands, key=lambda t: t[0])

    # Meshes
    def made(self, ob, matrix=None):
        """Identifiers of the mesh2 of an object's evaluated geometry: list of (name, interior), and its bounds.

        matrix: where it stands, unless it is one of many.
        """
        slots = self.slots(ob)
        self.eye = None
        if matrix is not None and ob.type == 'MESH' and any(self.materials.look(m).relief for m in slots):
            self.eye = self._eye(matrix)
        key = (ob.data.as_pointer() if ob.data else 0, ob.type, ob.name_full if ob.type != 'MESH' else '',
               tuple(m.name_full if m else None for m in slots), None if self.eye is None else self.eye.tobytes())
        if key not in self.cached:
            self.cached[key] = self._make(ob, slots)
        return self.cached[key]

    def _eye(self, matrix):
        """The camera in an object's own coordinates, for relief.facing; None where there is no one place of it."""
        ob = self.scene.camera
        if ob is None or ob.data.type == 'PANO' or abs(np.linalg.det(matrix[:3, :3])) < 1e-30:
            return None
        eye = np.array(ob.matrix_world)
        return np.linalg.inv(matrix) @ (np.append(eye[:3, 2], 0.0) if ob.data.type == 'ORTHO' else eye[:, 3])

    def slots(self, ob):
        """The materials of an object's slots, those that hang on the object before those of its data."""
        override = getattr(self.layer, 'material_override', None)
        if override is not None:
            return [override]
        own = list(ob.data.materials) if ob.data is not None and hasattr(ob.data, 'materials') else []
        found = []
        for i in range(max(len(own), len(ob.material_slots))):
            slot = ob.material_slots[i] if i < len(ob.material_slots) else None
            found.append(slot.material if slot is not None and (slot.link == 'OBJECT' or i >= len(own)) else own[i])
        return found or [None]

    def _make(self, ob, slots):
        if ob.type in ('CURVES', 'HAIR'):
            return self._curves(ob, slots)
        if ob.type == 'POINTCLOUD':
            return self._points(ob, slots)
        own = ob.type == 'MESH'
        try:
            mesh = ob.data if own else ob.to_mesh()
        except RuntimeError:
            mesh = None
        if mesh is None:
            return []
        try:
            return self._mesh(ob, mesh, slots)
        finally:
            if not own:
                ob.to_mesh_clear()

    def _mesh(self, ob, mesh, slots):
        triangles = geometry.Triangles(mesh, self.version)
        if not triangles.count:
            return []
        if triangles.bad:
            self.losses.nearest(ob.name_full, '-', '-', '%d coordinates that are no numbers are 0' % triangles.bad)
        looks = [self.materials.look(m) for m in slots]
        slot = np.clip(triangles.slots, 0, len(looks) - 1)
        digest = hashlib.blake2b(digest_size=16)
        for array in (triangles.points, triangles.faces, slot, triangles.smooth):
            digest.update(array.tobytes())
        if triangles.own_normals:
            digest.update(triangles.corner_normals().tobytes())
        if self.eye is not None:
            digest.update(self.eye.tobytes())
        for look in looks:
            digest.update(look.name.encode() + b'\0')
            if look.uv is not None:
                corners = triangles.uv(look.uv or None)
                digest.update(b'-' if corners is None else corners.tobytes())
        if any(l.corner is not None for l in looks):
            for layer in sorted({n for l in looks if l.corner is not None for n in self.painter.layers(l.corner)}):
                values = triangles.colour(layer)
                digest.update(values.tobytes() if values is not None else b'-')
        digest = digest.hexdigest()
        if digest not in self.declared:
            self.declared[digest] = self._write_mesh(ob, triangles, looks, slot)
        self.bounds = triangles.bounds()
        return [part + (self.bounds,) for part in self.declared[digest]]

    def unique(self, label):
        name = text.name('M_', label)
        count, base = 1, name
        while name in self.names:
            count += 1
            name = '%s_v%d' % (base, count)
        self.names.add(name)
        return name

    def _write_mesh(self, ob, triangles, looks, slot):
        groups = {}
        for number in np.unique(slot).tolist():
            look = looks[number]
            alone = number if look.relief is not None else -1
            groups.setdefault((look.interior or '', look.uv, alone), []).append(number)
        parts = []
        bounds = triangles.bounds()
        whole, slots = triangles, slot
        for (interior, uv, alone), numbers in sorted(groups.items(), key=lambda g: g[1]):
            triangles, slot = whole, slots
            chosen = np.arange(triangles.count) if len(groups) == 1 else np.flatnonzero(np.isin(slot, numbers))
            if alone >= 0 and triangles.uv(uv or None) is not None and looks[alone].corner is None:
                triangles = Refined(whole, chosen, uv, looks[alone].relief, Tree(self.losses, ob.name_full), self.painter,
                                    self.options.relief, self.eye)
                chosen, slot = np.arange(triangles.count), np.full(triangles.count, alone)
            name = self.unique(ob.data.name_full if ob.data else ob.name_full)
            textures, entries = self._textures(ob, triangles, looks, slot, chosen, numbers, bounds)
            if textures is None:
                entries = [entries[0]]
            if uv is not None and triangles.uv(uv or None) is None:
                self.losses.lost(ob.name_full, 'UV', looks[numbers[0]].name, 'the mesh has no UV map "%s"' % uv)
            geometry.write_part(self.meshes, name, triangles, chosen, textures,
                                entries + ([interior] if interior and textures is None else []), uv)
            if interior and textures is not None:
                self.meshes.write(interior.encode() + b'\n')
            self.meshes.write(b'}\n')
            parts.append((name,))
        return parts

    def _textures(self, ob, triangles, looks, slot, chosen, numbers, bounds):
        """Texture numbers of the chosen faces (None if there is one texture), and the textures."""
        if any(looks[n].corner is not None for n in numbers):
            return self._corner_textures(ob, triangles, looks, slot, chosen, numbers, bounds)
        entries, index = [], {}
        for n in numbers:
            entry = looks[n].texture(bounds)
            index[n] = entries.index(entry) if entry in entries else len(entries)
            if index[n] == len(entries):
                entries.append(entry)
        if len(entries) == 1:
            return None, entries
        table = np.zeros(max(numbers) + 1, np.int64)
        for n, number in index.items():
            table[n] = number
        return table[slot[chosen]][:, None], entries

    def _corner_textures(self, ob, triangles, looks, slot, chosen, numbers, bounds):
        """Vertex colours: three textures a face, each colour once (in steps of 1/255 of its coded value)."""
        entries = []
        result = np.zeros((len(chosen), 3), np.int64)
        tree = Tree(self.losses, ob.name_full)
        for n in numbers:
            rows = np.flatnonzero(slot[chosen] == n)
            look = looks[n]
            if look.corner is None:
                result[rows] = len(entries)
                entries.append(look.texture(bounds))
                continue
            loops = triangles.loops[chosen[rows]].ravel()

            def colours(layer):
                values = triangles.colour(layer)
                return None if values is None else values[loops].astype(np.float64)
            rgb = look.corner.value(tree, Points(len(loops), colours=colours))
            steps = np.rint(np.sqrt(np.clip(rgb, 0, 4)) * 255).astype(np.int64)
            keys = (steps[:, 0] << 40) | (steps[:, 1] << 20) | steps[:, 2]
            found, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
            result[rows] = inverse.reshape(-1, 3) + len(entries)
            entries += [look.corner_text(text.vector((steps[i] / 255.0) ** 2)) for i in first]
        return result, entries

    # Hair
    def hair(self, ob, order, words):
        found = []
        for system in ob.particle_systems if ob.type == 'MESH' else ():
            settings = system.settings
            if settings.type != 'HAIR' or settings.render_type != 'PATH':
                continue
            points, counts = self._strands(ob, system)
            if not counts:
                continue
            slots = self.slots(ob)
            material = slots[min(max(settings.material - 1, 0), len(slots) - 1)]
            shape = getattr(settings, 'shape', 0.0)
            # Called radius in Python and diameter in the panel; Cycles takes half of it.
            root, tip = (0.5 * r * settings.radius_scale for r in (settings.root_radius, settings.tip_radius))
            power = 1 + shape if shape < 0 else 1 / max(1 - shape, 1e-3)
            along = np.concatenate([np.linspace(0, 1, c) for c in counts])
            radii = tip + (root - tip) * np.power(np.maximum(1 - along, 0), power)
            parts = self._tubes('%s %s' % (ob.name_full, system.name), np.concatenate(points), counts, radii, material)
            found.append(((order[0], order[1] + (system.name,)), parts, np.eye(4), words))
        return [((f[0][0] + '/' + str(f[0][1][-1]), f[0][1][:-1]), *f[1:]) for f in found]

    @staticmethod
    def _strands(ob, system):
        """World points of each strand of a hair system, children where it has them."""
        settings = system.settings
        parents, children = len(system.particles), len(system.child_particles)
        steps = 2 ** settings.render_step if settings.render_step else 1
        first = parents if settings.child_type != 'NONE' and children and not settings.use_parent_particles else 0
        last = parents + children if settings.child_type != 'NONE' else parents
        points, counts = [], []
        for number in range(first, last):
            strand = []
            for step in range(steps + 1):
                co = system.co_hair(ob, particle_no=number, step=step)
                if strand and not any(co):
                    break
                strand.append(tuple(co))
            strand = [p for i, p in enumerate(strand) if i == 0 or p != strand[i - 1]]
            if len(strand) > 1:
                points.append(np.array(strand))
                counts.append(len(strand))
        return points, counts

    def _tubes(self, label, points, counts, radii, material):
        look = self.materials.look(material)
        name = self.unique(label)
        tube = geometry.tubes(points, counts, np.maximum(radii, 1e-6), self.options.hair_sides)
        if look.corner is not None or look.uv is not None:
            self.losses.lost(label, '-', '-', 'textures and vertex colours on hair')
        entry = look.texture() if look.corner is None else look.corner_text('0.5')
        geometry.write_tubes(self.meshes, name, tube, [entry] + ([look.interior] if look.interior else []))
        self.meshes.write(b'}\n')
        bounds = points.min(axis=0), points.max(axis=0)
        return [(name, bounds)]

    def _curves(self, ob, slots):
        """The new hair curves: points, how many a curve, and the radius attribute."""
        data = ob.data
        count = len(data.points)
        if not count:
            return []
        flat = np.empty(count * 3, np.float32)
        data.attributes['position'].data.foreach_get('vector', flat)
        counts = [len(range(c.points_length)) for c in data.curves]
        radius = data.attributes.get('radius')
        radii = np.full(count, 0.01, np.float32)
        if radius is not None and len(radius.data) == count:
            radius.data.foreach_get('value', radii)
        points = flat.reshape(-1, 3)
        if min(counts) < 2:
            keep = np.repeat(np.array(counts) > 1, counts)
            points, radii = points[keep], radii[keep]
            counts = [c for c in counts if c > 1]
        return self._tubes(ob.name_full, points, counts, radii.astype(np.float64), slots[0])

    def _points(self, ob, slots):
        """A cloud of points is a union of spheres."""
        data = ob.data
        count = len(data.points)
        if not count:
            return []
        flat = np.empty(count * 3, np.float32)
        data.attributes['position'].data.foreach_get('vector', flat)
        radii = np.full(count, 0.01, np.float32)
        radius = data.attributes.get('radius')
        if radius is not None:
            radius.data.foreach_get('value', radii)
        points = flat.reshape(-1, 3)
        look = self.materials.look(slots[0])
        name = self.unique(ob.name_full)
        self.meshes.write(b'#declare %s = union {\n' % name.encode())
        for point, r in zip(points, radii):
            self.meshes.write(b'sphere { %s, %s }\n' % (text.vector(point).encode(), text.number(r).encode()))
        self.meshes.write(look.texture().encode() + b'\n' + (look.interior or '').encode() + b'\n}\n')
        return [(name, (points.min(axis=0), points.max(axis=0)))]

    # The file
    def grow(self, bounds, matrix):
        low, high = bounds
        corners = np.array([[(low, high)[(i >> a) & 1][a] for a in range(3)] for i in range(8)])
        placed = corners @ matrix[:3, :3].T + matrix[:3, 3]
        self.low = np.minimum(self.low, placed.min(axis=0))
        self.high = np.maximum(self.high, placed.max(axis=0))
        if self.scene.camera is not None:
            eye = np.array(self.scene.camera.matrix_world)
            depth = (eye[:3, 3] - placed) @ eye[:3, 2] / max(np.linalg.norm(eye[:3, 2]), 1e-20)
            near, far = float(depth.min()), float(depth.max())
            self.farthest = max(self.farthest, far)
            if near > 0:
                self.nearest = min(self.nearest, near)

    def run(self):
        things = self.gather()
        objects = []
        for order, parts, matrix, words in things:
            if abs(np.linalg.det(matrix[:3, :3])) < 1e-30 or not np.all(np.isfinite(matrix)):
                continue
            placed = matrix_text(matrix)
            for part in parts:
                self.grow(part[-1], matrix)
                objects.append('object { %s }\n' % ' '.join([part[0]] + [placed] * bool(placed) + words))
        if not np.all(np.isfinite(self.low)):
            self.low, self.high = -np.ones(3), np.ones(3)
        self.middle = 0.5 * (self.low + self.high)
        self.radius = max(0.5 * float(np.linalg.norm(self.high - self.low)), 1e-3)
        lights = []
        for order, data, matrix, label in self.lights:
            lamps.write(lights, data, matrix, label, self)
        sky = []
        lit = world.write(sky, self.scene.world, self)
        eye = []
        ob = self.scene.camera
        if ob is None:
            self.losses.lost(self.scene.name, 'Camera', '-', 'the scene has none')
        else:
            camera.write(eye, ob.evaluated_get(self.graph), self.scene, self)
        self.notes()
        self._write_file(lit, sky, eye, lights, objects)
        return self.losses

    def notes(self):
        scene = self.scene
        view = scene.view_settings.view_transform
        if view not in ('Standard', 'Raw'):
            self.losses.nearest(scene.name, 'View Transform', '-', '%s is applied after rendering; the picture is as '
                                'with Standard' % view)
        if scene.render.use_motion_blur:
            self.losses.lost(scene.name, 'Motion Blur', '-', 'movement within a frame')
        if scene.render.film_transparent:
            self.losses.nearest(scene.name, 'Transparent', '-', 'the world stays visible')

    def _global(self, lit):
        scene = self.scene
        cycles = getattr(scene, 'cycles', None)
        depth = min(max(getattr(cycles, 'max_bounces', 8), 5), 20)
        bounces = min(max(getattr(cycles, 'diffuse_bounces', 3), 0), 3)
        words = ['assumed_gamma 1', 'max_trace_level %d' % depth]
        wanted = self.options.radiosity
        if wanted == 'on' or wanted == 'auto' and bounces > 0:
            words.append('radiosity {\npretrace_start 0.08 pretrace_end 0.02 count 100 nearest_count 8 error_bound 0.8\n'
                         'recursion_limit %d low_error_factor 0.5 gray_threshold 0 minimum_reuse 0.01 brightness 1\n'
                         'adc_bailout 0.005\n}' % max(bounces, 1))
        return 'global_settings {\n%s\n}\n' % '\n'.join(words)

    def _write_file(self, lit, sky, eye, lights, objects):
        head = ['// Written by Alidade\'s exporter for Blender; see docs/exporter.md.\n']
        lost, nearest = self.losses.lost_lines(), self.losses.nearest_lines()
        for title, lines in (('Lost (object, socket, node)', lost), ('Said in other words', nearest)):
            if lines:
                head.append('// %s:\n' % title)
                head += ['//   %s\n' % text.comment(line) for line in lines]
        if lost and self.options.strict:
            raise Lost('\n'.join(lost))
        temporary = self.path + '.part'
        with open(temporary, 'wb') as out:
            def put(*parts):
                for part in parts:
                    out.write(''.join(part).encode('utf-8'))
            put(head, '#version 3.7;\n', self._global(lit), '#default { finish { ambient 0 } }\n', sky, eye, lights,
                self.materials.text)
            out.write(self.meshes.getbuffer())
            put(objects)
        os.replace(temporary, self.path)
