# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Every scene with every accelerator, against itself and against POV-Ray: run by scenes.sh.

    scenes.py [SCENE...]

Environment: ALIDADE (the program), ALIDADE_SRC, ALIDADE_BUILD; ALIDADE_ALL=1 renders whole what is
otherwise cropped, and every accelerator with every number of threads (but in the scenes with many
triangles). The report is ALIDADE_BUILD/tests/report.html.
"""
import filecmp
import os
import shutil
import sys
import tempfile

import measure
import picture
import renderers
import report
import tap

MANY = 20000                   # triangles from which on the slow accelerators get a part of the picture
CROP = (64, 48)
LEAST = {None: 99.8, 'pov2': 99.0}
FILES = {None: 'reference.exr', 'pov2': 'reference-aa.exr'}


def table(path):
    """scenes.txt: name, (width, height), triangles, flags."""
    with open(path, encoding='utf-8') as file:
        rows = [line.split() for line in file if line.strip() and not line.startswith('#')]
    return [(name, tuple(int(n) for n in size.split('x')), int(triangles), flags)
            for name, size, triangles, flags in rows]


class Scene:
    def __init__(self, name, size, triangles, folder, work, whole):
        self.name, self.size, self.triangles, self.folder, self.work = name, size, triangles, folder, work
        self.whole = whole
        self.file = os.path.join(folder, name + '.pov')

    def render(self, accel, threads, aa=None, crop=None):
        out = os.path.join(self.work, '%s-%s-%d%s%s.pfm' % (
            self.name, accel, threads, '-aa' if aa else '', '-crop' if crop else ''))
        if not os.path.exists(out):
            renderers.alidade(self.file, out, self.size, accel, threads, aa, crop)
        return out

    def same(self, accel, threads, crop, want):
        """One accelerator's picture against the bytes that octree made with two threads."""
        what = '%s: %s, %d thread%s: the same bytes%s' % (
            self.name, accel, threads, 's'[:threads > 1], ' (crop)' if crop else '')
        try:
            got = self.render(accel, threads, crop=crop)
        except renderers.Failed as failure:
            tap.ok(False, what, failure)
            return
        differ = [] if filecmp.cmp(got, want, False) else [self.first_difference(got, want)]
        tap.ok(not differ, what, *differ)

    def first_difference(self, got, want):
        a, b = picture.read(got), picture.read(want)
        if a.shape != b.shape:
            return 'sizes differ: %s, %s' % (a.shape, b.shape)
        places = (a != b).any(axis=2).nonzero()
        if not len(places[0]):
            return 'the pixels are equal, the files are not'
        y, x = places[0][0], places[1][0]
        return '%d pixels differ, first (%d, %d): %s and %s' % (len(places[0]), x, y, a[y, x], b[y, x])

    def accelerators(self):
        """Each accelerator, and 1, 2 and 7 threads: all pairs if the whole is asked for."""
        crop = None
        if self.triangles > MANY and not self.whole:
            crop = ((self.size[0] - CROP[0]) // 2, (self.size[1] - CROP[1]) // 2) + CROP
        try:
            full = self.render('octree', 2)
            part = self.render('octree', 2, crop=crop) if crop else full
        except renderers.Failed as failure:
            tap.ok(False, '%s: octree renders it' % self.name, failure)
            return False
        self.same('octree', 1, None, full)
        self.same('octree', 7, None, full)
        if crop:
            x, y, w, h = crop
            inside = picture.read(full)[y:y + h, x:x + w]
            tap.ok((picture.read(part) == inside).all(), '%s: a crop is that part of the whole' % self.name)
        pairs = (('none', 2), ('sphere', 7), ('box', 1), ('bvh8', 2))
        if self.whole and self.triangles <= MANY:
            pairs = [(accel, n) for accel in ('none', 'sphere', 'box', 'bvh8') for n in (1, 2, 7)]
        for accel, threads in pairs:
            self.same(accel, threads, crop, part)
        return True

    def against_povray(self, aa, page):
        """The picture octree made against POV-Ray's; why pixels differ goes to the report."""
        what = '%s%s: as POV-Ray' % (self.name, ', anti-aliased' if aa else '')
        try:
            ours = picture.read(self.render('octree', 2, aa))
            figures = measure.Figures(ours, picture.read(os.path.join(self.folder, FILES[aa])))
            complaints = figures.complaints(LEAST[aa])
            # Anti-aliased, POV-Ray's larger picture takes long: only where somebody will want it.
            larger = self.larger(aa) if figures.count and (complaints or not aa or self.whole) else None
        except (renderers.Failed, picture.Unreadable, OSError) as failure:
            tap.ok(False, what, failure)
            page.fail(what, str(failure))
            return
        classes = measure.classify(figures, larger)
        tap.ok(not complaints, what, *complaints)
        tap.note('%s: %s' % (what, figures.text()))
        tap.note(*['  %s %d' % (kind, mask.sum()) for kind, mask in classes.items()])
        page.add(what, figures, classes, complaints)

    def larger(self, aa):
        if not shutil.which('povray'):
            return None
        try:
            return renderers.povray(self.file, os.path.join(self.work, 'larger.exr'), self.size, aa, 100)
        except (renderers.Failed, picture.Unreadable) as failure:
            tap.note('POV-Ray on the scene made larger: %s' % failure)
            return None


def main():
    source, build = os.environ['ALIDADE_SRC'], os.environ['ALIDADE_BUILD']
    whole = os.environ.get('ALIDADE_ALL', '') not in ('', '0')
    page = report.Report()
    rows = table(os.path.join(source, 'scenes', 'scenes.txt'))
    with tempfile.TemporaryDirectory(prefix='alidade-scenes.') as work:
        for name, size, triangles, flags in rows:
            if sys.argv[1:] and name not in sys.argv[1:]:
                continue
            folder = os.path.join(source, 'scenes', name)
            scene = Scene(name, size, triangles, folder, work, whole)
            if 'large' in flags:
                made = os.path.join(build, 'scenes', name, name + '.pov')
                scene.file = made if os.path.exists(made) else scene.file
            if not os.path.exists(scene.file):
                tap.skip(name, 'not exported: scenes/export.sh --missing makes it, with Blender')
                continue
            if scene.accelerators():
                scene.against_povray(None, page)
                scene.against_povray('pov2', page)
            else:
                page.fail(name, 'not rendered')
            for leftover in os.listdir(work):
                os.remove(os.path.join(work, leftover))
    os.makedirs(os.path.join(build, 'tests'), exist_ok=True)
    page.write(os.path.join(build, 'tests', 'report.html'))
    tap.note('report: %s' % os.path.join(build, 'tests', 'report.html'))
    tap.done()


if __name__ == '__main__':
    main()
