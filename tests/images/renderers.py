# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Running Alidade and POV-Ray."""
import os
import shutil
import subprocess

import enlarge
import picture

# POV-Ray 3.7 as the references are made: see scenes/references.sh.
POVRAY = ['+FE', '-D', '-P', '-UA', '+WT1', '-J']
POVRAY_AA = {None: ['-A'], 'pov2': ['+A0.03', '+AM2', '+R2', '+AG2.5'],
             'many': ['+A0.0', '+AM1', '+R4'], 'most': ['+A0.0', '+AM1', '+R8']}
ALIDADE_AA = {None: 'none', 'pov2': 'pov2:threshold=0.03,depth=2', 'many': 'pov1:threshold=0,depth=4',
              'most': 'pov1:threshold=0,depth=8'}


class Failed(Exception):
    pass


class TooLong(Failed):
    pass


NONFINITE = 6 # Alidade's exit status


def _run(command, cwd=None, limit=1800, good=(0,)):
    try:
        done = subprocess.run(command, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL, timeout=limit, check=False)
    except subprocess.TimeoutExpired:
        raise TooLong('%s took more than %d s' % (' '.join(command), limit)) from None
    text = done.stdout.decode('utf-8', 'replace')
    if done.returncode not in good:
        raise Failed('%s: exit status %d\n%s' % (' '.join(command), done.returncode, text[-1500:]))
    return text


def alidade(scene, out, size, accel='octree', threads=2, aa=None, crop=None, more=(), good=(0,)):
    """Render a scene to out (.pfm), by the program $ALIDADE names; good: exit statuses that are none too bad."""
    command = [os.environ['ALIDADE'], '-q', '-a', accel, '-t', str(threads), '-s', '%dx%d' % size,
               '--aa', ALIDADE_AA[aa], '-o', out]
    if crop:
        command.append('--crop=%d,%d,%d,%d' % crop)
    return _run(command + list(more) + [scene], good=good)


def povray(scene, out, size, aa=None, factor=1, limit=1800):
    """Render a scene to out (.exr) with POV-Ray, factor times enlarged; gives the picture.

    Debian's POV-Ray opens files in the current folder and the temporary one only.
    """
    folder = os.path.dirname(out)
    local = os.path.join(folder, 'povray-input.pov')
    if factor == 1:
        shutil.copyfile(scene, local)
    else:
        with open(scene, encoding='utf-8') as file:
            text = enlarge.enlarge(file.read(), factor)
        with open(local, 'w', encoding='utf-8') as file:
            file.write(text)
    _run(['povray', '+Ipovray-input.pov', '+O' + os.path.basename(out), '+W%d' % size[0],
          '+H%d' % size[1]] + POVRAY + POVRAY_AA[aa], cwd=folder, limit=limit)
    return picture.read(out)
