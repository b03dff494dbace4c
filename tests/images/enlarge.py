# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""The same scene a number of times larger, as text: for what Blender's POV-Ray add-on writes.

POV-Ray leaves out hits nearer than fixed distances (1e-3 and the like). Where its picture of the
enlarged scene agrees with ours and its picture of the scene itself does not, that was the reason.

    enlarge.py FACTOR IN.pov OUT.pov
"""
import re
import sys

VECTOR = r'<([^<>]*)>'


def _times(factor, skip=0):
    def scaled(match):
        numbers = [float(n) * factor for n in match.group(2).split(',')]
        return '%s<%s>' % (match.group(1), ', '.join('%.9g' % n for n in numbers))
    return scaled


def enlarge(text, factor):
    """Objects and lamps are placed by matrices, everything else by the camera's two vectors."""
    # Planes are moved by their matrices too: a plane through the origin is scaled into itself.
    text = re.sub(r'(\bmatrix\s*)' + VECTOR, _times(factor), text)
    text = re.sub(r'(\bfade_distance\s+)([-+.\deE]+)',
                  lambda m: '%s%.9g' % (m.group(1), float(m.group(2)) * factor), text)

    # The distance of fog.
    text = re.sub(r'(\bfog\s*\{\s*distance\s+)([-+.\deE]+)',
                  lambda m: '%s%.9g' % (m.group(1), float(m.group(2)) * factor), text)

    # What media do per unit of length.
    text = re.sub(r'(\bscattering\s*\{\s*\d\s*,\s*|\babsorption\s+|\bemission\s+)(?=[\d.]+\s*[*/]\s*<)',
                  lambda m: '%s%.9g*' % (m.group(1), 1 / factor), text)

    def camera(match):
        block = re.sub(r'(\btranslate\s*)' + VECTOR, _times(factor), match.group(0))
        if 'orthographic' in block:
            block = re.sub(r'(\b(?:right|up)\s*)' + VECTOR, _times(factor), block)
        return block

    return re.sub(r'\bcamera\s*\{[^{}]*\}', camera, text)


if __name__ == '__main__':
    with open(sys.argv[2], encoding='utf-8') as file:
        larger = enlarge(file.read(), float(sys.argv[1]))
    with open(sys.argv[3], 'w', encoding='utf-8') as file:
        file.write(larger)
