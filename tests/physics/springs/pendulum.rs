//! A mass on a spring, and two on two: high-order solutions, and what each integrator makes of them.

use glam::{DVec3, DVec4};
use motes::{POSITION, State, VELOCITY};

use super::{at, fix, forces, gpu, setup, spring};
use crate::support;
use crate::support::states::{cpu, phase};

const WEIGHT: f64 = 9.81;

/// m = 1, L = 1, at rest beside its anchor.
fn elastic() -> State {
    let mut particles = at(&[[0.0; 3], [1.0, 0.0, 0.0]], 1.0);
    particles.links.springs.push(spring([0, 1], 1.0, 100.0));
    fix(&mut particles, [0]);
    particles
}

fn state(x: DVec4, v: DVec4) -> [f64; 4] {
    [x.x, x.z, v.x, v.z]
}

fn apart(got: [f64; 4], want: [f64; 4]) -> f64 {
    got.iter().zip(want).map(|(got, want)| (got - want).abs()).fold(0.0, f64::max)
}

/// Taylor's method in 25 digits.
#[test]
fn the_elastic_pendulum() {
    let known = [
        (1.0, [-0.980_196_936_129_783_7, -0.615_055_321_443_245_2, -1.379_140_672_232_713, 2.773_917_337_747_923]),
        (2.0, [-0.174_468_935_324_077_2, -1.209_469_318_982_599, 4.279_765_120_419_576, -0.696_790_740_067_004]),
        (5.0, [0.839_269_188_915_798_4, -0.873_139_571_465_612_5, 2.474_186_386_544_033, 2.559_958_614_222_677]),
    ];
    // Of order 4: with ω = 10 its error is about 6e-5 (ω dt)⁴ ω t, which is 5e-10 at the end; ten times that.
    let mut simulation = cpu(&elastic(), forces(WEIGHT, 0.0), "pefrl", 0.002);
    let mut done = 0.0;
    for (time, want) in known {
        simulation.step(((time - done) / 0.002_f64).round() as u32).expect("steps");
        done = time;
        let (x, v) = phase(&mut simulation);
        let error = apart(state(x[1], v[1]), want);
        assert!(error < 5e-9, "at {time}: {error:e}");
        assert_eq!((x[0], v[0]), (DVec3::ZERO.extend(1.0), DVec4::ZERO), "the anchor");
    }
}

#[test]
fn two_on_two() {
    let mut particles = at(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], 1.0);
    particles.links.springs = vec![spring([0, 1], 1.0, 1000.0), spring([1, 2], 1.0, 1000.0)];
    fix(&mut particles, [0]);
    let known = [
        (
            0.5,
            [0.577_233_737_832_086_5, -0.849_419_970_019_783_3, -2.299_187_134_671_516, -1.699_322_927_777_997],
            [1.528_584_215_764_919, -1.202_597_355_372_5, -3.247_435_954_206_075, -4.537_995_910_886_952],
        ),
        (
            1.0,
            [-0.520_538_454_272_716_3, -0.889_425_682_242_139_3, -3.135_467_042_137_867, 1.230_092_189_479_277],
            [-1.350_759_119_963_038, -1.475_342_318_742_294, -4.871_207_614_360_284, 3.182_682_716_663_016],
        ),
    ];
    // ω is up to 51: 6e-5 (0.051)⁴ 51 is 2e-8 of a stretch of 0.03, and the velocity has 51 times that.
    let mut simulation = cpu(&particles, forces(WEIGHT, 0.0), "pefrl", 0.001);
    for (time, first, second) in known {
        simulation.step(500).expect("steps");
        let (x, v) = phase(&mut simulation);
        let error = apart(state(x[1], v[1]), first).max(apart(state(x[2], v[2]), second));
        assert!(error < 2e-7, "at {time}: {error:e}");
    }
}

/// One hundred steps of 0.01, to the digits that an independent program has; and the same on the device.
#[test]
fn what_integrators_make_of_it() {
    let shared = support::device();
    let known = [
        ("forward_euler", [-1.048_172_854_895, -0.548_525_937_254, -1.337_794_225_159, 3.176_567_807_980], 6e-6),
        ("symplectic_euler", [-0.987_134_683_964, -0.600_953_175_549, -1.377_574_247_568, 2.774_292_979_383], 3e-6),
        ("leapfrog", [-0.980_397_262_490, -0.614_784_370_346, -1.377_340_490_978, 2.773_417_007_756], 6e-6),
        ("rk4", [-0.980_196_727_560, -0.615_055_566_850, -1.379_142_980_394, 2.773_917_458_892], 6e-6),
    ];
    for (name, want, single) in known {
        let mut simulation = cpu(&elastic(), forces(WEIGHT, 0.0), name, 0.01);
        simulation.step(100).expect("steps");
        let (x, v) = phase(&mut simulation);
        let error = apart(state(x[1], v[1]), want);
        // The last digit that is given.
        assert!(error < 1e-12, "{name}: {error:e}");

        // In f32, seen elsewhere: 1e-6 (symplectic Euler), 4e-6 (leapfrog), 3e-6 (Runge–Kutta); and dt itself is rounded.
        let mut simulation = gpu(&shared, &setup(&elastic(), forces(WEIGHT, 0.0), name, 0.01));
        simulation.step(100).expect("steps");
        let x = pollster::block_on(simulation.read(POSITION)).expect("places");
        let v = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
        let error = apart(state(x[1].as_dvec4(), v[1].as_dvec4()), want);
        assert!(error < single, "{name} on the device: {error:e}");
        assert_eq!(x[0].truncate(), glam::Vec3::ZERO);
    }
}
