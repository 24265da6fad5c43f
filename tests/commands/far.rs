//! The command and forces through a tree: how wrong they are, and what `over = "auto"` chooses.

use std::process::Command;

use serde_json::Value;

fn motes(args: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_motes")).args(args).output().expect("the program starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("output is UTF-8");
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// A file with a star cluster and gravity that says more; it lives as long as the folder.
fn cluster(folder: &tempfile::TempDir, count: u32, gravity: &str) -> String {
    let path = folder.path().join("cluster.toml");
    let text = format!(
        "[simulation]\ndt = 0.01\nsteps = 1\n[output]\nformats = []\n[[particles]]\nshape = \"plummer\"\ncount = {count}\n\
         [[force]]\nkind = \"uniform\"\nacceleration = [0, 0, 0]\n[[force]]\nkind = \"gravity\"\nsoftening = 0.05\n{gravity}\n"
    );
    std::fs::write(&path, text).expect("written");
    path.to_str().expect("a path of words").to_owned()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Median, 99th percentile and maximum of a row.
fn three(row: &Value) -> [f64; 3] {
    ["median", "p99", "max"].map(|key| number(&row[key]))
}

#[test]
fn angles_are_compared_with_direct_sums_as_a_table_and_for_programs() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = cluster(&folder, 600, "");
    let (code, table, stderr) = motes(&["compare", "--theta", "0.5,1", &path]);
    assert_eq!(code, Some(0), "{table}{stderr}");
    let (code, json, stderr) = motes(&["compare", "--json", "--theta", "0.5,1", &path]);
    assert_eq!(code, Some(0), "{json}{stderr}");
    let json: Value = serde_json::from_str(&json).expect("JSON");
    let rows = json["rows"].as_array().expect("rows");
    let angles: Vec<_> = rows.iter().map(|row| (number(&row["theta"]), row["multipoles"].as_str())).collect();
    let (monopole, quadrupole) = (Some("monopole"), Some("quadrupole"));
    assert_eq!(angles, [(0.5, monopole), (0.5, quadrupole), (1.0, monopole), (1.0, quadrupole)]);
    let device: Vec<_> = rows.iter().map(|row| three(&row["errors"][0]["device"])).collect();
    for (row, theta) in rows.iter().zip(["θ=0.5", "θ=0.5", "θ=1", "θ=1"]) {
        assert_eq!(row["errors"].as_array().map(Vec::len), Some(1), "one law walks a tree: {row}");
        let errors = &row["errors"][0];
        assert_eq!(errors["targets"], 600, "no more targets than there are: {row}");
        assert_eq!(errors["law"], format!("gravity {theta}"));
        for [median, most, max] in ["device", "walk", "rounding"].map(|of| three(&errors[of])) {
            assert!(0.0 < median && median < most && most <= max && max < 1.0, "{row}");
        }
    }
    // The next term of the expansion is smaller by about θ / 2, and the angle enters by its square and more.
    assert!(
        device[1][0] < 0.6 * device[0][0] && device[3][0] < 0.6 * device[2][0],
        "quadrupoles are worth it: {device:?}"
    );
    assert!(device[0][0] < 0.5 * device[2][0] && device[1][0] < 0.5 * device[3][0], "small angles are: {device:?}");

    // The table says the same, and the same again: the same run, the same bits.
    let lines: Vec<_> = table.lines().collect();
    assert!(
        lines[0].starts_with("cluster: 600 particles, ") && lines[0].contains("against direct summation"),
        "{table}"
    );
    let row = |theta: &str, n: usize| {
        let cells: Vec<_> = device[n..n + 2].iter().flatten().map(|error| format!("{error:.1e}")).collect();
        format!("| {theta} | {} |", cells.join(" | "))
    };
    let head = "| θ | monopole: median | 99 % | max | quadrupole: median | 99 % | max |";
    assert_eq!(lines[2..], [head, "|---|---|---|---|---|---|---|", &row("0.5", 0), &row("1", 2)], "{table}");

    // What has no gravity has nothing to compare, and no tree has such an angle.
    let (code, _, stderr) = motes(&["compare", "--theta", "0.5", "throw"]);
    assert!(code == Some(3) && stderr.contains("throw has no gravity"), "{code:?} {stderr}");
    let (code, _, stderr) = motes(&["compare", "--theta", "1.5", &path]);
    assert!(code == Some(3) && stderr.contains("1 at most, not 1.5"), "{code:?} {stderr}");
}

#[test]
fn a_comparison_tells_what_is_left_out_from_what_is_rounded() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = cluster(&folder, 600, "over = \"tree\"\ntheta = 0.7");
    let (code, stdout, stderr) = motes(&["compare", "--steps", "2", &path]);
    assert!(code == Some(0) && stdout.contains("they agree"), "{stdout}{stderr}");
    let part = stdout.split("\n\n").find(|part| part.starts_with("gravity θ=0.7: ")).expect("a part for the tree");
    let lines: Vec<_> = part.lines().collect();
    assert_eq!(lines[0], "gravity θ=0.7: 600 targets against direct summation in f64: |a − a′| / |a′|");
    let numbers = |line: &str, what: &str| -> [f64; 3] {
        let rest = line.trim_start().strip_prefix(what).unwrap_or_else(|| panic!("no {what} in {line}"));
        let all: Vec<f64> = rest.split_whitespace().map(|cell| cell.parse().expect("a number")).collect();
        all.try_into().unwrap_or_else(|all| panic!("{all:?} are not three"))
    };
    assert_eq!(lines[1].split_whitespace().collect::<Vec<_>>(), ["median", "99", "%", "max"]);
    let device = numbers(lines[2], "the device");
    let walk = numbers(lines[3], "the same walk in f64");
    let rounding = numbers(lines[4], "device against that walk");
    assert_eq!(lines.len(), 5, "{part}");
    // The error is that of the method, to two digits; what is rounded is far below it.
    for k in 0..3 {
        assert!((device[k] - walk[k]).abs() <= 0.1 * walk[k], "{part}");
    }
    // Sums of 600 terms in f32: some units in the last place, 6e-8. Truncation at this angle is above 1e-5.
    assert!(walk[0] > 1e-5 && walk[1] < 0.05 && 0.0 < rounding[0] && rounding[0] < 1e-6, "{part}");

    let (code, json, stderr) = motes(&["compare", "--steps", "2", "--json", &path]);
    assert_eq!(code, Some(0), "{json}{stderr}");
    let json: Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json["far_groups"].as_array().map(Vec::len), Some(1));
    let shown = |of: [f64; 3]| of.map(|error| format!("{error:.1e}"));
    for (of, listed) in [("device", device), ("walk", walk), ("rounding", rounding)] {
        assert_eq!(shown(three(&json["far_groups"][0][of])), shown(listed), "{of}");
    }
    // Two digits do not tell them apart; all digits do.
    let [device, walk] = ["device", "walk"].map(|of| three(&json["far_groups"][0][of]).map(f64::to_bits));
    assert!(device != walk, "{json}");
    // Direct summation takes no group as one.
    let (code, json, _) = motes(&["compare", "--steps", "2", "--json", "--set", "force.1.over=pairs", &path]);
    let json: Value = serde_json::from_str(&json).expect("JSON");
    assert!(code == Some(0) && json["far_groups"].as_array().is_some_and(Vec::is_empty), "{json}");
}

#[test]
fn what_auto_chooses_is_said_below_and_above_the_crossing() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out").to_str().expect("a path of words").to_owned();
    let machine = |software| motes::kernel::Machine { software, ..motes::kernel::Machine::HOST };
    let crossings = [true, false].map(|software| motes::visit::crossing(&machine(software)));
    let (_, words, _) = motes(&["check", &cluster(&folder, 40, "over = \"auto\"")]);
    let found = words.split("from about ").nth(1).and_then(|rest| rest.split(' ').next()?.parse().ok());
    let from: u32 = found.unwrap_or_else(|| panic!("no crossing in: {words}"));
    assert!(crossings.contains(&from) && crossings[0] < crossings[1], "{from} is none of {crossings:?}");
    let pairs = format!("note: `gravity` uses direct summation: a tree is faster from about {from} particles on here");
    let tree = |more: &str| {
        format!("note: `gravity` approximates far groups by a tree (θ=0.9{more}): `motes compare` measures the error")
    };
    let auto = tree(&format!("; faster from about {from} particles on here"));
    for (over, count, want) in [
        ("auto", from - 1, Some(&pairs)),
        ("auto", from, Some(&auto)),
        ("tree", 40, Some(&tree(""))),
        ("pairs", 40, None),
    ] {
        let path = cluster(&folder, count, &format!("over = \"{over}\"\ntheta = 0.9"));
        for args in [&["check", &path][..], &["run", &path, "-o", &out, "--overwrite"]] {
            let (code, stdout, stderr) = motes(args);
            let words = stdout + &stderr;
            assert_eq!(code, Some(0), "{args:?}: {words}");
            let notes: Vec<_> = words.lines().filter(|line| line.starts_with("note: `gravity`")).collect();
            let want: Vec<_> = want.map(String::as_str).into_iter().collect();
            assert_eq!(notes, want, "{over}, {count}: motes {args:?}");
        }
    }
}
