//! The panel: what its controls change.

use egui::{Key, Modifiers, PointerButton, Pos2, Vec2};
use motes::settings::Value;

use super::hand::Hand;
use super::small;

#[test]
fn a_slider_changes_the_force_while_the_run_goes_on() {
    let mut hand = Hand::on("plummer", &["particles.0.count=500"]);
    hand.frames(3);
    let softening = |hand: &mut Hand| hand.setting("gravity", "softening");
    let before = softening(&mut hand);
    let place = hand.place_beside("softening");
    hand.drag(place, Vec2::new(40.0, 0.0), PointerButton::Primary);
    let after = softening(&mut hand);
    let (Value::Number(before), Value::Number(after)) = (before, after) else { panic!("numbers") };
    assert!((after - before).abs() > 1e-3 * before, "{before} stays {after}");
    assert_eq!(hand.message(), "");
    let steps = hand.steps();
    hand.frames(3);
    assert_eq!(hand.steps(), steps + 3, "the run goes on");
    // Back to the settings of the scene.
    let place = hand.place("Scene");
    hand.click(place);
    hand.frames(1);
    assert_eq!(softening(&mut hand), Value::Number(before));
}

#[test]
fn what_kernels_depend_on_is_compiled_anew_and_said() {
    let mut hand = Hand::on("flock", &["particles.0.count=500"]);
    hand.frames(2);
    let before = hand.setting("boids", "range");
    // A force with many settings is folded at first.
    let place = hand.place("boids");
    hand.click(place);
    hand.frames(30);
    let place = hand.place_beside("range");
    hand.drag(place, Vec2::new(25.0, 0.0), PointerButton::Primary);
    assert_ne!(hand.setting("boids", "range"), before, "{}", hand.message());
    assert!(hand.message().contains("compiled anew"), "{}", hand.message());
    let steps = hand.steps();
    hand.frames(2);
    assert_eq!(hand.steps(), steps + 2, "the run goes on where it was");
}

/// What was changed by hand, given to another run, shows the same picture of the same forces.
#[test]
fn what_was_changed_is_written_as_values_of_the_command() {
    let particles = ["particles.0.count=200", "simulation.steps=1000"];
    let mut hand = Hand::on("plummer", &particles);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(2);
    assert_eq!(hand.changes(), [""; 0], "nothing was changed");
    let place = hand.place_beside("softening");
    hand.drag(place, Vec2::new(40.0, 0.0), PointerButton::Primary);
    hand.choose("background", "black");
    hand.drag(Pos2::new(250.0, 600.0), Vec2::new(60.0, 20.0), PointerButton::Primary);
    hand.wheel(Pos2::new(250.0, 600.0), 50.0);
    let changes = hand.changes();
    let keys: Vec<&str> = changes.iter().filter_map(|value| value.split('=').next()).collect();
    let camera = ["eye", "up", "projection", "auto_frame", "width", "height", "center", "extent"];
    let camera = camera.map(|key| format!("picture.{key}"));
    assert_eq!(keys, [&["force.0.softening", "picture.background"][..], &camera.each_ref().map(|key| &**key)].concat());
    hand.key(Key::R, Modifiers::NONE);
    hand.key(Key::C, Modifiers::NONE);
    assert!(hand.message().contains("10 values"), "{}", hand.message());
    let all: Vec<&str> = particles.into_iter().chain(changes.iter().map(String::as_str)).collect();
    let mut other = Hand::on("plummer", &all);
    other.key(Key::Space, Modifiers::NONE);
    // One step was made meanwhile.
    other.key(Key::R, Modifiers::NONE);
    other.frames(2);
    let softening = |hand: &mut Hand| hand.setting("gravity", "softening");
    assert_eq!(softening(&mut hand), softening(&mut other));
    hand.frames(2);
    let (one, two) = (hand.picture(), other.picture());
    let differ = one.iter().zip(&two).filter(|(a, b)| a.abs_diff(**b) > 8).count();
    assert!(one.len() == two.len() && differ < one.len() / 1000, "{differ} of {} bytes are others", one.len());
    // By the way back the camera is that of the scene.
    assert_eq!(other.changes(), [""; 0]);
}

#[test]
fn a_style_has_its_notes_wherever_it_is_chosen() {
    let mut hand = Hand::on("plummer", &["particles.0.count=2000"]);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(2);
    let noted = |hand: &Hand| hand.changes().contains(&"picture.annotate=true".to_owned());
    assert!(!noted(&hand));
    hand.choose("style", "density");
    assert!(noted(&hand), "{:?}", hand.changes());
    let place = hand.place_beside("annotate");
    hand.click(place);
    hand.frames(2);
    assert!(hand.changes().contains(&"picture.annotate=false".to_owned()), "{:?}", hand.changes());
    hand.choose("style", "balls");
    assert!(!noted(&hand), "{:?}", hand.changes());
}

/// The coefficients of pairs of species, and texts, have controls as numbers have.
#[test]
fn tables_and_texts_are_changed_in_the_panel() {
    let mut hand = Hand::on("salt", &["simulation.steps=10"]);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(2);
    let before = hand.setting("born_mayer", "pairs");
    let place = hand.place_beside("pairs");
    hand.drag(place, Vec2::new(30.0, 0.0), PointerButton::Primary);
    hand.frames(2);
    let after = hand.setting("born_mayer", "pairs");
    let (Value::Pairs(before), Value::Pairs(after)) = (&before, &after) else { panic!("tables") };
    let differ = before.iter().zip(after).flat_map(|(a, b)| a.values.iter().zip(&b.values)).filter(|(a, b)| a != b);
    assert_eq!(differ.count(), 1, "{}: {after:?}", hand.message());
    let changes = hand.changes();
    assert!(changes.iter().any(|value| value.starts_with("force.") && value.contains("species = [0, 0]")));
    // They are read back as they are.
    let all: Vec<&str> = std::iter::once("simulation.steps=10").chain(changes.iter().map(String::as_str)).collect();
    assert_eq!(Hand::on("salt", &all).setting("born_mayer", "pairs"), Value::Pairs(after.clone()));
}

/// Values beyond the ends of a slider, and with more digits than it shows, stay as they are until they are moved.
#[test]
fn what_is_shown_is_not_changed_by_that() {
    let values = [
        "picture.size=50",
        "picture.exposure=0.01",
        "picture.bloom=9.1234",
        "picture.tail=30",
        "force.0.softening=0.0123456789",
    ];
    let mut hand = Hand::on("plummer", &[&["particles.0.count=50"][..], &values].concat());
    hand.frames(5);
    assert_eq!(hand.changes(), [""; 0]);
    // A pace is halved and doubled, also where the slider would show whole numbers alone.
    let pace = hand.number_beside("steps / s");
    (0..9).for_each(|_| hand.key(Key::OpenBracket, Modifiers::NONE));
    hand.frames(2);
    assert!(pace > 30.0 * hand.number_beside("steps / s"), "{pace}");
    (0..9).for_each(|_| hand.key(Key::CloseBracket, Modifiers::NONE));
    hand.frames(2);
    assert!((hand.number_beside("steps / s") / pace - 1.0).abs() < 1e-9, "{pace}");
}

/// Sliders have the size of what they show: atoms in metres, kilograms and joules.
#[test]
fn sliders_work_in_any_unit() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("atoms.toml");
    let text = "[simulation]\ndt = 2e-15\nsteps = 100\n[box]\nlow = [0, 0, 0]\nsize = [4e-9, 4e-9, 4e-9]\nboundary = \"periodic\"\n\
                [[particles]]\nshape = \"block\"\nspacing = 4e-10\nsize = [2e-9, 2e-9, 2e-9]\ncenter = [2e-9, 2e-9, 2e-9]\n\
                density = 1036\n[[force]]\nkind = \"lennard_jones\"\nepsilon = 1.65e-21\nsigma = 3.4e-10\nrange = 9e-10\n";
    std::fs::write(&scene, text).expect("a scene");
    let mut hand = Hand::on(scene.to_str().expect("a path"), &[]);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(2);
    for name in ["epsilon", "sigma"] {
        let number = |value| if let Value::Number(x) = value { x } else { panic!("a number") };
        let before = number(hand.setting("lennard_jones", name));
        assert!((1.0..10.0).contains(&hand.number_beside(name)), "in units of its own size");
        // A press moves it to the pointer; a changed value has a button before it.
        let mut dragged = |points| {
            let place = hand.place_beside(name);
            hand.drag(place, Vec2::new(points, 0.0), PointerButton::Primary);
            hand.frames(2);
            number(hand.setting("lennard_jones", name)) / before
        };
        let (near, far) = (dragged(8.0), dragged(20.0));
        assert!(1e-3 < near && near < far && far < 100.0 && far / near < 100.0, "{name}: {near} {far} times {before}");
    }
}

/// A text is set when it is finished; until then its letters are no shortcuts, and what is unknown is refused.
#[test]
fn a_text_is_set_when_it_is_finished() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("bodies.toml");
    let text = "[simulation]\ndt = 0.01\nsteps = 10\n[[motion]]\nname = \"turning\"\nkeys = [{ time = 0 }, { time = 1, turn = [0, 0, 90] }]\n\
                [[particles]]\nbodies = [{ position = [0, 0, 2] }]\n[[particles]]\nbodies = [{ position = [1, 0, 2] }]\nfixed = \"all\"\n\
                motion = \"turning\"\n[[force]]\nkind = \"solid\"\n";
    std::fs::write(&scene, text).expect("a scene");
    let mut hand = Hand::on(scene.to_str().expect("a path"), &[]);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(2);
    let steps = hand.steps();
    let header = hand.place("solid");
    hand.click(header);
    hand.frames(30);
    for (text, now) in [("upturned", ""), ("turning", "turning")] {
        let field = hand.place_beside("motion");
        hand.click(field);
        hand.write(text);
        hand.frames(2);
        assert_eq!(hand.setting("solid", "motion"), Value::from(now), "{text}: {}", hand.message());
        assert_eq!(hand.message().contains("upturned"), text == "upturned", "{}", hand.message());
    }
    assert_eq!(hand.steps(), steps, "a letter was taken for a key of the viewer");
    assert_eq!(hand.changes(), ["force.0.motion=\"turning\""]);
}

/// The density of a fluid is one of its particles, too, where a scene is read. What is changed by hand leaves them as they are.
#[test]
fn a_density_that_was_changed_leaves_the_particles_of_the_scene_as_they_are() {
    let coarse = ["force.1.spacing=0.05"];
    let mut hand = Hand::on("dam_break_2d", &coarse);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(2);
    let header = hand.place("fluid");
    hand.click(header);
    hand.frames(30);
    let place = hand.place_beside("density");
    hand.drag(place, Vec2::new(20.0, 0.0), PointerButton::Primary);
    hand.frames(2);
    let changes = hand.changes();
    assert!(changes[0].starts_with("force.1.density=") && changes.len() > 1, "{changes:?} {}", hand.message());
    assert!(changes[1..].iter().all(|value| value.ends_with(".density=1000.0")), "{changes:?}");
    let all: Vec<&str> = coarse.into_iter().chain(changes.iter().map(String::as_str)).collect();
    let mut other = Hand::on("dam_break_2d", &all);
    assert_eq!(hand.setting("fluid", "density"), other.setting("fluid", "density"));
    assert_ne!(hand.setting("fluid", "density"), Value::Number(1000.0));
    assert_eq!(hand.masses(), other.masses());
}

/// Measures that are looked at are taken and plotted, those of flocks too.
#[test]
fn measures_are_plotted_while_they_are_looked_at() {
    let mut hand = Hand::on("vicsek", small::smaller("vicsek"));
    hand.frames(2);
    for header in ["Measures", "flock"] {
        let place = hand.place(header);
        hand.click(place);
        hand.frames(30);
    }
    let steps = hand.steps();
    hand.until(steps + 30);
    for cell in ["kinetic", "order", "clusters"] {
        hand.place(cell);
    }
    let place = hand.place("clusters");
    hand.click(place);
    hand.frames(5);
    assert_eq!(hand.message(), "");
}

#[test]
fn the_panel_has_the_letters_of_all_scenes() {
    let hand = Hand::on("plummer", &["particles.0.count=10"]);
    for scene in motes::scene::SCENES {
        let missing: String = scene.about().chars().filter(|c| !hand.can_write(&c.to_string())).collect();
        assert_eq!(missing, "", "{}", scene.name);
    }
    assert!(!hand.can_write("ξ₁ᵢ"));
}
