//! Stages of rigid rods: chains with held ends and without, after drifts forth and back, after kicks, and where one is lost.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use glam::{DVec3, Vec4};
use motes::forces::Problem;
use motes::kernel::{Backend, Kernel, Machine, Plan, World};
use motes::links::{Links, Rod};
use motes::motion::{Held, Hold};
use motes::{Bounds, Gpu, POSITION, Side, Simulation, VELOCITY};

use crate::stages::{Device, FEW, Stage, moving};
use crate::support::Random;
use crate::support::states::force;

const PART: f64 = 0.4;

/// Chains of one to three rods, some through a periodic side; fixed ones at ends and within.
fn tied(device: &Device, back: f64) -> (Simulation<Gpu>, Links, Vec<Held>) {
    let bounds = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
    let mut simulation = moving(device, FEW, None);
    let clock = pollster::block_on(simulation.backend().world()).expect("a clock");
    simulation.backend().set_world(World { bounds, ..clock }).expect("a world");
    let mut random = Random::new(29);
    let (mut places, mut links, mut held) = (Vec::<DVec3>::new(), Links::default(), Vec::new());
    let mut next = 3;
    for id in 0..FEW {
        let starts = id == 0 || next == 0;
        next = if starts { 1 + id % 3 } else { next - 1 };
        let place = if starts { random.vector() } else { places[id - 1] + random.vector().normalize() * 0.4 };
        places.push(place.as_vec3().as_dvec3());
        if !starts {
            // On the way back they are found too long and too short as well.
            let wrong = if back < 0.0 { [0.95, 1.05][id % 2] } else { 1.0 };
            let length = f64::from((wrong * places[id].distance(places[id - 1])) as f32);
            links.rods.push(Rod { ends: [id as u32, id as u32 - 1], length });
        }
        if id % 6 == 5 {
            held.push(Held { id: id as u32, by: Hold::Fixed });
        }
    }
    let h = back * clock.dt;
    let speed = if back > PART { 0.2 } else { 0.5 };
    let velocity: Vec<Vec4> = (0..FEW).map(|_| (random.vector() * speed).as_vec3().extend(0.3)).collect();
    let masses: Vec<f32> = (0..FEW).map(|_| (1.5 + random.next()) as f32).collect();
    let moved = places.iter().zip(&velocity).map(|(x, v)| bounds.wrapped_single(*x + h * v.truncate().as_dvec3()));
    let position: Vec<Vec4> = moved.zip(&masses).map(|(x, m)| x.extend(*m)).collect();
    simulation.write(POSITION, &position).expect("places");
    simulation.write(VELOCITY, &velocity).expect("velocities");
    (simulation, links, held)
}

fn kernel(links: &Links, held: &[Held], write: impl Fn(&mut Plan, &Problem)) -> Kernel {
    let machine = Machine::HOST;
    let problem = Problem::new(u32::try_from(FEW).expect("few"), machine).tied(links, held);
    let mut plan = Plan::default();
    write(&mut plan, &problem);
    plan.kernels.remove(0)
}

/// What follows a drift, one back, a step that was no drift, and a kick; and a chain that is lost.
pub fn rods(device: &Device, stages: &mut Vec<Stage>) {
    let rod = force("rod", &[]);
    for (factor, settles) in [(PART, false), (-PART, false), (0.0, false), (1.0, true)] {
        // As if a part of the step had gone otherwise.
        let (simulation, links, held) = tied(device, if settles { 0.9 } else { factor });
        let kernel = kernel(&links, &held, |plan, problem| {
            if settles {
                rod.stage(motes::component::Stage::AfterAdvance { factor: 1.0 }, plan, problem)
            } else {
                rod.stage(motes::component::Stage::AfterDrift { factor }, plan, problem)
            }
            .expect("a kernel");
        });
        stages.push(Stage::new(&format!("rods, {factor}"), simulation, kernel));
    }
    for first in [3usize, 4] {
        let mut simulation = moving(device, FEW, None);
        let mut links = Links::default();
        links.rods.push(Rod { ends: [3, 4], length: 1.0 });
        let held = [Held { id: first as u32, by: Hold::Fixed }];
        let mut position = vec![Vec4::ONE; FEW];
        (position[3], position[4]) = (Vec4::new(0.0, 0.0, 0.0, 2.0), Vec4::new(1.0, 9.0, 0.0, 2.0));
        simulation.write(POSITION, &position).expect("places");
        let clock = pollster::block_on(simulation.backend().world()).expect("a clock");
        let mut velocity = vec![Vec4::ZERO; FEW];
        // One has gone nine lengths in a step, the other was nine away before.
        velocity[4].y = if first == 3 { (9.0 / clock.dt) as f32 } else { 0.0 };
        simulation.write(VELOCITY, &velocity).expect("velocities");
        let kernel = kernel(&links, &held, |plan, problem| {
            rod.stage(motes::component::Stage::AfterDrift { factor: 1.0 }, plan, problem).expect("a kernel");
        });
        let mut expected: Vec<f32> = position.iter().flat_map(Vec4::to_array).collect();
        let lost = 4 * (7 - first);
        expected[lost..lost + 3].fill(f32::NAN);
        stages.push(
            Stage::new(&format!("a lost rod, {first} held"), simulation, kernel).expected(POSITION.name, expected),
        );
    }
}
