# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Picture files beside the scene, written by ourselves so that the same pixels are the same bytes.

PNG (8 or 16 bits, no time stamp, no path) for textures and Radiance HDR for light that goes beyond 1. Needs numpy and
nothing of Blender.
"""
import struct
import zlib

import numpy as np


def to_srgb(linear):
    linear = np.clip(linear, 0.0, 1.0)
    return np.where(linear <= 0.0031308, linear * 12.92, 1.055 * np.power(np.maximum(linear, 1e-9), 1 / 2.4) - 0.055)


def to_linear(coded):
    coded = np.asarray(coded)
    return np.where(coded <= 0.04045, coded / 12.92, np.power((np.maximum(coded, 0.0) + 0.055) / 1.055, 2.4))


def _chunk(kind, data):
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))


def png(pixels, bits=8):
    """pixels: height x width x 1, 3 or 4 values of 0 to 1 as they are to stand in the file, top row first."""
    height, width, channels = pixels.shape
    most = (1 << bits) - 1
    values = np.rint(np.clip(np.nan_to_num(pixels), 0.0, 1.0) * most).astype('>u2' if bits == 16 else np.uint8)
    rows = np.zeros((height, 1 + width * channels * bits // 8), np.uint8)
    rows[:, 1:] = values.reshape(height, -1).view(np.uint8)
    kind = {1: 0, 3: 2, 4: 6}[channels]
    return (b'\x89PNG\r\n\x1a\n' + _chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, bits, kind, 0, 0, 0))
            + _chunk(b'IDAT', zlib.compress(rows.tobytes(), 6)) + _chunk(b'IEND', b''))


def _run_lengths(row):
    """One channel of one row in Radiance's run-length code."""
    out = bytearray()
    i, count = 0, len(row)
    change = np.flatnonzero(np.diff(row)) + 1
    starts = np.concatenate([[0], change])
    lengths = np.diff(np.concatenate([starts, [count]]))
    plain = bytearray()

    def flush():
        for k in range(0, len(plain), 128):
            part = plain[k:k + 128]
            out.append(len(part))
            out.extend(part)
        plain.clear()
    for i, length in zip(starts.tolist(), lengths.tolist()):
        value = int(row[i])
        if length < 4:
            plain.extend([value] * length)
            continue
        flush()
        while length > 0:
            part = min(length, 127)
            out.extend((128 + part, value))
            length -= part
    flush()
    return bytes(out)


def hdr(pixels):
    """Radiance: height x width x 3 linear values, top row first."""
    pixels = np.maximum(np.nan_to_num(np.asarray(pixels[..., :3], np.float64), posinf=1e30), 0.0)
    height, width = pixels.shape[:2]
    most = pixels.max(axis=2)
    mantissa, exponent = np.frexp(most)
    scale = np.where(most > 1e-32, mantissa * 256.0 / np.maximum(most, 1e-38), 0.0)
    coded = np.zeros((height, width, 4), np.uint8)
    coded[..., :3] = np.clip(pixels * scale[..., None], 0, 255).astype(np.uint8)
    coded[..., 3] = np.where(most > 1e-32, exponent + 128, 0).astype(np.uint8)
    head = b'#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n' % (height, width)
    if width < 8 or width > 32767:
        return head + coded.tobytes()
    out = [head]
    for row in coded:
        out.append(bytes((2, 2, width >> 8, width & 255)))
        out.extend(_run_lengths(row[:, c]) for c in range(4))
    return b''.join(out)
