# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers as text, in bulk.

Writing a million triangles is writing some five million numbers, so this is where an export spends its time. A call
of Python a number is too slow; here a whole array becomes a matrix of bytes, a row a number, with zero bytes where a
short number has nothing, and one call removes those. What stands in the file is exact: a 32-bit float is written with
the fewest digits (once in ten thousand one more) that read back as the same float.

Needs numpy and nothing of Blender.
"""
import numpy as np

CHUNK = 1 << 16
WIDTH = 18

# The digits of 0 to 999, three bytes each.
_THREE = np.array([list(b'%03d' % i) for i in range(1000)], np.uint8)
_TEN = 10.0 ** np.arange(0, 23)


def _scale(values, power):
    """values * 10**power, rounded once where |power| is at most 22: those powers of ten are exact."""
    if np.all((power >= -22) & (power <= 22)):
        return np.where(power >= 0, values * _TEN[np.maximum(power, 0)], values / _TEN[np.maximum(-power, 0)])
    return values * 10.0 ** power.astype(np.float64)


def decimal(values):
    """Sign, nine digits as an integer, exponent of the first, and how many digits are needed."""
    exact = np.ascontiguousarray(values, np.float32).ravel()
    wide = np.abs(exact.astype(np.float64))
    zero = wide == 0
    exponent = np.floor(np.log10(np.where(zero, 1.0, wide))).astype(np.int64)
    nine = np.rint(_scale(wide, 8 - exponent)).astype(np.int64)
    over = nine >= 10 ** 9
    if over.any():
        exponent[over] += 1
        nine[over] = np.rint(_scale(wide[over], 8 - exponent[over])).astype(np.int64)
    under = (nine < 10 ** 8) & ~zero
    if under.any():
        exponent[under] -= 1
        nine[under] = np.rint(_scale(wide[under], 8 - exponent[under])).astype(np.int64)
    want = np.abs(exact)
    need = np.full(wide.shape, 9, np.int8)
    mantissa = nine
    left = None                     # None: all
    for digits in (8, 7, 6):
        step = 10 ** (9 - digits)
        part = nine if left is None else nine[left]
        powers = exponent if left is None else exponent[left]
        short = (part + step // 2) // step
        good = _scale(short.astype(np.float64), powers - (digits - 1)).astype(np.float32) == (
            want if left is None else want[left])
        if left is None:
            left = np.flatnonzero(good)
        else:
            left = left[good]
        if not left.size:
            break
        if mantissa is nine:
            mantissa = nine.copy()
        mantissa[left] = short[good] * step
        need[left] = digits
    over = mantissa >= 10 ** 9      # 9.999996 in six digits is 10.0000
    if over.any():
        mantissa[over] //= 10
        exponent[over] += 1
    return np.signbit(exact) & ~zero, mantissa, exponent, need


def tokens(values):
    """A row of WIDTH bytes for each number."""
    minus, mantissa, exponent, need = decimal(values)
    count = len(mantissa)
    digits = np.empty((count, 9), np.uint8)
    rest, last = np.divmod(mantissa, 1000)
    first, middle = np.divmod(rest, 1000)
    digits[:, 0:3] = _THREE[first]
    digits[:, 3:6] = _THREE[middle]
    digits[:, 6:9] = _THREE[last]
    # No zeros at the end: from the last digit on, as long as there was nothing but zeros.
    idle = np.ones(count, bool)
    trimmed = digits.copy()
    for i in range(8, 0, -1):
        idle &= digits[:, i] == 48
        trimmed[idle, i] = 0
    out = np.zeros((count, WIDTH), np.uint8)
    out[minus, 0] = 45
    for power in np.unique(exponent).tolist():
        rows = np.flatnonzero(exponent == power)
        if rows.size == count:
            rows = slice(None)
        if 0 <= power <= 8:
            out[rows, 1:2 + power] = digits[rows, :1 + power]
            if power < 8:
                out[rows, 2 + power] = np.where(trimmed[rows, 1 + power] != 0, 46, 0)
                out[rows, 3 + power:11] = trimmed[rows, 1 + power:]
        elif -6 <= power < 0:
            out[rows, 1:2 - power] = np.frombuffer(b'0.00000', np.uint8)[:1 - power]
            out[rows, 2 - power:11 - power] = trimmed[rows]
        else:
            out[rows, 1] = digits[rows, 0]
            out[rows, 2] = np.where(trimmed[rows, 1] != 0, 46, 0)
            out[rows, 3:11] = trimmed[rows, 1:]
            tail = np.frombuffer(b'e%d' % power, np.uint8)
            out[rows, 11:11 + len(tail)] = tail
    return out


def number(value):
    """One number: the shortest text of the nearest 32-bit float; whole numbers without a point."""
    value = float(value)
    if value != value:
        value = 0.0
    value = max(-1e30, min(1e30, value))
    return tokens([value]).tobytes().translate(None, b'\0').decode()


def vector(values):
    return '<%s>' % ','.join(number(v) for v in values)


def precise(values):
    """A vector of 64-bit numbers: POV-Ray warns where a camera's vectors are not perpendicular to ten digits."""
    return '<%s>' % ','.join('0' if abs(v) < 1e-15 else repr(float(v)) for v in values)


def sane(values):
    """The same array with what is no number or beyond all measure set to zero, and how many those were."""
    values = np.asarray(values, dtype=np.float32)
    bad = ~(np.abs(values) < 1e30)
    count = int(np.count_nonzero(bad))
    if count:
        values = np.where(bad, np.float32(0), values)
    return values, count


def _rows(parts):
    """Join columns (matrices of bytes, or bytes that all rows share) and drop the empty bytes."""
    count = next(len(p) for p in parts if not isinstance(p, bytes))
    width = sum(len(p) if isinstance(p, bytes) else p.shape[1] for p in parts)
    out = np.empty((count, width), np.uint8)
    at = 0
    for part in parts:
        if isinstance(part, bytes):
            out[:, at:at + len(part)] = np.frombuffer(part, np.uint8)
            at += len(part)
        else:
            out[:, at:at + part.shape[1]] = part
            at += part.shape[1]
    return out.tobytes().translate(None, b'\0')


def write_vectors(out, rows, decimals=None):
    """Rows of 2 or 3 floats as <a,b,c>, one a line, with commas between them. out takes bytes.

    decimals: round to so many first (unit normals do not need nine digits).
    """
    rows = np.asarray(rows, np.float32)
    for start in range(0, len(rows), CHUNK):
        part = rows[start:start + CHUNK]
        if decimals is not None:
            part = np.round(part.astype(np.float64), decimals).astype(np.float32)
        parts = [b'<']
        for column in range(part.shape[1]):
            parts += [tokens(part[:, column]), b',']
        parts[-1] = b'>,\n'
        _send(out, _rows(parts), start + CHUNK >= len(rows))


def _send(out, text, last):
    out.write(text[:-2] + b'\n' if last else text)


class Integers:
    """The texts of 0 to most, made once and looked up for every use."""

    def __init__(self, most):
        groups = (len(str(int(most))) + 2) // 3
        rest = np.arange(int(most) + 1)
        self.table = np.zeros((len(rest), 3 * groups), np.uint8)
        for group in range(groups - 1, -1, -1):
            rest, three = np.divmod(rest, 1000)
            self.table[:, 3 * group:3 * group + 3] = _THREE[three]
        idle = np.ones(len(self.table), bool)
        for column in range(3 * groups - 1):
            idle &= self.table[:, column] == 48
            self.table[idle, column] = 0
        # One number as one item, which numpy gathers much faster than rows of bytes.
        self.items = self.table.view('V%d' % (3 * groups)).ravel()

    def take(self, indices):
        return self.items[indices].view(np.uint8).reshape(len(indices), -1)

    def write(self, out, rows, behind=None):
        """Rows of three numbers as <a,b,c>; behind: further numbers a row, which follow without brackets."""
        for start in range(0, len(rows), CHUNK):
            part = rows[start:start + CHUNK]
            parts = [b'<', self.take(part[:, 0]), b',', self.take(part[:, 1]), b',', self.take(part[:, 2]), b'>']
            if behind is not None:
                more = behind[start:start + CHUNK]
                for column in range(more.shape[1]):
                    parts += [b',', self.take(more[:, column])]
            parts.append(b',\n')
            _send(out, _rows(parts), start + CHUNK >= len(rows))


def name(prefix, text):
    """An SDL identifier from any name; different names give different identifiers."""
    return prefix + ''.join(c if c.isascii() and c.isalnum() else '_%x_' % ord(c) for c in text)


def quoted(text):
    """A file name as an SDL string."""
    return '"' + text.replace('\\', '/').replace('"', '\\"') + '"'


def comment(text):
    """Any name inside a // comment."""
    return ''.join(c if c.isprintable() else '?' for c in text)
