//! What `motes bench` says.

use std::process::Command;

use serde_json::Value;

#[test]
fn a_topic_is_measured() {
    let motes = |args: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_motes")).arg("bench").args(args).output();
        let output = output.expect("the program starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        output.stdout
    };
    let bench: Value = serde_json::from_slice(&motes(&["neighbors", "--repeat", "2", "--json"])).expect("JSON");
    let topics = bench["topics"].as_array().expect("topics");
    let row = &topics[0];
    assert_eq!((topics.len(), row["topic"].as_str(), row["scene"].as_str()), (1, Some("neighbors"), Some("flock")));
    let times: Vec<f64> = row["seconds_per_step"].as_array().expect("times").iter().filter_map(Value::as_f64).collect();
    assert!(times.len() == 2 && times.iter().all(|time| *time > 0.0), "{row}");
    // The median of two is the longer one.
    let rate = row["particles"].as_f64().expect("a count") / times.iter().copied().fold(0.0, f64::max);
    assert!((row["particle_steps_per_second"].as_f64().expect("a rate") / rate - 1.0).abs() < 1e-9, "{row}");
    let table = String::from_utf8(motes(&["springs", "--repeat", "1"])).expect("text");
    assert!(table.contains("springs") && table.contains("flag") && table.contains("/s"), "{table}");
}

fn motes(args: &[&str]) -> Result<Value, String> {
    let output = Command::new(env!("CARGO_BIN_EXE_motes")).arg("bench").args(args).arg("--json").output();
    let output = output.expect("the program starts");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    output.status.success().then(|| serde_json::from_slice(&output.stdout).expect("JSON")).ok_or(said)
}

#[test]
fn each_kernel_of_a_step_is_measured() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("kernels.json");
    let path = file.to_str().expect("a path");
    let set = ["--set", "particles.0.count=2000", "--set", "simulation.dt=0.02"];
    let args = [&["kernels", "flock", "--repeat", "3", "--output", path], &set[..]].concat();
    let bench = motes(&args).expect("a bench");
    let kept: Value = serde_json::from_slice(&std::fs::read(&file).expect("a file")).expect("JSON");
    assert_eq!(kept, bench);
    let row = &bench["topics"][0];
    assert_eq!((row["topic"].as_str(), row["particles"].as_u64()), (Some("kernels"), Some(2000)));
    let kernels = row["kernels"].as_array().expect("kernels");
    let names: Vec<_> = kernels.iter().filter_map(|its| its["kernel"].as_str()).collect();
    assert!(names.contains(&"boids") && names.contains(&"tick"), "{names:?}");
    // Kernels that are fused are one.
    assert!(names.iter().any(|name| name.starts_with("wander + kick + ") && name.ends_with(" + watch")), "{names:?}");
    let (mut sum, mut timed) = (0.0, 0);
    for its in kernels {
        let number = |key: &str| its[key].as_u64().unwrap_or_else(|| panic!("{key} of {its}"));
        assert!(number("dispatches") >= number("least_dispatches") && number("least_dispatches") > 0, "{its}");
        assert!(number("workgroups") > 0 && number("bytes") > 0 && number("spirv_instructions") > 5, "{its}");
        sum += its["device_seconds"].as_f64().unwrap_or(0.0);
        timed += u32::from(its["device_seconds"].as_f64().is_some_and(|seconds| seconds > 0.0));
    }
    // The search has loops, and the end of a step none.
    let iteration = |name: &str| {
        let its = kernels.iter().find(|its| its["kernel"] == name).expect("a kernel");
        its["spirv_instructions_per_iteration"].as_u64()
    };
    assert!(iteration("boids").is_some_and(|n| n > 20) && iteration("tick").is_none(), "{row:#}");
    // A device without a clock has no times; one that has one has times of what takes any.
    if let Some(whole) = row["device_seconds_of_step"].as_f64() {
        let all = row["device_seconds_of_kernels"].as_f64().expect("a sum");
        assert!(timed > 0 && whole > 0.0 && sum > 0.2 * all && sum < 5.0 * all, "{row:#}");
    }
    let said = motes(&["springs", "flock"]).expect_err("springs have a scene of their own");
    assert!(said.contains("motes bench kernels flock"), "{said}");
}

#[test]
fn sizes_grow_until_the_time_is_over() {
    let bench = motes(&["springs", "--repeat", "1", "--to", "20000", "--seconds", "0.001"]).expect("a bench");
    let rows = bench["topics"].as_array().expect("topics");
    let left: Vec<_> = rows.iter().map(|row| row["left_out"].as_str()).collect();
    assert_eq!(left, [None, Some("--seconds"), Some("--seconds")], "{bench:#}");
    let counts: Vec<_> = rows.iter().filter_map(|row| row["particles"].as_u64()).collect();
    assert_eq!(counts, [3876, 15_504, 20_000]);
}

#[test]
fn an_iteration_of_a_solve_is_measured() {
    let bench = motes(&["solve", "--repeat", "1"]).expect("a bench");
    let row = &bench["topics"][0];
    assert!(row["seconds_per_iteration"][0].as_f64().is_some_and(|seconds| seconds > 0.0), "{row:#}");
}
