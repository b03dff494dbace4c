# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Export from the command line:

    blender -b FILE.blend -P .../export.py -- OUT.pov [--frame N | --frames A..B[:STEP]] [--strict] [--no-radiosity]
        [--lamp-grid N] [--blur-samples N] [--relief N]

Writes OUT.pov, OUT.ini and, where it needs pictures, the folder OUT-pictures. What the scene language cannot say is
listed on standard error; with --strict it is an error and nothing is written. The exit status is 0 if the scene was
written, 1 if not, 2 for wrong options.
"""
import argparse
import os
import sys


def arguments(given):
    parser = argparse.ArgumentParser(prog='export.py', description='Write the scene of a .blend as a POV-Ray scene.',
                                     usage='blender -b FILE.blend -P export.py -- OUT.pov [options]')
    parser.add_argument('out', metavar='OUT.pov')
    parser.add_argument('--frame', type=int, help='this frame instead of the file\'s current one')
    parser.add_argument('--frames', metavar='A..B[:STEP]', help='numbered files, and OUT.pov which includes them')
    parser.add_argument('--strict', action='store_true', help='fail if the scene language cannot say something')
    parser.add_argument('--no-radiosity', action='store_true', help='no indirect light')
    parser.add_argument('--lamp-grid', type=int, default=9, metavar='N', help='points a side of a soft lamp (9)')
    parser.add_argument('--blur-samples', type=int, default=256, metavar='N', help='samples of a lens out of focus (256)')
    parser.add_argument('--relief', type=int, default=200000, metavar='N',
                        help='triangles that a mesh with a normal map may become (200000); 0: leave such maps out')
    parser.add_argument('--scene', metavar='NAME', help='this scene instead of the file\'s current one')
    found = parser.parse_args(given)
    if found.frames:
        span, _, step = found.frames.partition(':')
        first, dots, last = span.partition('..')
        try:
            found.frames = (int(first), int(last) if dots else int(first), int(step) if step else 1)
        except ValueError:
            parser.error('--frames needs A..B or A..B:STEP, not "%s"' % found.frames)
        if found.frames[1] < found.frames[0] or found.frames[2] < 1:
            parser.error('--frames %s names no frame' % span)
    if found.frame is not None and found.frames:
        parser.error('--frame and --frames exclude each other')
    return found


def report(losses, seen):
    for line in losses.lost_lines():
        if line not in seen:
            seen.add(line)
            print('export.py: warning: lost: %s' % line, file=sys.stderr)


def main(given):
    import bpy
    here = os.path.dirname(os.path.abspath(__file__))
    package = os.path.basename(here)
    if package not in sys.modules:
        sys.path.insert(0, os.path.dirname(here))
    import importlib
    engine = importlib.import_module(package + '.engine')
    try:
        engine.register()
    except ValueError:
        pass                            # the add-on is enabled as well
    found = arguments(given)
    scene = bpy.context.scene
    if found.scene:
        scene = bpy.data.scenes.get(found.scene)
        if scene is None:
            print('export.py: the file has no scene "%s"' % found.scene, file=sys.stderr)
            return 2
    options = engine.Options(strict=found.strict, radiosity='off' if found.no_radiosity else 'auto',
                             lamp_grid=max(found.lamp_grid, 1), blur_samples=max(found.blur_samples, 1),
                             relief=max(found.relief, 0))
    seen = set()
    try:
        if found.frames:
            first, last, step = found.frames
            for _, losses in engine.export_frames(scene, found.out, first, last, step, options):
                report(losses, seen)
        else:
            if found.frame is not None:
                scene.frame_set(found.frame)
            report(engine.export(scene, found.out, options), seen)
            engine.write_ini(scene, found.out)
    except engine.Lost as lost:
        for line in str(lost).splitlines():
            print('export.py: error: lost: %s' % line, file=sys.stderr)
        return 1
    except OSError as error:
        print('export.py: error: %s: %s' % (error.filename or found.out, error.strerror or error), file=sys.stderr)
        return 1
    print('export.py: wrote %s' % found.out)
    return 0


if __name__ == '__main__':
    try:
        status = main(sys.argv[sys.argv.index('--') + 1:] if '--' in sys.argv else [])
    except SystemExit as leave:
        status = leave.code if isinstance(leave.code, int) else 1
    except Exception:
        import traceback
        traceback.print_exc()
        status = 1
    sys.stdout.flush()
    sys.stderr.flush()
    # Blender itself ends with 0 whatever its scripts did.
    os._exit(status or 0)
