# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Small numbers in the sources, which may be lengths in a scene's units, against the list of those that are none.

A number is small if it is a literal between 0 and 0.05, or a power of two below 2^-9. Each line with one has to be on
the list (lengths.txt: file | part of the line | why it is no length), and each entry has to be of use.
"""
import os
import re
import sys

NUMBER = re.compile(r'(?<![\w.])(0x[0-9a-f]*\.?[0-9a-f]*p[-+]?\d+|\d+\.?\d*(?:e[-+]?\d+)?|\.\d+(?:e[-+]?\d+)?)', re.I)


def value(text):
    return float.fromhex(text) if text.lower().startswith('0x') else float(text)


def is_small(text):
    x = value(text)
    return 0 < x < (2.0 ** -9 if text.lower().startswith('0x') else 0.05)


def code_of(text):
    """Without comments and strings, lines kept."""
    def blank(m):
        return re.sub(r'[^\n]', ' ', m.group(0))
    return re.sub(r'/\*.*?\*/|"(?:\\.|[^"\\\n])*"', blank, text, flags=re.S)


def small_lines(path):
    with open(path, encoding='utf-8') as file:
        text = file.read()
    for number, (bare, line) in enumerate(zip(code_of(text).split('\n'), text.split('\n')), 1):
        if any(is_small(m.group(1)) for m in NUMBER.finditer(bare)):
            yield number, line.strip()


def sources(folders):
    for folder in folders:
        for where, _, names in sorted(os.walk(folder)):
            for name in sorted(names):
                if name.endswith(('.c', '.h', '.cc')):
                    yield os.path.join(where, name)


def read_list(path):
    with open(path, encoding='utf-8') as file:
        lines = [line.rstrip('\n') for line in file if line.strip() and not line.startswith('#')]
    entries = [tuple(part.strip() for part in line.split('|')) for line in lines]
    for entry in entries:
        if len(entry) != 3 or not all(entry):
            sys.exit('%s: not "file | part of the line | reason": %s' % (path, ' | '.join(entry)))
    return entries


def main():
    entries = read_list(sys.argv[1])
    used, bad = set(), False
    for path in sources(sys.argv[2:]):
        for number, line in small_lines(path):
            found = [e for e in entries if e[0] == path and (e[1] == '*' or e[1] in line)]
            used.update(found)
            if not found:
                print('%s:%d: may be a length in scene units: %s' % (path, number, line))
                bad = True
    for entry in entries:
        if entry not in used:
            print('lengths.txt: matches nothing: %s | %s' % entry[:2])
            bad = True
    sys.exit(bad)


main()
