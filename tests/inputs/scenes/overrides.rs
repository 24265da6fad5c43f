//! Overrides from the command line. Each text is what a user reads, whole.

use crate::scenes::assert_report;

#[test]
fn override_of_wrong_type() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &["simulation.dt=abc"],
        r#"error: `dt` must be a number above zero, not the text "abc"
  --> the command line
   |
   | --set simulation.dt=abc
   |                     ^^^

a.toml: 1 error"#,
    );
}

#[test]
fn override_of_unknown_key() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &["simulation.dtt=0.1"],
        "error: unknown key `dtt` in [simulation]
  --> the command line
   |
   | --set simulation.dtt=0.1
   |                  ^^^ did you mean `dt`?
   = known here: `steps`, `until`, `until_redshift`, `integrator`, `dt`, `adaptive`, `dt_min`, `dt_before`, `cfl`, `block_levels`, `block_eta`, `block_length`, `block_mass`, `block_shared`, `precision`

a.toml: 1 error",
    );
}

#[test]
fn override_of_unknown_section() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &["simulaton.dt=0.1"],
        "error: unknown section `simulaton`
  --> the command line
   |
   | --set simulaton.dt=0.1
   |       ^^^^^^^^^ did you mean [simulation]?
   = the sections are [simulation], [solver], [box], [plan], [[motion]], [[column]], [[particles]], [[emitter]], [[drain]], [[links]], [[force]], [output], [[measure]], [checkpoint], [picture]

a.toml: 1 error",
    );
}

#[test]
fn override_without_value() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &["simulation.dt"],
        "error: an override has the form key=value
  --> the command line
   |
   | --set simulation.dt
   |       ^^^^^^^^^^^^^
   = help: for example --set simulation.dt=0.01 or --set force.0.g=2, where 0 is the first [[force]]

a.toml: 1 error",
    );
}

#[test]
fn override_without_section() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &["dt=0.01"],
        "error: `dt` names no section
  --> the command line
   |
   | --set dt=0.01
   |       ^^ write simulation.dt

a.toml: 1 error",
    );
}

#[test]
fn override_beyond_the_list() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
kind = "gravity"
"#,
        &["force.1.g=2"],
        "error: there is no `force.1`
  --> the command line
   |
   | --set force.1.g=2
   |             ^ `force` has 1, counted from 0

a.toml: 1 error",
    );
}

#[test]
fn override_without_index() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
kind = "gravity"
"#,
        &["force.g=2"],
        "error: `force` is a list, so its entries are numbered
  --> the command line
   |
   | --set force.g=2
   |             ^ write force.0.g for the first

a.toml: 1 error",
    );
}

#[test]
fn override_of_no_list() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &["force.0.g=2"],
        "error: the scene has no [[force]]
  --> the command line
   |
   | --set force.0.g=2
   |       ^^^^^
   = help: an override changes what is in the scene, and cannot add an entry to a list

a.toml: 1 error",
    );
}

#[test]
fn override_inside_a_number() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &["simulation.dt.x=2"],
        "error: `simulation.dt` is 0.1, not a section
  --> the command line
   |
   | --set simulation.dt.x=2
   |                     ^

a.toml: 1 error",
    );
}

#[test]
fn override_that_is_not_toml() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &["output.formats=[\"csv\""],
        r#"error: this is not a TOML value: unclosed array, expected `]`
  --> the command line
   |
   | --set output.formats=["csv"
   |                      ^^^^^^
   = help: a number, true or false, "text", or a list such as [1, 0, 0]

a.toml: 1 error"#,
    );
}

#[test]
fn override_with_nothing() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &["simulation.dt="],
        "error: there is no value after the `=`
  --> the command line
   |
   | --set simulation.dt=
   |                     ^
   = help: for example --set simulation.dt=0.01 or --set force.0.g=2, where 0 is the first [[force]]

a.toml: 1 error",
    );
}

#[test]
fn faults_of_scene_and_overrides() {
    assert_report(
        "[simulation]
dt = 0
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &["output.every=0", "simulation.integrator=rk5"],
        r#"error: `dt` must be a number above zero, not 0
  --> a.toml:2:6
   |
 2 | dt = 0
   |      ^

error: `every` must be a whole number, one or above, not 0
  --> the command line
   |
   | --set output.every=0
   |                    ^

error: unknown integrator "rk5"
  --> the command line
   |
   | --set simulation.integrator=rk5
   |                             ^^^ did you mean "rk4"?
   = known: {integrators}

a.toml: 3 errors"#,
    );
}
