//! Softenings of particles: the larger one of a pair counts, over all pairs and over a tree.

use glam::{DVec3, DVec4, Vec4};
use motes::diagnose::{Remark, diagnose};
use motes::forces::Component;
use motes::kernel::{Array, Column, Columns, Kind, Machine, Problem};
use motes::lockstep::{Verdict, compare};
use motes::settings::Value;
use motes::{Bounds, Cpu, Energy, Setup, Simulation, State};

use crate::support::machines::{machines, walkers};
use crate::support::states::{accelerations, cpu, force, word};
use crate::support::{self, Random, Shared};
use crate::tree::sets::cloud;
use crate::tree::walks::{Walk, particles};

/// The largest of them: the spline of two such reaches over a fifth of the cloud.
const LARGEST: f64 = 0.15625;

fn gravity(words: [&'static str; 3], theta: f64, alpha: f64) -> Box<dyn Component> {
    let [over, kernel, multipoles] = words;
    let numbers = [("g", 1.3), ("softening", LARGEST), ("theta", theta), ("alpha", alpha)];
    let mut settings: Vec<_> = numbers.iter().map(|(key, x)| (*key, Value::Number(*x))).collect();
    settings.extend([("over", word(over)), ("kernel", word(kernel)), ("multipoles", word(multipoles))]);
    settings.push(("individual_softening", Value::Flag(true)));
    force("gravity", &settings)
}

/// Of 18, eight are small, seven are up to eight times as large, two are the largest, and one is 0.
fn softenings(count: usize, seed: u64) -> Vec<f32> {
    let mut random = Random::new(seed);
    let one = |i: usize, part: f32| match i % 18 {
        0 | 9 => LARGEST as f32,
        17 => 0.0,
        n if n % 2 == 0 => 0.015_625 * part,
        _ => 0.125 * part,
    };
    (0..count).map(|i| one(i, 0.5 + 0.5 * random.narrow().abs())).collect()
}

fn column() -> Column {
    Column::new("softening_length", Kind::Scalar, "length", "its own gravitational softening").required()
}

fn state(bodies: &[Vec4], softenings: &[f32]) -> State {
    let mut state = particles(bodies);
    state.declare(&column()).expect("a column");
    state
        .set("softening_length", Array::Float(softenings.iter().copied().map(f64::from).collect()))
        .expect("softenings");
    state
}

/// A law on a device, in the state before the first evaluation.
fn on_device(shared: &Shared, machine: Machine, (bodies, seed): (&[Vec4], u64), law: Box<dyn Component>) -> Walk {
    let softenings = softenings(bodies.len(), seed);
    let mut walk = Walk::new(shared, machine, bodies, law);
    walk.simulation
        .backend()
        .write_bytes("softening_length", 0, bytemuck::cast_slice(&softenings))
        .expect("softenings");
    walk
}

#[test]
fn each_walk_agrees_with_its_reference() {
    let shared = support::device();
    for (turn, (name, machine)) in walkers(&shared).into_iter().enumerate() {
        for (case, multipoles) in ["quadrupole", "monopole"].into_iter().enumerate() {
            for count in [257, 1500] {
                let bodies = cloud(count, 2 + (turn + 3 * case) as u64);
                let law = gravity(["tree", "spline", multipoles], 0.7, 0.0);
                let verdict = on_device(&shared, machine, (&bodies, 5), law).verdict();
                assert!(verdict.good() && verdict.changed, "{name}, {multipoles}, {count}: {verdict:?}");
            }
        }
    }
}

#[test]
fn all_pairs_agree_with_their_reference() {
    let shared = support::device();
    for (name, machine) in machines(&shared) {
        for kernel in ["plummer", "spline"] {
            for count in [2, 65, 700] {
                let law = gravity(["pairs", kernel, "quadrupole"], 0.5, 0.0);
                let mut pairs = on_device(&shared, machine, (&cloud(count, 3), 7), law);
                let plan = pairs.plan.clone();
                let verdicts =
                    pollster::block_on(compare(pairs.simulation.backend(), &plan, count as u32)).expect("verdicts");
                assert!(!verdicts.is_empty(), "{name}, {kernel}: nothing is compared");
                assert!(verdicts.iter().all(Verdict::good), "{name}, {kernel}, {count}: {verdicts:?}");
            }
        }
    }
}

/// Forces of two bodies are those of the larger softening, whichever of them has it, and equal and opposite.
#[test]
fn the_larger_one_of_a_pair_counts() {
    let mut random = Random::new(11);
    for case in 0..60 {
        let reach = LARGEST * [0.1, 0.7, 1.2, 2.0, 2.7, 3.1][case % 6];
        let bodies = [DVec3::ZERO.extend(0.7), (reach * random.vector().normalize()).extend(1.9)].map(DVec4::as_vec4);
        let own = [LARGEST as f32, 0.75 * LARGEST as f32 * random.narrow().abs()];
        for kernel in ["plummer", "spline"] {
            let one = [("g", Value::Number(1.3)), ("softening", Value::Number(LARGEST)), ("kernel", word(kernel))];
            let want = accelerations(&[force("gravity", &one)], &particles(&bodies), 0.0);
            for own in [own, [own[1], own[0]]] {
                let law = gravity(["pairs", kernel, "quadrupole"], 0.5, 0.0);
                let got = accelerations(&[law], &state(&bodies, &own), 0.0);
                assert_eq!(got, want, "{kernel} at {reach}, {own:?}");
                let [first, second] = bodies.map(|body| f64::from(body.w));
                let sum = first * got[0].truncate() + second * got[1].truncate();
                assert!(sum.length() < 1e-15 * got[0].length(), "{kernel} at {reach}: {sum}");
            }
            let smaller = [own[1]; 2];
            let law = gravity(["pairs", kernel, "quadrupole"], 0.5, 0.0);
            let got = accelerations(&[law], &state(&bodies, &smaller), 0.0);
            let reached = kernel == "plummer" || reach < 2.8 * LARGEST;
            assert_eq!(got[0] != want[0], reached, "{kernel} at {reach}: the smaller one changes nothing");
        }
    }
}

/// Groups nearer than the largest spline reaches are opened, or the error of quadrupoles would be 6.5e-4 here.
#[test]
fn a_tree_is_as_accurate_as_with_one_softening() {
    let shared = support::device();
    for seed in [13, 14] {
        let bodies = cloud(3000, seed);
        let softenings = softenings(bodies.len(), seed);
        let want =
            accelerations(&[gravity(["pairs", "spline", "quadrupole"], 0.5, 0.0)], &state(&bodies, &softenings), 0.0);
        for (name, machine) in walkers(&shared) {
            for (multipoles, most) in [("quadrupole", 5e-4), ("monopole", 3e-3)] {
                let law = gravity(["tree", "spline", multipoles], 0.5, 0.0);
                let got = on_device(&shared, machine, (&bodies, seed), law).run();
                let square = |(got, want): (&Vec4, &DVec4)| {
                    let error = got.as_dvec4().truncate() - want.truncate();
                    error.length_squared() / want.truncate().length_squared()
                };
                let errors: f64 = got.iter().zip(&want).map(square).sum();
                let error = (errors / want.len() as f64).sqrt();
                assert!(error < most, "{name}, {multipoles}, seed {seed}: {error:e}");
            }
        }
    }
}

/// Heavy soft bodies among light hard ones, half of a crossing time: energy to the order of the method, momentum to rounding.
#[test]
fn energy_and_momentum_are_kept() {
    for seed in [17, 18] {
        let bodies = cloud(300, seed);
        let mut start = state(&bodies, &softenings(bodies.len(), seed));
        // Those that are as large weigh ten times as much; of the others there is none that steps do not resolve.
        let largest =
            start.scalar("softening_length").expect("softenings").iter().map(|own| *own > 0.1).collect::<Vec<_>>();
        start.mass_mut().iter_mut().zip(&largest).filter(|(_, is)| **is).for_each(|(mass, _)| *mass *= 10.0);
        let own = start.scalar("softening_length").expect("softenings").iter().map(|own| own.max(0.0625)).collect();
        start.set("softening_length", Array::Float(own)).expect("softenings");
        for kernel in ["plummer", "spline"] {
            let mut simulation =
                cpu(&start, vec![gravity(["pairs", kernel, "quadrupole"], 0.5, 0.0)], "leapfrog", 1e-3);
            let snapshot =
                |simulation: &mut Simulation<Cpu>| pollster::block_on(simulation.snapshot()).expect("a snapshot");
            let momentum =
                |state: &State| -> DVec3 { state.velocity().iter().zip(state.mass()).map(|(v, m)| *m * *v).sum() };
            let before = snapshot(&mut simulation);
            simulation.step(500).expect("steps");
            let after = snapshot(&mut simulation);
            let first = Energy::of(&before).expect("energies");
            let change = Energy::of(&after).expect("energies").drift_from(&first).abs();
            assert!(change < 1e-5, "{kernel}, seed {seed}: the energy changes by {change:e}");
            let drift = (momentum(&after) - momentum(&before)).length();
            assert!(drift < 1e-14, "{kernel}, seed {seed}: {drift:e}");
        }
    }
}

#[test]
fn softenings_that_contradict_the_law_are_refused() {
    let bodies = cloud(20, 19);
    let good = softenings(20, 19);
    let refusal = |state: State, law: Box<dyn Component>| {
        Setup::new(state, vec![law], 0.01).check().expect_err("it is refused").to_string()
    };
    let pairs = || gravity(["pairs", "plummer", "quadrupole"], 0.5, 0.0);
    let with = |place: usize, softening: f32| {
        let mut own = good.clone();
        own[place] = softening;
        state(&bodies, &own)
    };
    let says = |message: String, words: &[&str]| {
        for word in words {
            assert!(message.contains(word), "`{message}` does not say `{word}`");
        }
    };
    Setup::new(state(&bodies, &good), vec![pairs()], 0.01).check().expect("good softenings");
    says(refusal(particles(&bodies), pairs()), &["`softening_length` has no initial value", "give every particle one"]);
    says(refusal(with(4, -0.25), pairs()), &["particle 4 has the softening_length -0.25", "give 0 or above"]);
    says(
        refusal(with(7, 0.5), pairs()),
        &["particle 7 has the softening_length 0.5", "0.15625", "key `softening` of the force"],
    );
    says(refusal(with(3, f32::NAN), pairs()), &["particle 3 has a `softening_length` that is NaN"]);
    let refused = |law: Box<dyn Component>, words: &[&str]| {
        says(law.check(&Bounds::default()).expect_err("it is refused").to_string(), words);
    };
    for over in ["tree", "auto"] {
        refused(
            gravity([over, "plummer", "quadrupole"], 0.5, 0.0),
            &["individual_softening over a tree", "kernel = \"spline\"", "over = \"pairs\""],
        );
        gravity([over, "spline", "quadrupole"], 0.5, 0.0).check(&Bounds::default()).expect("a spline");
    }
    let own = ("individual_softening", Value::Flag(true));
    refused(force("gravity", std::slice::from_ref(&own)), &["softening = 0", "the largest softening"]);
    let images = [own, ("softening", Value::Number(0.2)), ("images", word("ewald"))];
    refused(force("gravity", &images), &["images = \"ewald\"", "leave out either"]);
}

#[test]
fn softenings_that_are_all_zero_are_remarked_on() {
    let bodies = cloud(20, 19);
    let remarks = |own: &[f32]| {
        let law = gravity(["pairs", "spline", "quadrupole"], 0.5, 0.0);
        let setup = Setup::new(state(&bodies, own), vec![law], 0.01);
        pollster::block_on(diagnose(&setup)).expect("remarks")
    };
    let is_of_them = |remark: &Remark| remark.id == "unsoftened";
    let all = remarks(&[0.0; 20]);
    let text = all.iter().find(|remark| is_of_them(remark)).expect("a remark").to_string();
    assert!(
        text.contains("all 20 particles have the softening_length 0") && text.contains("individual_softening"),
        "{text}"
    );
    let mut one = [0.0; 20];
    one[7] = 0.125;
    assert!(!remarks(&one).iter().any(is_of_them));
}

/// Where a walk that continues and the relative criterion leave no binding, the way out is said; where they do, it runs.
#[test]
fn the_relative_criterion_takes_a_binding() {
    let shared = support::device();
    for (name, machine) in walkers(&shared) {
        let bodies = cloud(1500, 21);
        let law = gravity(["tree", "spline", "quadrupole"], 0.7, 0.004);
        if machine.software {
            let law = law.laws().swap_remove(0);
            let problem = Problem::new(1500, machine).of_columns(Columns::with([column()]).expect("a column"));
            match law.kernel(&problem).map(drop) {
                Ok(()) => assert_eq!(machine, Machine::HOST, "{name}: only references bind nothing"),
                Err(error) => {
                    let error = error.to_string();
                    assert!(error.contains("9 storage buffers") && error.contains("alpha = 0"), "{name}: {error}");
                }
            }
            // The backend of references runs it.
            let law = gravity(["tree", "spline", "quadrupole"], 0.7, 0.004);
            let mut by_reference = cpu(&state(&bodies, &softenings(1500, 5)), vec![law], "leapfrog", 1e-3);
            by_reference.step(1).expect("a step");
        } else {
            let verdict = on_device(&shared, machine, (&bodies, 5), law).verdict();
            assert!(verdict.good() && verdict.changed, "{name}: {verdict:?}");
        }
    }
}
