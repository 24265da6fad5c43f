//! What is not given, or given twice over. Each text is what a user reads, whole.

use crate::scenes::assert_report;

#[test]
fn missing_section() {
    assert_report(
        "[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: the section [simulation] is missing
  --> a.toml
   = help: add

         [simulation]
         dt = 0.001
         steps = 1000

a.toml: 1 error",
    );
}

#[test]
fn missing_particles() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
",
        &[],
        r#"error: there are no particles
  --> a.toml
   = help: add

         [[particles]]
         shape = "plummer"
         count = 1000

a.toml: 1 error"#,
    );
}

#[test]
fn missing_key() {
    assert_report(
        "[simulation]
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: [simulation] lacks `dt`
  --> a.toml:1:1
   |
 1 | [simulation]
   | ^^^^^^^^^^^^ add `dt`, a number above zero: the length of a step, of the longest where they are adaptive [time]

a.toml: 1 error",
    );
}

#[test]
fn missing_key_of_a_shape() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
shape = "plummer"
"#,
        &[],
        "error: [[particles]] plummer lacks `count`
  --> a.toml:4:1
   |
 4 | [[particles]]
   | ^^^^^^^^^^^^^ add `count`, a whole number, one or above: number of particles

a.toml: 1 error",
    );
}

#[test]
fn neither_steps_nor_until() {
    assert_report(
        "[simulation]
dt = 0.1
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: [simulation] needs one of `steps`, `until`, `until_redshift`
  --> a.toml:1:1
   |
 1 | [simulation]
   | ^^^^^^^^^^^^

a.toml: 1 error",
    );
}

#[test]
fn both_steps_and_until() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
until = 1.0
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: [simulation] has both `steps` and `until`
  --> a.toml:4:1
   |
 4 | until = 1.0
   | ^^^^^ remove one of them

a.toml: 1 error",
    );
}

#[test]
fn neither_file_nor_shape_nor_bodies() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
color = "red"
"#,
        &[],
        "error: [[particles]] needs one of `file`, `shape`, `bodies`
  --> a.toml:4:1
   |
 4 | [[particles]]
   | ^^^^^^^^^^^^^

a.toml: 1 error",
    );
}

#[test]
fn all_of_file_shape_and_bodies() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
file = "a.csv"
shape = "plummer"
bodies = []
"#,
        &[],
        r#"error: [[particles]] has both `file` and `shape`
  --> a.toml:6:1
   |
 6 | shape = "plummer"
   | ^^^^^ remove one of them

error: [[particles]] has both `file` and `bodies`
  --> a.toml:7:1
   |
 7 | bodies = []
   | ^^^^^^ remove one of them

a.toml: 2 errors"#,
    );
}

#[test]
fn a_law_without_over() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
wgsl = "swirl.wgsl"
"#,
        &[],
        r#"error: [[force]] wgsl lacks `over`
  --> a.toml:6:1
   |
 6 | [[force]]
   | ^^^^^^^^^ add `over`, one of `each`, `pairs`, `within`, `near`, `list`, `nearest`, `tree`, `auto`, `links`, `joints`, `dihedrals`, `triangles`: which pairs are evaluated

error: there is no file swirl.wgsl
  --> a.toml:7:8
   |
 7 | wgsl = "swirl.wgsl"
   |        ^^^^^^^^^^^^
   = it is sought at tests/inputs/scenes/swirl.wgsl

a.toml: 2 errors"#,
    );
}

#[test]
fn a_law_with_another_reach_than_it_needs() {
    let scene = |over: &str, more: &str| {
        format!(
            "[simulation]\ndt = 0.1\nsteps = 10\n[[particles]]\nbodies = [{{ position = [0, 0, 0] }}]\n[[force]]\nover = \"{over}\"\n{more}wgsl = \"missing.rs\"\n"
        )
    };
    let missing = |wanted: &str| format!("error: [[force]] wgsl lacks {wanted}\n\na.toml: 1 error");
    assert_report(
        &scene("near", ""),
        &[],
        &missing(
            "`range`\n  --> a.toml:6:1\n   |\n 6 | [[force]]\n   | ^^^^^^^^^ add `range`, a number above zero: the cut-off radius [length]",
        ),
    );
    assert_report(
        &scene("nearest", ""),
        &[],
        &missing(
            "`neighbors`\n  --> a.toml:6:1\n   |\n 6 | [[force]]\n   | ^^^^^^^^^ add `neighbors`, a whole number, one or above: the number of neighbours",
        ),
    );
    assert_report(
        &scene("each", "range = 2\n"),
        &[],
        "error: a law over \"each\" does not use `range`\n  --> a.toml:8:1\n   |\n 8 | range = 2\n   | ^^^^^ remove it, or change `over`\n\na.toml: 1 error",
    );
    assert_report(
        &scene("within", "range = 0\n"),
        &[],
        "error: `range` must be a number above zero, not 0\n  --> a.toml:8:9\n   |\n 8 | range = 0\n   |         ^\n\na.toml: 1 error",
    );
}
