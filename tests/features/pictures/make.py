#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Make the small pictures that the feature scenes lay on things. PNG by hand, so that every kind can be had;
the others with oiiotool. Usage: make.py, in this folder."""
import os
import struct
import subprocess
import zlib

import numpy as np


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(name, samples, colour, depth, extra=b""):
    """samples: height x width x channels; colour: PNG's 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA"""
    height, width = samples.shape[:2]
    rows = b""
    for row in samples.reshape(height, -1):
        rows += b"\0" + row.astype(">u2" if depth == 16 else "u1").tobytes()
    head = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0)
    with open(name, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + extra +
                  chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def gama(x):
    return chunk(b"gAMA", struct.pack(">I", round(x * 100000)))


def field(width, height, channels, top, seed):
    """Smooth, with some jumps, no two sides alike."""
    y, x = np.mgrid[0:height, 0:width] + 0.5
    out = np.zeros((height, width, channels))
    for c in range(channels):
        wave = np.sin(x * (0.35 + 0.2 * c) + seed + c) * np.cos(y * (0.5 - 0.1 * c) + 2 * seed)
        out[:, :, c] = 0.5 + 0.45 * wave
    out[: height // 3, : width // 4] = np.roll(np.linspace(0.05, 1, channels), seed)
    out[-1, :, 0] = 0.95
    return np.rint(out * top).astype(int)


def main():
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    png("colour.png", field(13, 9, 3, 255, 1), 2, 8)
    png("grey.png", field(16, 10, 1, 255, 2), 0, 8)
    png("clear.png", field(10, 8, 4, 255, 3), 6, 8)
    png("greyclear.png", field(9, 7, 2, 255, 4), 4, 8)
    png("deep.png", field(8, 8, 3, 65535, 5), 2, 16, gama(1 / 1.8))
    palette = bytes([250, 20, 30, 20, 200, 40, 30, 60, 240, 230, 220, 30, 90, 90, 90, 255, 255, 255])
    y, x = np.mgrid[0:7, 0:9]
    png("palette.png", ((x // 2 + y * y // 3) % 6)[:, :, None], 3, 8,
        chunk(b"PLTE", palette) + chunk(b"tRNS", bytes([255, 128, 255, 0])))
    for name in "photo.jpg", "greyphoto.jpg", "old.tga", "old.bmp", "plain.tif", "plain.ppm", "bright.hdr":
        command = ["oiiotool", "colour.png" if "grey" not in name else "grey.png"]
        if name.endswith("jpg"):
            command += ["--compression", "jpeg:90"]
        subprocess.run(command + ["--nosoftwareattrib", "-o", name], check=True)
    subprocess.run(["oiiotool", "clear.png", "-d", "half", "--mulc", "1.5,1.5,1.5,1", "--nosoftwareattrib", "-o",
                    "light.exr"], check=True)


main()
