//! The layouts that other programs expect, byte by byte and name by name: readers of motes would not notice an own dialect.

use glam::DVec3;
use hdf5_pure::{AttrValue, DType, File};
use motes::State;
use motes::formats::{Options, atomically, format};
use motes::kernel::{Array, Bounds, Side};
use motes::links::Link;

use super::folder;

/// Three particles of two species, a spring, and the triangle of all.
fn state() -> State {
    let mut state = State::default();
    for (x, mass) in [(0.5, 1.0), (-2.0, 2.0), (4.0, 8.0)] {
        state.push(DVec3::new(x, 1.0, -x), DVec3::new(0.0, x, 0.25), mass, 0.0);
    }
    state.species_mut().copy_from_slice(&[0, 1, 0]);
    state.links.springs = vec![Link { ends: [0, 2], rest: 1.0, stiffness: 1.0, damping: 0.0, rope: false }];
    state.links.triangles = vec![[2, 0, 1]];
    (state.time, state.step) = (0.75, 40);
    state
}

fn written(name: &str, state: &State) -> Vec<u8> {
    let (folder, format) = (folder(), format(name).expect("a format"));
    let sides = [Side::Periodic; 3];
    let bounds = Bounds { low: DVec3::splat(-5.0), high: DVec3::splat(5.0), sides, dimensions: 3 };
    let options = Options { bounds: Some(bounds), ..Options::default() };
    let path = folder.path().join("a");
    atomically(&path, |out| format.write.expect("a writer")(out, state, &options)).expect(name);
    std::fs::read(&path).expect("a file")
}

/// Some numbers as they stand in a file.
fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}
fn whole(numbers: &[u32]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// What stands behind a mark.
fn behind<'a>(bytes: &'a [u8], mark: &str) -> &'a [u8] {
    let place = bytes.windows(mark.len()).position(|part| part == mark.as_bytes());
    &bytes[place.unwrap_or_else(|| panic!("no {mark}")) + mark.len()..]
}

#[test]
fn hdf5_has_the_names_and_types_of_gadget() {
    // Without densities nothing is gas: species 0 is dark matter.
    for (gas, groups) in [(false, ["PartType1", "PartType2"]), (true, ["PartType0", "PartType1"])] {
        let (folder, mut state) = (folder(), state());
        if gas {
            state.set("density", Array::Float(vec![1.5, 2.5, 3.5])).expect("densities");
        }
        let path = folder.path().join("a.hdf5");
        std::fs::write(&path, written("hdf5", &state)).expect("a file");
        let file = File::open(&path).expect("HDF5");
        let root = file.root();
        let header = root.group("Header").expect("a header").attrs().expect("attributes");
        let counts = |of: [u64; 6]| AttrValue::U64Array(of.to_vec());
        let per_type = if gas { [2, 1, 0, 0, 0, 0] } else { [0, 2, 1, 0, 0, 0] };
        for (name, wanted) in [
            ("NumPart_ThisFile", counts(per_type)),
            ("NumPart_Total", AttrValue::U32Array(per_type.map(|n| u32::try_from(n).expect("few")).to_vec())),
            ("NumPart_Total_HighWord", AttrValue::U32Array(vec![0; 6])),
            ("MassTable", AttrValue::F64Array(vec![0.0; 6])),
            ("NumFilesPerSnapshot", AttrValue::I32(1)),
            ("Time", AttrValue::F64(0.75)),
            ("Redshift", AttrValue::F64(0.0)),
            ("BoxSize", AttrValue::F64(10.0)),
        ] {
            assert_eq!(header.get(name).map(|value| format!("{value:?}")), Some(format!("{wanted:?}")), "{name}");
        }
        let group = root.group(groups[0]).expect("species 0");
        let mut names = group.datasets().expect("datasets");
        names.sort_unstable();
        let all = ["Coordinates", "Density", "Masses", "ParticleIDs", "Velocities"];
        let wanted: Vec<&str> = all.into_iter().filter(|name| gas || *name != "Density").collect();
        assert_eq!(names, wanted);
        let read = |name: &str, kind: DType| {
            let dataset = group.dataset(name).expect(name);
            assert_eq!(format!("{:?}", dataset.dtype().expect(name)), format!("{kind:?}"), "{name}");
            (dataset.shape().expect(name), dataset.read_f64().expect(name))
        };
        assert_eq!(read("Coordinates", DType::F32), (vec![2, 3], vec![0.5, 1.0, -0.5, 4.0, 1.0, -4.0]));
        assert_eq!(read("Velocities", DType::F32), (vec![2, 3], vec![0.0, 0.5, 0.25, 0.0, 4.0, 0.25]));
        assert_eq!(read("Masses", DType::F32), (vec![2], vec![1.0, 8.0]));
        assert_eq!(read("ParticleIDs", DType::U32), (vec![2], vec![0.0, 2.0]));
        let other = root.group(groups[1]).expect("species 1").dataset("Masses").expect("masses");
        assert_eq!(other.read_f64().expect("masses"), [2.0]);
    }
}

#[test]
fn ply_has_the_names_and_bytes_of_blender() {
    let bytes = written("ply", &state());
    let head = String::from_utf8_lossy(&bytes[..bytes.len() - behind(&bytes, "end_header\n").len()]).into_owned();
    let lines: Vec<&str> = head.lines().filter(|line| !line.starts_with("comment")).collect();
    assert_eq!(
        lines,
        [
            "ply",
            "format binary_little_endian 1.0",
            "element vertex 3",
            "property float x",
            "property float y",
            "property float z",
            "property float vx",
            "property float vy",
            "property float vz",
            "property float mass",
            "property uint species",
            "property uint id",
            "element edge 1",
            "property int vertex1",
            "property int vertex2",
            "element face 1",
            "property list uchar int vertex_indices",
            "end_header",
        ]
    );
    let rows = [
        ([0.5, 1.0, -0.5, 0.0, 0.5, 0.25, 1.0], [0, 0]),
        ([-2.0, 1.0, 2.0, 0.0, -2.0, 0.25, 2.0], [1, 1]),
        ([4.0, 1.0, -4.0, 0.0, 4.0, 0.25, 8.0], [0, 2]),
    ];
    let mut wanted: Vec<u8> = rows.iter().flat_map(|(real, rest)| [floats(real), whole(rest)].concat()).collect();
    wanted.extend([whole(&[0, 2]), vec![3], whole(&[2, 0, 1])].concat());
    assert_eq!(behind(&bytes, "end_header\n"), wanted);
}

#[test]
fn vtp_has_the_cells_of_vtk() {
    let bytes = written("vtp", &state());
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let counts =
        "NumberOfPoints=\"3\" NumberOfVerts=\"1\" NumberOfLines=\"1\" NumberOfStrips=\"0\" NumberOfPolys=\"1\"";
    assert!(text.contains(counts) && text.contains("byte_order=\"LittleEndian\" header_type=\"UInt64\""), "{text}");
    assert!(text.contains("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">0.75</DataArray>"), "{text}");
    let data = behind(&bytes, "<AppendedData encoding=\"raw\">\n_");
    // The array of a name within a part of the XML: 8 bytes of its length, then its numbers.
    let array = |section: &str, name: &str| {
        let part = text.split_once(&format!("<{section}>")).expect(section).1;
        let tag = part.split("<DataArray").find(|tag| tag.contains(&format!("Name=\"{name}\""))).expect(name);
        let offset = tag.split_once("offset=\"").expect("an offset").1.split_once('"').expect("its end").0;
        let at: usize = offset.parse().expect("a number");
        let length = u64::from_le_bytes(data[at..at + 8].try_into().expect("8 bytes"));
        data[at + 8..at + 8 + usize::try_from(length).expect("short")].to_vec()
    };
    let long = |numbers: &[u64]| numbers.iter().flat_map(|n| n.to_le_bytes()).collect::<Vec<u8>>();
    assert_eq!(array("Points", "Points"), floats(&[0.5, 1.0, -0.5, -2.0, 1.0, 2.0, 4.0, 1.0, -4.0]));
    assert_eq!(array("PointData", "velocity"), floats(&[0.0, 0.5, 0.25, 0.0, -2.0, 0.25, 0.0, 4.0, 0.25]));
    assert_eq!(array("PointData", "mass"), floats(&[1.0, 2.0, 8.0]));
    assert_eq!(array("PointData", "id"), whole(&[0, 1, 2]));
    for (section, places, end) in [("Verts", &[0, 1, 2][..], 3), ("Lines", &[0, 2], 2), ("Polys", &[2, 0, 1], 3)] {
        assert_eq!(array(section, "connectivity"), long(places), "{section}");
        assert_eq!(array(section, "offsets"), long(&[end]), "{section}");
    }
}

#[test]
fn xyz_has_the_names_of_ase_and_ovito() {
    let wanted = "3\nLattice=\"10.0 0 0 0 10.0 0 0 0 10.0\" Origin=\"-5.0 -5.0 -5.0\" \
                  Properties=species:S:1:id:I:1:pos:R:3:velo:R:3:masses:R:1 pbc=\"T T T\" Time=0.75 Step=40\n\
                  X 0 0.5 1.0 -0.5 0.0 0.5 0.25 1.0\nH 1 -2.0 1.0 2.0 0.0 -2.0 0.25 2.0\nX 2 4.0 1.0 -4.0 0.0 4.0 0.25 8.0\n";
    assert_eq!(String::from_utf8_lossy(&written("xyz", &state())), wanted);
}
