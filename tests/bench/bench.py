#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Alidade authors
# SPDX-License-Identifier: Apache-2.0
"""Figures of speed, behind ./dev bench. Times are printed, never tested.

lecture   what none, sphere, box and octrees of depth 0 to 5 with one triangle a leaf cast, test and hit:
          camera rays only, one mesh of 3,072 triangles in world coordinates
povray    the landscape of 250,000 triangles at 800x600, by POV-Ray and by alidade, end to end, with the
          same number of threads; the two take turns, and the medians of their times are compared
"""
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import time

SOURCE = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
BUILD = os.environ.get("ALIDADE_BUILD", os.path.join(SOURCE, "build"))
WORK = os.path.join(BUILD, "bench")
ALIDADE = os.path.join(BUILD, "src", "alidade")
LECTURE_TRIANGLES = 3072


def run_alidade(*arguments):
    """Seconds in all, and those of each phase; nothing is counted."""
    start = time.monotonic()
    done = subprocess.run([ALIDADE, "-o", os.path.join(WORK, "alidade.png"), "--progress=json", *arguments],
                          check=True, stdout=subprocess.PIPE, text=True)
    seconds = time.monotonic() - start
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    return seconds, {line["phase"]: line["elapsed"] for line in lines if line["kind"] == "end"}


def count_alidade(*arguments):
    """The figures of --stats."""
    stats = os.path.join(WORK, "stats.json")
    subprocess.run([ALIDADE, "-q", "-o", os.path.join(WORK, "alidade.png"), "--stats=" + stats, *arguments],
                   check=True)
    with open(stats, encoding="utf-8") as file:
        return json.load(file)


def lecture():
    scene = os.path.join(SOURCE, "scenes", "lecture", "lecture.pov")
    rows = ["none", "sphere", "box"] + [f"octree:depth={d},leaf=1,price=0" for d in range(6)]
    print(f"{'accelerator':<30} {'rays':>9} {'tests':>12} {'hits':>8} {'volume hits':>12} {'misses':>12}"
          f" {'real %':>7} {'build s':>8} {'trace s':>8}")
    first = None
    for accel in rows:
        arguments = ["-s", "512x512", "-a", accel, "--camera-only", scene]
        s = count_alidade(*arguments)
        phases = run_alidade(*arguments)[1]
        rays, tests = s["rays"]["camera"], s["tests"]
        real = tests["volume_hits_useful_percent"]
        print(f"{accel:<30} {rays['cast']:>9} {tests['intersection_tests']:>12} {rays['hit']:>8}"
              f" {tests['volume_hits']:>12} {tests['volume_misses']:>12}"
              f" {'-' if real is None else format(real, '.1f'):>7}"
              f" {phases['building']:>8.4f} {phases['rendering']:>8.3f}")
        if accel == "none":
            first = rays
            if tests["intersection_tests"] != rays["cast"] * LECTURE_TRIANGLES:
                sys.exit(f"bench: none should make rays x {LECTURE_TRIANGLES} tests")
        if rays != first:
            sys.exit(f"bench: {accel} hits other rays than none")
    share = 100 * first["hit"] / first["cast"]
    print(f"{share:.2f} % of the rays hit; none makes exactly rays x {LECTURE_TRIANGLES} tests")


def run_povray(scene, threads):
    """Seconds, and those that POV-Ray says it parsed, bounded and traced."""
    start = time.monotonic()
    done = subprocess.run(["povray", "+I" + scene, "+O" + os.path.join(WORK, "povray.png"), "+FN", "+W800",
                           "+H600", f"+WT{threads}", "-A", "-D"], stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True, check=False)
    seconds = time.monotonic() - start
    if done.returncode:
        sys.exit("bench: povray failed:\n" + done.stderr[-2000:])
    return seconds, {name.lower(): float(value) for name, value in
                     re.findall(r"(Parse|Bounding|Trace) Time:.*?\(([0-9.]+) seconds\)", done.stderr)}


def landscape():
    scene = os.path.join(SOURCE, "scenes", "landscape", "landscape.pov")
    if not os.path.exists(scene):
        scene = os.path.join(WORK, "landscape", "landscape.pov")
    if not os.path.exists(scene):
        os.makedirs(os.path.join(WORK, "landscape"), exist_ok=True)
        subprocess.run(["sh", os.path.join(SOURCE, "scenes", "export.sh"), "--into", WORK, "landscape"],
                       check=True)
    return scene


def povray(rounds=5):
    if not shutil.which("povray"):
        sys.exit("bench: povray is not installed; ./dev deps installs it")
    scene = landscape()
    threads = len(os.sched_getaffinity(0))
    ours, theirs = [], []
    for turn in range(rounds):
        theirs.append(run_povray(scene, threads))
        ours.append(run_alidade("-s", "800x600", "-t", str(threads), scene))
        print(f"round {turn + 1}: POV-Ray {theirs[-1][0]:.2f} s, alidade {ours[-1][0]:.2f} s", flush=True)

    def median(values):
        return statistics.median(list(values))

    print(f"\n{scene}, 800x600, {threads} threads, medians of {rounds} in seconds")
    print(f"{'':<10} {'read':>8} {'build':>8} {'trace':>8} {'all':>8}")
    print(f"{'POV-Ray':<10} {median(t['parse'] for _, t in theirs):>8.3f}"
          f" {median(t['bounding'] for _, t in theirs):>8.3f} {median(t['trace'] for _, t in theirs):>8.3f}"
          f" {median(s for s, _ in theirs):>8.3f}")
    print(f"{'alidade':<10} {median(p['reading'] for _, p in ours):>8.3f}"
          f" {median(p['building'] for _, p in ours):>8.3f}"
          f" {median(p['rendering'] for _, p in ours):>8.3f} {median(s for s, _ in ours):>8.3f}")
    ratio = median(s for s, _ in ours) / median(s for s, _ in theirs)
    print(f"alidade takes {ratio:.2f} of POV-Ray's time")


def main():
    os.makedirs(WORK, exist_ok=True)
    os.environ.setdefault("ALIDADE_ACCEL_PATH", os.path.join(BUILD, "plugins", ".libs"))
    jobs = {"lecture": lecture, "povray": povray}
    for name in sys.argv[1:] or jobs:
        if name not in jobs:
            sys.exit(__doc__)
        jobs[name]()


if __name__ == "__main__":
    main()
