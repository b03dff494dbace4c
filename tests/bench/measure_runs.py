# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Timing programs: interleaved runs, so that a busy moment falls on all alike, and medians."""
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time


def run(command, cwd=None):
    """Seconds from start to end, and what the program printed."""
    start = time.perf_counter()
    done = subprocess.run(command, cwd=cwd, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)
    seconds = time.perf_counter() - start
    text = done.stdout.decode('utf-8', 'replace')
    if done.returncode != 0:
        sys.exit('%s: exit status %d\n%s' % (' '.join(command), done.returncode, text[-2000:]))
    return seconds, text


def timed(command, cwd=None):
    """Seconds from start to end, and those that processors were busy."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds, _ = run(command, cwd)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def peaked(command, cwd=None):
    """Seconds from start to end, the most memory in bytes, and what the program printed."""
    with tempfile.TemporaryFile() as out:
        start = time.perf_counter()
        child = subprocess.Popen(command, cwd=cwd, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(child.pid, 0)
        seconds = time.perf_counter() - start
        child.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        text = out.read().decode('utf-8', 'replace')
    if child.returncode:
        sys.exit('%s: exit status %d\n%s' % (' '.join(command), child.returncode, text[-2000:]))
    return seconds, 1024 * usage.ru_maxrss, text


def alidade(arguments, folder):
    """One run that counts; gives its report."""
    report = os.path.join(folder, 'stats.json')
    run([os.environ['ALIDADE'], '-q', '--stats=' + report] + arguments)
    with open(report, encoding='utf-8') as file:
        return json.load(file)


def median(values):
    return statistics.median(values)


def table(rows):
    """Columns as wide as they need; the first is text, the others are numbers."""
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    for row in rows:
        print('  '.join([row[0].ljust(widths[0])] + [c.rjust(w) for c, w in zip(row[1:], widths[1:])]))
