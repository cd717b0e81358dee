#!/usr/bin/env python3
"""How a solve grows as its tolerance tightens, on one thread: vertices, CPU time, peak memory.

    growth.py ISOLUX PLOT.png SCENE.yaml:TOLERANCES [SCENE.yaml:TOLERANCES ...]

TOLERANCES are in per cent, parted by commas, the loosest first. Prints a line for each solve and,
between neighbouring ones, the exponents of time and memory in terms of vertices."""

import json
import subprocess
import sys
import tempfile
from math import log
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def solve(isolux, scene, tolerance):
    """Vertices, CPU seconds, peak memory in bytes."""
    with tempfile.TemporaryDirectory() as folder:
        stats = Path(folder) / "stats.json"
        command = [isolux, "solve", scene, "--tolerance", tolerance, "--threads", "1", "--quiet"]
        done = subprocess.run(
            [*command, "-o", Path(folder) / "solved.glb", "--stats", stats], check=False
        )
        if done.returncode not in (0, 3):
            sys.exit(f"{scene} at {tolerance} %: exit code {done.returncode}")
        told = json.loads(stats.read_text())
    return told["vertices"], told["cpu_seconds"], told["peak_bytes"]


def exponent(before, after, quantity):
    return log(after[quantity] / before[quantity]) / log(after[0] / before[0])


def run(isolux, scene, tolerances):
    rows = []
    for tolerance in tolerances:
        row = solve(isolux, scene, tolerance)
        vertices, seconds, memory = row
        line = f"{Path(scene).stem}  {tolerance} %  {vertices} vertices  {seconds:.2f} s"
        line += f"  {memory / 1e6:.0f} MB  {memory / vertices / 1e3:.1f} kB a vertex"
        if rows and vertices > rows[-1][0]:
            line += f"  exponents {exponent(rows[-1], row, 1):.2f} {exponent(rows[-1], row, 2):.2f}"
        print(line, flush=True)
        rows.append(row)
    return rows


def plot(curves, path):
    figure, panels = plt.subplots(1, 2, figsize=(9, 3.6))
    for axes, quantity, unit, label in (
        (panels[0], 1, 1, "CPU, s"),
        (panels[1], 2, 1e6, "peak memory, MB"),
    ):
        for name, rows in curves.items():
            vertices = [row[0] for row in rows]
            axes.loglog(vertices, [row[quantity] / unit for row in rows], "o-", ms=4, label=name)
        low, high = axes.get_ylim()
        left, right = axes.get_xlim()
        start = next(iter(curves.values()))[0]
        line = [start[quantity] / unit * (x / start[0]) for x in (left, right)]
        axes.loglog([left, right], line, ":", color="gray", label="linear")
        axes.set(xlabel="vertices", ylabel=label, ylim=(low, high), xlim=(left, right))
        axes.grid(True, which="both", lw=0.3)
    panels[0].legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main(isolux, path, *runs):
    curves = {}
    for spec in runs:
        scene, tolerances = spec.rsplit(":", 1)
        curves[Path(scene).stem] = run(isolux, scene, tolerances.split(","))
    plot(curves, path)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
