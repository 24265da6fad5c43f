#!/usr/bin/env python3
"""The beginning of `dam_break` in motes and in salva, in turns: seconds of a step, and how well the density is kept.

Usage: python3 benches/salva/compare.py [TURNS]

Build both first: `cargo build --release` here and in `benches/salva` (or say where they are in MOTES and SALVA). Wants numpy and
scipy. Each solves for pressure at the same steps, to the same mean error of the density, in one iteration
or more; motes also takes the scene's own steps, by an equation of state, to the same time. What is measured of the density is the same for both:
the sum of masses with the cubic spline of a reach of two spacings, over its sum on a lattice at rest, of those that are farther from
walls than that; its mean excess, and the front of the water.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

ROOT = Path(__file__).resolve().parents[2]
MOTES = os.environ.get("MOTES", str(ROOT / "target/release/motes"))
SALVA = os.environ.get("SALVA", str(ROOT / "benches/salva/target/release/salva-dam-break"))
SPACING, STEPS, DT = 0.04, 60, 0.0018
REACH = 2 * SPACING
# Steps of the scene's own to the same time.
WEAKLY = round(STEPS * DT / 0.0004)
FLUID = 15_000
TOLERANCES = [1e-2, 1e-3, 1e-4]


def bell(q):
    return np.where(q <= 0.5, 1 - 6 * q * q * (1 - q), np.where(q < 1, 2 * (1 - q) ** 3, 0))


def excess(x):
    """Mean excess of the density inside, as a part of that at rest."""
    line = np.arange(-2, 3) * SPACING
    lattice = np.stack(np.meshgrid(line, line, line), -1).reshape(-1, 3)
    rest = bell(np.linalg.norm(lattice, axis=1) / REACH).sum()
    low, high = np.array([0, 0, 0]) + REACH, np.array([4, 0.48, 6]) - REACH
    inside = np.flatnonzero(((x > low) & (x < high)).all(axis=1))
    tree = cKDTree(x)
    sums = [bell(np.linalg.norm(x[near] - x[i], axis=1) / REACH).sum() for i, near in zip(inside, tree.query_ball_point(x[inside], REACH))]
    return float(np.maximum(np.array(sums) / rest - 1, 0).mean())


def table(file, rows=None):
    names = file.open().readline().strip().split(",")
    columns = [names.index(name) for name in "xyz"]
    return np.loadtxt(file, delimiter=",", skiprows=1, usecols=columns, max_rows=rows)


def motes(folder, sets, steps):
    command = [MOTES, "run", "dam_break", "--json", "-o", str(folder), "--steps", str(steps)]
    for value in ["output.every=100000", *sets]:
        command += ["--set", value]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    return [json.loads(line) for line in lines]


def stepping(events):
    """Seconds that steps alone took."""
    return next(e["stepping_seconds"] for e in reversed(events) if "stepping_seconds" in e)


def main():
    turns = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        motes(folder / "start", [], 1)
        start = min((folder / "start").glob("snapshot_*.csv")).read_text().splitlines()
        (folder / "fluid.csv").write_text("\n".join(start[: FLUID + 1]) + "\n")
        (folder / "walls.csv").write_text("\n".join([start[0], *start[FLUID + 1 :]]) + "\n")
        solve = [f"simulation.dt={DT}", "simulation.integrator=symplectic_euler", "force.1.solver=dfsph", "force.1.min_iterations=1"]
        rows = {}
        for _ in range(turns):
            out = folder / "state"
            events = motes(out, [], WEAKLY)
            last = sorted(out.glob("snapshot_*.csv"))[-1]
            rows.setdefault(("motes, equation of state", None), []).append((stepping(events) / STEPS, table(last, FLUID)))
            for tolerance in TOLERANCES:
                out = folder / "motes"
                events = motes(out, [*solve, f"force.1.tolerance={tolerance}"], STEPS)
                last = sorted(out.glob("snapshot_*.csv"))[-1]
                rows.setdefault(("motes", tolerance), []).append((stepping(events) / STEPS, table(last, FLUID)))
                out = folder / "salva.csv"
                command = [SALVA, folder / "fluid.csv", folder / "walls.csv", SPACING, DT, STEPS, tolerance, out]
                done = json.loads(subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stdout)
                rows.setdefault(("salva", tolerance), []).append((done["seconds"] / done["steps_timed"], table(out)))
        result = []
        for (program, tolerance), runs in rows.items():
            seconds = [run[0] for run in runs]
            x = runs[-1][1]
            result.append({
                "program": program,
                "tolerance": tolerance,
                "seconds_per_step": seconds,
                "median": float(np.median(seconds)),
                "mean_excess": excess(x),
                "front": float(x[:, 0].max()),
            })
        for tolerance in TOLERANCES:
            pair = {p: np.array([run[0] for run in rows[(p, tolerance)]]) for p in ("motes", "salva")}
            result.append({"tolerance": tolerance, "salva_over_motes": float(np.median(pair["salva"] / pair["motes"]))})
        print(json.dumps({"particles": FLUID, "spacing": SPACING, "dt": DT, "steps": STEPS, "turns": turns, "rows": result}, indent=1))


if __name__ == "__main__":
    main()
