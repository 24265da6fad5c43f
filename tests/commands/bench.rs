//! What `motes bench tree` says, and what it draws.

use std::process::Command;

use serde_json::Value;

#[test]
fn trees_are_measured_held_against_direct_sums_and_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let plot = folder.path().join("tree.svg");
    let output = Command::new(env!("CARGO_BIN_EXE_motes"))
        .args(["bench", "tree", "--from", "1024", "--to", "1024", "--repeat", "1", "--json", "--plot"])
        .arg(&plot)
        .output()
        .expect("the program starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let bench: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let sets = bench["tree"].as_array().expect("sets");
    assert_eq!(
        sets.iter().map(|set| set["set"].as_str()).collect::<Vec<_>>(),
        [Some("plummer"), Some("cusp"), Some("disk")]
    );
    for set in sets {
        assert_eq!(set["pairs"].as_array().map(Vec::len), Some(1), "{set}");
        let variants = set["variants"].as_array().expect("variants");
        let last = |n: usize| &variants[n]["sizes"][0];
        for n in 0..variants.len() {
            assert!(last(n)["bodies"] == 1024 && number(&last(n)["bodies_per_second"]) > 0.0, "{set}");
            let [step, build] = ["seconds_per_step", "seconds_per_build"].map(|key| number(&last(n)[key][0]));
            assert!(step > 0.0 && build > 0.0 && number(&last(n)["ratio"]) > 0.0, "{set}");
        }
        let error = |n: usize| number(&last(n)["relative_force_error"]["median"]);
        // θ 0.7, θ 0.5, and that without quadrupoles: each must differ from the next by far more than 1000 targets scatter.
        assert!(error(0) < 2e-3 && error(1) < 0.6 * error(0) && error(2) > 3.0 * error(1), "{set}");
    }
    let svg = std::fs::read_to_string(plot).expect("a plot");
    // Three sets and all pairs, and four keys of the legend.
    assert_eq!(svg.matches("<circle").count(), 8, "{svg}");
    assert!(svg.contains("bodies") && svg.contains("all pairs") && svg.contains("disk"), "{svg}");
}
