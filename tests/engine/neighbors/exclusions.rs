//! Pairs of few bonds leave the list: the device, the reference and brute force agree on which.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec3, DVec4};
use motes::forces::{Component, Custom, Law, Over};
use motes::integrators::Step;
use motes::kernel::{Machine, Problem, Source};
use motes::links::{Exclusions, Link, Links, Network, Rod};
use motes::{Bounds, Error, Side, State};

use crate::neighbors::list::{
    accelerations, active_places, agree, builds, evaluation, jet, life, on, positions, setup,
};
use crate::neighbors::variants;
use crate::support::states::{force, word};
use crate::support::{self, Random};

/// A power of two: nothing is rounded.
const PART: f64 = 1.0 / 1_048_576.0;
const RANGE: f64 = 0.37;

const COUNTING: &str = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    (*sum).acceleration += vec3f(f32(you.index % 101u), 1.0, 1.0);
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, 0.0) / 1048576.0; }";
const REMEMBERING: &str = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let steps = recall(you, 0u) + 1.0;
    remember(you, 0u, steps);
    (*sum).acceleration += vec3f(f32(you.index % 101u), 1.0, steps);
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, 0.0) / 1048576.0; }";

/// Counts the steps of each pair, and the ids of those in range, which are whole numbers; pairs of few bonds are left out.
#[derive(Clone)]
struct Apart {
    bonds: u32,
    remembers: bool,
    over: Over,
}

impl Component for Apart {
    fn laws(&self) -> Vec<Law> {
        if self.remembers {
            let wgsl = Source::ours("apart", REMEMBERING);
            let law = Law::remembering(
                "apart",
                (RANGE, Some(0.1), 1),
                wgsl,
                Vec::new(),
                &["acceleration"],
                |_, you, _, _, memory, sum: &mut DVec3| {
                    let steps = memory.recall(0) + 1.0;
                    memory.remember(0, steps);
                    *sum += DVec3::new((you.index % 101) as f64, 1.0, steps);
                },
                |_, sum, _, outcome| outcome.accelerate((PART * *sum).extend(0.0)),
            );
            return vec![law.excluding(self.bonds)];
        }
        let law = Law::between("apart", self.over, Source::ours("apart", COUNTING), Vec::new(), |_, you, _| {
            PART * DVec4::new((you.index % 101) as f64, 1.0, 1.0, 0.0)
        });
        vec![law.excluding(self.bonds)]
    }
}

/// Springs, ropes and rods between particles near each other: chains, rings, branches and crosses.
fn bonded(mut state: State, seed: u64) -> State {
    // What is linked cannot be removed.
    state.drains.clear();
    let mut random = Random::new(seed);
    let mut links = Links::default();
    let ends = |random: &mut Random| {
        let a = (random.next().abs() * 0.999 * state.len() as f64) as u32;
        let whole = |id: u32| state.mass()[id as usize] > 0.0 && state.births.iter().all(|birth| birth.id != id);
        let near = |b: &u32| {
            *b != a
                && whole(a)
                && whole(*b)
                && state.position()[a as usize].distance(state.position()[*b as usize]) < 0.5
        };
        let others: Vec<u32> = (0..state.len() as u32).filter(near).collect();
        others.get((random.next().abs() * 0.999 * others.len() as f64) as usize).map(|b| [a, *b])
    };
    let mut known = BTreeSet::new();
    for n in 0..state.len() {
        // Two particles have one bond.
        let Some(ends) = ends(&mut random).filter(|[a, b]| known.insert([*a.min(b), *a.max(b)])) else { continue };
        match n % 4 {
            0 => links.rods.push(Rod { ends, length: 0.2 }),
            _ => {
                links.springs.push(Link { ends, rest: 0.2, stiffness: 1.0 + n as f64, damping: 0.0, rope: n % 4 == 1 });
            }
        }
    }
    assert!(links.springs.len() > 40 && links.rods.len() > 10, "{} {}", links.springs.len(), links.rods.len());
    state.links = links;
    state
}

/// How many bonds two particles are apart, by relaxation over all bonds.
fn distances(state: &State, most: u32) -> BTreeMap<(u32, u32), u32> {
    let bonds: Vec<[u32; 2]> =
        state.links.springs.iter().map(|l| l.ends).chain(state.links.rods.iter().map(|r| r.ends)).collect();
    let mut known = BTreeMap::new();
    for id in 0..state.len() as u32 {
        known.insert((id, id), 0);
    }
    for round in 1..=most {
        for [a, b] in &bonds {
            for (from, to) in [(*a, *b), (*b, *a)] {
                for id in 0..state.len() as u32 {
                    if known.get(&(id, from)) == Some(&(round - 1)) {
                        known.entry((id, to)).or_insert(round);
                    }
                }
            }
        }
    }
    known
}

/// The links of a state pull nothing here: they only are bonds.
#[test]
fn pairs_of_few_bonds_are_not_evaluated_and_all_others_are() {
    let shared = support::device();
    let side = |half: f64| Bounds::new(DVec3::splat(-half), DVec3::splat(half), Side::Periodic);
    let cloud = |seed| {
        let mut state = support::cloud(250, seed);
        state.links = Links::default();
        state
    };
    for (state, bounds) in [(cloud(9), side(1.0)), (cloud(4), Bounds::default()), (jet(0.15, 0.6, 0.7), side(0.8))] {
        let state = bonded(state, 17);
        for (bonds, remembers, over) in [
            (1, false, Over::List { range: RANGE, skin: Some(0.1), slots: 0 }),
            (2, true, Over::List { range: RANGE, skin: Some(0.1), slots: 0 }),
            (3, false, Over::Auto { range: RANGE, skin: None }),
        ] {
            let apart = distances(&state, bonds);
            // The table itself, by all kinds of bonds.
            let count = state.len() as u32;
            let table = Exclusions::new(&Network::new(count, &state.links), bonds, count).expect("few");
            for id in 0..count {
                let want: Vec<u32> =
                    (0..count).filter(|other| *other != id && apart.contains_key(&(id, *other))).collect();
                assert_eq!(table.of(id), want, "{id}: {bonds}");
            }
            // A rod would keep its length.
            let mut state = state.clone();
            state.links.rods.clear();
            let apart = distances(&state, bonds);
            for (variant, machine) in variants(&shared) {
                let setup = setup(&state, bounds, Box::new(Apart { bonds, remembers, over }), 7e-3);
                let mut simulation = on(&shared, machine, &setup);
                let mut steps: BTreeMap<(usize, usize), f64> = BTreeMap::new();
                let (mut left_out, mut met) = (0, 0);
                simulation.step(0).expect("a start");
                for step in 0..30 {
                    let before = life(&mut simulation);
                    simulation.step(1).expect("a step");
                    pollster::block_on(simulation.check()).expect("no alarm");
                    let places = active_places(&mut simulation, before.as_deref());
                    let after = life(&mut simulation);
                    let got = accelerations(&mut simulation);
                    let mut now = BTreeMap::new();
                    for i in 0..places.len() {
                        let mut want = DVec4::ZERO;
                        for j in (0..places.len()).filter(|j| *j != i && bounds.within(places[*j] - places[i], RANGE)) {
                            if apart.contains_key(&(i as u32, j as u32)) {
                                left_out += 1;
                                continue;
                            }
                            met += 1;
                            let count = if remembers { steps.get(&(i, j)).copied().unwrap_or(0.0) + 1.0 } else { 1.0 };
                            now.insert((i, j), count);
                            want += PART * DVec4::new((j % 101) as f64, 1.0, count, 0.0);
                        }
                        let gone = after.as_ref().is_some_and(|life| life[i] != 1);
                        let of = format!("{bounds}, {variant}, {bonds} bonds, step {step}, particle {i}");
                        assert!(gone || got[i] == want.as_vec4(), "{of}: {} is not {want}", got[i]);
                    }
                    steps = now;
                }
                assert!(left_out > 500 && met > 10 * left_out / 30, "{left_out} of {met}");
                assert!(builds(&mut simulation) > 2, "{variant}");
                let plan = evaluation(&setup, machine);
                agree(&mut simulation, &plan, variant);
                let mut places = positions(&mut simulation);
                places.iter_mut().step_by(9).for_each(|x| x.x += 0.08);
                simulation.write(motes::POSITION, &places).expect("places");
                assert!(agree(&mut simulation, &plan, variant), "{variant}: not built");
            }
        }
    }
}

/// A star: any two of its ends are two bonds apart.
#[test]
fn a_table_of_too_many_pairs_is_refused() {
    let star = |count: u32| {
        let link = |end| Link { ends: [0, end], rest: 1.0, stiffness: 1.0, damping: 0.0, rope: false };
        Network::new(count, &Links { springs: (1..count).map(link).collect(), ..Links::default() })
    };
    for bonds in 1..=8 {
        let table = Exclusions::new(&star(1024), bonds, 1024).expect("1023 others at most");
        assert_eq!(table.others.len(), if bonds > 1 { 1024 * 1023 } else { 2 * 1023 });
        let text = Exclusions::new(&star(50_000), bonds, 50_000).expect_err("too many").to_string();
        assert!(text.contains(&format!("exclude = {bonds}: particle 0 has more than 1024 others")), "{text}");
    }
}

/// Every law with the key, and a user's.
#[test]
fn the_key_reaches_the_laws() {
    let with = |name: &str, bonds: f64, over: &'static str| {
        let settings = [("exclude", bonds.into()), ("over", word(over)), ("range", 0.5.into())];
        let known = motes::forces::entry(name).expect("a force").keys;
        let settings: Vec<_> = settings.into_iter().filter(|(key, _)| known.iter().any(|k| k.name == *key)).collect();
        force(name, &settings)
    };
    let names: Vec<_> = motes::forces::entries().filter(|e| e.keys.iter().any(|key| key.name == "exclude")).collect();
    assert!(names.len() == 6, "{}", names.len());
    for entry in names {
        assert_eq!(with(entry.name, 2.0, "list").laws()[0].exclude, 2, "{}", entry.name);
        for (bonds, over) in [(9.0, "list"), (1.0, "near"), (3.0, "within")] {
            let error = with(entry.name, bonds, over).check(&Bounds::default()).expect_err("refused").to_string();
            assert!(error.contains(&format!("exclude = {bonds}")), "{}: {error}", entry.name);
        }
        for (bonds, over) in [(8.0, "list"), (2.0, "auto"), (0.0, "near")] {
            with(entry.name, bonds, over).check(&Bounds::default()).expect(entry.name);
        }
    }
    let over = Over::List { range: RANGE, skin: None, slots: 0 };
    let own = Custom { exclude: 3, ..Custom::new("own", "own.wgsl", COUNTING, over) };
    assert_eq!(own.laws()[0].exclude, 3);
}

#[test]
fn what_cannot_leave_pairs_out_is_refused() {
    let refusal = |laws: &[Apart], breaks: bool| {
        let forces: Vec<Box<dyn Component>> =
            laws.iter().map(|law| Box::new(law.clone()) as Box<dyn Component>).collect();
        let mut step = Step::new(&forces, Problem::new(10, Machine::HOST).breaking(breaks));
        step.evaluate();
        match step.finished() {
            Err(Error::Scene(text)) => text,
            Err(other) => panic!("{other:?}"),
            Ok(_) => String::new(),
        }
    };
    let list = Over::List { range: RANGE, skin: None, slots: 0 };
    let law = |bonds, over| Apart { bonds, remembers: false, over };
    let near = refusal(&[law(2, Over::Near { range: RANGE, of: None })], false);
    assert!(near.contains("exclude = 2, and over = \"near\"") && near.contains("set over = \"list\""), "{near}");
    let within = refusal(&[law(1, Over::Pairs)], false);
    assert!(within.contains("exclude = 1, and over = \"pairs\""), "{within}");
    let many = refusal(&[law(9, list)], false);
    assert!(many.contains("exclude = 9") && many.contains("up to 8 bonds"), "{many}");
    let both = refusal(&[law(3, list), law(0, list)], false);
    assert!(both.contains("exclude = 0") && both.contains("has 3"), "{both}");
    let torn = refusal(&[law(1, list)], true);
    assert!(torn.contains("exclude = 1") && torn.contains("may break"), "{torn}");
    // Nothing is left out of nothing, and the same of both is one list.
    assert_eq!(refusal(&[law(0, list)], true), "");
    assert_eq!(refusal(&[law(3, list), law(3, list)], false), "");
    let auto = refusal(&[law(3, list), law(0, Over::Auto { range: RANGE, skin: None })], false);
    assert!(auto.contains("over = \"auto\" and exclude = 0") && auto.contains("up to 3 bonds"), "{auto}");
    assert_eq!(refusal(&[law(3, list), law(0, Over::Near { range: RANGE, of: None })], false), "");
}
