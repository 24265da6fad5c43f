//! Rigid bodies: a free asymmetric top about its middle axis turns over and over (Dzhanibekov's effect), when elliptic functions say
//! so (Landau & Lifshitz 1976, § 37), and keeps its energy and angular momentum; a dipole in a field keeps what that leaves.

use glam::{DQuat, DVec3, DVec4, Vec4};
use motes::integrators::INTEGRATORS;
use motes::kernel::{Array, Field};
use motes::rotation::{angular_momentum, energy};
use motes::{Cpu, Simulation};

use crate::pairs::elliptic::{complete, jacobi};
use crate::pairs::{beginning, by_references, column, setup};
use crate::support::columns::{Bodies, FIELD};
use crate::support::machines::gpu;
use crate::support::states::one;

const INERTIA: DVec3 = DVec3::new(1.0, 2.0, 3.0);
/// Along its own axes, as the middle one turns over; −I₁ ω₁² (I₂ − I₁) + I₃ ω₃² (I₃ − I₂) is just above 0, so that it dwells there.
const SPIN: DVec3 = DVec3::new(1.2, 0.0, 0.72);

fn facing() -> DQuat {
    DQuat::from_xyzw(0.3, -0.5, 0.1, 0.8).normalize()
}

/// The motion of the free top, by the integrals 2E and L².
struct Solution {
    rate: f64,
    m: f64,
    amplitudes: DVec3,
}

impl Solution {
    fn new() -> Self {
        let DVec3 { x: i1, y: i2, z: i3 } = INERTIA;
        let (twice, square) = (SPIN.dot(INERTIA * SPIN), (INERTIA * SPIN).length_squared());
        assert!(square > twice * i2, "of the two kinds, that about the third axis");
        Self {
            rate: ((i3 - i2) * (square - twice * i1) / (i1 * i2 * i3)).sqrt(),
            m: (i2 - i1) * (twice * i3 - square) / ((i3 - i2) * (square - twice * i1)),
            amplitudes: DVec3::new(
                ((twice * i3 - square) / (i1 * (i3 - i1))).sqrt(),
                ((twice * i3 - square) / (i2 * (i3 - i2))).sqrt(),
                ((square - twice * i1) / (i3 * (i3 - i1))).sqrt(),
            ),
        }
    }
    /// The angular velocity along its own axes.
    fn spin(&self, time: f64) -> DVec3 {
        let [sn, cn, dn] = jacobi(self.rate * time, self.m);
        self.amplitudes * DVec3::new(cn, sn, dn)
    }
    /// From one turn over to the next.
    fn flip(&self) -> f64 {
        2.0 * complete(self.m) / self.rate
    }
}

fn start() -> [(&'static str, Array); 3] {
    let q = facing();
    [
        ("orientation", Array::Vec4(vec![DVec4::from(q)])),
        ("angular_velocity", Array::Vec3(vec![q * SPIN])),
        ("inertia", Array::Vec3(vec![INERTIA])),
    ]
}

fn top(name: &str, dt: f64, field: bool) -> Simulation<Cpu> {
    let state = beginning(&one(DVec3::ZERO, DVec3::ZERO), &start());
    by_references(&setup(&state, vec![Box::new(Bodies { field })], name, dt))
}

fn vector(simulation: &mut Simulation<Cpu>, name: &str) -> DVec4 {
    match column(simulation, name) {
        Array::Vec4(all) => all[0],
        other => panic!("{other:?}"),
    }
}

/// The orientation and the angular velocity in space.
fn body(simulation: &mut Simulation<Cpu>) -> (DVec4, DVec3) {
    (vector(simulation, "orientation"), vector(simulation, "angular_velocity").truncate())
}

fn own(q: DVec4, spin: DVec3) -> DVec3 {
    DQuat::from_vec4(q).inverse() * spin
}

/// When the middle component of the angular velocity changes its sign, and how; the first time of it is the start.
fn crossings(dt: f64, values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut times = Vec::new();
    let mut before = 0.0f64;
    for (now, step) in values.zip(1..) {
        if step > 1 && before * now <= 0.0 {
            // It is straight there: its second derivative is 0 with it.
            times.push(dt * (f64::from(step) - now / (now - before)));
        }
        before = now;
    }
    times
}

#[test]
fn a_top_turns_over_when_elliptic_integrals_say() {
    let flip = Solution::new().flip();
    assert!((4.0..20.0).contains(&flip), "{flip}");
    for (name, order) in [("leapfrog", 2), ("pefrl", 2), ("rk4", 4)] {
        let error = |dt: f64| {
            let (mut simulation, steps) = (top(name, dt, false), (6.4 * flip / dt) as u32);
            let middle = (0..steps).map(|_| {
                simulation.step(1).expect("a step");
                let (q, spin) = body(&mut simulation);
                own(q, spin).y
            });
            let times = crossings(dt, middle);
            assert_eq!(times.len(), 6, "{name}: {times:?}");
            times[5] - 6.0 * flip
        };
        let dt = if order == 4 { 0.08 } else { 0.02 };
        let [coarse, fine] = [error(dt), error(0.5 * dt)];
        let slope = (coarse / fine).log2();
        if order == 4 {
            // Its energy falls by an order more than its phase errs, and moves the period first.
            assert!((3.7..5.3).contains(&slope) && fine.abs() < 1e-4, "{name}: {coarse:e} {fine:e}, slope {slope}");
            continue;
        }
        // What is left when the first order of the error is taken away is of the next even one.
        let rest = fine - (coarse - fine) / 3.0;
        assert!((slope - 2.0).abs() < 0.3 && rest.abs() < 0.1 * fine.abs(), "{name}: {coarse:e} {fine:e}, {rest:e}");
        assert!(fine.abs() < 2e-3 * flip, "{name}: {fine:e} of {flip}");
    }
}

/// The error of all that is known: of the angular velocity against elliptic functions, of the orientation against a fine run.
#[test]
fn a_free_top_has_the_order_of_its_turns() {
    let (time, solution) = (5.3, Solution::new());
    let mut fine = top("rk4", time / 8192.0, false);
    fine.step(8192).expect("steps");
    let (facing, spin) = body(&mut fine);
    assert!((own(facing, spin) - solution.spin(time)).length() < 1e-11, "a fine run is no solution");
    for entry in INTEGRATORS.iter().filter(|entry| entry.by_default().advances_columns()) {
        let its = entry.by_default();
        let order = if its.is_implicit() || its.order_with_velocity() == 1 { 2 } else { its.order() };
        let error = |steps: u32| {
            let mut simulation = top(entry.name, time / f64::from(steps), false);
            simulation.step(steps).expect("steps");
            let (q, spin) = body(&mut simulation);
            assert!((q.length() - 1.0).abs() < 1e-14, "{}: {q} is no unit", entry.name);
            (own(q, spin) - solution.spin(time)).length() + (q - facing).length()
        };
        let steps = if order == 4 { 128 } else { 1024 };
        let [coarse, fine] = [steps, 2 * steps].map(error);
        let slope = (coarse / fine).log2();
        assert!((slope - f64::from(order)).abs() < 0.2, "{}: {coarse:e} {fine:e}, slope {slope}", entry.name);
    }
}

#[test]
fn a_free_top_keeps_its_integrals() {
    let momentum = angular_momentum(facing().into(), facing() * SPIN, INERTIA);
    let first = energy(facing().into(), facing() * SPIN, INERTIA);
    // By hand: L² = Σ (I ω)², 2 E = Σ I ω².
    assert!(
        (momentum.length() - 1.2f64.hypot(2.16)).abs() < 1e-14 && (2.0 * first - 1.44 - 3.0 * 0.5184).abs() < 1e-14
    );
    for name in ["leapfrog", "symplectic_euler", "forest_ruth"] {
        let mut swings = Vec::new();
        for (dt, steps) in [(0.04, 20_000), (0.02, 20_000)] {
            let mut simulation = top(name, dt, false);
            let (mut early, mut late, mut turned) = (0.0f64, 0.0f64, 0.0f64);
            for step in 0..steps {
                simulation.step(1).expect("a step");
                let (q, spin) = body(&mut simulation);
                let off = (energy(q, spin, INERTIA) / first - 1.0).abs();
                if 2 * step < steps {
                    early = early.max(off);
                } else {
                    late = late.max(off);
                }
                turned = turned.max((angular_momentum(q, spin, INERTIA) - momentum).length() / momentum.length());
            }
            // A dozen roundings of 1e-16 in a step, were they all on one side.
            assert!(turned < 12.0 * f64::EPSILON * f64::from(steps), "{name}: L is off by {turned:e}");
            // A symplectic method swings about, however long it runs.
            assert!(late < 1.1 * early && early < 2.0 * dt * dt, "{name}: {early:e}, then {late:e}");
            swings.push(early);
        }
        let slope = (swings[0] / swings[1]).log2();
        assert!((slope - 2.0).abs() < 0.2, "{name}: energy is off by {swings:?}");
    }
}

/// A dipole along the first axis of a body in a field along z: E = T − m·B and L along z are kept.
#[test]
fn a_dipole_in_a_field() {
    let time = 3.1;
    let mut fine = top("rk4", time / 8192.0, true);
    fine.step(8192).expect("steps");
    let (facing_then, spin_then) = body(&mut fine);
    let kept = |q: DVec4, spin: DVec3| {
        let potential = -FIELD * (DQuat::from_vec4(q) * DVec3::X).z;
        [energy(q, spin, INERTIA) + potential, angular_momentum(q, spin, INERTIA).z]
    };
    let start = kept(facing().into(), facing() * SPIN);
    for (now, then) in kept(facing_then, spin_then).into_iter().zip(start) {
        assert!((now - then).abs() < 1e-11, "{now} {then}: a fine run keeps nothing");
    }
    for entry in INTEGRATORS.iter().filter(|entry| entry.by_default().advances_columns()) {
        let its = entry.by_default();
        let (order, staged) = (its.order(), its.order_with_velocity() > 1);
        let order = match (its.is_implicit(), staged) {
            (true, _) => 1,
            (false, true) => order,
            (false, false) => order.min(2),
        };
        let error = |steps: u32| {
            let mut simulation = top(entry.name, time / f64::from(steps), true);
            simulation.step(steps).expect("steps");
            let (q, spin) = body(&mut simulation);
            (spin - spin_then).length() + (q - facing_then).length()
        };
        let steps = [0, 2048, 512, 0, 128][order as usize];
        let [coarse, fine] = [steps, 2 * steps].map(error);
        let slope = (coarse / fine).log2();
        assert!((slope - f64::from(order)).abs() < 0.2, "{}: {coarse:e} {fine:e}, slope {slope}", entry.name);
    }
    // A step of leapfrog is symplectic, with torques too.
    let mut simulation = top("leapfrog", 0.02, true);
    let mut worst = [[0.0f64; 2]; 2];
    for step in 0..20_000 {
        simulation.step(1).expect("a step");
        let (q, spin) = body(&mut simulation);
        for (worst, (now, then)) in worst[step / 10_000].iter_mut().zip(kept(q, spin).into_iter().zip(start)) {
            *worst = worst.max((now - then).abs());
        }
    }
    let [early, late] = worst;
    assert!(late[0] < 1.2 * early[0] && early[0] < 2e-3, "the energy is off by {} and then {}", early[0], late[0]);
    assert!(late[1] < 12.0 * f64::EPSILON * 20_000.0 * start[1].abs().max(1.0), "L along z is off by {}", late[1]);
}

/// The same on a device, in single precision.
#[test]
fn a_top_turns_over_on_a_device() {
    let shared = crate::support::device();
    let (flip, dt) = (Solution::new().flip(), 0.02);
    let steps = (2.3 * flip / dt) as u32;
    for name in ["leapfrog", "rk4"] {
        let state = beginning(&one(DVec3::ZERO, DVec3::ZERO), &start());
        let setup = setup(&state, vec![Box::new(Bodies { field: false })], name, dt);
        let mut simulation = Simulation::on(gpu(&shared, 1), &setup).expect("a simulation");
        let mut exact = top(name, dt, false);
        let momentum = angular_momentum(facing().into(), facing() * SPIN, INERTIA);
        let first = energy(facing().into(), facing() * SPIN, INERTIA);
        let (mut ours, mut theirs, mut off) = (Vec::new(), Vec::new(), [0.0f64; 2]);
        for _ in 0..steps {
            simulation.step(1).expect("a step");
            exact.step(1).expect("a step");
            let mut get = |name| pollster::block_on(simulation.read(Field::<Vec4>::new(name))).expect("a column")[0];
            let (q, spin) = (get("orientation").as_dvec4(), get("angular_velocity").as_dvec4().truncate());
            let now = angular_momentum(q, spin, INERTIA);
            off[0] = off[0].max((now - momentum).length() / momentum.length());
            off[1] = off[1].max((energy(q, spin, INERTIA) / first - 1.0).abs());
            ours.push(own(q, spin).y);
            let (q, spin) = body(&mut exact);
            theirs.push(own(q, spin).y);
        }
        let [ours, theirs] = [ours, theirs].map(|values| crossings(dt, values.into_iter()));
        assert_eq!([ours.len(), theirs.len()], [2, 2], "{name}");
        // A dozen roundings of 6e-8 in each step, as at random: 3e-5 in 1 500 of them. About the middle axis what is wrong grows
        // by the root of 1 / (1 − m), which is about 10 here.
        for (mine, its) in ours.iter().zip(&theirs) {
            assert!((mine - its).abs() < 3e-4, "{name}: {ours:?} {theirs:?}");
        }
        assert!(off[0] < 1e-4 && off[1] < 2.0 * dt * dt + 2e-4, "{name}: {off:?}");
    }
}
