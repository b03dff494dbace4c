# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Picture files that textures need, in a folder beside the scene and named relative to it.

A JPEG, and a PNG without alpha or a gamma of its own, is copied as it is; everything else (packed, generated, other
formats, with alpha, computed from nodes) is written by pictures.py. Same pixels, same bytes.
"""
import hashlib
import os

import numpy as np

from . import pictures


class Store:
    def __init__(self, folder, name):
        self.folder = folder            # of the .pov
        self.name = name                # the pictures' folder below it
        self._files = {}                # contents' hash -> relative name
        self._names = set()
        self._pixels = {}

    def put(self, data, stem, extension):
        """Write bytes once; returns the name to put into the scene."""
        digest = hashlib.blake2b(data, digest_size=16).hexdigest() + extension
        if digest in self._files:
            return self._files[digest]
        stem = ''.join(c if c.isascii() and (c.isalnum() or c in '-_') else '_' for c in stem)[:60] or 'picture'
        name, count = stem, 1
        while (name + extension).lower() in self._names:
            count += 1
            name = '%s-%d' % (stem, count)
        self._names.add((name + extension).lower())
        os.makedirs(os.path.join(self.folder, self.name), exist_ok=True)
        with open(os.path.join(self.folder, self.name, name + extension), 'wb') as out:
            out.write(data)
        relative = self.name + '/' + name + extension
        self._files[digest] = relative
        return relative

    def pixels(self, image, path=None):
        """height x width x 4, bottom row first, as stored: bytes are still coded, floats are linear. None: no data.

        path: of an image that is a sequence, the file to take.
        """
        key = image.name_full, path
        if key not in self._pixels:
            self._pixels[key] = self._of_file(image, path) if path else self._of_image(image)
        return self._pixels[key]

    @staticmethod
    def _of_image(image):
        width, height = image.size
        if not width or not height or not image.has_data and not len(image.pixels):
            return None
        buffer = np.empty(width * height * image.channels, np.float32)
        image.pixels.foreach_get(buffer)
        buffer = buffer.reshape(height, width, image.channels)
        full = np.ones((height, width, 4), np.float32)
        if image.channels >= 3:
            full[..., :image.channels] = buffer
        else:
            full[..., :3] = buffer[..., :1]
        return full

    def _of_file(self, image, path):
        import bpy
        try:
            frame = bpy.data.images.load(bpy.path.abspath(path, library=image.library))
        except RuntimeError:
            return None
        try:
            frame.colorspace_settings.name = image.colorspace_settings.name
            return self._of_image(frame)
        finally:
            bpy.data.images.remove(frame)

    @staticmethod
    def is_data(image):
        return image.colorspace_settings.name in ('Non-Color', 'Raw', 'Linear', 'Linear Rec.709', 'Generic Data')

    def linear(self, image, path=None):
        """The same in linear light, as a shader sees it."""
        pixels = self.pixels(image, path)
        if pixels is None:
            return None
        if not image.is_float and not self.is_data(image):
            pixels = pixels.copy()
            pixels[..., :3] = pictures.to_linear(pixels[..., :3])
        return pixels

    def _source(self, image, path=None):
        """The bytes of the image's file, from the file or packed, unless it was painted on since."""
        if image.is_dirty or image.source != 'FILE' and not path:
            return None
        if image.packed_file and not path:
            return bytes(image.packed_file.data)
        import bpy
        path = bpy.path.abspath(path or image.filepath_raw, library=image.library)
        try:
            with open(path, 'rb') as file:
                return file.read()
        except OSError:
            return None

    def file(self, image, path=None):
        """A file of the image's colours without alpha: its name, or None where there are no pixels."""
        key = ('file', image.name_full, path)
        if key not in self._files:
            self._files[key] = self._write(image, path)
        return self._files[key]

    def _write(self, image, path):
        data = self._source(image, path)
        stem = os.path.splitext(image.name)[0]
        if data and data[:3] == b'\xff\xd8\xff' and jpeg_components(data) in (1, 3):
            return self.put(data, stem, '.jpg')
        if data and plain_png(data):
            return self.put(data, stem, '.png')
        pixels = self.pixels(image, path)
        if pixels is None:
            return None
        top = pixels[::-1, :, :3]
        if image.is_float:
            return self.put(pictures.hdr(top), stem, '.hdr')
        return self.put(pictures.png(top, 8), stem, '.png')


def jpeg_components(data):
    """Colour components that a JPEG's frame header states; 0 if it cannot be found."""
    at = 2
    while at + 9 < len(data) and data[at] == 0xff:
        kind = data[at + 1]
        if 0xc0 <= kind <= 0xcf and kind not in (0xc4, 0xc8, 0xcc):
            return data[at + 9]
        at += 2 + int.from_bytes(data[at + 2:at + 4], 'big')
    return 0


def plain_png(data):
    """Whether every reader sees the colours that Blender sees: no alpha, palette, or word on gamma."""
    if data[:8] != b'\x89PNG\r\n\x1a\n' or data[25] not in (0, 2):
        return False
    at = 8
    while at + 8 <= len(data):
        kind = data[at + 4:at + 8]
        if kind in (b'gAMA', b'iCCP', b'cHRM', b'tRNS'):
            return False
        if kind == b'IDAT':
            return True
        at += 12 + int.from_bytes(data[at:at + 4], 'big')
    return False


def sample(pixels, u, v, closest=False, extension='REPEAT'):
    """Bilinear samples at u, v: (n, 4). CLIP is transparent black outside, EXTEND repeats the edge."""
    height, width = pixels.shape[:2]
    x, y = u * width - 0.5, v * height - 0.5
    if closest:
        x, y = np.rint(x), np.rint(y)
    x0, y0 = np.floor(x), np.floor(y)
    fx, fy = (x - x0)[:, None], (y - y0)[:, None]

    def index(values, size):
        values = values.astype(np.int64)
        return values % size if extension == 'REPEAT' else np.clip(values, 0, size - 1)
    xa, xb, ya, yb = index(x0, width), index(x0 + 1, width), index(y0, height), index(y0 + 1, height)
    found = ((pixels[ya, xa] * (1 - fx) + pixels[ya, xb] * fx) * (1 - fy)
             + (pixels[yb, xa] * (1 - fx) + pixels[yb, xb] * fx) * fy)
    if extension == 'CLIP':
        found[(u < 0) | (u > 1) | (v < 0) | (v > 1)] = 0
    return found
