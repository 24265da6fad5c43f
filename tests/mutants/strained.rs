//! Stages of springs that are kept short: broken ones, held ends, ends that are heavy.

use motes::forces::Problem;
use motes::kernel::{Machine, Plan};
use motes::motion::{Held, Hold};
use motes::{Bounds, POSITION};

use crate::laws::resting;
use crate::stages::{Device, FEW, Stage, stage};
use crate::support;
use crate::support::states::force;

/// A sweep over springs of which some lack stiffness, or damping, or both, between ends of which one or both are held.
pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    let machine = Machine::HOST;
    let mut links = support::links(FEW);
    for (place, spring) in links.springs.iter_mut().enumerate() {
        [spring.stiffness, spring.damping] = [[0.7, 0.0], [0.0, 0.3], [0.0, 0.0], [2.5, 1.5]][place % 13 % 4];
    }
    let ids = (0..u32::try_from(FEW).expect("few")).filter(|id| id % 5 == 0 || id % 31 == 1);
    let held: Vec<_> = ids.map(|id| Held { id, by: Hold::Fixed }).collect();
    let problem = Problem::new(u32::try_from(FEW).expect("few"), machine).tied(&links, &held);
    let mut plan = Plan::default();
    force("strain_limit", &[])
        .stage(motes::component::Stage::AfterDrift { factor: 0.8 }, &mut plan, &problem)
        .expect("kernels");
    let mut simulation = resting(device, machine, Bounds::default());
    let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
    for (id, place) in places.iter_mut().enumerate() {
        place.w *= if id % 3 == 0 { 700.0 } else { 1.0 };
    }
    simulation.write(POSITION, &places).expect("places");
    stages.push(stage("strain limit", simulation, plan.kernels.swap_remove(0)));
}
