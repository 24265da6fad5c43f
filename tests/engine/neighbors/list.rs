//! The list that is kept over steps: against brute force, in lockstep, and over runs in which it is built again and again.

use glam::{DVec3, DVec4, Vec4};
use motes::forces::{Component, Law, Over};
use motes::kernel::{Machine, Plan, Source};
use motes::life::Drain;
use motes::lockstep::compare;
use motes::neighbors::LIST_STATE;
use motes::settings::{Settings, Value};
use motes::shapes::emitter;
use motes::solids::Solid;
use motes::{ACCELERATION, Bounds, Error, Gpu, POSITION, Setup, Side, Simulation, State, VELOCITY};

use crate::neighbors::exact::{by_force, same, whole};
use crate::neighbors::places::{self, Place};
use crate::neighbors::{Curious, variants};
use crate::support::states::integrator;
use crate::support::{self, Shared, machines};

/// How much of what the whole law finds accelerates a particle: a power of two, so that nothing is rounded.
const PART: f64 = 1.0 / 1_048_576.0;

/// The whole law, so weak that particles move on.
#[derive(Clone)]
pub struct Weak(pub Over);

impl Component for Weak {
    fn laws(&self) -> Vec<Law> {
        let wgsl = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
            let e = clamp(floor(r * 8.0), vec3f(-64.0), vec3f(64.0));
            (*sum).acceleration += vec3f(1.0, f32(you.index), e.x + 3.0 * e.y + 9.0 * e.z);
            (*sum).potential += 2.0 * f32(you.index % 13u);
        }
        fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential) / 1048576.0; }";
        // Of a potential each of the two has half.
        let scale = PART * DVec4::new(1.0, 1.0, 1.0, 2.0);
        vec![Law::between("weak", self.0, Source::ours("weak", wgsl), Vec::new(), move |_, you, r| {
            scale * whole(you.index, r.as_vec3().as_dvec3())
        })]
    }
}

pub fn list(range: f64, skin: f64) -> Over {
    Over::List { range, skin: Some(skin), slots: 0 }
}

pub fn setup(state: &State, bounds: Bounds, force: Box<dyn Component>, dt: f64) -> Setup {
    let solver = motes::Solver::default();
    Setup { state: state.clone(), forces: vec![force], integrator: integrator("leapfrog"), dt, bounds, solver }
}

pub fn on(shared: &Shared, machine: Machine, setup: &Setup) -> Simulation<Gpu> {
    let mut gpu = machines::gpu(shared, setup.state.len());
    gpu.pretend(machine);
    Simulation::on(gpu, setup).expect("a simulation")
}

pub fn positions(simulation: &mut Simulation<Gpu>) -> Vec<Vec4> {
    pollster::block_on(simulation.read(POSITION)).expect("positions")
}

/// How often the list has been built.
pub fn builds(simulation: &mut Simulation<Gpu>) -> u32 {
    let bytes = pollster::block_on(simulation.backend().bytes(LIST_STATE, 0, 16)).expect("a state");
    bytemuck::pod_collect_to_vec::<u8, u32>(&bytes)[1]
}

/// Which particles are active, where any are not.
pub fn life(simulation: &mut Simulation<Gpu>) -> Option<Vec<u32>> {
    pollster::block_on(simulation.read(motes::LIFE)).ok()
}

/// Where particles are; an inactive one is far from all others.
pub fn active_places(simulation: &mut Simulation<Gpu>, life: Option<&[u32]>) -> Vec<DVec3> {
    let active = |i: usize| life.is_none_or(|life| life[i] == 1);
    let place = |(i, x): (usize, &Vec4)| if active(i) { x.truncate().as_dvec3() } else { DVec3::NAN };
    positions(simulation).iter().enumerate().map(place).collect()
}

/// What brute force finds among active particles, as the weak law says it.
pub fn wanted(simulation: &mut Simulation<Gpu>, bounds: &Bounds, range: f64) -> Vec<Vec4> {
    let life = life(simulation);
    let places = active_places(simulation, life.as_deref());
    by_force(&places, bounds, range).iter().map(|a| (PART * a.as_dvec4()).as_vec4()).collect()
}

pub fn accelerations(simulation: &mut Simulation<Gpu>) -> Vec<Vec4> {
    pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations")
}

/// The plan of one evaluation.
pub fn evaluation(setup: &Setup, machine: Machine) -> Plan {
    let problem = setup.problem(machine).expect("a problem");
    let mut step = motes::integrators::Step::new(&setup.forces, problem);
    step.evaluate();
    step.finished().expect("a plan")
}

/// Looks at the list and at the law; whether the list was built.
pub fn agree(simulation: &mut Simulation<Gpu>, plan: &Plan, of: &str) -> bool {
    let count = simulation.count();
    let before = builds(simulation);
    let verdicts = pollster::block_on(compare(simulation.backend(), plan, count)).expect("a comparison");
    assert!(verdicts.iter().any(|v| v.kernel.starts_with("list") && v.field == "list"), "{of}: {plan}");
    for verdict in verdicts {
        assert!(verdict.good(), "{of}: {plan}: {verdict:?}");
    }
    builds(simulation) > before
}

#[test]
fn the_list_and_the_law_agree_with_brute_force() {
    let shared = support::device();
    for (place, Place { name, particles, bounds, range }) in places::all().into_iter().enumerate() {
        for (turn, (variant, machine)) in variants(&shared).into_iter().enumerate() {
            // Every pipeline takes its time: half of them with a skin.
            let skin = [0.0, 0.2][(place + turn) % 2];
            let of = format!("{name}, {variant}, skin {skin}");
            let setup = setup(&particles, bounds, Box::new(Curious(list(range, skin * range))), 1e-3);
            let mut simulation = on(&shared, machine, &setup);
            let plan = evaluation(&setup, machine);
            assert!(agree(&mut simulation, &plan, &of), "{of}: not built at first");
            assert!(!agree(&mut simulation, &plan, &of), "{of}: built for nothing");
            // One of them moves by too much, another out of its cell.
            let mut places = positions(&mut simulation);
            let step = range as f32 * Vec4::new(0.3, -0.35, 0.2, 0.0);
            places[0] += step;
            simulation.write(POSITION, &places[..1]).expect("places");
            let way = bounds.shortest(step.truncate().as_dvec3()).length();
            let rebuilt = places[0] != places[0] - step && way > 0.5 * skin * range;
            assert_eq!(agree(&mut simulation, &plan, &of), rebuilt, "{of}: a particle moved");
        }
    }
}

#[test]
fn runs_are_brute_force_to_the_bit() {
    let shared = support::device();
    let mixed = Bounds {
        low: DVec3::splat(-1.0),
        high: DVec3::splat(1.0),
        sides: [Side::Periodic, Side::Reflecting, Side::Open],
        dimensions: 3,
    };
    let periodic = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
    for bounds in [periodic, mixed, Bounds::default()] {
        for (variant, machine) in variants(&shared) {
            for (range, skin) in [(0.31, 0.1), (0.45, 0.02), (0.2, 0.3), (0.3, 0.0)] {
                let of = format!("{bounds}, {variant}, range {range}, skin {skin}");
                let setup = setup(&support::cloud(400, 9), bounds, Box::new(Weak(list(range, skin))), 7e-3);
                let mut simulation = on(&shared, machine, &setup);
                for _ in 0..12 {
                    simulation.step(5).expect("steps");
                    pollster::block_on(simulation.check()).expect("no alarm");
                    let want = wanted(&mut simulation, &bounds, range);
                    same(&accelerations(&mut simulation), &want, &of);
                }
                // The fastest has moved by about 0.4: that is so many halves of the skin, at least half as often.
                let built = builds(&mut simulation);
                let most = if skin > 0.0 { 2 + (2.0 * 0.5 / (0.5 * skin)) as u32 } else { 61 };
                assert!(built >= 2 && built <= most, "{of}: built {built} times");
            }
        }
    }
}

/// A cloud, and particles so far apart that an emitter spawns until a time; outside of a sphere they are removed. Forces act on
/// spawned particles at once.
pub fn jet(spacing: f64, until: f64, radius: f64) -> State {
    let text = |word: &'static str| Value::Text(word.into());
    let known = Settings::defaults(emitter::KEYS)
        .with("shape", text("rectangle"))
        .with("size", Value::Vector(DVec3::new(0.5, 0.4, 0.0)))
        .with("direction", Value::Vector(DVec3::new(2.0, -1.0, 2.0)))
        .with("speed", Value::Number(1.3))
        .with("spacing", Value::Number(spacing));
    let mut state = emitter::build(&known, 3, until, 10_000).expect("an emitter");
    state.births.iter_mut().for_each(|birth| birth.guided = 0.0);
    let solid = Solid::Sphere(radius);
    state.drains = vec![Drain { solid, position: DVec3::ZERO, outside: true, species: None }];
    state.append(&support::cloud(100, 3)).expect("one form of columns");
    state.links = motes::links::Links::default();
    state
}

#[test]
fn births_and_deaths_are_brute_force_to_the_bit() {
    let shared = support::device();
    let particles = jet(0.1, 1.0, 0.6);
    let bounds = Bounds::new(DVec3::splat(-0.7), DVec3::splat(0.7), Side::Periodic);
    for (variant, machine) in variants(&shared) {
        let setup = setup(&particles, bounds, Box::new(Weak(list(0.23, 0.2))), 7e-3);
        let mut simulation = on(&shared, machine, &setup);
        let plan = evaluation(&setup, machine);
        let mut population = Vec::new();
        for _ in 0..15 {
            simulation.step(8).expect("steps");
            pollster::block_on(simulation.check()).expect("no alarm");
            // The next evaluation knows what has been spawned and removed.
            agree(&mut simulation, &plan, variant);
            let want = wanted(&mut simulation, &bounds, 0.23);
            same(&accelerations(&mut simulation), &want, variant);
            population.push(pollster::block_on(simulation.population()).expect("a population"));
        }
        assert!(
            population.iter().any(|p| p.pending > 0) && population.iter().any(|p| p.removed > 20),
            "{population:?}"
        );
    }
}

#[test]
fn measuring_leaves_no_trace() {
    let shared = support::device();
    let bounds = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
    let (_, machine) = variants(&shared)[0];
    let run = |measured: u32, skin: f64| {
        let setup = setup(&support::cloud(300, 8), bounds, Box::new(Curious(list(0.4, skin))), 2e-3);
        let mut simulation = on(&shared, machine, &setup);
        for step in 0..80 {
            if measured > 0 && step % measured == 0 {
                pollster::block_on(simulation.snapshot()).expect("a snapshot");
            }
            simulation.step(1).expect("a step");
        }
        let velocity: Vec<Vec4> = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
        (positions(&mut simulation), velocity, builds(&mut simulation))
    };
    let (x, v, built) = run(0, 0.05);
    assert!(built > 3, "built {built} times");
    for (measured, skin) in [(1, 0.05), (7, 0.05), (3, 0.1), (0, 0.21)] {
        let other = run(measured, skin);
        assert!(x == other.0 && v == other.1, "measured every {measured}, skin {skin}: other bits");
    }
}

#[test]
fn laws_share_one_list() {
    let shared = support::device();
    let bounds = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
    for (variant, machine) in variants(&shared) {
        let mut setup = setup(&support::cloud(300, 8), bounds, Box::new(Weak(list(0.2, 0.3))), 2e-3);
        setup.forces.push(Box::new(Curious(list(0.4, 0.05))));
        let plan = setup.plans(machine).expect("plans").step;
        let lists: Vec<_> = plan.steps().filter(|kernel| kernel.name.starts_with("list ")).collect();
        assert_eq!(lists.len(), 1, "{plan}");
        assert!(lists[0].name.starts_with("list RANGE=0.4 SKIN=0.1 "), "{plan}");
        let mut simulation = on(&shared, machine, &setup);
        let plan = evaluation(&setup, machine);
        for _ in 0..5 {
            agree(&mut simulation, &plan, variant);
            simulation.step(9).expect("steps");
        }
        assert!(builds(&mut simulation) > 1);
    }
}

#[test]
fn what_is_no_skin_is_refused() {
    for skin in [-1.0, f64::NAN, f64::INFINITY] {
        let setup = setup(&support::cloud(30, 8), Bounds::default(), Box::new(Weak(list(0.1, skin))), 2e-3);
        let Err(Error::Scene(text)) = setup.plans(Machine::HOST).map(|_| ()) else { panic!("{skin} is a skin") };
        assert!(text.contains(&format!("a skin of {skin}")), "{text}");
    }
}
