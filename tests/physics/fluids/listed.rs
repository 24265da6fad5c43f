//! Fluids over a neighbour list: what the cell list finds, at any skin, as they move.

use motes::kernel::{Backend, Machine};
use motes::life::Drain;
use motes::lockstep::compare;
use motes::neighbors::LIST_STATE;
use motes::settings::Value;
use motes::solids::Solid;
use motes::visit::{Loads, few_neighbors};
use motes::{Gpu, POSITION, Setup, Side, Simulation};

use crate::fluids::{gpu, scene, setup, state};
use crate::support;
use crate::support::fluids::{SPACING, bounds, cloud, fluid};
use crate::support::states::{vector, word};
use Value::Number;

/// The steps of a run, and the time of one: a particle moves by a tenth of a spacing in about four.
const STEPS: u32 = 37;
const DT: f64 = 0.004;

/// Densities by sums and as states, with walls of both kinds and a surface.
fn cases() -> Vec<Vec<(&'static str, Value)>> {
    vec![
        vec![],
        vec![("tension", Number(0.4)), ("adhesion", Number(700.0)), ("xsph", Number(0.1))],
        vec![
            ("density_by", word("continuity")),
            ("diffusion", Number(0.1)),
            ("weight", vector(0.3, -0.9, 0.0)),
            ("walls", word("extrapolate")),
            ("wall_mass", word("lattice")),
        ],
    ]
}

fn over(over: &'static str, skin: f64, more: &[(&'static str, Value)]) -> Vec<(&'static str, Value)> {
    [&[("over", word(over)), ("skin", Number(skin * SPACING))], more].concat()
}

fn moving(count: usize, flat: bool, side: Side, settings: &[(&'static str, Value)]) -> Setup {
    let particles = cloud(count, flat, true);
    setup(&particles, vec![fluid(settings)], "leapfrog", DT, bounds(count, flat, side))
}

fn builds(simulation: &mut Simulation<Gpu>) -> u32 {
    let bytes = pollster::block_on(simulation.backend().bytes(LIST_STATE, 0, 16)).expect("a state");
    bytemuck::pod_collect_to_vec::<u8, u32>(&bytes)[1]
}

/// The kernels of one more step, by the references, which meet all pairs.
fn agrees(simulation: &mut Simulation<Gpu>, setup: &Setup, name: &str) {
    let count = u32::try_from(setup.state.len()).expect("few");
    let plan = setup.plans(simulation.backend().machine()).expect("plans").step;
    for verdict in pollster::block_on(compare(simulation.backend(), &plan, count)).expect("verdicts") {
        assert!(verdict.sound(), "{name}: {verdict:?}");
    }
}

/// A list that is some steps old lacks no neighbour, through periodic sides, beside walls and at surfaces, where rates of densities are
/// computed in the middle of a drift, too.
#[test]
fn an_old_list_lacks_no_neighbour() {
    let shared = support::device();
    for (flat, side) in [(false, Side::Periodic), (true, Side::Open), (true, Side::Periodic)] {
        for more in cases() {
            let built = [0.1, 0.6].map(|skin| {
                let name = format!("flat {flat}, {side:?}, skin {skin}, {more:?}");
                let setup = moving(500, flat, side, &over("list", skin, &more));
                let mut simulation = gpu(&shared, &setup);
                simulation.step(STEPS).expect("steps");
                pollster::block_on(simulation.check()).expect("no alarm");
                let built = builds(&mut simulation);
                agrees(&mut simulation, &setup, &name);
                built
            });
            // The wider the skin, the older a list.
            let old = built[1] > 1 && built[1] < STEPS / 2 && built[0] > built[1];
            assert!(old, "flat {flat}, {side:?}, {more:?}: built {built:?} times");
        }
    }
}

/// Whatever the skin, and from any state of the run.
#[test]
fn bits_depend_on_no_skin_and_no_stop() {
    let shared = support::device();
    for more in cases() {
        let run = |skin: f64, stop: u32| {
            let mut setup = moving(400, false, Side::Periodic, &over("list", skin, &more));
            let mut simulation = gpu(&shared, &setup);
            simulation.step(stop).expect("steps");
            if stop < STEPS {
                setup.state = pollster::block_on(simulation.snapshot()).expect("a state");
                simulation = gpu(&shared, &setup);
                simulation.step(STEPS - stop).expect("steps");
            }
            pollster::block_on(simulation.read(POSITION)).expect("positions")
        };
        let whole = run(0.2, STEPS);
        for (skin, stop) in [(0.4, STEPS), (0.02, STEPS), (0.2, 13)] {
            assert!(run(skin, stop) == whole, "{more:?}: skin {skin}, stopped after {stop}");
        }
    }
}

/// Sums in another order: rounding, which grows while particles push each other.
#[test]
fn a_run_is_that_over_cells() {
    let shared = support::device();
    for more in cases() {
        let run = |settings: &[(&'static str, Value)]| {
            let mut simulation = gpu(&shared, &moving(500, true, Side::Periodic, settings));
            simulation.step(STEPS).expect("steps");
            state(&mut simulation)
        };
        let (near, list) = (run(&over("near", 0.0, &more)), run(&over("list", 0.2, &more)));
        let off = near.iter().zip(&list).map(|(a, b)| a.0.distance(b.0)).fold(0.0, f64::max);
        // 37 roundings of positions up to 5, 3e-7 each, and what forces make of them; a neighbour that lacks moves a particle by 1e-3.
        assert!(off < 2e-5 && off > 0.0, "{more:?}: {off:e}");
    }
}

/// Particles that come, beside walls, in a box that is open: they are on the list as soon as they are born.
#[test]
fn what_is_born_is_on_the_list() {
    let shared = support::device();
    let (_, setup) = scene("fountain_pool", &["force.1.over=list"]);
    let mut simulation = gpu(&shared, &setup);
    let fluid = |simulation: &mut Simulation<Gpu>| {
        let life = pollster::block_on(simulation.read(motes::LIFE)).expect("lives");
        life.iter().filter(|word| **word == 1).count()
    };
    let before = fluid(&mut simulation);
    simulation.step(300).expect("steps");
    pollster::block_on(simulation.check()).expect("no alarm");
    assert!(fluid(&mut simulation) > before + 5, "{before}");
    agrees(&mut simulation, &setup, "fountain_pool");
}

/// Particles that a drain removes while a list is old are no neighbours any more: the run is that over cells, which are sorted in every step.
#[test]
fn what_is_removed_is_no_neighbour() {
    let shared = support::device();
    for more in cases() {
        let run = |settings: &[(&'static str, Value)]| {
            let mut setup = moving(500, true, Side::Periodic, settings);
            let position = 0.5 * (setup.bounds.low + setup.bounds.high);
            let solid = Solid::Sphere(5.0 * SPACING);
            setup.state.drains = vec![Drain { solid, position, outside: false, species: None }];
            let mut simulation = gpu(&shared, &setup);
            let removed = [1, 11, STEPS - 12].map(|steps| {
                simulation.step(steps).expect("steps");
                pollster::block_on(simulation.check()).expect("no alarm");
                pollster::block_on(simulation.population()).expect("a count").removed
            });
            (simulation, setup, removed)
        };
        let (mut near, _, want) = run(&over("near", 0.0, &more));
        let (mut list, setup, removed) = run(&over("list", 0.6, &more));
        // Some steps use the list of an earlier one, while particles move into the gap.
        let built = builds(&mut list);
        assert!(built > 1 && built < 2 * STEPS / 3, "{more:?}: built {built} times");
        // Some after the first step, of which a list of its start has all, and more later.
        assert!(removed == want && removed[0] > 0 && removed[2] > removed[0], "{more:?}: {removed:?}, {want:?}");
        let off = state(&mut near).iter().zip(&state(&mut list)).map(|(a, b)| a.0.distance(b.0)).fold(0.0, f64::max);
        // As above.
        assert!(off < 2e-5 && off > 0.0, "{more:?}: {off:e}");
        agrees(&mut list, &setup, "drain");
    }
}

/// The faster one, as measured; and a pressure solve has none.
#[test]
fn auto_counts_neighbours() {
    let keeps = |support: f64, software: bool| {
        let more = [("over", word("auto")), ("support", Number(support))];
        let machine = Machine { software, ..Machine::HOST };
        let plan = moving(1000, false, Side::Periodic, &more).plans(machine).expect("plans").step;
        (plan.steps().any(|kernel| kernel.name.starts_with("list ")), machine)
    };
    // 4/3 π support³ neighbours, 34 and 113.
    for (support, mean) in [(2.0, 33.5), (3.0, 113.1)] {
        for software in [false, true] {
            let (list, machine) = keeps(support, software);
            assert_eq!(list, mean < few_neighbors(&machine, Loads::Fields), "{support}, {software}");
        }
    }
    assert!(keeps(2.0, true).0 && !keeps(3.0, true).0, "both are chosen");
    let solved = [("solver", word("dfsph")), ("over", word("list"))];
    let refused = moving(100, false, Side::Periodic, &solved).plans(Machine::HOST).err();
    let why = refused.expect("no list").to_string();
    assert!(why.contains("leave out over = \"list\""), "{why}");
    let either = [("solver", word("dfsph")), ("over", word("auto"))];
    moving(100, false, Side::Periodic, &either).plans(Machine::HOST).expect("its own pairs");
}
