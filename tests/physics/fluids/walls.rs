//! How heavy walls are, and what they do to a fluid that lies on them.

use glam::DVec3;
use motes::settings::Value;
use motes::{Bounds, Cpu, Side, Simulation, State};

use super::setup;
use crate::support::states::{force, phase, word};
use Value::Number;

const D: f64 = 0.1;

/// A layer of walls at y = 0 and above it, from a gap on, layers of fluid; periodic along the walls.
fn layers(flat: bool, gap: f64, fluid: usize) -> (State, Bounds, usize) {
    let n = 12;
    let mut particles = State::default();
    let volume = if flat { D * D } else { D * D * D };
    for j in 0..=fluid {
        let y = if j == 0 { 0.0 } else { gap + (j - 1) as f64 };
        for k in 0..if flat { 1 } else { n } {
            for i in 0..n {
                let z = if flat { 0.0 } else { k as f64 + 0.5 };
                particles.push(DVec3::new(i as f64 + 0.5, y, z) * D, DVec3::ZERO, 1000.0 * volume, 0.0);
            }
        }
    }
    let count = if flat { n } else { n * n };
    let held = (0..count as u32).map(|id| motes::motion::Held { id, by: motes::motion::Hold::Fixed });
    particles.held = held.collect();
    let (low, high) = (DVec3::ZERO, DVec3::splat(D * n as f64));
    let sides = [Side::Periodic, Side::Open, if flat { Side::Open } else { Side::Periodic }];
    (particles, Bounds { low, high, sides, dimensions: if flat { 2 } else { 3 } }, count)
}

fn fluid(kernel: &'static str, support: f64) -> Box<dyn motes::forces::Component> {
    let settings =
        [("spacing", Number(D)), ("support", Number(support)), ("sound_speed", Number(3.0)), ("kernel", word(kernel))];
    force("fluid", &settings)
}

/// Support in spacings; in space and in the plane: V / d^D, ρ / ρ₀ of the first fluid at a gap of d, and the gap in
/// spacings at which it is ρ₀. As an independent script has it, with the kernel as its integral is 1.
const LAYERS: [(f64, [[f64; 3]; 2]); 4] = [
    (2.0, [[1.427, 1.064, 1.098], [1.466, 1.075, 1.114]]),
    (2.4, [[1.715, 1.146, 1.214], [1.756, 1.157, 1.230]]),
    (3.0, [[2.136, 1.253, 1.397], [2.190, 1.267, 1.424]]),
    (4.0, [[2.857, 1.372, 1.726], [2.932, 1.380, 1.761]]),
];

#[test]
fn a_layer_weighs_what_the_fluid_in_its_place_does() {
    for (support, both) in LAYERS {
        for (flat, [volume, dense, gap]) in [(false, both[0]), (true, both[1])] {
            let sum = motes::sph::Smoothing::Cubic.lattice_sum(support, if flat { 2 } else { 3 });
            for (gap, want) in [(1.0, dense), (gap, 1.0)] {
                let (particles, bounds, walls) = layers(flat, gap, 5);
                let setup = setup(&particles, vec![fluid("cubic", support)], "leapfrog", 1e-9, bounds);
                let mut simulation =
                    Simulation::on(Cpu::new(particles.len() as u32).expect("some"), &setup).expect("a simulation");
                // The start is what weighs walls.
                simulation.step(1).expect("a step");
                let (x, _) = phase(&mut simulation);
                let weight = x[0].w / (1000.0 * D.powi(if flat { 2 } else { 3 }));
                // As many digits as there are. The kernel here is that by its sum.
                assert!((weight / sum - volume).abs() < 6e-4, "{support}, flat {flat}: {weight}");
                let density = match simulation.backend().host().get("density") {
                    Some(motes::kernel::Array::Float(all)) => all[walls],
                    other => panic!("{other:?}"),
                };
                // Gaps have three digits: half a unit of the last is 3e-4 of the density, by its slope of 0.6 there; and
                // most of the density is that of fluid, by the kernel's sum.
                let density = density / 1000.0;
                assert!(
                    (density - want).abs() < 1e-3 + (sum - 1.0).abs(),
                    "{support}, flat {flat}, gap {gap}: {density}, not {want}"
                );
            }
        }
    }
}
