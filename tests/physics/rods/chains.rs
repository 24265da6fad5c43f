//! Many rods: chains that hang, fly and are pulled.

use crate::support::Random;
use crate::support::states::{force, phase};
use glam::{DVec3, DVec4};
use motes::State;
use motes::forces::{Component, Law};
use motes::kernel::Source;
use motes::links::Rod;
use motes::settings::Value;

use crate::rods::{HELD, Weight, chain, device, down, forces, read, references, state, stretch};

/// The equilibrium of links of mass 1 at their joints, 1.5 long in all, between two points 1 apart: the lowest joint, and the
/// first behind the left end. Statics: every joint carries the same pull across, and the slopes grow by one weight each.
#[expect(clippy::unreadable_literal, reason = "as it was computed")]
const CATENARIES: [(usize, f64, Option<[f64; 2]>); 2] =
    [(10, -0.5059459315710845, Some([0.06221109051911371, -0.13649095287389065])), (20, -0.5034466343401924, None)];

/// Straight down to the middle and up again.
fn valley(links: usize) -> State {
    let depth = (0.75f64 * 0.75 - 0.25).sqrt();
    let place = |n: usize| {
        let part = 2.0 * n as f64 / links as f64;
        DVec3::new(0.5 * part, 0.0, -depth * part.min(2.0 - part))
    };
    let mut particles = State::default();
    chain(&mut particles, &(0..=links).map(place).collect::<Vec<_>>(), [true, true]);
    particles
}

#[test]
fn a_chain_comes_to_hang_in_the_catenary() {
    let shared = crate::support::device();
    for (links, lowest, second) in CATENARIES {
        let start = valley(links);
        let drag = || -> Vec<Box<dyn Component>> {
            [forces(), vec![force("drag", &[("linear", Value::Number(6.0))])]].into_iter().flatten().collect()
        };
        let check = |x: &[DVec4], allowed: f64| {
            let low = x.iter().map(|x| x.z).fold(0.0, f64::min);
            assert!((low - lowest).abs() < allowed, "{links} links: the lowest is at {low}, not {lowest}");
            if let Some(want) = second {
                let error = (x[1].x - want[0]).hypot(x[1].z - want[1]);
                assert!(error < allowed, "{links} links: the second joint is {error:e} from {want:?}");
            }
        };
        // What swings decays by e^(−3t), and the valley is 0.05 from it: after t = 9, 1e-13.
        let mut simulation = references(&start, drag(), "leapfrog", 0.01);
        simulation.step(900).expect("steps");
        check(&phase(&mut simulation).0, 1e-11);
        // In f32 a joint stands still once its speed times dt is below half a place, 3e-8: at an acceleration of 6 times
        // 3e-6, which is 2e-6 of the weight.
        let mut simulation = device(&shared, &start, drag(), "leapfrog", 0.01);
        simulation.step(900).expect("steps");
        let (x, _) = read(&mut simulation);
        check(&x, 1e-5);
        assert!(stretch(&start, &x) < 2e-6, "{:e}", stretch(&start, &x));
    }
}

/// A free chain in space of different masses, which turns and flies; what is rigid now moves along no rod.
fn flying() -> State {
    let mut random = Random::new(17);
    let mut places = vec![DVec3::new(0.3, -0.2, 0.1)];
    for _ in 0..7 {
        places.push(*places.last().expect("a place") + random.vector().normalize() * (0.5 + 0.2 * random.next()));
    }
    let mut particles = State::default();
    chain(&mut particles, &places, [false, false]);
    for i in 0..particles.len() {
        particles.mass_mut()[i] = f64::from((2.0 + random.next()) as f32);
        particles.velocity_mut()[i] =
            DVec3::new(0.2, 0.1, -0.3) + DVec3::new(0.9, -1.3, 0.7).cross(particles.position()[i]);
    }
    particles
}

fn momenta(x: &[DVec4], v: &[DVec4]) -> (DVec3, DVec3, f64) {
    let all = x.iter().zip(v).map(|(x, v)| (x.truncate(), x.w * v.truncate()));
    all.fold((DVec3::ZERO, DVec3::ZERO, 0.0), |(p, l, e), (x, p1)| (p + p1, l + x.cross(p1), e + p1.length_squared()))
}

#[test]
fn a_free_chain_keeps_momentum_and_spin() {
    let shared = crate::support::device();
    let start = flying();
    let rod = || vec![force("rod", &[])];
    let join = |v: &[DVec3]| -> Vec<DVec4> { v.iter().zip(start.mass()).map(|(v, m)| v.extend(*m)).collect() };
    let (p, l, _) = momenta(&join(start.position()), &join(start.velocity()));
    for name in ["leapfrog", "pefrl", "rk4"] {
        let mut simulation = references(&start, rod(), name, 0.01);
        simulation.step(1000).expect("steps");
        let (x, v) = phase(&mut simulation);
        let (p_now, l_now, _) = momenta(&x, &v);
        let moved = (0..8).map(|i| (x[i] - x[0]).truncate().distance(start.position()[i] - start.position()[0]));
        assert!(moved.fold(0.0, f64::max) > 0.5, "{name}: it is as stiff as a stick");
        // 1000 steps of a dozen roundings, 1e-16 of 20 each.
        assert!(p_now.distance(p) < 1e-11 * p.length(), "{name}: {p_now} is not {p}");
        assert!(l_now.distance(l) < 1e-11 * l.length(), "{name}: {l_now} is not {l}");
        assert!(stretch(&start, &x) < 1e-14, "{:e}", stretch(&start, &x));
    }
    let mut simulation = device(&shared, &start, rod(), "leapfrog", 0.01);
    simulation.step(1000).expect("steps");
    let (x, v) = read(&mut simulation);
    let (p_now, l_now, _) = momenta(&x, &v);
    // 1000 steps of some roundings of 6e-8 each, at random.
    assert!(p_now.distance(p) < 1e-5 * p.length(), "{p_now} is not {p}");
    assert!(l_now.distance(l) < 2e-5 * l.length(), "{l_now} is not {l}");
}

/// The first particle is pulled, and no other.
#[derive(Clone)]
struct Pull;

impl Component for Pull {
    fn laws(&self) -> Vec<Law> {
        let wgsl =
            "fn force(me: Particle) -> vec4f { return select(vec4f(), vec4f(3.0, 0.0, 4.0, 0.0), me.index == 0u); }";
        vec![Law::each("pull", Source::ours("pull", wgsl), Vec::new(), |me, _| {
            if me.index == 0 { DVec4::new(3.0, 0.0, 4.0, 0.0) } else { DVec4::ZERO }
        })]
    }
}

/// A pull at the end of a straight chain moves all of it alike: each rod pulls what is behind it.
#[test]
fn each_rod_pulls_what_is_behind_it() {
    let shared = crate::support::device();
    let mut particles = State::default();
    let along = DVec3::new(-0.6, 0.0, -0.8);
    chain(&mut particles, &(0..13).map(|n| along * 0.25 * f64::from(n)).collect::<Vec<_>>(), [false, false]);
    particles.mass_mut().copy_from_slice(&(0..13).map(|n| f64::from(1 + n * n % 7)).collect::<Vec<_>>());
    let want = -along * 5.0 * particles.mass()[0] / particles.mass().iter().sum::<f64>();
    let forces = || -> Vec<Box<dyn Component>> { vec![Box::new(Pull), force("rod", &[])] };
    let mut simulation = references(&particles, forces(), "leapfrog", 0.125);
    simulation.step(16).expect("steps");
    for v in phase(&mut simulation).1 {
        assert!((v.truncate() - 2.0 * want).length() < 1e-13, "{v} is not twice {want}");
    }
    let mut simulation = device(&shared, &particles, forces(), "leapfrog", 0.125);
    simulation.step(16).expect("steps");
    for v in read(&mut simulation).1 {
        // 16 steps of some roundings of 6e-8 of the speed of the pulled one, 1.
        assert!((v.truncate() - 2.0 * want).length() < 3e-6, "{v} is not twice {want}");
    }
}

/// A chain that hangs at rest stays, whatever the weights: each rod carries what is below.
#[test]
fn a_hanging_chain_rests() {
    let shared = crate::support::device();
    let mut particles = State::default();
    chain(&mut particles, &(0..40).map(|n| down(0.0) * 0.0625 * f64::from(n)).collect::<Vec<_>>(), [true, false]);
    for n in 1..40 {
        particles.mass_mut()[n] = 1.0 + (n * n % 11) as f64;
    }
    let mut simulation = device(&shared, &particles, forces(), "leapfrog", 0.01);
    simulation.step(200).expect("steps");
    let (x, v) = read(&mut simulation);
    for (n, want) in particles.position().iter().enumerate() {
        // A place, 2.4e-7 at 2.4; and of a kick of 0.05 what the 40 rows round away.
        assert!(x[n].truncate().distance(*want) < 1e-6, "{n}: {} is not {want}", x[n]);
        assert!(v[n].truncate().length() < 1e-5, "{n}: {}", v[n]);
    }
    assert_eq!(x[0].w.to_bits(), HELD.to_bits());
}

/// Small swings of a chain of one rod and of two: ω² = g / L and (2 ∓ √2) g / L.
#[test]
fn modes_of_two_rods_have_their_frequencies() {
    for sign in [-1.0, 1.0] {
        let omega = ((2.0 + sign * 2f64.sqrt()) * crate::rods::G).sqrt();
        let small = 1e-5;
        let start = crate::rods::pendulum(&[small, -sign * 2f64.sqrt() * small]);
        // After a quarter of a period all pass the middle.
        let (x, _) = state(&start, "leapfrog", 0.25 * std::f64::consts::TAU / omega, 2000);
        // h² ω² / 24 of the phase, 3e-8.
        assert!(x[1].x.abs() < 1e-6 * small && x[2].x.abs() < 1e-6 * small, "{sign}: {x:?}");
    }
}

/// A held one may be anywhere, and may carry many: what hangs at it is independent of the others.
#[test]
fn chains_at_a_held_one_know_nothing_of_each_other() {
    let both = |two: bool| {
        let mut particles = crate::rods::pendulum(&[0.7, 1.1]);
        if two {
            particles.push(down(-1.3), DVec3::ZERO, 2.5, 0.0);
            particles.links.rods.push(Rod { ends: [3, 0], length: 1.0 });
        }
        let mut simulation = references(&particles, vec![Box::new(Weight), force("rod", &[])], "leapfrog", 0.01);
        simulation.step(50).expect("steps");
        phase(&mut simulation).0
    };
    let (alone, together) = (both(false), both(true));
    assert_eq!(alone[..3], together[..3]);
    assert!((together[3].truncate().length() - 1.0).abs() < 1e-14 && together[3].x.abs() < 0.9, "{}", together[3]);
}
