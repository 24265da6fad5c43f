//! Memory is counted before anything is made.
#![cfg(target_os = "linux")]

use std::process::Command;

use crate::process::{Place, output};

/// `motes check` of a text with so many KiB of memory.
fn check(text: &str, limit: u32) -> (i32, String) {
    let place = Place::with(&[("a.toml", text)]);
    let script = format!("ulimit -v {limit}; exec \"$0\" check \"$1\" --backend cpu");
    let mut command = Command::new("bash");
    let (code, stdout, stderr) =
        output(command.args(["-c", &script, env!("CARGO_BIN_EXE_motes"), &place.at("a.toml")]));
    (code, stdout + &stderr)
}

fn scene(particles: &str) -> String {
    format!("[simulation]\ndt = 0.01\nsteps = 3\n[[particles]]\n{particles}\n")
}

#[test]
fn what_does_not_fit_is_refused_with_numbers() {
    for (particles, words) in [
        (
            "shape = \"jelly\"\nsize = [3000, 3000, 10]",
            "90000000 particles, 764712020 springs and 36191932 triangles need",
        ),
        (
            "shape = \"cloth\"\ncolumns = 9000\nrows = 9000",
            "81000000 particles, 485910002 springs and 161964002 triangles need",
        ),
        ("shape = \"chain\"\ncount = 99000000", "99000000 particles and 98999999 springs need"),
        ("shape = \"hair\"\nstrands = 5000000", "80000000 particles, 70000000 rods and 70000000 joints need"),
        ("shape = \"box\"\ncount = 99999999\nsize = [1, 1, 1]", "99999999 particles need 31.2 GiB of memory"),
        ("shape = \"block\"\nsize = [1, 1, 1]\nspacing = 0.0022", "94196375 particles need 29.4 GiB"),
    ] {
        let (code, said) = check(&scene(particles), 4_000_000);
        assert_eq!(code, 3, "{particles}: {said}");
        assert!(said.contains(words) && said.contains("are free"), "{particles}: {said}");
    }
    // Several entries count together.
    let some = "shape = \"plummer\"\ncount = 8000000";
    let (code, said) = check(&scene(&format!("{some}\n[[particles]]\n{some}")), 4_000_000);
    assert!(code == 3 && said.contains("16000000 particles need 5.0 GiB"), "{said}");
}

/// A picture asks for its memory before it is drawn: an allocation that fails would end the process.
#[test]
fn a_picture_that_does_not_fit_is_refused() {
    let place = Place::with(&[(
        "a.toml",
        "[simulation]\ndt = 0.01\nsteps = 2\n[[particles]]\nbodies = [{ position = [1, 0, 0] }]\n[picture]\nwidth = 4096\nheight = 2048\n",
    )]);
    let script = "ulimit -v 1200000; exec \"$0\" run \"$1\" -o \"$2\" --backend cpu -q";
    let mut command = Command::new("bash");
    let out = place.at("out");
    let (code, stdout, stderr) =
        output(command.args(["-c", script, env!("CARGO_BIN_EXE_motes"), &place.at("a.toml"), &out]));
    let said = stdout + &stderr;
    assert!(
        code == 5 && said.contains("a picture of 4096×2048 takes some") && said.contains("refuses"),
        "{code} {said}"
    );
}

/// A fault in another line is reported without the 4 million particles and 18 million springs.
#[test]
fn faults_are_reported_before_particles_are_made() {
    let jelly = scene("shape = \"jelly\"\nsize = [1000000, 2, 2]");
    for fault in ["[[force]]\nkind = \"sprng\"\n", "[output]\nevry = 3\n", "[picture]\nwidth = -1\n", "[[forces]]\n"] {
        // Not even a tenth of the memory that they take; that is reported, too.
        let (code, said) = check(&(jelly.clone() + fault), 400_000);
        assert!(code == 3 && said.contains("unknown") != said.contains("`width`"), "{fault}: {said}");
        assert!(said.contains("4000000 particles, 17999988 springs and 7999996 triangles need"), "{fault}: {said}");
    }
}

/// What is counted is what is made.
#[test]
fn amounts_are_those_of_the_shapes() {
    use motes::settings::{Settings, Value};
    use motes::shapes::{Amount, shape};
    let number = |x: u32| Value::Number(f64::from(x));
    let size = Value::Vector(glam::DVec3::new(4.0, 3.0, 5.0));
    let text = |word: &'static str| Value::Text(word.into());
    for (name, given) in [
        ("chain", vec![("count", number(7)), ("bending", number(1))]),
        ("chain", vec![("count", number(7)), ("tie", text("rod"))]),
        ("chain", vec![("count", number(2)), ("tie", text("rope")), ("bending", number(1))]),
        ("cloth", vec![("columns", number(6)), ("rows", number(4))]),
        ("cloth", vec![("columns", number(2)), ("rows", number(2)), ("shear", number(0))]),
        ("cloth", vec![("columns", number(5)), ("rows", number(3)), ("bend", number(0))]),
        ("jelly", vec![("size", size.clone())]),
        ("hair", vec![("strands", number(3)), ("points", number(6))]),
        ("hair", vec![("strands", number(3)), ("bending", number(0))]),
        ("lattice", vec![("size", size.clone())]),
        ("block", vec![("size", size.clone()), ("spacing", Value::Number(0.9))]),
        ("tank", vec![("size", size.clone()), ("spacing", Value::Number(0.5)), ("open", text("+y -x"))]),
        ("tank", vec![("size", glam::DVec3::new(4.0, 2.0, 0.0).into()), ("spacing", Value::Number(0.5))]),
        ("plummer", vec![("count", number(11))]),
        ("disk", vec![("count", number(60))]),
    ] {
        let shape = shape(name).expect("a shape");
        let settings = given.into_iter().fold(Settings::defaults(shape.keys), |all, (key, value)| all.with(key, value));
        let made = (shape.build)(&settings).expect("particles");
        let of = |n: usize| n as f64;
        let links = &made.links;
        let amount = Amount {
            springs: of(links.springs.len()),
            rods: of(links.rods.len()),
            joints: of(links.joints.len()),
            triangles: of(links.triangles.len()),
            ..Amount::of(of(made.len()))
        };
        assert_eq!((shape.amount)(&settings), amount, "{name} {settings:?}");
    }
}
