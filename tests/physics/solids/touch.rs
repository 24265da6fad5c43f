//! Contacts that are where rounding decides.

use glam::DVec3;
use motes::kernel::Backend;
use motes::lockstep::compare;
use motes::{Gpu, Simulation, State};

use crate::solids::{number, setup, solid};
use crate::support::states::vector;

/// Particles that rest on a solid are where its surface is, up to rounding: whether they touch it there is undecided.
#[test]
fn particles_at_rest_at_the_touch_are_not_wrong() {
    let shared = crate::support::device();
    let mut particles = State::default();
    for i in 0..64u16 {
        // On the surface at 0.01 and the next numbers above and below it, on their way down.
        let height = f32::from_bits(0.01f32.to_bits() - 3 + u32::from(i % 7));
        let weighs = if i % 2 == 0 { 1.0 } else { 2.0 };
        particles.push(DVec3::new(f64::from(i) * 0.01, f64::from(height), 0.0), DVec3::NEG_Y * weighs, 1.0, 0.0);
    }
    let settings = [
        ("position", vector(0.3, -0.05, 0.0)),
        ("size", vector(1.4, 0.1, 1.0)),
        ("thickness", number(0.01)),
        ("friction", number(0.0)),
    ];
    let setup = setup(particles, vec![solid("box", &settings)], "leapfrog", 1e-9);
    let gpu: Gpu = crate::support::machines::gpu(&shared, 64);
    let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
    let plan = setup.plans(simulation.backend().machine()).expect("plans").step;
    let verdicts = pollster::block_on(compare(simulation.backend(), &plan, 64)).expect("verdicts");
    let touch = |field: &str| verdicts.iter().find(|v| v.kernel == "solid" && v.field == field).expect("a verdict");
    assert!(verdicts.iter().all(motes::lockstep::Verdict::sound), "{verdicts:?}");
    assert!(
        !touch("velocity").good() && touch("velocity").changed,
        "{:?}: no particle is at the touch",
        touch("velocity")
    );
}
