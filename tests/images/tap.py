# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""The Test Anything Protocol, https://testanything.org."""
import sys

_count = _failed = 0


def ok(good, name, *details):
    """One test; details are shown as comments where it failed. Gives good back."""
    global _count, _failed
    _count += 1
    _failed += not good
    print('%sok %d - %s' % ('' if good else 'not ', _count, name))
    if not good:
        note(*details)
    sys.stdout.flush()
    return good


def skip(name, reason):
    global _count
    _count += 1
    print('ok %d - %s # SKIP %s' % (_count, name, reason))


def note(*lines):
    for text in lines:
        for line in str(text).splitlines():
            print('# ' + line)
    sys.stdout.flush()


def done():
    """The plan; leaves the program with the status make check expects."""
    print('1..%d' % _count)
    sys.exit(1 if _failed else 0)
