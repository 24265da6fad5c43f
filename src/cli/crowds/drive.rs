//! Steps until all have left, with samples of places.

use glam::DVec2;
use motes::crowds::EXIT_DISTANCE;
use motes::evacuation::Record;
use motes::kernel::{Array, Backend};
use motes::run::{Progress as _, Stop};
use motes::{Error, Setup, Simulation};

use crate::cli::progress::Progress;

/// A run ends where nothing moves for so long \[s\].
pub const STILL: f64 = 30.0;

/// What a run gives.
pub struct Driven {
    pub record: Record,
    /// The distances of cells to exits \[m\].
    pub distance: Vec<f64>,
    /// The steps that were made.
    pub steps: u64,
    /// Whether it ended because those inside stood still.
    pub stuck: bool,
    /// Whether it was stopped before its end.
    pub stopped: bool,
    /// How often a pedestrian was put back in front of a wall.
    pub corrections: f64,
}

/// Steps until all have left, at most so many steps, with a sample each `every` steps.
pub async fn out<B: Backend>(
    simulation: &mut Simulation<B>,
    setup: &Setup,
    (every, most): (u32, u64),
    stop: &Stop,
    progress: &mut Progress,
) -> Result<Driven, Error> {
    let (state, dt) = (&setup.state, setup.dt);
    let places: Vec<DVec2> = state.position().iter().map(|x| x.truncate()).collect();
    let speeds = state.scalar("desired_speed").map(<[f64]>::to_vec).unwrap_or_default();
    let mut record = Record::begin(speeds, &places, 0.0);
    let mut steps = 0;
    while record.inside() > 0
        && !record.stands_still(STILL)
        && steps < most
        && !stop.is_asked()
        && !stop.asked(std::time::Duration::ZERO)
    {
        let next = u32::try_from(most - steps).unwrap_or(u32::MAX).min(every);
        simulation.step(next)?;
        steps += u64::from(next);
        simulation.check().await?;
        let places = vectors(&simulation.read_column("position").await?);
        let inside = numbers(&simulation.read_column("time_inside").await?);
        record.take(steps as f64 * dt, &places, &inside);
        progress.at(steps);
    }
    let stuck = record.stands_still(STILL);
    let stopped = record.inside() > 0 && steps < most && !stuck;
    let distance = numbers(&simulation.read_column(EXIT_DISTANCE.name).await?);
    let corrections = numbers(&simulation.read_column("wall_corrections").await?).iter().sum();
    Ok(Driven { record, distance, steps, stuck, stopped, corrections })
}

fn vectors(array: &Array) -> Vec<DVec2> {
    match array {
        Array::Vec3(all) => all.iter().map(|x| x.truncate()).collect(),
        Array::Vec4(all) => all.iter().map(|x| DVec2::new(x.x, x.y)).collect(),
        _ => Vec::new(),
    }
}

fn numbers(array: &Array) -> Vec<f64> {
    match array {
        Array::Float(all) => all.clone(),
        _ => Vec::new(),
    }
}
