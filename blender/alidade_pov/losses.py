# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What Alidade's scene format cannot say, gathered while a scene is written.

Two kinds. Lost: the picture misses something; each is one line "object, socket, node: why", a warning, and an error
with --strict. Nearest: said in other words, as docs/exporter.md explains (a rough mirror, a soft lamp as a grid);
these stand in the head of the file alone.
"""


class Losses:
    def __init__(self):
        self._lost = {}
        self._nearest = {}

    def lost(self, where, socket, node, why):
        """where: the object, material or world; socket and node: their names or '-'."""
        self._lost[(str(where), str(socket), str(node), why)] = True

    def nearest(self, where, socket, node, why):
        self._nearest[(str(where), str(socket), str(node), why)] = True

    @staticmethod
    def _lines(entries):
        return ['%s, %s, %s: %s' % entry for entry in sorted(entries)]

    def lost_lines(self):
        return self._lines(self._lost)

    def nearest_lines(self):
        return self._lines(self._nearest)
