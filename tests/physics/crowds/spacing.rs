//! `collision_free_speed`: the fundamental diagram of a file, trajectories of JuPedSim, overlaps, walls, encounters, mirror images, lockstep.

use glam::{DVec2, DVec3};
use motes::floor_plan::FloorPlan;
use motes::forces::Component;
use motes::kernel::Machine;
use motes::settings::Value;
use motes::{Setup, Side, State};

use super::plans::{exit, plan};
use super::{PERSON, Person, crowd, state};
use crate::matter::{agrees, on_cpu};
use crate::support::Random;
use crate::support::states::{force, integrator, vector, word};

const TIME_GAP: f64 = 1.0;

fn model(more: &[(&'static str, Value)]) -> Box<dyn Component> {
    force("collision_free_speed", more)
}

fn along(direction: DVec3) -> Box<dyn Component> {
    force("walk", &[("direction", Value::Vector(direction))])
}

fn to(x: f64, y: f64) -> Box<dyn Component> {
    force("walk", &[("to", word("target")), ("target", vector(x, y, 0.0))])
}

fn setup(state: State, forces: Vec<Box<dyn Component>>, dt: f64) -> Setup {
    Setup { integrator: integrator("symplectic_euler"), ..super::setup(state, forces, dt) }
}

fn after(setup: &Setup, steps: u32) -> State {
    let mut simulation = on_cpu(setup);
    simulation.step(steps).expect("steps");
    pollster::block_on(simulation.snapshot()).expect("a state")
}

fn at(x: f64, y: f64) -> Person {
    Person { position: DVec3::new(x, y, 0.0), radius: 0.2, speed: 1.2, ..PERSON }
}

/// One pedestrian walks at its desired speed from the first step on, under either integrator, whatever it did before.
#[test]
fn one_walks_at_the_desired_speed() {
    for name in ["symplectic_euler", "leapfrog"] {
        let person = Person { velocity: DVec3::new(0.0, -3.0, 0.0), ..at(1.0, 2.0) };
        let forces = || vec![along(DVec3::new(0.6, 0.8, 0.0)), model(&[])];
        let setup = Setup { integrator: integrator(name), ..setup(state(&[person]), forces(), 0.01) };
        let end = after(&setup, 250);
        let (want, v) = (DVec3::new(1.0, 2.0, 0.0) + 3.0 * DVec3::new(0.6, 0.8, 0.0), 1.2 * DVec3::new(0.6, 0.8, 0.0));
        assert!((end.position()[0] - want).length() < 1e-5, "{name}: {}", end.position()[0]);
        assert!((end.velocity()[0] - v).length() < 1e-6, "{name}: {}", end.velocity()[0]);
    }
}

/// In a file with equal spacings, on a ring, all walk at V = min(v₀, (d − l) / T), which is the model's fundamental diagram.
#[test]
fn a_file_has_the_fundamental_diagram_of_the_model() {
    for (spacing, time_gap) in [(0.4, 1.0), (0.45, 1.0), (0.8, 1.0), (1.1, 0.7), (1.59, 1.0), (1.7, 1.0), (2.5, 1.3)] {
        let count = 12;
        let half = 0.5 * spacing * f64::from(count);
        let file: Vec<Person> = (0..count).map(|i| at(spacing * (f64::from(i) + 0.5) - half, 0.0)).collect();
        let forces = vec![along(DVec3::X), model(&[("time_gap", Value::Number(time_gap))])];
        let mut setup = setup(state(&file), forces, 0.05);
        let corner = DVec3::new(half, 9.0, 0.0);
        setup.bounds = motes::Bounds { dimensions: 2, ..motes::Bounds::new(-corner, corner, Side::Periodic) };
        let want = ((spacing - 0.4) / time_gap).clamp(0.0, 1.2);
        for v in after(&setup, 20).velocity() {
            // Places on a ring of 30 m are rounded by 2e-6 m.
            assert!((*v - want * DVec3::X).length() < 1e-5, "{spacing} {time_gap}: {v}, and {want} is known");
        }
    }
}

/// Behind one at the speed u spacings tend to l + u T, by 1 − dt / T in each step: nearer than 1e-5 after 12 T.
#[test]
fn those_behind_a_slow_one_keep_their_time_gap() {
    let mut file: Vec<Person> = (0..5).map(|i| at(-2.0 * f64::from(i), 0.0)).collect();
    file[0].speed = 0.5;
    let end = after(&setup(state(&file), vec![along(DVec3::X), model(&[])], 0.02), 2000);
    for two in end.position().windows(2) {
        assert!((two[0].x - two[1].x - 0.4 - 0.5 * TIME_GAP).abs() < 1e-4, "{two:?}");
    }
}

/// Five that walk to a point, beside and behind each other, are where JuPedSim 1.4.2 (`CollisionFreeSpeedModel` with its defaults, dt = 0.01, f64) has them after
/// so many steps. The places here are rounded to 2e-7 m in each step.
#[test]
fn five_walk_as_in_jupedsim() {
    let known = [
        (
            1,
            [
                [0.0028674, 0.0035685],
                [0.7048374, 0.100181],
                [0.3123547, 0.7540448],
                [-0.1909741, -0.6062876],
                [1.6059291, 0.3509198],
            ],
        ),
        (
            100,
            [
                [0.3360086, 0.1628019],
                [1.226615, 0.1441797],
                [1.5755409, 0.9821096],
                [0.8860343, -0.5931414],
                [2.1937771, 0.4358702],
            ],
        ),
        (
            200,
            [
                [0.8083857, 0.2399151],
                [1.7647287, 0.3351348],
                [2.8581384, 1.1872989],
                [1.9791572, -0.4816931],
                [2.7932144, 0.436413],
            ],
        ),
        (
            300,
            [
                [1.3409656, 0.3181835],
                [2.3403682, 0.4745807],
                [4.156435, 1.1623236],
                [3.0435197, -0.2052456],
                [3.3852838, 0.5255105],
            ],
        ),
    ];
    let person = |x: f64, y: f64, speed: f64, radius: f64| Person { radius, speed, ..at(x, y) };
    let five = [
        person(0.0, 0.0, 1.2, 0.2),
        person(0.7, 0.1, 0.9, 0.25),
        person(0.3, 0.75, 1.3, 0.15),
        person(-0.2, -0.6, 1.1, 0.2),
        person(1.6, 0.35, 0.6, 0.2),
    ];
    let mut simulation = on_cpu(&setup(state(&five), vec![to(6.0, 1.0), model(&[])], 0.01));
    let mut done = 0;
    for (steps, places) in known {
        simulation.step(steps - done).expect("steps");
        done = steps;
        let now = pollster::block_on(simulation.snapshot()).expect("a state");
        for (x, want) in now.position().iter().zip(places) {
            let want = DVec2::from(want);
            assert!((x.truncate() - want).length() < 1e-6, "step {steps}: {x}, and {want} in JuPedSim");
        }
    }
}

/// The largest overlap of any two; of those that keep apart it is below 0.
fn overlap(state: &State) -> f64 {
    let (x, radius) = (state.position(), state.scalar("radius").expect("radii"));
    let there = |i: &usize| state.is_active(*i);
    let pairs = (0..x.len()).filter(there).flat_map(|i| (0..i).filter(there).map(move |j| (i, j)));
    pairs.map(|(i, j)| radius[i] + radius[j] - x[i].distance(x[j])).fold(f64::NEG_INFINITY, f64::max)
}

/// Places at random that do not overlap.
fn apart(count: usize, side: f64, seed: u64) -> Vec<Person> {
    let mut random = Random::new(seed);
    let mut people: Vec<Person> = Vec::new();
    while people.len() < count {
        let position = (0.5 * side * random.vector().with_z(0.0)).as_vec3().as_dvec3();
        let number = |x: f64| f64::from(x as f32);
        let radius = number(0.2 + 0.05 * random.next());
        if people.iter().all(|other| other.position.distance(position) > radius + other.radius) {
            people.push(Person { position, radius, speed: number(1.2 + 0.4 * random.next()), ..PERSON });
        }
    }
    people
}

/// All walk to one point, so that they are as dense as they can be. No two that are apart may come to overlap in continuous time. In steps of dt ≤ T / 2 one that is
/// not in front of the other may slide into its way: at the spacing ε each nears the other by v dt √(2 ε / l) at most, so that overlaps are at most the largest
/// value of 2 v dt √(2 ε / l) − ε, 2 v² dt² / l, and do not grow: those that overlap are in front of each other, or part.
#[test]
fn no_two_overlap() {
    let (mut seen, fastest, least): (f64, f64, f64) = (0.0, 1.6, 0.3);
    for (seed, dt) in [(1, 0.01), (2, 0.01), (3, 0.05), (4, 0.05), (5, 0.2), (6, 0.5), (7, 0.5)] {
        let setup = setup(state(&apart(60, 8.0, seed)), vec![to(0.3, -0.2), model(&[])], dt);
        let mut simulation = on_cpu(&setup);
        let most = 2.0 * (fastest * dt).powi(2) / least;
        let mut worst = f64::NEG_INFINITY;
        for _ in 0..(8.0 / dt) as u32 {
            simulation.step(1).expect("a step");
            worst = worst.max(overlap(&pollster::block_on(simulation.snapshot()).expect("a state")));
        }
        println!("seed {seed}, dt {dt}: overlaps of {worst} at most, {most} are possible");
        assert!(worst < most + 1e-6, "seed {seed}, dt {dt}: {worst}");
        seen = seen.max(worst / most);
    }
    assert!(seen > 0.0, "no step is long enough to show it: {seen}");
    // Without the model they walk into each other.
    let alone = setup(state(&apart(60, 8.0, 1)), vec![to(0.3, -0.2)], 0.01);
    let most = overlap(&after(&alone, 600));
    assert!(most > 0.3, "{most}");
}

/// Two that walk at each other, not quite in line, turn aside and pass; in line, they stay before each other.
#[test]
fn two_that_meet_pass() {
    for aside in [0.02, 0.1, -0.3, 0.0] {
        let mut two = state(&[at(-3.0, 0.0), at(3.0, aside)]);
        two.species_mut().copy_from_slice(&[0, 1]);
        let walk = |species: f64, x: f64| {
            force("walk", &[("direction", vector(x, 0.0, 0.0)), ("species", Value::Number(species))])
        };
        let setup = setup(two, vec![walk(0.0, 1.0), walk(1.0, -1.0), model(&[])], 0.01);
        let mut simulation = on_cpu(&setup);
        let mut worst = f64::NEG_INFINITY;
        for _ in 0..1200 {
            simulation.step(1).expect("a step");
            worst = worst.max(overlap(&pollster::block_on(simulation.snapshot()).expect("a state")));
        }
        let end = pollster::block_on(simulation.snapshot()).expect("a state");
        let [one, other] = [end.position()[0], end.position()[1]];
        if aside == 0.0 {
            // Their repulsion exceeds the desired direction at a gap of D ln a = 0.21 and turns them back, a step of 0.01 each.
            assert!(other.x - one.x > 0.4 && other.x - one.x < 0.4 + 0.3 && one.y == 0.0, "{one}, {other}");
        } else {
            assert!(one.x > 2.0 && other.x < -2.0, "{aside}: {one}, {other}");
        }
        assert!(worst < 0.0, "{aside}: {worst}");
    }
}

/// A crowd and its mirror image, about y = 0, stay mirror images: the f64 reference of each differs by rounding, which grows by e in D / v = 0.08 s at most.
#[test]
fn mirror_images_stay_mirror_images() {
    let people = apart(40, 6.0, 11);
    let mirrored: Vec<Person> =
        people.iter().map(|one| Person { position: one.position * DVec3::new(1.0, -1.0, 1.0), ..*one }).collect();
    let end = |people: &[Person], way: f64| {
        let forces = vec![along(DVec3::new(0.8, 0.6 * way, 0.0)), model(&[])];
        after(&setup(state(people), forces, 0.01), 50)
    };
    let (one, other) = (end(&people, 1.0), end(&mirrored, -1.0));
    for (x, y) in one.position().iter().zip(other.position()) {
        assert!((*x - *y * DVec3::new(1.0, -1.0, 1.0)).length() < 1e-5, "{x} {y}");
    }
    let walked = one.position().iter().zip(&people).filter(|(x, was)| x.distance(was.position) > 0.2).count();
    assert!(walked > 20, "{walked} have walked");
}

/// A room with a thin wall that sticks out from below.
fn room() -> FloorPlan {
    let points = [[0.0, 0.0], [5.0, 0.0], [5.0, 4.0], [5.1, 4.0], [5.1, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
    plan(&points, vec![exit(&[[9.0, 1.0], [9.0, 2.0]], 0.2)], 0.1).expect("a room")
}

/// A crowd that walks into a corner, and against a thin wall, at five times the speed of walking: no disc ever overlaps a wall by more than rounding, with
/// repulsion from walls or without, and none is put back. By `social_wall` they would be in the same steps.
#[test]
fn no_disc_enters_a_wall() {
    for (seed, dt, repulsion) in [(1, 0.01, 5.0), (2, 0.1, 5.0), (3, 0.1, 0.0), (4, 0.4, 0.0)] {
        for way in [DVec3::new(1.0, -0.4, 0.0), DVec3::new(-1.0, 0.7, 0.0)] {
            let mut people = apart(40, 3.4, seed);
            people.iter_mut().for_each(|one| {
                one.position += DVec3::new(2.5, 6.0, 0.0);
                one.speed = 6.0;
            });
            let forces =
                vec![along(way), model(&[("wall_repulsion", Value::Number(repulsion)), ("range", Value::Number(7.0))])];
            let mut simulation = on_cpu(&setup(state(&people).on_floor(room()), forces, dt));
            let (floor, mut least) = (room(), f64::INFINITY);
            for _ in 0..60 {
                simulation.step(1).expect("a step");
                let now = pollster::block_on(simulation.snapshot()).expect("a state");
                for (x, one) in now.position().iter().zip(&people) {
                    assert!(floor.holds(x.truncate()), "seed {seed}, dt {dt}: {x}");
                    least = least.min(floor.distance(x.truncate()) - one.radius);
                }
                assert!(now.scalar("wall_corrections").expect("counts").iter().all(|count| *count < 1.0));
            }
            println!("seed {seed}, dt {dt}, {repulsion}: {least} from walls at least");
            assert!(least > -2e-6, "seed {seed}, dt {dt}: {least}");
            assert!(least < 0.05, "none comes near a wall: {least}");
        }
    }
}

/// A room with a door of some width, 0.4 m deep, and an exit behind it.
fn bottleneck(width: f64) -> FloorPlan {
    let [low, high] = [5.0 - 0.5 * width, 5.0 + 0.5 * width];
    let room = [[12.0, high], [12.0, 10.0], [0.0, 10.0], [0.0, 0.0], [12.0, 0.0], [12.0, low], [12.4, low]];
    let yard = [[12.4, 2.0], [16.0, 2.0], [16.0, 8.0], [12.4, 8.0], [12.4, high]];
    plan(&[&room[..], &yard[..]].concat(), vec![exit(&[[14.0, 2.1], [14.0, 7.9]], 0.25)], 0.1).expect("a room")
}

/// How many leave in a second through a door, between the 20th and the 80th, of 100 that desire 1.2 m/s with T = 1 s.
fn flow(width: f64, seed: u64) -> f64 {
    let mut people = apart(100, 9.5, seed);
    people.iter_mut().for_each(|one| {
        one.position += DVec3::new(6.0, 5.0, 0.0);
        (one.radius, one.speed) = (0.2, 1.2);
    });
    let setup = setup(state(&people).on_floor(bottleneck(width)), vec![force("navigate", &[]), model(&[])], 1.0 / 64.0);
    let shared = crate::support::device();
    let mut simulation =
        motes::Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation");
    let mut last = Vec::new();
    for _ in 0..40 {
        simulation.step(200).expect("steps");
        let end = pollster::block_on(simulation.snapshot()).expect("a state");
        let inside = end.scalar("time_inside").expect("times");
        last = (0..end.len()).filter(|i| !end.is_active(*i)).map(|i| inside[i]).collect::<Vec<_>>();
        assert!(end.scalar("wall_corrections").expect("counts").iter().all(|count| *count < 1.0));
        assert!(overlap(&end) < 2.0 * (1.2_f64 / 64.0).powi(2) / 0.4 + 2e-6, "{}", overlap(&end));
        if last.len() > 80 {
            break;
        }
    }
    last.sort_by(f64::total_cmp);
    assert!(last.len() >= 80, "{width} m, seed {seed}: only {} have left", last.len());
    let flow = 60.0 / (last[79] - last[19]);
    println!("{width} m, seed {seed}: {flow} in a second");
    flow
}

/// The flow through a door grows with its width as a straight line (Seyfried et al., Transp. Sci. 43, 395, 2009, found 1.9 in a second for each metre; others
/// between 1.3 and 2.4). Of this model it is of the same order: a lane of those at 1.2 m/s has 1.2 / (0.4 + 1.2) = 0.75 in a second, and lanes are 0.4 m wide or wider.
#[test]
fn the_flow_through_a_door_is_linear_in_its_width() {
    let widths = [1.2, 1.8, 2.4];
    let flows = widths.map(|width| flow(width, 1));
    let mean = |all: [f64; 3]| all.iter().sum::<f64>() / 3.0;
    let (x, y) = (mean(widths), mean(flows));
    let slope = widths.iter().zip(flows).map(|(b, j)| (b - x) * (j - y)).sum::<f64>()
        / widths.iter().map(|b| (b - x).powi(2)).sum::<f64>();
    println!("{flows:?}: {slope} in a second for each metre");
    assert!((1.0..2.5).contains(&slope), "{slope}");
    for (b, j) in widths.iter().zip(flows) {
        let line = y + slope * (b - x);
        assert!((j - line).abs() < 0.12 * y, "{b} m: {j}, and {line} on the line");
    }
}

/// Behind a thin wall none is seen: two on either side walk along it as if they were alone, and beside its end they see each other.
#[test]
fn walls_hide_what_is_behind_them() {
    let two = |y: f64| {
        let people = [at(4.7, y), at(5.4, y + 0.3)];
        let forces = vec![along(DVec3::Y), model(&[("wall_repulsion", Value::Number(0.0))])];
        after(&setup(state(&people).on_floor(room()), forces, 0.01), 1).velocity()[0]
    };
    assert!((two(2.0) - 1.2 * DVec3::Y).length() < 1e-6, "{}", two(2.0));
    assert!(two(4.5).x < -0.1, "{}", two(4.5));
}

/// Each kernel agrees with its reference through every search, across a periodic box, of one species, and on a floor.
#[test]
fn lockstep() {
    for (seed, over) in [(1, "near"), (2, "list"), (3, "within"), (4, "near")] {
        let mut own = vec![("over", word(over))];
        if seed > 2 {
            own.push(("species", Value::Number(1.0)));
        }
        for count in [63, 250] {
            let side = (count as f64 * 0.9).sqrt();
            let mut setup = setup(crowd(count, side, seed), vec![model(&own), to(0.3, 0.2)], 1e-2);
            if seed == 4 {
                let half = DVec3::new(0.5 * side + 0.7, 0.5 * side + 0.7, 0.0);
                setup.bounds = motes::Bounds { dimensions: 2, ..motes::Bounds::new(-half, half, Side::Periodic) };
            }
            let names = ["walk", "collision_free_speed", "turn aside", "keep spacing", "set off"];
            agrees(&setup, 3, 8.0, &names);
        }
    }
    let mut people = crowd(120, 3.4, 5);
    people.position_mut().iter_mut().for_each(|x| *x += DVec3::new(2.5, 6.0, 0.0));
    let setup = setup(people.on_floor(room()), vec![force("navigate", &[]), model(&[])], 1e-2);
    agrees(
        &setup,
        3,
        8.0,
        &["navigate", "collision_free_speed", "turn aside", "keep spacing", "set off", "walls keep"],
    );
}

#[test]
fn settings_that_make_no_sense_are_refused() {
    let why = |forces: Vec<Box<dyn Component>>, dt: f64| {
        let setup = setup(state(&[at(0.0, 0.0)]), forces, dt);
        let plans = setup.check().and_then(|_| setup.plans(Machine::HOST));
        plans.map(|_| ()).expect_err("it makes no sense").to_string()
    };
    assert!(why(vec![model(&[("time_gap", Value::Number(0.1))])], 0.06).contains("choose a dt up to 0.05"));
    assert!(why(vec![model(&[("range", Value::Number(0.3))])], 0.01).contains("sum of two radii"));
    assert!(why(vec![model(&[("time_gap", Value::Number(3.0))])], 0.01).contains("time_gap"));
    assert!(why(vec![model(&[("decay", Value::Number(0.001))])], 0.01).contains("single precision"));
    assert!(why(vec![model(&[]), model(&[])], 0.01).contains("twice"));
    let mut solid = setup(state(&[at(0.0, 0.0)]), vec![model(&[])], 0.01);
    solid.bounds.dimensions = 3;
    assert!(solid.check().expect_err("a space").to_string().contains("dimensions = 2"));
}
