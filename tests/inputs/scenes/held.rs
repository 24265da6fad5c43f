//! Fixed particles and motions in scenes: what they become, and what is wrong with them, whole as a user reads it.

use motes::motion::{Held, Hold};

use crate::scenes::report;

fn load(text: &str) -> motes::scene::Scene {
    crate::scenes::load(text, &[]).unwrap_or_else(|faults| panic!("{faults}"))
}

fn faults(text: &str) -> motes::scene::Diagnostics {
    report(text, &[])
}

const HEAD: &str = "[simulation]\ndt = 0.1\nsteps = 2\n";

#[test]
fn what_a_scene_holds() {
    let text = format!(
        "{HEAD}
[[motion]]
name = \"to and fro\"
about = [1, 0, 0]
smooth = true
repeat = true
keys = [{{ time = 0.5 }}, {{ time = 1, shift = [0, 1, 0], turn = [0, 0, 180] }}, {{ time = 2, turn = [0, 0, 360] }}]
[[particles]]
bodies = [{{ position = [0, 0, 0], fixed = true }}, {{ position = [1, 0, 0] }}, {{ position = [2, 0, 0] }}]
fixed = [2]
[[particles]]
shape = \"lattice\"
size = [2, 2, 1]
spacing = 1
fixed = [3, 0]
motion = \"to and fro\"
[[force]]
kind = \"solid\"
motion = \"to and fro\"
"
    );
    let scene = load(&text);
    let held = |id, by| Held { id, by };
    let want = [held(0, Hold::Fixed), held(2, Hold::Fixed), held(6, Hold::Motion(0)), held(3, Hold::Motion(0))];
    assert_eq!(scene.particles.held, want);
    let motion = &scene.particles.motions[0];
    assert!(motion.smooth && motion.repeat && motion.about.x == 1.0 && motion.keys[0].time == 0.5);
    assert!((motion.keys[1].turn.z - std::f64::consts::PI).abs() < 1e-15);
    // Written back, it is the same scene.
    let again = load(&scene.resolved);
    assert_eq!(again.particles, scene.particles);
    let motion = |text: &str| text.split_once("[[motion]]").expect("a motion").1.to_owned();
    assert_eq!(motion(&again.resolved), motion(&scene.resolved));
}

/// All of an entry, be some of them fixed already.
#[test]
fn all_are_fixed_by_a_word() {
    let text = format!(
        "{HEAD}[[motion]]\nname = \"grip\"\nkeys = [{{ time = 1 }}]\n[[particles]]\nbodies = [{{ position = [9, 0, 0] }}]\n\
         [[particles]]\nbodies = [{{ position = [0, 0, 0] }}, {{ position = [1, 0, 0], fixed = true }}, {{ position = [2, 0, 0] }}]\n\
         fixed = \"all\"\nmotion = \"grip\"\n"
    );
    let scene = load(&text);
    let mut ids: Vec<u32> = scene.particles.held.iter().map(|held| held.id).collect();
    ids.sort_unstable();
    assert_eq!(ids, [1, 2, 3]);
    assert!(scene.particles.held.iter().all(|held| held.by == Hold::Motion(0)));
    let again = load(&scene.resolved);
    assert_eq!(again.particles, scene.particles);
    let said = faults(&text.replace("\"all\"", "\"some\"")).to_string();
    assert!(said.contains("`fixed` must be \"all\", or a list of whole numbers"), "{said}");
}

#[test]
fn what_is_wrong_with_them() {
    let text = format!(
        "{HEAD}
[[motion]]
name = \"lift\"
keys = [{{ time = 1 }}, {{ time = 1, shift = [0, 1, 0] }}]
[[motion]]
name = \"lift\"
keys = [{{ shift = [0, 1, 0] }}]
[[motion]]
name = \"jump\"
repeat = true
keys = [{{ time = 1 }}, {{ time = 2, shift = [0, 1, 0] }}]
[[particles]]
bodies = [{{ position = [0, 0, 0], fixed = true }}]
fixed = [0, 1, 0.5]
[[particles]]
bodies = [{{ position = [0, 0, 0] }}]
motion = \"lit\"
"
    );
    let said = faults(&text).to_string();
    for words in [
        "a keyframe at 1 comes after one at 1",
        "two motions are called \"lift\"",
        "a keyframe lacks `time`",
        "the motion \"jump\" repeats, and its last keyframe differs from its first",
        "particle 0 is fixed already",
        "there is no particle 1 in [[particles]]",
        "`fixed` must be a list of whole numbers, zero or above, not 0.5",
    ] {
        assert!(said.contains(words), "`{words}` is not in\n{said}");
    }
    let good =
        "[[motion]]\nname = \"lift\"\nkeys = [{ time = 0 }]\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n";
    let said =
        faults(&format!("{HEAD}{good}motion = \"lit\"\n[[force]]\nkind = \"solid\"\nmotion = \"lft\"\n")).to_string();
    assert_eq!(said.matches("did you mean \"lift\"?").count(), 2, "{said}");
    let said = faults(&format!("{HEAD}{good}motion = \"lift\"\n")).to_string();
    assert!(said.contains("no particle in [[particles]] is fixed, so the motion moves nothing"), "{said}");
    let said =
        faults(&format!("{HEAD}[[particles]]\nbodies = [{{ position = [0, 0, 0] }}]\nmotion = \"lift\"\n")).to_string();
    assert!(said.contains("there is no motion \"lift\"") && said.contains("add\n\n         [[motion]]"), "{said}");
}
