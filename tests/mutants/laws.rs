//! Stages of laws, and of what keeps velocities lawful.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use glam::{DVec3, Vec4};
use motes::forces::{Over, Problem};
use motes::integrators::Step;
use motes::kernel::{ALARM, Backend, Machine, POSITION, QUIET, VELOCITY, World};
use motes::links::Link;
use motes::settings::{Kind, Value};
use motes::{Bounds, Gpu, Side, Simulation};

use crate::stages::{Device, FEW, Stage, fill, moving, put, stage};
use crate::support::machines::{alone, kernel, kernels};
use crate::support::states::{force, word};
use crate::support::{self, choices};

/// Every law alone, in all its variants; those over pairs by the visit that compiles fastest.
pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    let machine = Machine::HOST;
    for entry in choices::entries() {
        for settings in choices::variants(entry.keys) {
            // Vectors that are none, or short, may go another way.
            let mut all = vec![settings.clone()];
            for key in entry.keys.iter().filter(|key| key.kind == Kind::Vector) {
                for part in [0.0, 0.3] {
                    let vector = (settings.vector(key.name) * part).as_vec3().as_dvec3();
                    all.push(settings.clone().with(key.name, Value::Vector(vector)));
                }
            }
            for settings in all {
                let force = (entry.build)(&settings);
                // A search wants its cell list, its list or its tree, and has stages of its own; brute force finds the same.
                let searches = |over| {
                    matches!(over, Over::Near { .. } | Over::List { .. } | Over::Nearest { .. } | Over::Tree { .. })
                };
                if force.laws().iter().any(|law| searches(law.over)) {
                    continue;
                }
                let problem = Problem::new(u32::try_from(FEW).expect("few"), machine).tied(&support::links(FEW), &[]);
                for kernel in kernels(force.as_ref(), &problem) {
                    stages.push(stage(entry.name, resting(device, machine, Bounds::default()), kernel));
                }
            }
        }
    }
}

/// The first law of a step, which sets the acceleration; and links of four kinds at most, which have a visit of their own.
pub fn firsts(device: &Device, stages: &mut Vec<Stage>) {
    let machine = Machine::HOST;
    let mut alike = support::links(FEW);
    for (place, spring) in alike.springs.iter_mut().enumerate() {
        // None at rest, ropes, and with a length at rest; not all ends of them have all kinds.
        let [rest, stiffness, damping] =
            [[0.0, 1.3, 0.7], [0.6, 0.9, 0.2], [0.35, 1.7, 0.4], [0.75, 0.6, 0.3]][place % 7 % 4];
        (spring.rope, spring.rest) = (place % 7 % 4 == 1, f64::from(rest as f32));
        [spring.stiffness, spring.damping] = [stiffness, damping].map(|x: f64| f64::from((x / FEW as f64) as f32));
    }
    // A particle without mass has no links.
    let mut each = support::links(FEW);
    for links in [&mut alike, &mut each] {
        links.springs.retain(|link| !link.ends.contains(&13));
    }
    for (name, links) in [("drag", &alike), ("spring", &each), ("spring", &alike), ("fene", &alike)] {
        let longest: &[_] = if name == "fene" { &[("max_length", Value::Number(4.125))] } else { &[] };
        let force = [force(name, longest)];
        let problem = Problem::new(u32::try_from(FEW).expect("few"), machine).tied(links, &[]);
        let mut step = Step::new(&force, problem.clone());
        step.evaluate();
        let first = step.finished().expect("a plan").kernels.swap_remove(0);
        assert_eq!(first.name, name, "nothing is cleared before the first law");
        let later = force[0].laws().swap_remove(0).kernel(&problem).expect("a kernel");
        for (case, kernel) in [("first", first), ("later", later)] {
            let mut simulation = resting(device, machine, Bounds::default());
            let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
            places[13].w = 0.0;
            simulation.write(POSITION, &places).expect("places");
            stages.push(stage(&format!("{name}, {case}"), simulation, kernel));
        }
    }
}

/// Softenings of particles: some reach beyond most of the cloud, and some are 0.
pub fn softenings(device: &Device, stages: &mut Vec<Stage>) {
    let machine = Machine::HOST;
    for name in ["plummer", "spline"] {
        let settings = [
            ("g", Value::Number(1.3)),
            ("softening", Value::Number(0.75)),
            ("kernel", word(name)),
            ("individual_softening", Value::Flag(true)),
        ];
        let plan = alone(kernel(force("gravity", &settings).as_ref(), FEW, &machine));
        let mut simulation = resting(device, machine, Bounds::default());
        fill(&mut simulation, &plan);
        let mut random = support::Random::new(47);
        let own: Vec<f32> = (0..FEW).map(|i| if i % 7 == 3 { 0.0 } else { 0.75 * random.narrow().abs() }).collect();
        simulation.backend().write_bytes("softening_length", 0, bytemuck::cast_slice(&own)).expect("softenings");
        stages.push(Stage::of(&format!("softenings, {name}"), simulation, plan));
    }
}

/// A joint that is almost straight, and a triangle that goes with the air.
pub fn corners(device: &Device, stages: &mut Vec<Stage>) {
    let machine = Machine::HOST;
    for name in ["joint", "air"] {
        let mut simulation = resting(device, machine, Bounds::default());
        let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
        for (id, x, y) in [(30, 0.25, 0.0), (31, 0.75, 0.0), (32, 1.25, 4e-4)] {
            places[id] = Vec4::new(x, y, 0.0, places[id].w);
        }
        simulation.write(POSITION, &places).expect("places");
        let mut velocities = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
        for id in [30, 35, 31] {
            velocities[id] = Vec4::ZERO;
        }
        simulation.write(VELOCITY, &velocities).expect("velocities");
        stages.push(stage(&format!("{name}, straight"), simulation, kernel(force(name, &[]).as_ref(), FEW, &machine)));
    }
}

/// Bonds that are too long, where that was found in an earlier step, in this one or in a later one; and one without stiffness.
pub fn overlong(device: &Device, stages: &mut Vec<Stage>) {
    let places = pollster::block_on(resting(device, Machine::HOST, Bounds::default()).read(POSITION)).expect("places");
    let mut links = support::links(FEW);
    // Few of them are bonds, so that none is just as long as they may be.
    links.springs.iter_mut().enumerate().filter(|(n, _)| n % 8 > 0).for_each(|(_, link)| link.stiffness = 0.0);
    let length = |link: &Link| {
        let [a, b] = link.ends.map(|id| places[id as usize].truncate());
        f64::from(a.distance(b))
    };
    let bonds = links.springs.iter().filter(|link| link.stiffness > 0.0);
    let mut lengths: Vec<f64> = bonds.map(length).filter(|length| (1.0..2.0).contains(length)).collect();
    lengths.sort_by(f64::total_cmp);
    let gap = lengths.windows(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0]))).expect("lengths");
    let longest = f64::from((0.5 * (gap[0] + gap[1])) as f32);
    let problem = Problem::new(u32::try_from(FEW).expect("few"), Machine::HOST).tied(&links, &[]);
    let of = |longest: f64| force("fene", &[("max_length", Value::Number(longest))]).laws().swap_remove(0);
    let quiet = |longest: f64, stages: &mut Vec<Stage>| {
        let mut simulation = resting(device, Machine::HOST, Bounds::default());
        put(&mut simulation, ALARM, &QUIET);
        let kernel = of(longest).kernel(&problem).expect("a kernel");
        stages.push(stage("none is overlong", simulation, kernel));
    };
    // Longer than all bonds, and not than some links without stiffness.
    let most = |stiff: bool| {
        let some = links.springs.iter().filter(|link| (link.stiffness > 0.0) == stiff);
        some.map(length).fold(0.0, f64::max)
    };
    assert!(1.1 * most(true) < most(false), "{} and {}", most(true), most(false));
    quiet(f64::from((0.5 * (most(true) + most(false))) as f32), stages);
    let law = of(longest);
    for [step, particle] in [[u32::MAX; 2], [1, 3], [9, 3], [9, 490], [17, 490]] {
        let mut simulation = resting(device, Machine::HOST, Bounds::default());
        let clock = pollster::block_on(simulation.backend().world()).expect("a clock");
        simulation.backend().set_world(World { step: 9, ..clock }).expect("a clock");
        let mut alarm = QUIET;
        alarm[12..14].copy_from_slice(&[step, particle]);
        put(&mut simulation, ALARM, &alarm);
        stages.push(stage(&format!("overlong {step}"), simulation, law.clone().kernel(&problem).expect("a kernel")));
    }
}

/// The virials of links, by both of their tables, of joints and of dihedrals.
pub fn virials(device: &Device, stages: &mut Vec<Stage>) {
    let links = support::links(FEW);
    let open = Problem::new(u32::try_from(FEW).expect("few"), Machine::HOST).tied(&links, &[]);
    // So small that the way between the ends of a dihedral is another one than that along its bonds.
    let small = Bounds::new(DVec3::splat(-0.5), DVec3::splat(0.625), Side::Periodic);
    let tight = Problem { bounds: small, ..open.clone() };
    for (name, problem) in [("spring", &open), ("joint", &open), ("dihedral", &open), ("dihedral", &tight)] {
        let law = force(name, &[]).laws().swap_remove(0);
        let kernel = law.virial(problem).expect("a virial").expect("forces");
        let what = format!("virial of {name}, {}", problem.bounds.sides[0].name());
        stages.push(stage(&what, resting(device, Machine::HOST, problem.bounds), kernel));
    }
}

/// A cloud where it began: some at rest, one of them in the middle, two at one place, and some far away, alone or head on.
pub fn resting(device: &Device, machine: Machine, bounds: Bounds) -> Simulation<Gpu> {
    let mut simulation = moving(device, FEW, Some(machine));
    let cloud = support::cloud(FEW, 11);
    let join = |v: &[DVec3], w: &[f64]| -> Vec<Vec4> { v.iter().zip(w).map(|(v, w)| v.extend(*w).as_vec4()).collect() };
    let mut positions = join(cloud.position(), cloud.mass());
    let mut velocities = join(cloud.velocity(), cloud.size());
    for v in &mut velocities {
        *v *= Vec4::splat(1.7).with_w(1.0);
    }
    velocities[13] *= Vec4::splat(0.03).with_w(1.0);
    positions[6] = Vec4::ZERO.with_w(positions[6].w);
    for id in [5, 6, 7] {
        velocities[id] = Vec4::ZERO.with_w(velocities[id].w);
    }
    positions[9] = positions[8];
    positions[7] = positions[7].with_x(9.0);
    positions[10] = positions[10].with_x(-9.0);
    positions[11] = positions[10].with_y(positions[10].y + 0.1);
    velocities[11] = (-velocities[10]).with_w(velocities[11].w);
    simulation.write(POSITION, &positions).expect("places");
    simulation.write(VELOCITY, &velocities).expect("velocities");
    let gpu = simulation.backend();
    let world = pollster::block_on(gpu.world()).expect("a clock");
    gpu.set_world(World { bounds, ..world }).expect("a clock");
    simulation
}

/// Laws that ask how many dimensions there are, in the plane.
pub fn planes(device: &Device, stages: &mut Vec<Stage>) {
    let machine = Machine::HOST;
    let flat = Bounds { dimensions: 2, ..Bounds::default() };
    for entry in choices::entries() {
        for settings in choices::variants(entry.keys) {
            let force = (entry.build)(&settings);
            let asks = |text: &str| text.contains("world.dimensions") || text.contains("signed_distance(");
            if force.laws().iter().any(|law| asks(&law.wgsl.text)) {
                let kernel = kernel(force.as_ref(), FEW, &machine);
                stages.push(stage(&format!("{}, flat", entry.name), resting(device, machine, flat), kernel));
            }
        }
    }
}
