//! What is not given, or given twice over. Each text is what a user reads, whole.

use crate::assert_report;

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
   | ^^^^^^^^^^^^ add `dt`, a number above zero: the length of a step [time]

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
        "error: [simulation] needs one of `steps`, `until`
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
   | ^^^^^^^^^ add `over`, one of `each`, `pairs`, `within`, `near`, `nearest`: who meets whom

error: there is no file swirl.wgsl
  --> a.toml:7:8
   |
 7 | wgsl = "swirl.wgsl"
   |        ^^^^^^^^^^^^
   = it is sought at tests/scenes/swirl.wgsl

a.toml: 2 errors"#,
    );
}
