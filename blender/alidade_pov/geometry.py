# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Evaluated meshes to mesh2: read with foreach_get into numpy arrays, a few calls a mesh whatever its size.

A mesh is written in parts. One mesh2 has one interior and one set of uv_vectors, so the faces of materials that differ
in those go to different mesh2; mostly there is one part. Flat faces need no normals: the smooth faces are written
first and normal_indices ends with them (POV-Ray's manual 3.4.5.2.4: further faces are then flat).
"""
import numpy as np

from . import text, versions


# Kinds of attributes: the field of their values, and how many numbers each has.
FIELDS = {'FLOAT_COLOR': ('color', 4), 'BYTE_COLOR': ('color', 4), 'FLOAT_VECTOR': ('vector', 3), 'FLOAT2': ('vector', 2),
          'FLOAT': ('value', 1), 'INT': ('value', 1), 'INT8': ('value', 1), 'BOOLEAN': ('value', 1)}
TYPES = {'INT': np.int32, 'INT8': np.int32, 'BOOLEAN': bool}


class Triangles:
    """The arrays of one evaluated mesh; uvs and colours are fetched when a material asks."""

    def __init__(self, mesh, version):
        self.mesh = mesh
        self.version = version
        mesh.calc_loop_triangles()
        count = len(mesh.loop_triangles)
        self.count = count
        self.points = np.empty(len(mesh.vertices) * 3, np.float32)
        mesh.vertices.foreach_get('co', self.points)
        self.points, self.bad = text.sane(self.points.reshape(-1, 3))
        self.faces = np.empty(count * 3, np.int32)
        self.loops = np.empty(count * 3, np.int32)
        self.slots = np.empty(count, np.int32)
        self.smooth = np.empty(count, bool)
        triangles = mesh.loop_triangles
        triangles.foreach_get('vertices', self.faces)
        triangles.foreach_get('loops', self.loops)
        triangles.foreach_get('material_index', self.slots)
        triangles.foreach_get('use_smooth', self.smooth)
        self.faces = self.faces.reshape(-1, 3)
        self.loops = self.loops.reshape(-1, 3)
        self.own_normals = bool(count) and versions.has_own_normals(mesh, version)
        self._vertex_normals = None
        self._corner_normals = None

    def vertex_normals(self):
        if self._vertex_normals is None:
            buffer = np.empty(len(self.points) * 3, np.float32)
            self.mesh.vertices.foreach_get('normal', buffer)
            self._vertex_normals = text.sane(buffer.reshape(-1, 3))[0]
        return self._vertex_normals

    def corner_normals(self):
        if self._corner_normals is None:
            buffer = versions.corner_normals(self.mesh, self.version, lambda n: np.empty(n, np.float32))
            self._corner_normals = text.sane(buffer.reshape(-1, 3))[0]
        return self._corner_normals

    def uv(self, layer):
        """Corner coordinates of a UV map (the rendered one for None), or None where there is none of that name."""
        layers = self.mesh.uv_layers
        found = layers.get(layer) if layer else next((x for x in layers if x.active_render), None)
        if found is None:
            return None
        buffer = np.empty(len(self.mesh.loops) * 2, np.float32)
        found.data.foreach_get('uv', buffer)
        return text.sane(buffer.reshape(-1, 2))[0]

    def colour(self, layer):
        """Linear corner values of a layer (the rendered colours for None): rgba, n x 4; None where there is none.

        A material's attribute node finds colours, UV maps and whatever else geometry nodes have stored under a name.
        """
        layers, default = versions.color_attributes(self.mesh)
        found = layers.get(layer or default)
        if found is None and layer:
            uv = self.uv(layer) if layer in self.mesh.uv_layers else None
            if uv is not None:
                return np.column_stack([uv, np.zeros(len(uv), np.float32), np.ones(len(uv), np.float32)])
            found = self.mesh.attributes.get(layer)
        if found is None or found.data_type not in FIELDS:
            return None
        field, width = FIELDS[found.data_type]
        buffer = np.empty(len(found.data) * width, TYPES.get(found.data_type, np.float32))
        found.data.foreach_get(field, buffer)
        rows = text.sane(buffer.reshape(-1, width))[0]
        values = np.zeros((len(rows), 4), np.float32)
        values[:, 3] = 1
        values[:, :width] = rows
        if width == 1:
            values[:, 1:3] = rows
        return self._at_corners(values, found.domain)

    def _at_corners(self, values, domain):
        count = len(self.mesh.loops)
        if domain == 'POINT':
            index = np.empty(count, np.int32)
            self.mesh.loops.foreach_get('vertex_index', index)
            return values[index]
        if domain == 'FACE':
            totals = np.empty(len(self.mesh.polygons), np.int32)
            self.mesh.polygons.foreach_get('loop_total', totals)
            return np.repeat(values, totals, axis=0)
        return values if domain == 'CORNER' and len(values) == count else None

    def bounds(self):
        if not len(self.points):
            return np.zeros(3), np.zeros(3)
        return self.points.min(axis=0).astype(np.float64), self.points.max(axis=0).astype(np.float64)


def distinct(rows):
    """Rows of 2 or 3 float32, each once, and where each row went. Order: by the value's bits, always the same."""
    rows = np.ascontiguousarray(rows, np.float32) + np.float32(0)      # -0 and 0 are one
    if rows.shape[1] == 2:
        keys = rows.view(np.uint64).ravel()
        _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    else:
        # Unit vectors in steps of 1e-6 fit 21 bits each.
        steps = np.rint(np.clip(rows, -1, 1).astype(np.float64) * 1e6).astype(np.int64) + 1000000
        keys = (steps[:, 0] << 42) | (steps[:, 1] << 21) | steps[:, 2]
        _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    return rows[first], inverse.ravel()


def _by_vertex(faces, corners, count):
    """Values at corners (faces x 3 x n) as values at vertices, or None where a vertex has several."""
    values = np.zeros((count, corners.shape[2]), np.float32)
    values[faces.ravel()] = corners.reshape(-1, corners.shape[2])
    return values if np.array_equal(values[faces], corners) else None


def used(faces, count):
    """The vertices that these faces need, and the faces renumbered to them."""
    mask = np.zeros(count, bool)
    mask[faces] = True
    if mask.all():
        return None, faces
    numbers = np.cumsum(mask) - 1
    return np.flatnonzero(mask), numbers[faces]


def write_part(out, name, triangles, chosen, textures, looks, uv_layer):
    """One mesh2.

    chosen: numbers of its faces. textures: texture numbers a face (n) or a corner (n x 3), or None for one texture.
    looks: lines of texture_list or of the one texture. uv_layer: a UV map's name, '' for the rendered one, or None.
    """
    order = chosen[np.argsort(~triangles.smooth[chosen], kind='stable')]
    if textures is not None:
        textures = textures[np.argsort(~triangles.smooth[chosen], kind='stable')]
    smooth = int(np.count_nonzero(triangles.smooth[order]))
    original = triangles.faces[order]
    loops = triangles.loops[order]
    keep, faces = used(original, len(triangles.points))
    points = triangles.points if keep is None else triangles.points[keep]

    normals = normal_faces = None
    if smooth and triangles.own_normals:
        normals, where = distinct(triangles.corner_normals()[loops[:smooth].ravel()])
        normal_faces = where.reshape(-1, 3)
    elif smooth:
        normals = triangles.vertex_normals() if keep is None else triangles.vertex_normals()[keep]
        normal_faces = None if smooth == len(faces) else faces[:smooth]

    uvs = uv_faces = None
    if uv_layer is not None:
        corners = triangles.uv(uv_layer or None)
        if corners is not None:
            corners = corners[loops]
            uvs = _by_vertex(faces, corners, len(points))
            if uvs is None:
                uvs, where = distinct(corners.reshape(-1, 2))
                uv_faces = where.reshape(-1, 3)

    numbers = text.Integers(max(len(points), 1 if normals is None else len(normals), 1 if uvs is None else len(uvs),
                                1 if textures is None else int(textures.max()) + 1))

    def block(head, count, write):
        out.write(b'%s {\n%d,\n' % (head, count))
        write()
        out.write(b'}\n')
    out.write(b'#declare %s = mesh2 {\n' % name.encode())
    block(b'vertex_vectors', len(points), lambda: text.write_vectors(out, points))
    if normals is not None:
        block(b'normal_vectors', len(normals), lambda: text.write_vectors(out, normals, 6))
    if uvs is not None:
        block(b'uv_vectors', len(uvs), lambda: text.write_vectors(out, uvs))
    if textures is not None:
        out.write(b'texture_list {\n%d,\n%s\n}\n' % (len(looks), '\n'.join(looks).encode()))
        behind = textures.reshape(len(textures), -1)
    else:
        behind = None
    block(b'face_indices', len(faces), lambda: numbers.write(out, faces, behind))
    if normal_faces is not None:
        block(b'normal_indices', len(normal_faces), lambda: numbers.write(out, normal_faces))
    if uv_faces is not None:
        block(b'uv_indices', len(uv_faces), lambda: numbers.write(out, uv_faces))
    if textures is None:
        out.write('\n'.join(looks).encode() + b'\n')


def tubes(points, counts, radii, sides=4):
    """Strands as one mesh of round tubes, closed at the tip by a point.

    points: all strands' points, one behind the other; counts: points a strand (at least 2); radii: at each point.
    Returns points, normals and faces. A sphere_sweep a strand would be the same picture, but a thousand of those take
    POV-Ray longer than a million triangles.
    """
    points = np.asarray(points, np.float64)
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
    ends = starts + np.asarray(counts) - 1
    ahead = np.roll(points, -1, axis=0) - points
    back = points - np.roll(points, 1, axis=0)
    back[starts] = ahead[starts]
    ahead[ends] = back[ends]
    along = ahead + back
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-20)
    # Any frame will do on a round tube, but neighbours must have nearly the same: one axis for a whole strand.
    whole = points[ends] - points[starts]
    axis = np.zeros_like(whole)
    axis[np.arange(len(whole)), np.argmin(np.abs(whole), axis=1)] = 1.0
    axis = np.repeat(axis, counts, axis=0)
    side = np.cross(along, axis)
    length = np.linalg.norm(side, axis=1, keepdims=True)
    side = np.where(length > 1e-9, side / np.maximum(length, 1e-20), np.roll(axis, 1, axis=1))
    up = np.cross(along, side)
    angles = 2 * np.pi * np.arange(sides) / sides
    ring = (np.cos(angles)[None, :, None] * side[:, None, :] + np.sin(angles)[None, :, None] * up[:, None, :])
    # The corners lie outside the circle so that the tube is as wide as the strand on average.
    wide = radii[:, None, None] * (2 * np.pi / sides / np.sin(2 * np.pi / sides)) ** 0.5
    vertices = (points[:, None, :] + wide * ring).reshape(-1, 3)
    segments = np.setdiff1d(np.arange(len(points)), ends, assume_unique=True)
    i = np.arange(sides)
    j = (i + 1) % sides
    a = segments[:, None] * sides + i
    b = segments[:, None] * sides + j
    c, d = a + sides, b + sides
    faces = np.stack([np.stack([a, b, d], -1), np.stack([a, d, c], -1)], 2).reshape(-1, 3)
    return vertices.astype(np.float32), ring.reshape(-1, 3).astype(np.float32), faces


def write_tubes(out, name, tube, looks):
    points, normals, faces = tube
    numbers = text.Integers(len(points))
    out.write(b'#declare %s = mesh2 {\nvertex_vectors {\n%d,\n' % (name.encode(), len(points)))
    text.write_vectors(out, points)
    out.write(b'}\nnormal_vectors {\n%d,\n' % len(normals))
    text.write_vectors(out, normals, 4)
    out.write(b'}\nface_indices {\n%d,\n' % len(faces))
    numbers.write(out, faces)
    out.write(b'}\n' + '\n'.join(looks).encode() + b'\n')
