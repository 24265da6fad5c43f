//! Numbers: of the wrong type, or out of range. Each text is what a user reads, whole.

use crate::scenes::assert_report;

#[test]
fn number_in_quotes() {
    assert_report(
        r#"[simulation]
dt = "0.1"
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
"#,
        &[],
        r#"error: `dt` must be a number above zero, not the text "0.1"
  --> a.toml:2:6
   |
 2 | dt = "0.1"
   |      ^^^^^ remove the quotes: 0.1

a.toml: 1 error"#,
    );
}

#[test]
fn zero_dt() {
    assert_report(
        "[simulation]
dt = 0
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: `dt` must be a number above zero, not 0
  --> a.toml:2:6
   |
 2 | dt = 0
   |      ^

a.toml: 1 error",
    );
}

#[test]
fn negative_dt() {
    assert_report(
        "[simulation]
dt = -0.5
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: `dt` must be a number above zero, not -0.5
  --> a.toml:2:6
   |
 2 | dt = -0.5
   |      ^^^^

a.toml: 1 error",
    );
}

#[test]
fn nan() {
    assert_report(
        "[simulation]
dt = nan
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: `dt` must be finite, not nan
  --> a.toml:2:6
   |
 2 | dt = nan
   |      ^^^

a.toml: 1 error",
    );
}

#[test]
fn infinite_position() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, -inf, 0] }]
",
        &[],
        "error: `position` must be finite, not -inf
  --> a.toml:5:28
   |
 5 | bodies = [{ position = [0, -inf, 0] }]
   |                            ^^^^

a.toml: 1 error",
    );
}

#[test]
fn beyond_f64() {
    assert_report(
        "[simulation]
dt = 0.1
until = 1e999
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: `until` is too large
  --> a.toml:3:9
   |
 3 | until = 1e999
   |         ^^^^^ single precision ends at 3.4e38

a.toml: 1 error",
    );
}

#[test]
fn beyond_single_precision() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
kind = "gravity"
g = 6e40
"#,
        &[],
        "error: `g` is too large
  --> a.toml:8:5
   |
 8 | g = 6e40
   |     ^^^^ single precision ends at 3.4e38

a.toml: 1 error",
    );
}

#[test]
fn below_single_precision() {
    assert_report(
        "[simulation]
dt = 1e-50
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: `dt` is too small
  --> a.toml:2:6
   |
 2 | dt = 1e-50
   |      ^^^^^ it is zero in single precision

a.toml: 1 error",
    );
}

#[test]
fn zero_steps() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 0
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: `steps` must be a whole number, one or above, not 0
  --> a.toml:3:9
   |
 3 | steps = 0
   |         ^

a.toml: 1 error",
    );
}

#[test]
fn half_a_step() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10.5
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: `steps` must be a whole number, one or above, not 10.5
  --> a.toml:3:9
   |
 3 | steps = 10.5
   |         ^^^^

a.toml: 1 error",
    );
}

#[test]
fn too_many_steps() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 2_000_000_000_000
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: `steps` is too large
  --> a.toml:3:9
   |
 3 | steps = 2_000_000_000_000
   |         ^^^^^^^^^^^^^^^^^ at most 4294967295

a.toml: 1 error",
    );
}

#[test]
fn more_than_64_bits() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 99999999999999999999
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: `steps` is too large
  --> a.toml:3:9
   |
 3 | steps = 99999999999999999999
   |         ^^^^^^^^^^^^^^^^^^^^ whole numbers end at 2^53

a.toml: 1 error",
    );
}

#[test]
fn until_too_far() {
    assert_report(
        "[simulation]
dt = 1e-9
until = 1e6
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: `until` is too large
  --> a.toml:3:9
   |
 3 | until = 1e6
   |         ^^^ 1.000e15 steps of dt = 1e-9, at most 4294967295

a.toml: 1 error",
    );
}

#[test]
fn zero_every() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[output]
every = 0
",
        &[],
        "error: `every` must be a whole number, one or above, not 0
  --> a.toml:7:9
   |
 7 | every = 0
   |         ^

a.toml: 1 error",
    );
}
