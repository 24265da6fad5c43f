//! The programs of the field open what motes writes, and find the same bits. They run where Python has them; in CI those that Debian
//! packages must be there (`tests/run` installs them).

use std::fs::File;
use std::path::Path;
use std::process::Command;

use glam::DVec3;
use motes::State;
use motes::formats::{FORMATS, Options, Part, atomically};
use motes::kernel::{Array, Bounds, Side};
use motes::links::Link;

use super::folder;

/// Programs, and whether CI must have them.
const PROGRAMS: [(&str, bool); 7] = [
    ("numpy", true),
    ("h5py", true),
    ("vtk", true),
    ("ase", true),
    ("plyfile", false),
    ("yt", false),
    ("pynbody", false),
];

/// Species, ids that are not places, columns of two kinds, springs and a triangle.
#[expect(clippy::cast_possible_truncation, reason = "numbers of single precision are wanted")]
fn state() -> State {
    let mut state = State::default();
    for row in 0..1000_u32 {
        let at = |k: u32| f64::from((f64::from((row * 7919 + k * 104_729) % 10_007) / 2501.75 - 2.0) as f32);
        state.push(DVec3::new(at(1), at(2), at(3)), DVec3::new(at(4), at(5), at(6)), at(7) + 3.0, 0.0);
    }
    state.species_mut().iter_mut().zip(0..).for_each(|(of, row)| *of = row % 3);
    state.set("charge", Array::Float((0..1000).map(|row| f64::from(row) - 500.5).collect())).expect("charges");
    let spins: Vec<DVec3> = state.velocity().iter().map(|v| *v * 0.5).collect();
    state.set("spin", Array::Vec3(spins)).expect("spins");
    state.set_ids((0..1000).map(|row| 3 * row + row % 2).collect()).expect("ids");
    let link = |ends| Link { ends, rest: 1.0, stiffness: 1.0, damping: 0.0, rope: false };
    state.links.springs = vec![link([0, 1]), link([2, 3])];
    state.links.triangles = vec![[4, 5, 6]];
    (state.time, state.step) = (0.375, 60);
    state
}

#[test]
fn programs_of_the_field_find_the_same_bits() {
    let folder = folder();
    let (state, sides) = (state(), [Side::Periodic; 3]);
    let bounds = Bounds { low: DVec3::splat(-2.0), high: DVec3::splat(2.0), sides, dimensions: 3 };
    let options = Options { bounds: Some(bounds), ..Options::default() };
    for format in FORMATS {
        let Some(write) = format.write else { continue };
        let name = if format.name == "npz" { "arrays.npz".to_owned() } else { format!("state.{}", format.name) };
        atomically(&folder.path().join(name), |out| write(out, &state, &options)).expect(format.name);
        if format.compresses {
            let (path, options) = (format!("packed.{}", format.name), Options { compress: true, ..options.clone() });
            atomically(&folder.path().join(path), |out| write(out, &state, &options)).expect(format.name);
        }
        for part in (0..3).map(|number| Part { number, of: 3 }).filter(|_| format.divides) {
            let options = Options { part, compress: part.number == 1, ..options.clone() };
            atomically(&folder.path().join(part.name("set", format)), |out| write(out, &state, &options))
                .expect(format.name);
        }
    }
    let python = std::env::var("MOTES_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/readers/readers.py");
    let ci = std::env::var_os("CI").is_some();
    let mut missing = Vec::new();
    for (program, wanted) in PROGRAMS {
        let run = || Command::new(&python).arg(&script).arg(program).arg(folder.path()).output();
        let (code, said) = match run() {
            Ok(output) => {
                let said = [output.stdout, output.stderr].concat();
                (output.status.code(), String::from_utf8_lossy(&said).into_owned())
            }
            Err(why) => (Some(3), why.to_string()),
        };
        match code {
            Some(0) => {}
            Some(3) if ci && wanted => panic!("{program} is not installed, and CI has it: {said}"),
            Some(3) => missing.push(program),
            _ => panic!("{program}: {said}"),
        }
    }
    if !ci && !missing.is_empty() {
        println!("not installed, and so not asked: {}", missing.join(", "));
    }
    assert!(File::open(folder.path().join("state.vtp")).is_ok());
}
