# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""The pictures of docs/exporter.md: each of the gallery's scenes by Cycles, POV-Ray and Alidade, side by side.

    pictures.py [NAME...]

Environment: ALIDADE, ALIDADE_SRC, and ALIDADE_BUILD, in whose docs-pictures the three pictures of each scene stay.
Needs blender, povray and numpy. Takes an hour for all; what is there already is not drawn again.
"""
import os
import subprocess
import sys

import numpy

source = os.environ['ALIDADE_SRC']
sys.path.insert(0, os.path.join(source, 'tests', 'images'))
import picture
import renderers

SIZE, GAP = (160, 120), 4
NAMES = ('areas', 'colours', 'focus', 'glass', 'hair', 'instances', 'lamps', 'relief', 'room', 'shaders', 'shapes',
         'sky', 'spheres', 'textures')


def blender(*arguments):
    subprocess.run(['blender', '-b', *arguments], stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL, check=True)


def export(name, folder):
    if not os.path.exists(os.path.join(folder, name, 'scene.pov')):
        blender('--factory-startup', '-P', os.path.join(source, 'tests', 'blender', 'gallery_export.py'), '--',
                os.path.join(source, 'blender'), folder, name)


def cycles(name, base):
    out, file = os.path.join(base, 'cycles0001.exr'), os.path.join(base, name + '.blend')
    if not os.path.exists(out):
        blender('--factory-startup', '-P', os.path.join(source, 'blender', 'gallery', 'gallery.py'), '--', name, file)
        blender(file, '-o', os.path.join(base, 'cycles'), '-F', 'OPEN_EXR', '--python-expr',
                'import bpy; bpy.context.scene.render.resolution_percentage = %d' % (100 * SIZE[0] // 320), '-f', '1')
    return picture.read(out)


def povray(base):
    out = os.path.join(base, 'povray.exr')
    return picture.read(out) if os.path.exists(out) else renderers.povray(os.path.join(base, 'scene.pov'), out, SIZE,
                                                                          'pov2')


def alidade(base):
    out = os.path.join(base, 'alidade.pfm')
    if not os.path.exists(out):
        renderers.alidade(os.path.join(base, 'scene.pov'), out, SIZE, aa='pov2')
    return picture.read(out)


def main():
    folder = os.path.join(os.environ['ALIDADE_BUILD'], 'docs-pictures')
    for name in sys.argv[1:] or NAMES:
        base = os.path.join(folder, name)
        os.makedirs(base, exist_ok=True)
        export(name, folder)
        gap = numpy.ones((SIZE[1], GAP, 3))
        strip = [cycles(name, base), gap, povray(base), gap, alidade(base)]
        with open(os.path.join(source, 'docs', 'exporter', name + '.png'), 'wb') as file:
            file.write(picture.png(numpy.concatenate([picture.encode(part) for part in strip], axis=1)))
        print(name, flush=True)


if __name__ == '__main__':
    main()
