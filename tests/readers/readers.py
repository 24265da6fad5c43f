"""Reads what motes has written with the programs of the field, and compares it with arrays.npz bit for bit.

usage: readers.py PROGRAM FOLDER
Ends with 0 where all is the same, 1 where something differs, 3 where the program is not installed.
"""

import pathlib
import sys

program, folder = sys.argv[1], pathlib.Path(sys.argv[2])

try:
    import numpy
    truth = {name: values for name, values in numpy.load(folder / "arrays.npz").items()}
    if program == "h5py":
        import h5py
    elif program == "yt":
        import yt
        yt.set_log_level("error")
    elif program == "pynbody":
        import pynbody
    elif program == "ase":
        import ase.io
    elif program == "vtk":
        import vtk
        from vtk.util.numpy_support import vtk_to_numpy
    elif program == "plyfile":
        import plyfile
    elif program != "numpy":
        raise ImportError(program)
except ImportError as why:
    print(why)
    sys.exit(3)

IDS = truth["id"]
POSITION = numpy.stack([truth[axis] for axis in "xyz"], axis=1)
VELOCITY = numpy.stack([truth["v" + axis] for axis in "xyz"], axis=1)
SPIN = numpy.stack([truth["spin_" + axis] for axis in "xyz"], axis=1)
TIME = float(truth["time"])


def same(what, found, wanted):
    """Compares two arrays of numbers by their bits in single precision."""
    found, wanted = numpy.asarray(found), numpy.asarray(wanted)
    if found.shape != wanted.shape:
        sys.exit(f"{what}: shape {found.shape}, wanted {wanted.shape}")
    if wanted.dtype.kind == "f":
        found, wanted = (a.astype("<f4").view("<u4") for a in (found, wanted))
    if not (found.astype("i8") == wanted.astype("i8")).all():
        sys.exit(f"{what} differs")


def by_id(ids, *arrays):
    """The arrays in the order of the ids, which must be those of the truth."""
    order = numpy.argsort(ids)
    same("ids", numpy.asarray(ids)[order], IDS)
    return [numpy.asarray(array)[order] for array in arrays]


def columns(what, ids, position, velocity, mass):
    position, velocity, mass = by_id(ids, position, velocity, mass)
    same(f"{what}: positions", position, POSITION)
    same(f"{what}: velocities", velocity, VELOCITY)
    same(f"{what}: masses", mass, truth["mass"])


def read_numpy():
    packed = numpy.load(folder / "packed.npz")
    if sorted(packed) != sorted(truth):
        sys.exit(f"numpy: {sorted(packed)}")
    for name, values in truth.items():
        same(f"numpy: {name}", packed[name], values)


def read_h5py():
    whole("state.hdf5")
    whole("packed.hdf5")
    parts = [h5py.File(folder / f"set.{number}.hdf5") for number in range(3)]
    totals = sum(part["Header"].attrs["NumPart_ThisFile"].astype("i8") for part in parts)
    found = []
    for part in parts:
        header = part["Header"].attrs
        assert header["NumFilesPerSnapshot"] == 3 and header["Time"] == TIME, dict(header)
        assert (header["NumPart_Total"] == totals).all() and totals.sum() == len(IDS), dict(header)
        types = sorted(name for name in part if name.startswith("PartType"))
        join = lambda name: numpy.concatenate([part[of][name][()] for of in types])
        found.append([join(name) for name in ("ParticleIDs", "Coordinates", "Velocities", "Masses")])
        part.close()
    columns("h5py: a set", *(numpy.concatenate(arrays) for arrays in zip(*found)))


def whole(name):
    with h5py.File(folder / name) as file:
        types = sorted(name for name in file if name.startswith("PartType"))
        join = lambda name: numpy.concatenate([file[of][name][()] for of in types])
        ids = join("ParticleIDs")
        columns("h5py", ids, join("Coordinates"), join("Velocities"), join("Masses"))
        charge, spin = by_id(ids, join("charge"), join("spin"))
        same("charges", charge, truth["charge"])
        same("spins", spin, SPIN)
        header = file["Header"].attrs
        assert header["Time"] == TIME and header["BoxSize"] == 4.0, dict(header)
        for number, count in enumerate(header["NumPart_ThisFile"]):
            there = f"PartType{number}" in file
            assert count == (len(file[f"PartType{number}"]["Masses"]) if there else 0)


def read_yt():
    for name in ("state.hdf5", "packed.hdf5", "set.0.hdf5"):
        read_by_yt(name)


def read_by_yt(name):
    box = [[-50.0, 50.0]] * 3
    data = yt.load(str(folder / name), bounding_box=box, unit_base={"length": (1.0, "cm"), "mass": (1.0, "g"), "velocity": (1.0, "cm/s")})
    all_of_it = data.all_data()
    types = [name for name in data.particle_types_raw]
    join = lambda name: numpy.concatenate([all_of_it[of, name].d for of in types])
    columns("yt", join("ParticleIDs").astype("u4"), join("Coordinates"), join("Velocities"), join("Masses"))
    assert float(data.current_time.to("code_time")) == TIME


def read_pynbody():
    for name in ("state.hdf5", "packed.hdf5", "set"):
        data = pynbody.load(str(folder / name))
        columns(f"pynbody: {name}", numpy.asarray(data["iord"]), data["pos"], data["vel"], data["mass"])
    tipsy = pynbody.load(str(folder / "state.tipsy"))
    same("pynbody: Tipsy", numpy.asarray(tipsy["pos"]), POSITION)


def read_ase():
    atoms = ase.io.read(folder / "state.xyz", format="extxyz")
    arrays = atoms.arrays
    columns("ASE", arrays["id"], atoms.positions, arrays["velo"], arrays.get("mass", arrays.get("masses")))
    same("ASE: its masses", by_id(arrays["id"], atoms.get_masses())[0], truth["mass"])
    same("spins", by_id(arrays["id"], arrays["spin"])[0], SPIN)
    same("species", atoms.numbers, truth["species"])
    assert atoms.info["Time"] == TIME, atoms.info
    assert numpy.allclose(atoms.cell.lengths(), 4.0) and atoms.pbc.all(), atoms.cell


def read_vtk():
    read_by_vtk("state.vtp")
    read_by_vtk("packed.vtp")
    mesh = vtk.vtkOBJReader()
    mesh.SetFileName(str(folder / "state.obj"))
    mesh.Update()
    found = mesh.GetOutput()
    same("VTK: OBJ", vtk_to_numpy(found.GetPoints().GetData()), POSITION)
    assert (found.GetNumberOfLines(), found.GetNumberOfPolys()) == (2, 1)


def read_by_vtk(name):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / name))
    reader.Update()
    found = reader.GetOutput()
    data = found.GetPointData()
    array = lambda name: vtk_to_numpy(data.GetArray(name))
    columns("VTK", array("id"), vtk_to_numpy(found.GetPoints().GetData()), array("velocity"), array("mass"))
    same("spins", array("spin"), SPIN)
    assert found.GetFieldData().GetArray("TimeValue").GetValue(0) == TIME
    assert (found.GetNumberOfVerts(), found.GetNumberOfLines(), found.GetNumberOfPolys()) == (1, 2, 1)
    polygon = found.GetPolys()
    polygon.InitTraversal()
    ends = vtk.vtkIdList()
    polygon.GetNextCell(ends)
    assert [ends.GetId(k) for k in range(3)] == [4, 5, 6]
    mesh = vtk.vtkPLYReader()
    mesh.SetFileName(str(folder / "state.ply"))
    mesh.Update()
    same("VTK: PLY", vtk_to_numpy(mesh.GetOutput().GetPoints().GetData()), POSITION)


def read_plyfile():
    data = plyfile.PlyData.read(folder / "state.ply")
    vertex = data["vertex"].data
    stack = lambda names: numpy.stack([vertex[name] for name in names], axis=1)
    columns("plyfile", vertex["id"], stack("xyz"), stack(["vx", "vy", "vz"]), vertex["mass"])
    assert len(data["edge"].data) == 2 and list(data["face"].data[0][0]) == [4, 5, 6]
    # Blender's importer wants x, y and z as floats, lists of faces called vertex_indices, and edges as vertex1 and vertex2.
    assert [str(vertex.dtype[axis]) for axis in "xyz"] == ["float32"] * 3
    assert data["edge"].data.dtype.names == ("vertex1", "vertex2")
    assert data["face"].data.dtype.names == ("vertex_indices",)


globals()["read_" + program]()
