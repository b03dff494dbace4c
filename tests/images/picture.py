# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Reading OpenEXR pictures, and writing PNG, with nothing but numpy and zlib.

A reader of its own, so that the comparison with POV-Ray does not lean on the code under test.
Chapters "Structure" and "Predefined attributes" of https://openexr.com/en/latest/OpenEXRFileLayout.html;
scan lines, uncompressed or ZIP, which is what POV-Ray and Alidade write.
"""
import struct
import zlib

import numpy

TYPES = {1: ('<f2', 2), 2: ('<f4', 4)}
LINES = {0: 1, 2: 1, 3: 16}


class Unreadable(Exception):
    pass


def _text(data, at):
    end = data.index(b'\0', at)
    return data[at:end].decode('latin-1'), end + 1


def _header(data):
    magic, version = struct.unpack_from('<II', data)
    if magic != 20000630 or version & 0xff != 2 or version & 0x1a00:
        raise Unreadable('not an OpenEXR file of one part with scan lines')
    attributes, at = {}, 8
    while data[at] != 0:
        name, at = _text(data, at)
        _, at = _text(data, at)
        size, = struct.unpack_from('<I', data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def _channels(block):
    found, at = [], 0
    while block[at] != 0:
        name, at = _text(block, at)
        kind, = struct.unpack_from('<I', block, at)
        if kind not in TYPES:
            raise Unreadable('a channel of integers: ' + name)
        found.append((name,) + TYPES[kind])
        at += 16
    return found


def _unzip(block, size):
    """ZIP as OpenEXR does it: differences of bytes, the even ones first."""
    if len(block) == size:
        return block
    raw = numpy.frombuffer(zlib.decompress(block), numpy.uint8).astype(numpy.int64)
    raw[1:] -= 128
    raw = (numpy.cumsum(raw) & 255).astype(numpy.uint8)
    out = numpy.empty_like(raw)
    half = (len(raw) + 1) // 2
    out[0::2], out[1::2] = raw[:half], raw[half:]
    return out.tobytes()


def read_exr(path):
    """R, G and B of a picture in linear light: float64, height x width x 3."""
    with open(path, 'rb') as file:
        data = file.read()
    try:
        attributes, at = _header(data)
        x0, y0, x1, y1 = struct.unpack('<4i', attributes['dataWindow'])
        compression = attributes['compression'][0]
        if compression not in LINES:
            raise Unreadable('compression %d' % compression)
        channels = _channels(attributes['channels'])
        width, height, lines = x1 - x0 + 1, y1 - y0 + 1, LINES[compression]
        planes = {name: numpy.empty((height, width)) for name, _, _ in channels}
        for offset in struct.unpack_from('<%dQ' % -(-height // lines), data, at):
            y, size = struct.unpack_from('<ii', data, offset)
            count = min(lines, y1 + 1 - y)
            block = data[offset + 8:offset + 8 + size]
            if compression:
                block = _unzip(block, count * width * sum(c[2] for c in channels))
            place = 0
            for row in range(y - y0, y - y0 + count):
                for name, kind, size in channels:
                    planes[name][row] = numpy.frombuffer(block, kind, width, place)
                    place += size * width
    except (struct.error, ValueError, IndexError, KeyError, zlib.error) as error:
        raise Unreadable('%s: damaged (%s)' % (path, error)) from None
    if not {'R', 'G', 'B'} <= set(planes):
        raise Unreadable('%s: no channels R, G and B' % path)
    return numpy.dstack([planes[c] for c in 'RGB'])


def encode(light):
    """Clamped to 0..1 and along the sRGB curve, as a screen shows it."""
    light = numpy.clip(numpy.nan_to_num(light, nan=0.0), 0.0, 1.0)
    return numpy.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def png(shown):
    """The bytes of a PNG of values 0..1, height x width x 3."""
    pixels = (numpy.clip(shown, 0, 1) * 255 + 0.5).astype(numpy.uint8)
    height, width, _ = pixels.shape

    def chunk(kind, body):
        return struct.pack('>I', len(body)) + kind + body + struct.pack('>I', zlib.crc32(kind + body))

    rows = b''.join(b'\0' + pixels[y].tobytes() for y in range(height))
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>2I5B', width, height, 8, 2, 0, 0, 0)) +
            chunk(b'IDAT', zlib.compress(rows, 9)) + chunk(b'IEND', b''))


def read_pfm(path):
    """A colour PFM, as Alidade writes it: light, rows from the bottom up."""
    with open(path, 'rb') as file:
        kind, size, scale = (file.readline().split() for _ in range(3))
        if kind != [b'PF'] or len(size) != 2:
            raise Unreadable('%s: not a PFM of three channels' % path)
        width, height = int(size[0]), int(size[1])
        order = '<f4' if float(scale[0]) < 0 else '>f4'
        data = numpy.frombuffer(file.read(), order)
    if data.size != 3 * width * height:
        raise Unreadable('%s: cut short' % path)
    return data.reshape(height, width, 3)[::-1].astype(numpy.float64)


def read(path):
    return read_pfm(path) if path.endswith('.pfm') else read_exr(path)
