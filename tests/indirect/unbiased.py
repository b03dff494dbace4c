# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""--indirect=exact has no bias, and knows its noise: run by unbiased.sh.

The scene unbiased.pov is computed here once more by brute force: numpy, plain random numbers, none of the
program's code. 200 pictures of other seeds have to average to that, and their Error layers have to tell how
far each is from it: 68 % of all values within one standard error, 95 % within 1.96.
"""
import math
import os
import re
import subprocess
import sys

import numpy as np

WIDTH, HEIGHT, SEEDS, RAYS = 12, 9, 200, 60000
LAMP, LAMP_COLOUR = np.array((2.0, 4.0, -3.0)), 0.8
SKY = np.zeros(3)
# centre, radius (None: the plane y = 0), colour times diffuse, emission
THINGS = [(None, None, np.array((0.8, 0.7, 0.6)) * 0.9, np.zeros(3)),
          (np.array((-1.1, 1, 0.5)), 1.0, np.array((0.9, 0.4, 0.3)) * 0.8, np.zeros(3)),
          (np.array((1, 0.8, 0)), 0.8, np.array((0.1, 0.25, 0.3)) * 0.9, np.zeros(3)),
          (np.array((0, 0.6, -1)), 0.6, np.zeros(3), np.array((1.0, 0.8, 0.5))),
          (np.array((0.0, 2, 0)), 7.0, np.array((0.6, 0.65, 0.7)) * 0.9, np.zeros(3))]
failed = 0
number = 0


def ok(good, what, *notes):
    global failed, number
    number += 1
    failed += not good
    print('%sok %d - %s' % ('' if good else 'not ', number, what))
    for note in notes:
        print('# ' + note)
    sys.stdout.flush()


def nearest(org, direction):
    """Distance and thing that each ray meets; -1 for none."""
    best = np.full(len(org), np.inf)
    which = np.full(len(org), -1)
    for i, (centre, radius, _, _) in enumerate(THINGS):
        with np.errstate(divide='ignore', invalid='ignore'):
            if centre is None:
                t = -org[:, 1] / direction[:, 1]
                t = np.where(t > 1e-9, t, np.inf)
            else:
                oc = org - centre
                b = (oc * direction).sum(1)
                d = b * b - (oc * oc).sum(1) + radius * radius
                root = np.sqrt(np.maximum(d, 0))
                t = np.where(-b - root > 1e-9, -b - root, -b + root)
                t = np.where((d > 0) & (t > 1e-9), t, np.inf)
        closer = t < best
        best[closer] = t[closer]
        which[closer] = i
    return best, which


def direct(p, n):
    """What of the lamp arrives at each point."""
    to = LAMP - p
    far = np.sqrt((to * to).sum(1))
    to = to / far[:, None]
    cosine = np.maximum(0, (to * n).sum(1))
    t, _ = nearest(p + 1e-7 * n, to)
    return LAMP_COLOUR * cosine * (t > far)


def scatter(n, rng):
    """Cosine-weighted: the normal and a point of the unit sphere around its end."""
    v = rng.normal(size=n.shape)
    v /= np.sqrt((v * v).sum(1))[:, None]
    v += n
    return v / np.sqrt((v * v).sum(1))[:, None]


def light(org, direction, bounces, rng):
    """One path for each ray."""
    colour = np.zeros((len(org), 3))
    share = np.ones((len(org), 3))
    alive = np.arange(len(org))
    for bounce in range(bounces + 1):
        t, which = nearest(org, direction)
        gone = which < 0
        colour[alive[gone]] += share[alive[gone]] * SKY
        alive, org, direction, t, which = (a[~gone] for a in (alive, org, direction, t, which))
        if not len(alive):
            break
        p = org + t[:, None] * direction
        n = np.zeros_like(p)
        albedo = np.zeros_like(p)
        for i, (centre, radius, c, emission) in enumerate(THINGS):
            here = which == i
            n[here] = (0, 1, 0) if centre is None else (p[here] - centre) / radius
            inward = here & ((n * direction).sum(1) > 0)
            n[inward] *= -1
            albedo[here] = c
            colour[alive[here]] += share[alive[here]] * emission
        share[alive] *= albedo
        colour[alive] += share[alive] * direct(p, n)[:, None]
        org = p + 1e-7 * n
        direction = scatter(n, rng)
    return colour


def reference():
    """Mean and standard error of each pixel."""
    rng = np.random.default_rng(20260101)
    mean = np.zeros((HEIGHT, WIDTH, 3))
    error = np.zeros((HEIGHT, WIDTH, 3))
    for y in range(HEIGHT):
        for x in range(WIDTH):
            d = np.array(((x + 0.5) / WIDTH * 4 / 3 - 2 / 3, 0.5 - (y + 0.5) / HEIGHT, 1.0))
            d = np.tile(d / math.sqrt((d * d).sum()), (RAYS, 1))
            c = light(np.tile((0.0, 1.5, -5.0), (RAYS, 1)), d, 2, rng)
            mean[y, x] = c.mean(0)
            error[y, x] = c.std(0) / math.sqrt(RAYS)
    return mean, error


def render(scene, out, *options):
    subprocess.run([os.environ['ALIDADE'], '-q', '--progress=none', '-s', '%dx%d' % (WIDTH, HEIGHT), '-o', out,
                    *options, os.path.join(os.environ['ALIDADE_SRC'], 'tests', 'indirect', 'unbiased', scene)],
                   check=True)


def pfm(path):
    with open(path, 'rb') as file:
        data = file.read()
    head = re.match(rb'PF\s+(\d+)\s+(\d+)\s+-[\d.]+\s', data)
    w, h = int(head.group(1)), int(head.group(2))
    return np.frombuffer(data, '<f4', offset=head.end()).reshape(h, w, 3)[::-1].astype(float)


def layers(path):
    """Colour and Error of an .exr. Not by ImageBuf, which remembers files by name."""
    import OpenImageIO as oiio
    file = oiio.ImageInput.open(path)
    names = list(file.spec().channelnames)
    pixels = file.read_image(format=oiio.FLOAT).astype(float)
    file.close()
    return (pixels[..., [names.index(c) for c in 'RGB']],
            pixels[..., [names.index('Error.' + c) for c in 'RGB']])


def check_mean(seen, mean, error):
    ours = seen.mean(0)
    spread = np.sqrt(seen.var(0, ddof=1) / len(seen) + error ** 2)
    noisy = spread > 1e-6                       # the background has no noise at all
    ok(np.abs(ours - mean)[~noisy].max(initial=0) < 1e-5, 'pixels without noise are equal')
    z = (ours - mean)[noisy] / spread[noisy]
    within = (np.abs(z) < 1.96).mean()
    ok(within > 0.92, 'pixels: 95 % of the means are within their confidence interval',
       '%.1f %% of %d values, largest %.2f' % (100 * within, z.size, np.abs(z).max()))
    total = (ours - mean)[noisy].sum() / math.sqrt((spread[noisy] ** 2).sum())
    # Channels share their rays, so three as one have up to sqrt(3) times the spread.
    ok(abs(total) < 2.58 * math.sqrt(3), 'the whole picture too', '%.2f standard errors, %.6f of %.4f' % (
        total, (ours - mean)[noisy].mean(), mean[noisy].mean()))


def check_error(seen, told):
    truth = seen.mean(0)
    noisy = told.mean(0) > 1e-6
    z = np.abs(seen - truth)[:, noisy] / np.maximum(told[:, noisy], 1e-12)
    z *= math.sqrt(len(seen) / (len(seen) - 1))     # the truth is their own mean
    for k, want in ((1, 68.27), (1.96, 95)):
        got = 100 * (z <= k).mean()
        ok(abs(got - want) <= 3, '%.1f %% are within %.2f standard errors' % (want, k), '%.2f %%' % got)


def main():
    work = sys.argv[1]
    out = os.path.join(work, 'a.exr')
    mean, error = reference()
    runs = [('64', 'few rays')]
    if os.environ.get('ALIDADE_ALL', '') not in ('', '0'):
        runs.append(('512', 'as many as by default'))
    for samples, name in runs:
        seen, told = [], []
        for seed in range(SEEDS):
            render('unbiased.pov', out, '--error-layer', '--indirect-samples', samples, '--seed', str(seed))
            colour, e = layers(out)
            seen.append(colour)
            told.append(e)
        print('# ' + name)
        check_mean(np.array(seen), mean, error)
        check_error(np.array(seen), np.array(told))
    seen = []
    for seed in range(SEEDS):
        render('unbiased.pov', os.path.join(work, 'a.pfm'), '--indirect-samples', '16', '--seed', str(seed))
        seen.append(pfm(os.path.join(work, 'a.pfm')))
    print('# without an error layer')
    check_mean(np.array(seen), mean, error)
    render('furnace.pov', os.path.join(work, 'a.pfm'))
    off = np.abs(pfm(os.path.join(work, 'a.pfm')) / 0.476672 - 1).max()
    ok(off < 0.005, 'a furnace is as bright everywhere as it has to be', 'off by at most %.2g' % off)
    print('1..%d' % number)
    return failed != 0


sys.exit(main())
