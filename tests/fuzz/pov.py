#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Damage scene files and read them: no crash, no hang, and an error wherever it fails.

Usage: pov.py ALIDADE KEYWORDS.DEF SEED ROUNDS SCENE...

ALIDADE should be built with ./configure --enable-sanitizers. Files that were read badly are kept in the
current folder as fuzz-SEED-ROUND.pov.
"""
import os
import random
import re
import subprocess
import sys

SIGNS = ['{', '}', '(', ')', '<', '>', '[', ']', ',', ';', '"', '#', '#end', '#if(1)', '#while(0)',
         '#macro M(A)', 'M(', '#declare A=', '#local B=', 'array[2]{', '1e308', '-1', '0', '2147483648',
         '1/0', 'A', 'B', 'A[0]', '#else', '#break', '#switch(1)', '#case(1)', '/*', '*/', '//', '\n',
         '.x', '.red', '?', ':', '&', '|', '=', '!', 'concat(', 'str(', 'vstr(3,', 'substr("abc",',
         '#undef A', '#include "colors.inc"', '#for(I,0,3)', '#default{', '#version 3.6;', 'matrix<']


def damage(rng, data, words):
    """One random change."""
    at = rng.randrange(len(data) + 1)
    kind = rng.random()
    if kind < 0.3:
        return data[:at] + rng.choice(SIGNS).encode() + data[at:]
    if kind < 0.4:
        return data[:at] + rng.choice(words).encode() + b' ' + data[at:]
    if kind < 0.6:
        return data[:at] + data[at + rng.randrange(40):]
    if kind < 0.75:
        to = rng.randrange(len(data) + 1)
        return data[:to] + data[at:at + rng.randrange(300)] + data[to:]
    if kind < 0.85:
        return data[:at] + b' '
    return data[:at] + bytes([rng.randrange(256)]) + data[at + 1:]


def main():
    program, keywords, seed, rounds = sys.argv[1], sys.argv[2], sys.argv[3], int(sys.argv[4])
    with open(keywords, encoding='ascii') as f:
        words = re.findall(r'"([a-z0-9_]+)"', f.read())
    rng = random.Random(seed)
    top = os.path.dirname(os.path.dirname(os.path.abspath(program)))
    os.environ.setdefault('ALIDADE_ACCEL_PATH', os.path.join(top, 'plugins', '.libs'))
    bad = 0
    for i in range(rounds):
        scene = rng.choice(sys.argv[5:])
        with open(scene, 'rb') as f:
            data = f.read()
        if len(data) > 60000:
            at = rng.randrange(len(data) - 60000)
            data = data[at:at + 60000]
        for _ in range(rng.choice([1, 1, 2, 4, 10, 40])):
            data = damage(rng, data, words) or b' '
        name = 'fuzz-%s-%d.pov' % (seed, i)
        with open(name, 'wb') as f:
            f.write(data)
        lenient = ['--lenient'] if rng.random() < 0.7 else []
        command = [program, '--dry-run', '-q', '-L', os.path.dirname(scene) or '.', '--limit',
                   'tokens=2e6', '--limit', 'loop_steps=2e4', *lenient, name]
        try:
            r = subprocess.run(command, capture_output=True, timeout=60, check=False)
            fine = r.returncode in (0, 3) and (r.returncode == 0 or b'error: ' in r.stderr) and not \
                re.search(rb'Sanitizer|runtime error', r.stderr)
        except subprocess.TimeoutExpired:
            fine = False
        if fine:
            os.remove(name)
        else:
            bad += 1
            print('kept', name, 'from', scene)
    print('%d of %d read badly' % (bad, rounds))
    return bad > 0


if __name__ == '__main__':
    sys.exit(main())
