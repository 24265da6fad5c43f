//! Motions by themselves: what their keys say, and which ones are refused.

use std::f64::consts::PI;

use glam::DVec3;
use motes::kernel::Bounds;
use motes::motion::{Held, Hold};
use motes::{Setup, State};

use crate::pins::{motions, pinned, setup};

#[test]
fn what_makes_no_sense_is_refused() {
    let refused = |change: &dyn Fn(&mut State), words: &str| {
        let mut particles = pinned(12);
        change(&mut particles);
        let error = setup(particles, "leapfrog").check().expect_err(words).to_string();
        assert!(error.contains(words), "{error} does not say `{words}`");
    };
    refused(&|p| p.held[0].id = 12, "particle 12 is fixed, but there are 12");
    refused(&|p| p.held[0].id = 0, "particle 0 is fixed twice");
    refused(&|p| p.held[0].by = Hold::Motion(5), "motion 5, but there are 5");
    refused(&|p| p.motions[1].name = "pulled".to_owned(), "two motions are called \"pulled\"");
    refused(&|p| p.motions[1].keys.clear(), "has no keyframes");
    refused(&|p| p.motions[1].keys[1].time = -0.1, "times must increase");
    refused(&|p| p.motions[1].keys[1].turn.x = f64::NAN, "NaN");
    refused(&|p| p.motions[1].keys[2].time = 1e9, "steps away");
    refused(&|p| p.motions[1].about.y = 1e39, "finite numbers");
    refused(&|p| p.motions[1].repeat = true, "it would jump");
    refused(&|p| p.motions[3].keys[1].time = 0.021, "less than a step");
    let mut flat = State::default();
    flat.push(DVec3::X, DVec3::ZERO, 1.0, 0.0);
    flat.motions = motions();
    let bounds = Bounds { dimensions: 2, ..Bounds::default() };
    let error = Setup { bounds, ..setup(flat, "leapfrog") }.check().expect_err("out of the plane").to_string();
    assert!(error.contains("leaves the plane"), "{error}");
}

#[test]
fn sets_of_particles_keep_their_own_motions() {
    let mut both = pinned(12);
    both.append(&pinned(12)).expect("one kind");
    assert_eq!(both.motions.len(), 10);
    assert_eq!(both.held[9], Held { id: 19, by: Hold::Motion(5) });
}

/// A pose and its rates: by hand, and by differences.
#[test]
fn a_motion_is_what_its_keys_say() {
    let all = motions();
    let half = all[2].pose(0.2);
    assert!(
        (half.turn * DVec3::X - DVec3::new(0.0, 0.0, -1.0)).length() < 1e-12,
        "2.5 π about y: {}",
        half.turn * DVec3::X
    );
    assert!((half.spin - DVec3::Y * 12.5 * PI).length() < 1e-12);
    assert!((all[0].pose(0.18).shift - 0.5 * DVec3::new(0.7, -0.2, 0.4)).length() < 1e-12);
    assert_eq!(all[0].pose(9.0).velocity, DVec3::ZERO);
    assert_eq!(all[0].pose(0.0).velocity, DVec3::ZERO);
    // A quarter of the way in time is 5/32 of the way, gently.
    let gentle = all[1].pose(0.1 + 0.25 * 0.17).shift;
    assert!((gentle - DVec3::new(0.4, 0.3, -0.2).lerp(DVec3::new(-0.3, 0.1, 0.2), 5.0 / 32.0)).length() < 1e-12);
    for motion in &all {
        for time in [0.033, 0.09, 0.14, 0.2, 0.5] {
            let (h, home) = (1e-6, DVec3::new(0.3, -0.6, 0.9));
            let (pose, x) = (motion.pose(time), motion.place(home, time));
            let by_rate = pose.velocity + pose.spin.cross(x - motion.about - pose.shift);
            let by_difference = (motion.place(home, time + h) - motion.place(home, time - h)) / (2.0 * h);
            // The third derivative of a turn at 66 / s, and rounding: 1e-16 / h.
            assert!((by_rate - by_difference).length() < 1e-6, "{} at {time}: {by_rate}, {by_difference}", motion.name);
        }
    }
}
