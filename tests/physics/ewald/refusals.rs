//! Boxes in which there is no such sum, and trees over nearest images.

use glam::DVec3;
use motes::forces::{Component, Problem, Stage};
use motes::kernel::{Machine, Plan};
use motes::settings::Value;
use motes::{Bounds, Side};

use crate::ewald::{cube, gravity};
use crate::support::states::{force, word};

const MACHINE: Machine = Machine { software: true, subgroup: 8, invocations: 1, ..Machine::HOST };

/// Why a force is refused in a box, if it is.
pub fn refused(force: &dyn Component, bounds: Bounds) -> Option<String> {
    let problem = Problem::new(100, MACHINE).at(&[], bounds);
    force.stage(Stage::Evaluate { earlier: 0 }, &mut Plan::default(), &problem).err().map(|error| error.to_string())
}

#[test]
fn all_images_want_a_periodic_cube() {
    let cubic = cube(2.0);
    let force = gravity(1.0, 0.0, "pairs").swap_remove(0);
    assert_eq!(refused(force.as_ref(), cubic), None);
    let flat = Bounds { dimensions: 2, ..cubic };
    let long = Bounds { high: cubic.high + DVec3::X * 1e-3, ..cubic };
    let mirror = Bounds { sides: [Side::Periodic, Side::Reflecting, Side::Periodic], ..cubic };
    for (bounds, says) in [
        (Bounds::default(), "x open, y open, z open"),
        (long, "x periodic from -0.5 to 1.501"),
        (mirror, "y reflecting from 1 to 3"),
        (flat, "in the plane"),
    ] {
        let text = refused(force.as_ref(), bounds).unwrap_or_default();
        for part in [says, "images = \"ewald\"", "images = \"nearest\"", "[box]"] {
            assert!(text.contains(part), "{part} is not in: {text}");
        }
    }
}

#[test]
fn nearest_images_want_no_tree() {
    let with = |over: &'static str, images: &'static str| {
        force("gravity", &[("over", word(over)), ("images", word(images)), ("theta", Value::Number(0.6))])
    };
    for bounds in [cube(2.0), Bounds { sides: [Side::Open, Side::Periodic, Side::Open], ..cube(2.0) }] {
        let text = refused(with("tree", "nearest").as_ref(), bounds).unwrap_or_default();
        for part in ["over = \"tree\"", "periodic", "images = \"ewald\"", "over = \"pairs\""] {
            assert!(text.contains(part), "{part} is not in: {text}");
        }
        assert_eq!(refused(with("pairs", "nearest").as_ref(), bounds), None);
        // So few are summed over all pairs.
        assert_eq!(refused(with("auto", "nearest").as_ref(), bounds), None);
    }
    assert_eq!(refused(with("tree", "nearest").as_ref(), Bounds::default()), None);
    assert_eq!(refused(with("tree", "ewald").as_ref(), cube(2.0)), None);
}

/// The spline has no waves of its own.
#[test]
fn the_spline_is_refused() {
    let spline = force("gravity", &[("kernel", word("spline")), ("images", word("ewald"))]);
    let text = refused(spline.as_ref(), cube(2.0)).unwrap_or_default();
    assert!(text.contains("plummer"), "{text}");
}
