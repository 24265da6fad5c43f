//! Stability: limits of integrators, measured from their own steps, and frequencies of networks between bounds.

use crate::support::states::{force, integrator};
use glam::DVec3;
use motes::forces::Over;
use motes::kernel::Source;
use motes::links::{Dihedral, Joint, Link};
use motes::stability::{Bound, Network, Oscillator, Verdict, largest_step};
use motes::{Bounds, Gpu};
use pollster::block_on;

const OMEGA: f64 = 1.3;
/// Long enough that a tenfold growth within it is a growth of 1e-9 per step.
const LONG: f64 = 3e9;

fn limit(name: &str, omega: f64, damping: f64, duration: f64) -> f64 {
    block_on(largest_step(integrator(name), omega, damping, duration)).expect("a limit")
}

/// Forest & Ruth's and PEFRL's are of 30 digits; 2 is leapfrog's (Hairer, Lubich & Wanner 2006, §I.5.2) and 2√2 that of
/// Runge–Kutta 4 (Hairer & Wanner 1996, §IV.2).
#[test]
fn limits_on_the_oscillator() {
    let limits = [
        // |eigenvalue| leaves 1 as the root of the distance from the limit: 1e-6 stands for 1e-12; rounding does the rest.
        ("symplectic_euler", 2.0, 3e6, 1e-10),
        ("leapfrog", 2.0, 3e6, 1e-10),
        ("forest_ruth", 1.573_401_947_435, 3e6, 1e-10),
        ("pefrl", 2.989_449_545_907, 3e6, 1e-10),
        // It crosses 1 with a slope of about 2: 1e-9 per step counts.
        ("rk4", 8f64.sqrt(), LONG, 4e-9),
    ];
    for (name, want, duration, allowed) in limits {
        let got = OMEGA * limit(name, OMEGA, 0.0, duration);
        assert!((got - want).abs() < allowed, "{name} bears hω = {got:.13}, not {want:.13}");
    }
}

/// These grow at any step: what is called bearable shrinks with the time, as their growth per step says.
#[test]
fn some_have_no_limit_at_all() {
    // E grows by 1 + y² a step, which is e^(h ω² t) over a time: amplitudes reach 10 at h = 2 ln 10 / (ω² t).
    let want = |t: f64| 2.0 * 10f64.ln() / (OMEGA * OMEGA * t);
    for t in [1e2, 1e4] {
        let got = limit("forward_euler", OMEGA, 0.0, t);
        // 1 + y² stands for e^(y²): y² / 2 is what that leaves.
        assert!((got / want(t) - 1.0).abs() < (OMEGA * got).powi(2), "{got:e}, not {:e}", want(t));
    }
    for name in ["midpoint", "heun"] {
        // E grows by 1 + y⁴ / 4: amplitudes by 10 at h³ = 8 ln 10 / (ω⁴ t).
        let got = limit(name, OMEGA, 0.0, 1e6);
        let want = (8.0 * 10f64.ln() / (OMEGA.powi(4) * 1e6)).cbrt();
        assert!((got / want - 1.0).abs() < 1e-3, "{name}: {got:e}, not {want:e}");
    }
}

/// Damping makes the largest step shorter where it is explicit: h²ω² + 2hc < 4. Leapfrog's kicks take the velocity of
/// half a step ago, which makes it the same method.
#[test]
fn damping_shortens_the_step() {
    for (omega, damping) in [(1.0, 1.0), (0.3, 2.0), (2.0, 0.3), (0.0, 1.7)] {
        // The positive root of h²ω² + 2hc − 4.
        let want = 4.0 / (damping + f64::hypot(damping, 2.0 * omega));
        for name in ["symplectic_euler", "leapfrog"] {
            let got = limit(name, omega, damping, LONG);
            // The eigenvalue crosses −1 with a slope of about one.
            assert!((got / want - 1.0).abs() < 1e-8, "{name}, ω = {omega}, c = {damping}: {got}, not {want}");
        }
    }
    assert!(limit("symplectic_euler", 1.0, 1.0, LONG) > 1.236 && limit("leapfrog", 1.0, 1.0, LONG) < 1.237);
    // u′ = −c u: 2 for Euler and Runge–Kutta 2, 2.785 for Runge–Kutta 4.
    for (name, want) in [("forward_euler", 2.0), ("midpoint", 2.0), ("heun", 2.0), ("rk4", 2.785_293_563_405)] {
        let got = 1.7 * limit(name, 0.0, 1.7, LONG);
        assert!((got - want).abs() < 1e-8, "{name} bears hc = {got}, not {want}");
    }
}

#[test]
fn without_forces_every_step_is_stable() {
    assert!(limit("forward_euler", 0.0, 0.0, 1e9).is_infinite());
}

/// The device's step is the references' step.
#[test]
fn growth_is_the_same_on_the_device() {
    let shared = crate::support::device();
    for entry in motes::integrators::INTEGRATORS {
        let gpu = Gpu::new(&shared.found.device, &shared.found.queue, 1).expect("a device");
        let mut device = Oscillator::on(gpu, entry.by_default(), OMEGA, 0.2).expect("an oscillator");
        let mut references = Oscillator::new(entry.by_default(), OMEGA, 0.2).expect("an oscillator");
        for dt in [0.1, 0.7, 2.0] {
            let (got, want) = block_on(async { (device.step(dt).await, references.step(dt).await) });
            let (got, want) = (got.expect("a step"), want.expect("a step"));
            let apart = (got - want).to_cols_array().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let size = want.to_cols_array().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            // A dozen sums of single precision.
            assert!(apart < 1e-6 * size, "{}: {got} is not {want}", entry.name);
        }
    }
}

/// A sheet of n² particles, `1 / (n − 1)` apart: edges and diagonals of the squares, and the next but one in a row.
fn cloth(n: u32, stiffness: f64, bend: f64) -> (Vec<Link>, Vec<DVec3>) {
    let apart = 1.0 / f64::from(n - 1);
    let place = |x: u32, y: u32| y * n + x;
    let mut springs = Vec::new();
    for y in 0..n {
        for x in 0..n {
            let ways = [(1, 0, 1.0), (0, 1, 1.0), (1, 1, 1.0), (-1, 1, 1.0), (2, 0, bend), (0, 2, bend)];
            for (dx, dy, part) in ways {
                let (Some(u), v) = (x.checked_add_signed(dx).filter(|u| *u < n), y + dy) else { continue };
                if v < n {
                    let rest = apart * f64::from(dx).hypot(f64::from(dy));
                    let ends = [place(x, y), place(u, v)];
                    springs.push(Link { ends, rest, stiffness: part * stiffness, damping: 10.0, rope: false });
                }
            }
        }
    }
    let positions = (0..n * n).map(|i| DVec3::new(f64::from(i % n), f64::from(i / n), 0.0) * apart).collect();
    (springs, positions)
}

#[test]
fn a_cloth_is_between_its_bounds() {
    for (bend, usual) in [(1.0, 1.54), (0.1, 1.45)] {
        let (springs, positions) = cloth(32, 1000.0, bend);
        let masses = vec![0.1; positions.len()];
        let bound = Bound::of(&springs, &masses);
        let mode = Network::new(&springs, &masses, &positions, &Bounds::default()).quickest();
        let over = (bound.stiffness.sum / mode.stiffness).sqrt();
        // The iteration ends a few parts in a hundred below.
        assert!((over / usual - 1.0).abs() < 0.06, "the bound is {over} times above, not {usual}");
    }
    // NVIDIA Warp's benchmark of cloth: k = 1000, damping 10, m = 0.1, h = 1 / 960. Damping binds.
    let (springs, positions) = cloth(64, 1000.0, 1.0);
    let bound = Bound::of(&springs, &vec![0.1; positions.len()]);
    let h = 1.0 / 960.0;
    assert!((h * h * bound.stiffness.sum - 0.260_416_666).abs() < 1e-6, "{bound:?}");
    assert!((2.0 * h * bound.damping.sum - 5.0).abs() < 1e-12, "{bound:?}");
}

/// A chain between walls: ω = 2 √(k/m) sin(N π / 2(N + 1)), and the bound is 2 √(k/m) (Born & von Kármán 1912).
#[test]
fn a_chain_is_at_its_bound() {
    let (count, stiffness, mass) = (20u32, 100.0, 0.1);
    let ends = 0..=count;
    let spring = |i: u32| Link { ends: [i, i + 1], rest: 1.0, stiffness, damping: 0.3, rope: false };
    let springs: Vec<Link> = ends.map(spring).collect();
    let positions: Vec<DVec3> = (0..count + 2).map(|i| DVec3::X * f64::from(i)).collect();
    let mut masses = vec![mass; positions.len()];
    (masses[0], masses[count as usize + 1]) = (f64::INFINITY, f64::INFINITY);
    let bound = Bound::of(&springs, &masses);
    assert!((bound.stiffness.sum - 4.0 * stiffness / mass).abs() < 1e-9, "{bound:?}");
    assert!((bound.damping.sum - 4.0 * 0.3 / mass).abs() < 1e-9, "{bound:?}");
    let network = Network::new(&springs, &masses, &positions, &Bounds::default());
    let quickest = 4.0 * stiffness / mass * (20.0 * std::f64::consts::PI / 42.0).sin().powi(2);
    for mode in [network.quickest(), network.most_damped()] {
        assert!(mode.stiffness <= quickest * (1.0 + 1e-12) && mode.stiffness > 0.95 * quickest, "{mode:?}");
        // Damping in proportion: c = ω² · 0.3 / 100.
        assert!((mode.damping / mode.stiffness - 0.003).abs() < 1e-12, "{mode:?}");
    }
    // Half as much is held by one wall as by two neighbours: a row counts 1 / m alone for it.
    let held = Bound::of(&springs[..1], &masses);
    assert!((held.stiffness.sum - stiffness / mass).abs() < 1e-9 && held.stiffness.particle == 1, "{held:?}");
}

/// Unlike masses, one stiff spring among soft ones: the row and the spring are named.
#[test]
fn the_stiffest_is_named() {
    let mut springs: Vec<Link> =
        (0..9).map(|i| Link { ends: [i, i + 1], rest: 1.0, stiffness: 10.0, damping: 0.0, rope: false }).collect();
    (springs[6].stiffness, springs[2].damping) = (500.0, 4.0);
    let mut masses = vec![1.0; 10];
    masses[7] = 0.25;
    let bound = Bound::of(&springs, &masses);
    // 7 has springs 6 (to 6) and 7 (to 8): (500 + 10) (4 + 2).
    assert_eq!((bound.stiffness.particle, bound.stiffness.spring), (7, 6));
    assert!((bound.stiffness.sum - 3060.0).abs() < 1e-9, "{bound:?}");
    assert_eq!((bound.damping.particle, bound.damping.spring, bound.damping.sum), (2, 2, 8.0));
    // Two masses on one spring swing with k (1/m + 1/M): below the bound, and found.
    let positions: Vec<DVec3> = (0..10).map(|i| DVec3::Y * f64::from(i)).collect();
    let pair = Network::new(&springs[6..7], &masses, &positions, &Bounds::default()).quickest();
    assert!((pair.stiffness - 2500.0).abs() < 1e-9, "{pair:?}");
}

/// What a spring does across: nothing at rest or pressed, k (1 − L / l) when drawn out, k at any length without rest.
#[test]
fn springs_resist_across_when_drawn_out() {
    for (length, rest, rope, want) in [
        (1.0, 1.0, false, 0.0),
        (0.5, 1.0, false, 0.0),
        (2.0, 1.0, false, 4.0),
        (2.0, 0.0, false, 8.0),
        (0.0, 0.0, false, 8.0),
        (0.5, 1.0, true, 0.0),
        (2.0, 1.0, true, 4.0),
    ] {
        let springs = [Link { ends: [0, 1], rest, stiffness: 8.0, damping: 0.0, rope }];
        let places = [DVec3::ZERO, DVec3::X * length];
        let network = Network::new(&springs, &[1.0, f64::INFINITY], &places, &Bounds::default());
        let [along, across] = [DVec3::X, DVec3::Y].map(|way| network.product_of(&[way, DVec3::ZERO])[0]);
        assert!((across - DVec3::Y * want).length() < 1e-12, "{length}, {rest}, {rope}: {across}");
        // Along it resists, unless it is slack.
        let stiff = if rope && length < rest { 0.0 } else { 8.0 };
        assert!((along - DVec3::X * stiff).length() < 1e-12, "{length}, {rest}, {rope}: {along}");
    }
}

/// A law without more.
#[derive(Clone)]
struct Own(motes::forces::Law);

impl motes::forces::Component for Own {
    fn laws(&self) -> Vec<motes::forces::Law> {
        vec![self.0.clone()]
    }
}

/// Of a whole setup: the bound by what acts, the limit of its integrator by both, and the parts of a step that is too long.
#[test]
fn a_setup_is_judged() {
    let mut particles = motes::State::default();
    for i in 0..12 {
        particles.push(DVec3::X * f64::from(i), DVec3::ZERO, 0.1, 0.0);
    }
    let link = |i: u32| Link { ends: [i, i + 1], rest: 1.0, stiffness: 100.0, damping: 0.2, rope: false };
    particles.links.springs = (0..11).map(link).collect();
    let judged = |forces: Vec<Box<dyn motes::forces::Component>>, name: &str, dt: f64| {
        let entry = motes::integrators::entry(name).expect("an integrator");
        let (particles, bounds) = (particles.clone(), Bounds::default());
        let setup = motes::Setup {
            state: particles,
            forces,
            integrator: entry.by_default(),
            dt,
            bounds,
            solver: motes::Solver::default(),
        };
        block_on(Verdict::of(&setup, &|| entry.by_default(), 1_000_000)).expect("a verdict")
    };
    assert_eq!(judged(Vec::new(), "leapfrog", 0.1), None);
    // A user's law by the name of ours: what it does is not known.
    let own = motes::forces::Law::own(
        "spring",
        Over::Links,
        Source::law("spring.wgsl".to_owned(), String::new()),
        Vec::new(),
    );
    assert_eq!(judged(vec![Box::new(Own(own))], "leapfrog", 0.1), None);
    // ω² ≤ 4 k / m, c ≤ 4 · 0.2 / m: h²ω² + 2hc = 4.
    let (square, damping) = (4000.0, 8.0);
    let want = 4.0 / (damping + f64::sqrt(damping * damping + 4.0 * square));
    let verdict = judged(vec![force("spring", &[])], "leapfrog", 0.05).expect("springs");
    assert!((verdict.safe / want - 1.0).abs() < 1e-6 && !verdict.by_damping, "{verdict:?}, not {want}");
    assert!(verdict.lost > verdict.safe && verdict.lost < 1.1 * verdict.safe, "{verdict:?}");
    // 0.05 / (0.9 · 0.0298)
    assert_eq!(
        (verdict.substeps(0.05), verdict.substeps(verdict.safe), verdict.substeps(1e9)),
        (Some(2), Some(1), None)
    );
    let safe = judged(vec![force("spring", &[])], "leapfrog", 0.02).expect("springs");
    assert!(safe.lost.is_infinite(), "no mode was looked at: {safe:?}");
}

/// A dihedral of right angles has |∇φ|² = Σ gᵢ² / mᵢ by hand: at its ends 1, and at those between 1 where the ends are above them. A bound by
/// rows is no less than ω² = k n² |∇φ|², and with four entries at most twice that here. One that is in a line does not hide it, nor a joint.
#[test]
fn dihedrals_limit_the_step() {
    let mut particles = motes::State::default();
    for x in [DVec3::Y, DVec3::ZERO, DVec3::X, DVec3::new(1.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 2.0)] {
        particles.push(x, DVec3::ZERO, 0.5, 0.0);
    }
    let judged = |dihedrals: Vec<Dihedral>, joints: Vec<Joint>| {
        let mut state = particles.clone();
        (state.links.dihedrals, state.links.joints) = (dihedrals, joints);
        let entry = motes::integrators::entry("leapfrog").expect("an integrator");
        let (bounds, solver) = (Bounds::default(), motes::Solver::default());
        let forces = vec![force("dihedral", &[]), force("joint", &[])];
        let setup = motes::Setup { state, forces, integrator: entry.by_default(), dt: 1e-3, bounds, solver };
        block_on(Verdict::of(&setup, &|| entry.by_default(), 1000)).expect("a verdict").expect("dihedrals")
    };
    let one = Dihedral { ids: [0, 1, 2, 3], stiffness: 3.0, multiplicity: 4, phase: 0.3 };
    let straight = Dihedral { ids: [1, 2, 3, 4], stiffness: 1e6, multiplicity: 12, phase: 0.0 };
    // Both bonds are across the axis, so that each of the two between takes up the turn of the end beside it.
    let square = 3.0 * 16.0 * 4.0 / 0.5;
    for dihedrals in [vec![one], vec![one, straight], vec![Dihedral { stiffness: -3.0, ..one }, straight]] {
        let verdict = judged(dihedrals, Vec::new());
        assert!((0.999 * square..=2.0 * square).contains(&verdict.bending), "{verdict:?}, not {square}");
        assert!(verdict.safe <= 2.02 / square.sqrt() && verdict.safe > 0.5 * 2.0 / square.sqrt(), "{verdict:?}");
    }
    let joint = Joint { ids: [2, 3, 4], stiffness: 50.0, rest: 0.0 };
    // k (1 + 4 + 1) / m, by rows at most k (2 · 4) / m.
    let bent = judged(vec![straight], vec![joint]).bending;
    assert!((600.0..=800.1).contains(&bent), "{bent}");
    // What single precision does not hold is unstable at any step.
    assert!(judged(vec![Dihedral { stiffness: 1e38, ..one }], Vec::new()).safe <= 0.0);
}
