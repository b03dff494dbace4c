# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Normal and bump maps. POV-Ray bends normals in a frame of its own, not along a UV map, so a picture of normals cannot
be said as a texture. It is put into the mesh: triangles are divided as finely as the picture, or a limit, asks for,
and their corners get the bent normals. Shapes do not change.
"""
import numpy as np

from .values import Points, as_number

FINEST = 64


class Relief:
    """What bends a material's normals: a Paint of normals (kind 'map') or of heights ('bump')."""

    def __init__(self, kind, paint, strength, distance, space, node, size):
        self.kind, self.paint, self.strength, self.distance = kind, paint, strength, distance
        self.space, self.node, self.size = space, node, size

    def bend(self, tree, painter, uv, normal, du, dv):
        """Bent unit normals at points; du, dv: how the place changes with u and v."""
        def values(at):
            flat = np.column_stack([at, np.zeros(len(at))])
            return self.paint.value(tree, Points(len(at), coordinates={self.space: flat}, sampler=painter.sampler))
        across, up = np.cross(dv, normal), np.cross(normal, du)
        det = (du * across).sum(axis=1, keepdims=True)
        if self.kind == 'bump':
            step = 1.0 / max(self.size)
            here, right, above = (as_number(values(uv + d)) for d in ((0, 0), (step, 0), (0, step)))
            slope = ((right - here)[:, None] * across + (above - here)[:, None] * up) / step
            bent = np.abs(det) * normal - self.distance * np.sign(det) * slope
            bent = _unit(bent, normal)
            return _unit(self.strength * bent + (1 - self.strength) * normal, normal)
        rgb = values(uv) * 2 - 1
        rgb[:, :2] *= self.strength
        rgb[:, 2] = 1 + (rgb[:, 2] - 1) * min(self.strength, 1.0)
        tangent = _unit(du - normal * (du * normal).sum(axis=1, keepdims=True), du)
        side = np.cross(normal, tangent) * np.where(det < 0, -1.0, 1.0)
        return _unit(rgb[:, :1] * tangent + rgb[:, 1:2] * side + rgb[:, 2:] * normal, normal)


def _unit(rows, instead):
    length = np.linalg.norm(rows, axis=1, keepdims=True)
    return np.where(length > 1e-12, rows / np.maximum(length, 1e-12), instead)


def facing(bent, flat, eye, points):
    """Normals turned back towards the flat face's, as little as is needed for the eye to see a mirror's ray leave it.

    Cycles does so while it shades. Without, a normal that points away from the eye is taken for one of the back, and the
    place is dark. eye: where it is, or with a fourth number 0 the direction to it. Faces seen from behind stay.
    """
    to_eye = eye[:3] - points if eye[3] else np.broadcast_to(eye[:3], points.shape)
    to_eye = _unit(to_eye, flat)

    def along(a, b):
        return (a * b).sum(axis=1, keepdims=True)
    facing_us = along(flat, to_eye)
    least = np.minimum(0.9 * facing_us, 0.01)

    def good(normal):
        across = along(normal, to_eye)
        return (across > 0) & (2 * across * along(normal, flat) - facing_us >= least)
    low, high = np.zeros((len(bent), 1)), np.ones((len(bent), 1))
    for _ in range(12):
        middle = 0.5 * (low + high)
        fits = good(_unit((1 - middle) * bent + middle * flat, flat))
        low, high = np.where(fits, low, middle), np.where(fits, middle, high)
    turn = ~good(bent) & (facing_us > 1e-6)
    return np.where(turn, _unit((1 - high) * bent + high * flat, flat), bent)


def divisions(spans, limit):
    """Into how many parts each triangle's sides go: enough for its span in the picture, all within the limit."""
    low, high = 0.0, 1.0
    for _ in range(30):
        middle = 0.5 * (low + high) if low or high < 1 else 1.0
        count = np.clip(np.ceil(spans * middle), 1, FINEST)
        if (count ** 2).sum() <= limit:
            low = middle
            if middle == 1.0:
                break
        else:
            high = middle
    return np.clip(np.ceil(spans * low), 1, FINEST).astype(np.int64)


def lattice(n):
    """Barycentric coordinates of a triangle's points at n parts a side, and its n * n triangles."""
    points = [(n - i - j, i, j) for j in range(n + 1) for i in range(n + 1 - j)]
    number = {(i, j): k for k, (_, i, j) in enumerate(points)}
    faces = []
    for j in range(n):
        for i in range(n - j):
            faces.append((number[i, j], number[i + 1, j], number[i, j + 1]))
            if i + j < n - 1:
                faces.append((number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]))
    return np.array(points, np.float64) / n, np.array(faces, np.int64)


class Refined:
    """Stands in for geometry.Triangles: the chosen triangles, divided, with bent normals at their corners."""
    own_normals = True
    bad = 0

    def __init__(self, triangles, chosen, layer, relief, tree, painter, limit, eye=None):
        faces, loops = triangles.faces[chosen], triangles.loops[chosen]
        place = triangles.points[faces].astype(np.float64)
        corners_uv = triangles.uv(layer or None)
        uv = np.zeros((len(faces), 3, 2)) if corners_uv is None else corners_uv[loops].astype(np.float64)
        flat = np.cross(place[:, 1] - place[:, 0], place[:, 2] - place[:, 0])
        flat = _unit(flat, np.array([0, 0, 1.0]))
        corner = triangles.corner_normals()[loops] if triangles.own_normals else triangles.vertex_normals()[faces]
        normal = np.where(triangles.smooth[chosen][:, None, None], corner, flat[:, None, :])
        e1, e2 = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
        det = e1[:, 0] * e2[:, 1] - e1[:, 1] * e2[:, 0]
        safe = np.where(np.abs(det) < 1e-20, 1.0, det)[:, None]
        p1, p2 = place[:, 1] - place[:, 0], place[:, 2] - place[:, 0]
        du = np.where(np.abs(det)[:, None] < 1e-20, p1, (p1 * e2[:, 1:] - p2 * e1[:, 1:]) / safe)
        dv = np.where(np.abs(det)[:, None] < 1e-20, p2, (p2 * e1[:, :1] - p1 * e2[:, :1]) / safe)
        size = np.array(relief.size, np.float64)
        spans = np.max([np.abs((uv[:, a] - uv[:, b]) * size).max(axis=1) for a, b in ((0, 1), (1, 2), (2, 0))], axis=0)
        parts = divisions(spans, max(limit, len(faces)))
        points, normals, uvs, triples, owners = [], [], [], [], []
        at = 0
        for n in np.unique(parts).tolist():
            rows = np.flatnonzero(parts == n)
            weights, inner = lattice(n)
            where = np.einsum('kc,mcx->mkx', weights, place[rows]).reshape(-1, 3)
            smooth = np.einsum('kc,mcx->mkx', weights, normal[rows]).reshape(-1, 3)
            coordinates = np.einsum('kc,mcx->mkx', weights, uv[rows]).reshape(-1, 2)
            smooth = _unit(smooth, np.array([0, 0, 1.0]))
            repeat = len(weights)
            bent = relief.bend(tree, painter, coordinates, smooth, np.repeat(du[rows], repeat, axis=0),
                               np.repeat(dv[rows], repeat, axis=0))
            if eye is not None:
                bent = facing(bent, np.repeat(flat[rows], repeat, axis=0), eye, where)
            points.append(where)
            normals.append(bent)
            uvs.append(coordinates)
            triples.append((inner[None, :, :] + at + repeat * np.arange(len(rows))[:, None, None]).reshape(-1, 3))
            owners.append(np.repeat(rows, len(inner)))
            at += repeat * len(rows)
        self.points = np.concatenate(points).astype(np.float32)
        self.faces = np.concatenate(triples)
        self.loops = self.faces
        self.owners = np.concatenate(owners)
        self.count = len(self.faces)
        self.smooth = np.ones(self.count, bool)
        self._normals = np.concatenate(normals).astype(np.float32)
        self._uvs = np.concatenate(uvs).astype(np.float32)
        self.layer = layer

    def corner_normals(self):
        return self._normals

    def vertex_normals(self):
        return self._normals

    def uv(self, layer):
        return self._uvs if (layer or '') == (self.layer or '') else None
