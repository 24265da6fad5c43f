//! Keys and sections: unknown, missing, in the wrong place. Each text is what a user reads, whole.

use motes::scene::{Options, Scene, Source};

use crate::scenes::assert_report;

#[test]
fn unknown_key() {
    assert_report(
        "[simulation]
dt = 0.1
stepps = 10
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: unknown key `stepps` in [simulation]
  --> a.toml:3:1
   |
 3 | stepps = 10
   | ^^^^^^ did you mean `steps`?
   = known here: `steps`, `until`, `until_redshift`, `integrator`, `dt`, `adaptive`, `dt_min`, `dt_before`, `cfl`, `block_levels`, `block_eta`, `block_length`, `block_mass`, `block_shared`, `precision`

a.toml: 1 error",
    );
}

#[test]
fn unknown_key_of_a_force() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
kind = "gravity"
sofening = 0.05
"#,
        &[],
        "error: unknown key `sofening` in [[force]] gravity
  --> a.toml:8:1
   |
 8 | sofening = 0.05
   | ^^^^^^^^ did you mean `softening`?
   = known here: `kind`, `g`, `softening`, `kernel`, `individual_softening`, `over`, `theta`, `alpha`, `images`, `accuracy`, `multipoles`, `hubble`, `omega_matter`, `omega_lambda`, `redshift`

a.toml: 1 error",
    );
}

#[test]
fn key_of_another_section() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
every = 5
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: unknown key `every` in [simulation]
  --> a.toml:4:1
   |
 4 | every = 5
   | ^^^^^ it belongs in [output]
   = known here: `steps`, `until`, `until_redshift`, `integrator`, `dt`, `adaptive`, `dt_min`, `dt_before`, `cfl`, `block_levels`, `block_eta`, `block_length`, `block_mass`, `block_shared`, `precision`

a.toml: 1 error",
    );
}

#[test]
fn key_of_another_force() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
kind = "drag"
linear = 0.1
acceleration = [0, 0, 1]
"#,
        &[],
        "error: unknown key `acceleration` in [[force]] drag
  --> a.toml:9:1
   |
 9 | acceleration = [0, 0, 1]
   | ^^^^^^^^^^^^
   = known here: `kind`, `linear`, `quadratic`, `wind`, `over`

a.toml: 1 error",
    );
}

#[test]
fn unknown_key_of_a_shape() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
shape = "plummer"
count = 10
sede = 3
"#,
        &[],
        "error: unknown key `sede` in [[particles]] plummer
  --> a.toml:7:1
   |
 7 | sede = 3
   | ^^^^ did you mean `seed`?
   = known here: `shape`, `color`, `species`, `fixed`, `motion`, `count`, `seed`, `mass`, `scale`, `g`, `cutoff`, `center`, `velocity`, `particle_size`

a.toml: 1 error",
    );
}

#[test]
fn unknown_key_of_a_body() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0], speed = [1, 0, 0] }]
",
        &[],
        "error: unknown key `speed` in a body
  --> a.toml:5:35
   |
 5 | bodies = [{ position = [0, 0, 0], speed = [1, 0, 0] }]
   |                                   ^^^^^ it belongs in [[particles]]
   = known here: `position`, `velocity`, `mass`, `size`, `species`, `fixed`

a.toml: 1 error",
    );
}

#[test]
fn unknown_section() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[forces]
g = 1.0
",
        &[],
        "error: unknown section `forces`
  --> a.toml:6:2
   |
 6 | [forces]
   |  ^^^^^^ did you mean [[force]]?
   = the sections are [simulation], [solver], [box], [plan], [[motion]], [[column]], [[particles]], [[emitter]], [[drain]], [[links]], [[force]], [output], [[measure]], [checkpoint], [picture]

a.toml: 1 error",
    );
}

#[test]
fn unknown_section_like_no_other() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[gpu]
name = "H200"
"#,
        &[],
        "error: unknown section `gpu`
  --> a.toml:6:2
   |
 6 | [gpu]
   |  ^^^
   = the sections are [simulation], [solver], [box], [plan], [[motion]], [[column]], [[particles]], [[emitter]], [[drain]], [[links]], [[force]], [output], [[measure]], [checkpoint], [picture]

a.toml: 1 error",
    );
}

#[test]
fn single_brackets() {
    assert_report(
        r#"[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[force]
kind = "gravity"
"#,
        &[],
        "error: there can be several [[force]], so it is written in double brackets
  --> a.toml:6:1
   |
 6 | [force]
   | ^^^^^^^ write [[force]]

a.toml: 1 error",
    );
}

#[test]
fn double_brackets() {
    assert_report(
        "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[output]]
every = 5
",
        &[],
        "error: there is only one [output], so it is written in single brackets
  --> a.toml:6:1
   |
 6 | [[output]]
   | ^^^^^^^^^^ write [output]

a.toml: 1 error",
    );
}

#[test]
fn key_outside_of_sections() {
    assert_report(
        "dt = 0.1
[simulation]
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
",
        &[],
        "error: the key `dt` is outside of every section
  --> a.toml:1:1
   |
 1 | dt = 0.1
   | ^^ it belongs below [simulation]

error: [simulation] lacks `dt`
  --> a.toml:2:1
   |
 2 | [simulation]
   | ^^^^^^^^^^^^ add `dt`, a number above zero: the length of a step, of the longest where they are adaptive [time]

a.toml: 2 errors",
    );
}

/// Each at its key, and a force of another kind is no fluid beside which there could not be one.
#[test]
fn settings_of_a_force_that_contradict_each_other() {
    assert_report(
        r#"[simulation]
dt = 0.001
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }]
[[force]]
kind = "boids"
range = 0.3
separation_range = 0.5
[[force]]
kind = "fluid"
spacing = 0.1
density = 1
sound_speed = 10
"#,
        &[],
        "error: boids have separation_range = 0.5 and range = 0.3: no neighbour is seen beyond the range; choose a smaller separation_range, or a larger range
  --> a.toml:9:20
   |
 9 | separation_range = 0.5
   |                    ^^^

a.toml: 1 error",
    );
}

/// A skin that no list has is remarked on, with its number and what would use it.
#[test]
fn a_skin_without_a_list_is_remarked_on() {
    let remarks = |over: &str, skin: &str| {
        let set = [format!("force.0.over={over}"), format!("force.0.skin={skin}")];
        let source = Source::find("argon").expect("a built-in scene");
        let scene = Scene::load(&source, &set, &Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
        scene.remarks
    };
    let near = remarks("near", "0.25");
    assert!(near.len() == 1 && near[0].contains("skin = 0.25") && near[0].contains("\"near\""), "{near:?}");
    assert_eq!(remarks("within", "0.25").len(), 1);
    for (over, skin) in [("list", "0.25"), ("auto", "0.25"), ("near", "0")] {
        assert_eq!(remarks(over, skin), Vec::<String>::new(), "{over} {skin}");
    }
}

/// Bonded pairs are left out where there are no bonds: nothing is, and that is remarked on.
#[test]
fn pairs_to_leave_out_of_a_scene_without_bonds_are_remarked_on() {
    let remarks = |name: &str, number: usize, bonds: u32| {
        let set = [format!("force.{number}.over=list"), format!("force.{number}.exclude={bonds}")];
        let source = Source::find(name).expect("a built-in scene");
        let scene = Scene::load(&source, &set, &Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
        assert_eq!(scene.forces[number].laws()[0].exclude, bonds, "{name}");
        scene.remarks
    };
    let said = remarks("argon", 0, 2);
    assert!(said.len() == 1 && said[0].contains("`exclude`") && said[0].contains("no pair is left out"), "{said:?}");
    assert_eq!(remarks("argon", 0, 0), Vec::<String>::new());
    // Those of `polymer` are bonded.
    assert_eq!(remarks("polymer", 0, 1), Vec::<String>::new());
}
