# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""One HTML page, whole in itself: ours, POV-Ray's and the difference of every comparison, with figures."""
import base64
import html

import numpy

import measure
import picture

HEAD = '''<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Alidade and POV-Ray</title><style>
body { font: 15px/1.4 sans-serif; margin: 2em; background: #f4f4f2; color: #222 }
h2 { margin: 1.6em 0 .3em } img { image-rendering: pixelated; width: 320px; background: #000 }
figure { display: inline-block; margin: 0 8px 8px 0 } figcaption { font-size: 13px; color: #555 }
table { border-collapse: collapse; background: #fff } th, td { border: 1px solid #ccc; padding: 3px 9px }
td { text-align: right } td:first-child, th { text-align: left } .bad { color: #b00020; font-weight: bold }
</style></head><body><h1>Alidade and POV-Ray, picture by picture</h1>
<p>Both render the same file. Differences are in sRGB after clamping, ours minus POV-Ray's; the third picture
shows them 20 times enlarged around grey, the fourth the pixels that differ by more than 1/255, by class.</p>
'''
COLOURS = {'edge': (0.2, 0.5, 1.0), 'tolerance': (0.1, 0.8, 0.3), 'busy': (0.9, 0.7, 0.1), 'leak': (0.8, 0.2, 0.9),
           'level': (0.6, 0.6, 0.6), 'shade': (1.0, 0.1, 0.1)}


def _image(shown, caption):
    data = base64.b64encode(picture.png(shown)).decode('ascii')
    return '<figure><img alt="%s" src="data:image/png;base64,%s"><figcaption>%s</figcaption></figure>' % (
        caption, data, caption)


class Report:
    def __init__(self):
        self.rows, self.parts, self.used = [], [], set()

    def add(self, name, figures, classes, complaints, note=''):
        """One comparison: figures and classes of measure.py, complaints a list of sentences."""
        where = len(self.rows)
        bad = ' class="bad"' if complaints else ''
        kinds = ', '.join('%s %d' % (k, m.sum()) for k, m in classes.items()) or 'none'
        self.used |= set(classes)
        self.rows.append(
            '<tr><td><a href="#c%d">%s</a></td><td%s>%.3f %%</td><td>%d</td><td>%+.6f</td><td>%.6f</td>'
            '<td>%.4f</td><td>%d</td><td style="text-align:left">%s</td></tr>' % (
                where, html.escape(name), bad, figures.within, figures.count, figures.mean, figures.rmse,
                figures.max, figures.nonfinite, kinds))
        mask = 0.15 * figures.theirs
        for kind, pixels in classes.items():
            mask[pixels] = COLOURS[kind]
        self.parts.append('<h2 id="c%d">%s</h2>' % (where, html.escape(name)))
        for complaint in complaints:
            self.parts.append('<p class="bad">%s</p>' % html.escape(complaint))
        self.parts.append('<p>%s. Pixels off by more than 1/255: %s. %s</p>' % (
            html.escape(figures.text()), html.escape(kinds), html.escape(note)))
        self.parts.append(_image(figures.ours, 'Alidade') + _image(figures.theirs, 'POV-Ray') +
                          _image(numpy.clip(0.5 + 20 * figures.error, 0, 1), 'difference x 20') +
                          _image(mask, 'pixels off by more than 1/255'))

    def fail(self, name, reason):
        """A comparison that could not be made."""
        self.rows.append('<tr><td>%s</td><td class="bad" colspan="7" style="text-align:left">%s</td></tr>' % (
            html.escape(name), html.escape(reason)))

    def text(self):
        legend = ''.join('<li><b style="color:rgb(%d,%d,%d)">%s</b> %s</li>' % (
            tuple(int(255 * c) for c in COLOURS[k]) + (k, html.escape(measure.CLASSES[k])))
            for k in measure.CLASSES if k in self.used)
        return (HEAD + '<table><tr><th>picture</th><th>within 1/255</th><th>not</th><th>mean error</th>'
                '<th>RMSE</th><th>max</th><th>not finite</th><th>pixels by class</th></tr>' +
                '\n'.join(self.rows) + '</table><ul>' + legend + '</ul>' + '\n'.join(self.parts) +
                '</body></html>\n')

    def write(self, path):
        with open(path, 'w', encoding='utf-8') as file:
            file.write(self.text())
