# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""The scenes that docs/exporter.md shows, as our own exporter writes them, drawn by both renderers: run by gallery.sh.

    gallery.py [NAME...]

Environment: ALIDADE, ALIDADE_SRC, ALIDADE_BUILD. The files stay in ALIDADE_BUILD/tests/gallery, the report is
ALIDADE_BUILD/tests/gallery.html. What is compared, and within what bounds, against.py says.
"""
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import traceback

import against
import breadth
import picture
import renderers
import report
import tap


def export(folder, names):
    """Both programs' scenes, by one run of Blender; gives the names."""
    source = os.environ['ALIDADE_SRC']
    script = os.path.join(source, 'tests', 'blender', 'gallery_export.py')
    done = subprocess.run(['blender', '-b', '--factory-startup', '-P', script, '--',
                           os.path.join(source, 'blender'), folder] + names, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=600, stdin=subprocess.DEVNULL, check=False)
    text = done.stdout.decode('utf-8', 'replace')
    found = re.findall(r'^exported (\w+)$', text, re.M)
    if not found or 'Traceback' in text:
        raise renderers.Failed('Blender did not export all:\n' + text[-1500:])
    return found


def attempt(number, name, folder):
    outcome = breadth.Outcome(number)
    outcome.name = name
    try:
        base = os.path.join(folder, name)
        against.compare(outcome, os.path.join(base, 'scene.pov'), base, os.path.join(base, 'hard.pov'))
    except (renderers.Failed, picture.Unreadable, OSError, subprocess.TimeoutExpired) as failure:
        outcome.problem = str(failure)
    except Exception:
        outcome.problem = traceback.format_exc()
    return outcome


def main():
    folder = os.path.join(os.environ['ALIDADE_BUILD'], 'tests', 'gallery')
    names = sys.argv[1:]
    for name in names or ['']:
        shutil.rmtree(os.path.join(folder, name), ignore_errors=True)
    os.makedirs(folder, exist_ok=True)
    try:
        names = export(folder, names)
    except renderers.Failed as failure:
        tap.ok(False, 'the gallery is exported', str(failure))
        tap.done()
        return
    page = report.Report()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        for outcome in pool.map(lambda each: attempt(*each, folder), enumerate(names, 1)):
            breadth.tell(outcome, page)
    page.write(folder + '.html')
    tap.note('report: %s.html' % folder, '%.0f s of processor time' % sum(os.times()[:4]))
    tap.done()


if __name__ == '__main__':
    main()
