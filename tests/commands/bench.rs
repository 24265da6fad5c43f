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
