//! Words that are not known, and how they are reported. Each text is what a user reads, whole.

use crate::scenes::assert_report;

#[test]
fn formats_not_a_list() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[output]
formats = "csv"
"#,
        &[],
        r#"error: `formats` must be a list, as in ["csv", "png"], not the text "csv"
  --> a.toml:7:11
   |
 7 | formats = "csv"
   |           ^^^^^

a.toml: 1 error"#,
    );
}

#[test]
fn unknown_format() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[output]
formats = ["csv", "pgn"]
"#,
        &[],
        r#"error: unknown format "pgn"
  --> a.toml:7:19
   |
 7 | formats = ["csv", "pgn"]
   |                   ^^^^^ did you mean "png"?
   = known: `npz`, `hdf5`, `ply`, `vtp`, `obj`, `tipsy`, `xyz`, `csv`, `png`

a.toml: 1 error"#,
    );
}

#[test]
fn unknown_integrator() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
integrator = "leapforg"
[[particles]]
bodies = [{ position = [0, 0, 0] }]
"#,
        &[],
        r#"error: unknown integrator "leapforg"
  --> a.toml:4:14
   |
 4 | integrator = "leapforg"
   |              ^^^^^^^^^^ did you mean "leapfrog"?
   = known: {integrators}

a.toml: 1 error"#,
    );
}

#[test]
fn unknown_force() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
kind = "magnetism"
"#,
        &[],
        r#"error: unknown force "magnetism"
  --> a.toml:7:8
   |
 7 | kind = "magnetism"
   |        ^^^^^^^^^^^
   = known: {forces}

a.toml: 1 error"#,
    );
}

#[test]
fn unknown_shape() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
shape = "plumer"
count = 5
"#,
        &[],
        r#"error: unknown shape "plumer"
  --> a.toml:5:9
   |
 5 | shape = "plumer"
   |         ^^^^^^^^ did you mean "plummer"?
   = known: {shapes}

a.toml: 1 error"#,
    );
}

#[test]
fn unknown_choice() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
kind = "gravity"
kernel = "splin"
"#,
        &[],
        r#"error: unknown kernel "splin"
  --> a.toml:8:10
   |
 8 | kernel = "splin"
   |          ^^^^^^^ did you mean "spline"?
   = known: `plummer`, `spline`

a.toml: 1 error"#,
    );
}

#[test]
fn choice_not_a_word() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
kind = "gravity"
kernel = 3
"#,
        &[],
        "error: `kernel` must be one of `plummer`, `spline`, not 3
  --> a.toml:8:10
   |
 8 | kernel = 3
   |          ^

a.toml: 1 error",
    );
}

#[test]
fn unknown_color() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
color = "oragne"
"#,
        &[],
        r##"error: `color` must be a colour such as "#ffcc88" or "gold", not "oragne"
  --> a.toml:6:9
   |
 6 | color = "oragne"
   |         ^^^^^^^^ did you mean "orange"?

a.toml: 1 error"##,
    );
}

#[test]
fn short_color() {
    assert_report(
        r##"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
color = "#ffcc8"
"##,
        &[],
        r##"error: `color` must be a colour such as "#ffcc88" or "gold", not "#ffcc8"
  --> a.toml:6:9
   |
 6 | color = "#ffcc8"
   |         ^^^^^^^^ three or six digits, 0 to 9 and a to f

a.toml: 1 error"##,
    );
}
