#!/usr/bin/env python3
"""Seconds of gravity: motes, REBOUND's tree and pytreegrav, on the same bodies, at equal force error, on the same cores.

    python3 benches/peers.py --motes target/release/motes --json peers.json

makes a virtual environment in a temporary folder, installs rebound and pytreegrav into it, and measures there; with
--here, what the running Python has installed. What is timed, and what is not, is in benches/README.md.
"""

import argparse
import ctypes
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    import numpy as np
except ImportError:
    np = None  # the environment that this script makes has it

import elsewhere

SOFTENING = 0.02
# The spline of this support has the same depth at its centre as Plummer's of SOFTENING: pytreegrav has no other.
SUPPORT = 2.8 * SOFTENING
TARGETS = 1000
# Errors within a twentieth of each other are called equal; theta has so many trials to get there.
CLOSE = 0.05
TRIALS = 6
SCENE = """
[simulation]
integrator = "{integrator}"
dt = {dt}
steps = {steps}
[[particles]]
file = "bodies.npz"
[[force]]
kind = "gravity"
softening = {softening}
over = "tree"
theta = {theta}
multipoles = "{multipoles}"
[output]
every = {steps}
formats = [{formats}]
"""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--motes", default="target/release/motes", help="the program [%(default)s]")
    parser.add_argument("--bodies", type=int, nargs="+", default=[100_000, 1_000_000], help="sizes [%(default)s]")
    parser.add_argument("--theta", type=float, default=0.7, help="of motes [%(default)s]")
    parser.add_argument("--multipoles", choices=["quadrupole", "monopole"], default="quadrupole", help="of motes")
    parser.add_argument("--repeat", type=int, default=5, help="turns; medians count [%(default)s]")
    parser.add_argument("--steps", type=int, default=3, help="steps of motes in a turn; peers do one [%(default)s]")
    parser.add_argument("--json", metavar="FILE", help="write the result here, too")
    parser.add_argument("--here", action="store_true", help="use the packages that this Python has installed")
    return parser.parse_args()


def plummer(count):
    """A Plummer sphere of mass 1, cut at 0.999 of it, of the scale that motes takes; at rest, in single precision."""
    random = np.random.default_rng(1)
    radius = 3 * np.pi / 16 / np.sqrt((0.999 * random.random(count)) ** (-2 / 3) - 1)
    direction = random.normal(size=(count, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    mass = np.full(count, 1 / count, dtype=np.float32)
    return (radius[:, None] * direction).astype(np.float32).astype(np.float64), mass.astype(np.float64)


def direct(position, mass, targets):
    """Direct sums in f64, Plummer softening."""
    sums = np.empty((len(targets), 3))
    for row, target in enumerate(targets):
        r = position - position[target]
        square = np.einsum("ij,ij->i", r, r) + SOFTENING**2
        sums[row] = (mass / (square * np.sqrt(square))) @ r
    return sums


def errors(found, exact):
    """Of |a - a_direct| / |a_direct|: median, 99th percentile, maximum."""
    relative = np.linalg.norm(found - exact, axis=1) / np.linalg.norm(exact, axis=1)
    return dict(zip(["median", "p99", "max"], np.percentile(relative, [50, 99, 100]).tolist()))


class Motes:
    name = "motes"

    def __init__(self, args, position, mass, folder):
        self.args, self.folder = args, folder
        columns = {axis: position[:, n].astype(np.float32) for n, axis in enumerate("xyz")}
        np.savez(folder / "bodies.npz", mass=mass.astype(np.float32), **columns)

    def run(self, integrator, dt, steps, formats):
        """Runs a scene; gives the seconds that its steps took."""
        args = self.args
        text = SCENE.format(integrator=integrator, dt=dt, steps=steps, formats=formats, softening=SOFTENING,
                            theta=args.theta, multipoles=args.multipoles)
        (self.folder / "scene.toml").write_text(text)
        command = [args.motes, "run", self.folder / "scene.toml", "-o", self.folder / "out", "--json"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"motes ended with {done.returncode}: {done.stdout[-500:]}{done.stderr[-500:]}")
        events = [json.loads(line) for line in done.stdout.splitlines()]
        self.device = next(event["device"] for event in events if event["event"] == "start")
        return next(event["stepping_seconds"] for event in events if event["event"] == "finish")

    def forces(self):
        """From rest, after one step of 1 by Euler's method, velocities are the accelerations, bit for bit."""
        self.run("forward_euler", 1.0, 1, '"npz"')
        last = np.load(max((self.folder / "out").rglob("*.npz"), key=lambda path: path.stem))
        if last["step"] != 1:
            raise SystemExit(f"motes wrote step {last['step']} last, not 1")
        return np.stack([last[axis].astype(np.float64) for axis in ("vx", "vy", "vz")], axis=1)

    def seconds(self):
        """A whole step of leapfrog. A run of one step is taken off: start-up, and the forces before the first."""
        steps = self.args.steps
        return (self.run("leapfrog", 1e-3, 1 + steps, "") - self.run("leapfrog", 1e-3, 1, "")) / steps


class Rebound:
    name = "REBOUND, monopole"

    def __init__(self, position, mass):
        import rebound

        self.rebound = rebound
        sim = self.sim = rebound.Simulation()
        sim.integrator, sim.gravity, sim.dt, sim.softening = "leapfrog", "tree", 1e-3, SOFTENING
        sim.root_size = 2.1 * np.abs(position).max()
        for (x, y, z), m in zip(position, mass):
            sim.add(m=m, x=x, y=y, z=z)

    def set(self, theta):
        self.sim.opening_angle2 = theta**2

    def forces(self, targets):
        self.rebound.clibrebound.reb_simulation_update_acceleration(ctypes.byref(self.sim))
        bodies = [self.sim.particles[int(target)] for target in targets]
        return np.array([[body.ax, body.ay, body.az] for body in bodies])

    def seconds(self):
        """A whole step of leapfrog."""
        start = time.perf_counter()
        self.sim.steps(1)
        return time.perf_counter() - start

    def about(self):
        library = Path(self.rebound.clibrebound._name).read_bytes()
        threads = os.cpu_count() if b"GOMP_parallel" in library else 1
        return {"version": self.rebound.__version__, "threads": threads, "timed": "whole leapfrog step"}


class Pytreegrav:
    def __init__(self, position, mass, quadrupole):
        self.position, self.mass, self.quadrupole = position, mass, quadrupole
        self.name = f"pytreegrav, {'quadrupole' if quadrupole else 'monopole'}"
        self.support = np.full(len(mass), SUPPORT)

    def set(self, theta):
        self.theta = theta

    def accelerations(self):
        import pytreegrav

        return pytreegrav.Accel(self.position, self.mass, self.support, theta=self.theta, parallel=True, method="tree",
                                quadrupole=self.quadrupole)

    def forces(self, targets):
        return self.accelerations()[targets]

    def seconds(self):
        """One evaluation with the build of its tree; it has no steps."""
        start = time.perf_counter()
        self.accelerations()
        return time.perf_counter() - start

    def about(self):
        import importlib.metadata

        import numba

        version = importlib.metadata.version("pytreegrav")
        return {"version": version, "threads": numba.get_num_threads(), "timed": "one evaluation of forces"}


def spline_direct(position, mass, targets):
    """Direct sums in f64, with the softening that pytreegrav has."""
    import pytreegrav

    support = np.full(len(mass), SUPPORT)
    return pytreegrav.AccelTarget(position[targets], position, mass, softening_target=support[targets],
                                  softening_source=support, method="bruteforce", parallel=True)


def matched(peer, targets, exact, wanted, theta):
    """Sets the opening angle at which the 99th percentile of the error is that of motes; the first trial is `theta`."""
    tried = []
    for _ in range(TRIALS):
        peer.set(theta)
        error = errors(peer.forces(targets), exact)
        print(f"  {peer.name}: theta {theta:.3f}, 99 % {error['p99']:.2e} (wanted {wanted:.2e})", file=sys.stderr)
        tried.append((abs(np.log(error["p99"] / wanted)), theta, error))
        if tried[-1][0] < CLOSE:
            break
        theta = following(tried, wanted)
    _, theta, error = min(tried, key=lambda trial: trial[0])
    peer.set(theta)
    return theta, error


def following(tried, wanted):
    """The next angle to try, as if the error were a power of it: of the last two trials, or the third."""
    _, theta, error = tried[-1]
    power = 3.0
    if len(tried) > 1:
        _, before, its = tried[-2]
        power = np.log(error["p99"] / its["p99"]) / np.log(theta / before)
    factor = (wanted / error["p99"]) ** (1 / np.clip(power, 1.5, 6.0))
    return float(np.clip(theta * factor, 0.05, 2.0))


def measured(args, count, folder, last):
    """All programs on so many bodies; angles are sought from where those of the last size were found."""
    position, mass = plummer(count)
    targets = np.arange(0, count, max(1, count // TARGETS))[:TARGETS]
    exact = direct(position, mass, targets)
    motes = Motes(args, position, mass, folder)
    error = errors(motes.forces()[targets], exact)
    print(f"{count} bodies on {motes.device}: 99 % of motes {error['p99']:.2e}", file=sys.stderr)
    own = {"theta": args.theta, "multipoles": args.multipoles, "error": error}
    row = {"bodies": count, "device": motes.device, "motes": own}
    splined = spline_direct(position, mass, targets)
    peers = [(Rebound(position, mass), exact)]
    peers += [(Pytreegrav(position, mass, quadrupole), splined) for quadrupole in (False, True)]
    row["peers"] = []
    for peer, reference in peers:
        start = next((one["theta"] for one in last["peers"] if one["name"] == peer.name), 0.5) if last else 0.5
        theta, its = matched(peer, targets, reference, error["p99"], start)
        row["peers"].append({"name": peer.name, "theta": theta, "error": its, **peer.about()})
    take_turns(args, motes, [peer for peer, _ in peers], row)
    return row


def take_turns(args, motes, peers, row):
    """Each in turn with all others, so that what else the machine does falls on each."""
    turns = [[one.seconds() for one in [motes, *peers]] for _ in range(args.repeat)]
    row["motes"]["seconds"] = [turn[0] for turn in turns]
    for n, peer in enumerate(row["peers"], start=1):
        peer["seconds"] = [turn[n] for turn in turns]
        peer["ratio"] = statistics.median(turn[n] / turn[0] for turn in turns)
        # What would be left of it, if one thread were all cores.
        peer["ratio_if_all_cores"] = peer["ratio"] * peer["threads"] / os.cpu_count()


def table(rows):
    print(f"{'bodies':>9}  {'':>24}  {'theta':>6}  {'median':>8}  {'99 %':>8}  {'max':>8}  {'seconds':>9}  {'ratio':>7}"
          f"  {'threads':>7}  timed")
    for row in rows:
        motes = {**row["motes"], "name": f"motes, {row['motes']['multipoles']}", "ratio": 1.0, "threads": os.cpu_count(),
                 "timed": "whole leapfrog step"}
        for one in [motes, *row["peers"]]:
            error = "  ".join(f"{one['error'][key]:>8.1e}" for key in ("median", "p99", "max"))
            print(f"{row['bodies']:>9}  {one['name']:>24}  {one['theta']:>6.3f}  {error}"
                  f"  {statistics.median(one['seconds']):>9.3f}  {one['ratio']:>7.2f}  {one['threads']:>7}  {one['timed']}")


def main():
    args = arguments()
    if not args.here:
        return elsewhere.rerun(["rebound", "pytreegrav"])
    rows = []
    for count in args.bodies:
        with tempfile.TemporaryDirectory() as folder:
            rows.append(measured(args, count, Path(folder), rows[-1] if rows else None))
    table(rows)
    if args.json:
        result = {"cores": os.cpu_count(), "softening": SOFTENING, "support": SUPPORT, "repeat": args.repeat, "sizes": rows}
        Path(args.json).write_text(json.dumps(result, indent=2) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
