//! Forces in a periodic box: the nearest image, on every machine.

use glam::{DVec3, DVec4};
use motes::forces::{Component, Problem};
use motes::integrators::Step;
use motes::kernel::Backend;
use motes::lockstep::{Verdict, compare};
use motes::settings::Value;
use motes::{Bounds, Side, Simulation, State};

use crate::boundary::{odd, scattered, setup};
use crate::support::machines::{gpu, machines};
use crate::support::states::{accelerations_in, force, one, word};
use crate::support::{self, choices};

#[test]
fn every_law_in_a_periodic_box() {
    let shared = support::device();
    // A particle far from an obstacle in one box may be near it in another.
    let mut busy = Vec::new();
    for sides in [[Side::Periodic; 3], [Side::Periodic, Side::Open, Side::Reflecting]] {
        let bounds = odd(sides);
        for entry in choices::entries() {
            for variant in 0..choices::forces(entry).len() {
                let pick = || choices::forces(entry).swap_remove(variant).1;
                // Groups that are evaluated as one have no nearest image.
                if pick().laws().iter().any(|law| matches!(law.over, motes::forces::Over::Tree { .. })) {
                    continue;
                }
                let pairs = pick().laws().iter().any(|law| law.over == motes::forces::Over::Pairs);
                for (name, machine) in if pairs { machines(&shared) } else { vec![("", gpu(&shared, 1).machine())] } {
                    let count = 333;
                    let mut gpu = gpu(&shared, count);
                    gpu.pretend(machine);
                    let start = setup(
                        crate::boundary::inside(count, &bounds, 5),
                        vec![pick()],
                        "symplectic_euler",
                        0.01,
                        bounds,
                    );
                    let mut simulation = Simulation::on(gpu, &start).expect("a simulation");
                    simulation.step(2).expect("steps");
                    // Unwrapped, as within a Runge-Kutta step.
                    let meet = pick().laws().iter().any(|law| law.over != motes::forces::Over::Each);
                    // Directions of small ways are not to be had out of large numbers, nor the direction
                    // of prey that is all round: here no hunter is in the very middle of its prey.
                    let nearby = meet && !pairs;
                    let far =
                        if nearby { crate::boundary::inside(count, &bounds, 17) } else { scattered(count, &bounds, 9) };
                    let far: Vec<_> =
                        far.position().iter().zip(far.mass()).map(|(x, m)| x.extend(*m).as_vec4()).collect();
                    simulation.write(motes::POSITION, &far).expect("places");
                    let problem = Problem::new(333, machine)
                        .listed(start.problem(machine).expect("a problem").list)
                        .tied(&support::links(333), &[])
                        .at(start.state.position(), bounds)
                        .of_species(start.state.species());
                    let law = [pick()];
                    let mut step = Step::new(&law, problem);
                    step.evaluate();
                    let plan = step.finished().expect("a plan");
                    let verdicts = pollster::block_on(compare(simulation.backend(), &plan, 333)).expect("verdicts");
                    let bad = verdicts.iter().find(|verdict| !support::agrees(verdict));
                    assert!(bad.is_none(), "{}, {name}: {bad:?}", entry.name);
                    let accelerates = |v: &Verdict| v.kernel != "clear" && v.field == "acceleration" && v.changed;
                    if verdicts.iter().any(accelerates) {
                        busy.push(entry.name);
                    }
                }
            }
        }
    }
    let lawless = |name: &str| force(name, &[]).laws().is_empty();
    let idle: Vec<_> =
        choices::entries().map(|e| e.name).filter(|name| !busy.contains(name) && !lawless(name)).collect();
    assert!(idle.is_empty(), "nothing changes: {idle:?}");
}

fn cube(length: f64) -> Bounds {
    Bounds::new(DVec3::ZERO, DVec3::splat(length), Side::Periodic)
}

fn gravity() -> Vec<Box<dyn Component>> {
    vec![force("gravity", &[("softening", Value::Number(0.05))])]
}

/// Two on either side of a seam attract each other as two in the middle do.
#[test]
fn across_a_seam() {
    let two = |x: DVec3, y: DVec3| {
        let mut two = one(x, DVec3::ZERO);
        two.push(y, DVec3::ZERO, 3.0, 0.0);
        two
    };
    let bounds = cube(10.0);
    let near =
        accelerations_in(&bounds, &gravity(), &two(DVec3::new(5.25, 4.0, 4.75), DVec3::new(4.75, 4.0, 5.5)), 0.0);
    let across =
        accelerations_in(&bounds, &gravity(), &two(DVec3::new(0.25, 4.0, 9.75), DVec3::new(9.75, 4.0, 0.5)), 0.0);
    let open = accelerations_in(
        &Bounds::default(),
        &gravity(),
        &two(DVec3::new(0.25, 4.0, 9.75), DVec3::new(9.75, 4.0, 0.5)),
        0.0,
    );
    assert_eq!(near, across);
    assert!(near[0].truncate().length() > 100.0 * open[0].truncate().length(), "without a box they are far apart");
    // The nearest image of a centre pulls too.
    for law in ["attractor", "vortex", "tweezers"] {
        let key = if law == "vortex" { "center" } else { "position" };
        let at = |center: DVec3, x: DVec3| {
            let settings = [(key, Value::Vector(center))];
            accelerations_in(&bounds, &[force(law, &settings)], &one(x, DVec3::ZERO), 0.0)[0]
        };
        let (middle, seam) = (DVec3::splat(5.0), DVec3::new(9.5, 0.5, 9.75));
        let way = DVec3::new(1.0, -1.25, 0.75);
        assert_eq!(at(middle, middle + way), at(seam, (seam + way).rem_euclid(DVec3::splat(10.0))), "{law}");
    }
}

/// Everywhere in the box a beam along a side of it has images across the others alone, and a slanted one has none across those that it crosses: particles
/// at its far end are as near to it as those in the middle.
#[test]
fn a_slanted_beam_ends_at_the_sides_that_it_crosses() {
    let at = |bounds: &Bounds, axis: DVec3, x: DVec3| {
        let settings = [
            ("position", Value::Vector(DVec3::new(9.0, 5.0, 5.0))),
            ("axis", Value::Vector(axis)),
            ("waist", Value::Number(3.0)),
        ];
        accelerations_in(bounds, &[force("tweezers", &settings)], &one(x, DVec3::ZERO), 0.0)[0]
    };
    let (open, closed) = (Bounds::default(), cube(10.0));
    let slanted = DVec3::new(1.0, 0.0, 1.0);
    for along in [-8.5, -6.0, -5.5, -3.0, 0.5] {
        let x = DVec3::new(9.0, 5.0, 5.0) + along * DVec3::new(1.0, 0.0, 0.5) + DVec3::new(0.0, 0.75, 0.0);
        let (free, boxed) = (at(&open, slanted, x), at(&closed, slanted, x));
        assert_eq!(free, boxed, "{x}");
        assert!(boxed.w < -1e-9, "{x}: it has no potential");
        // Across y it has images.
        let image = (x + DVec3::new(0.0, 9.0, 0.0)).rem_euclid(DVec3::splat(10.0));
        let mirrored = at(&closed, slanted, image);
        let want = at(&open, slanted, image - DVec3::new(0.0, 10.0 * ((image.y - 5.0) / 10.0).round(), 0.0));
        assert_eq!(mirrored, want, "{image}");
    }
    let x = DVec3::new(0.5, 5.5, 1.0);
    assert_eq!(at(&closed, DVec3::Z, x), at(&open, DVec3::Z, x + DVec3::new(10.0, 0.0, 0.0)));
}

/// In a lattice that fills the box, no place is another: forces cancel, and all have one potential.
#[test]
fn a_lattice_is_the_same_everywhere() {
    let mut lattice = State::default();
    for place in 0..125_u8 {
        let x = DVec3::new(f64::from(place % 5), f64::from(place / 5 % 5), f64::from(place / 25));
        lattice.push(2.0 * x + DVec3::splat(0.5), DVec3::ZERO, 1.0, 0.0);
    }
    let got = accelerations_in(&cube(10.0), &gravity(), &lattice, 0.0);
    for a in &got {
        // 124 terms of up to 1/4, each rounded by 1e-16 of itself.
        assert!(a.truncate().length() < 1e-14 && (a.w - got[0].w).abs() < 1e-13, "{a} is not {}", got[0]);
    }
    let open = accelerations_in(&Bounds::default(), &gravity(), &lattice, 0.0);
    assert!(open[0].truncate().length() > 1.0, "without a box the corner falls inwards");
}

/// F = −∇U with images, where none is half a box away.
#[test]
fn forces_are_gradients() {
    let bounds = odd([Side::Periodic, Side::Open, Side::Periodic]);
    let laws: [Vec<Box<dyn Component>>; 4] = [
        gravity(),
        vec![force("gravity", &[("softening", Value::Number(0.3)), ("kernel", word("spline"))])],
        vec![force("attractor", &[("softening", Value::Number(0.2))])],
        vec![force("attractor", &[("profile", word("harmonic"))])],
    ];
    for (case, law) in laws.iter().enumerate() {
        let particles = scattered(8, &bounds, 12);
        let potential = |particles: &State| -> f64 {
            let all: Vec<DVec4> = accelerations_in(&bounds, law, particles, 0.3);
            all.iter().zip(particles.mass()).map(|(a, m)| a.w * m).sum()
        };
        for (id, a) in accelerations_in(&bounds, law, &particles, 0.3).iter().enumerate() {
            for k in 0..3 {
                let h = 1e-5;
                let at = |way: f64| {
                    let mut there = particles.clone();
                    there.position_mut()[id][k] += way;
                    potential(&there)
                };
                let want = -(at(h) - at(-h)) / (2.0 * h);
                let got = particles.mass()[id] * a[k];
                // Rounding, 1e-16 U / h, tenfold; and h² F″ / 6 with F″ up to F / ε², ε = 0.05.
                let allowed = 1e-10 * potential(&particles).abs().max(1.0) + 1e-7 * got.abs();
                assert!((got - want).abs() < allowed, "law {case}, particle {id}, axis {k}: {got} is not {want}");
            }
        }
    }
}
