//! Particles and vectors. Each text is what a user reads, whole.

use crate::scenes::assert_report;

#[test]
fn zero_count() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
shape = "plummer"
count = 0
"#,
        &[],
        "error: `count` must be a whole number, one or above, not 0
  --> a.toml:6:9
   |
 6 | count = 0
   |         ^

a.toml: 1 error",
    );
}

#[test]
fn too_many_particles() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
shape = "plummer"
count = 4_000_000_000
"#,
        &[],
        "error: 4000000000 particles are too many
  --> a.toml:6:9
   |
 6 | count = 4_000_000_000
   |         ^^^^^^^^^^^^^ the maximum is 100000000

a.toml: 1 error",
    );
}

#[test]
fn negative_mass() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0], mass = -1 }]
",
        &[],
        "error: `mass` must be a number, zero or above, not -1
  --> a.toml:5:42
   |
 5 | bodies = [{ position = [0, 0, 0], mass = -1 }]
   |                                          ^^

a.toml: 1 error",
    );
}

#[test]
fn two_numbers_for_three() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
kind = "uniform"
acceleration = [0, -9.81]
"#,
        &[],
        "error: `acceleration` must be three numbers, as in [0, 0, 1], not a list of length 2
  --> a.toml:8:16
   |
 8 | acceleration = [0, -9.81]
   |                ^^^^^^^^^^

a.toml: 1 error",
    );
}

#[test]
fn a_number_for_three() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
kind = "uniform"
acceleration = -9.81
"#,
        &[],
        "error: `acceleration` must be three numbers, as in [0, 0, 1], not -9.81
  --> a.toml:8:16
   |
 8 | acceleration = -9.81
   |                ^^^^^

a.toml: 1 error",
    );
}

#[test]
fn a_text_among_three() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
kind = "uniform"
acceleration = [0, "down", 0]
"#,
        &[],
        r#"error: `acceleration` must be three numbers, not the text "down"
  --> a.toml:8:20
   |
 8 | acceleration = [0, "down", 0]
   |                    ^^^^^^

a.toml: 1 error"#,
    );
}

#[test]
fn no_direction() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
kind = "vortex"
axis = [0, 0, 0]
"#,
        &[],
        "error: `axis` must be a direction: three numbers, not all zero
  --> a.toml:8:8
   |
 8 | axis = [0, 0, 0]
   |        ^^^^^^^^^

a.toml: 1 error",
    );
}

#[test]
fn no_bodies() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = []
",
        &[],
        "error: this entry has no particles
  --> a.toml:5:10
   |
 5 | bodies = []
   |          ^^

a.toml: 1 error",
    );
}

#[test]
fn bodies_not_tables() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [[1, 0, 0]]
",
        &[],
        "error: `bodies` must be a list of tables, as in [{ position = [1, 0, 0] }], not a list of length 3
  --> a.toml:5:11
   |
 5 | bodies = [[1, 0, 0]]
   |           ^^^^^^^^^

a.toml: 1 error",
    );
}
