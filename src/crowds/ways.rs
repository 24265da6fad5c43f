//! Ways to the exits of a plan: the distance to the nearest exit round walls, by the eikonal equation, and its descent.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::Drive;
use crate::error::Error;
use crate::floor_plan::{Cells, FloorPlan};
use crate::kernel::{
    Column, Field, Host, Kernel, Kind as Element, Pass, Plan, Problem, Scalar, Shader, Shape, Source, Table, World,
};
use crate::visit::{Law, Particle, View};

/// The distance to the nearest exit, of each cell \[length\].
pub const EXIT_DISTANCE: Field<f32> = Field::new("exit_distance");
/// The same after the next sweep.
const NEXT: Field<f32> = Field::new("exit_distance_next");
/// The time at the end of the last step in which a pedestrian was inside \[time\].
const INSIDE: Field<f32> = Field::new("time_inside");
/// Tables of cells.
const OPEN: &str = "cell_open";
const KNOWN: &str = "cell_known";

/// No distance: where no way has been found yet.
const FAR: f64 = 1e9;
/// Pairs of sweeps of one kernel.
const PAIRS: usize = 16;

/// The column of distances.
pub(crate) fn exit_distance(plan: &FloorPlan) -> Column {
    let count = u32::try_from(plan.cell_count()).unwrap_or(u32::MAX);
    let about = "from the centres of the cells of the plan to the nearest exit, round walls";
    Column::new(EXIT_DISTANCE.name, Element::Scalar, "length", about).shaped(Shape::System(count))
}

/// The column of the times at which pedestrians leave.
pub(crate) fn time_inside() -> Column {
    let about = "the time at the end of the last step in which the pedestrian was inside";
    Column::new(INSIDE.name, Element::Scalar, "time", about)
}

/// The tables of cells. What is known of those that are not on the floor is 0, which is not read.
fn tables(cells: &Cells) -> [Table; 2] {
    let known = (0..cells.open.len()).map(|k| cells.known(k).unwrap_or(if cells.is_floor(k) { FAR } else { 0.0 }));
    #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
    let known = known.map(|known| (known as f32).to_bits());
    [(OPEN.into(), cells.open.clone()), (KNOWN.into(), known.collect::<Vec<_>>().into())]
}

/// The kernels that find ways, before the first step.
pub(crate) fn kernels(plan: &FloorPlan, out: &mut Plan) -> Result<(), Error> {
    let cells = plan.cells();
    let tables = tables(&cells);
    out.add(start(&cells, &tables)?);
    // What a cell knows comes from its neighbours, sweep by sweep, along a chain of cells that is at most √2 longer than the shortest one.
    let longest = cells.steps().into_iter().flatten().max().unwrap_or(0) as usize;
    let sweep = sweeps(&cells, &tables)?;
    (0..(longest * 3 / 2 + 2).div_ceil(2 * PAIRS)).for_each(|_| out.add(sweep.clone()));
    Ok(())
}

fn cell_kernel(
    name: &str,
    passes: Vec<Pass>,
    (cells, tables): (&Cells, &[Table]),
    run: impl Fn(&Host) -> Result<(), Error> + Send + Sync + 'static,
) -> Kernel {
    let count = cells.open.len() as u64;
    let reads = |name: &str| passes.iter().any(|pass| pass.shader.reflection().binding(name).is_some());
    let tables: Vec<Table> = tables.iter().filter(|(name, _)| reads(name)).cloned().collect();
    let mut sizes: Vec<_> = tables.iter().map(|(name, _)| (name.clone(), count)).collect();
    sizes.extend([(EXIT_DISTANCE.name.into(), count), (NEXT.name.into(), count)]);
    Kernel { name: name.to_owned(), passes, reference: Some(Arc::new(run)), sizes, scratch: Vec::new(), tables }
}

fn start(cells: &Cells, tables: &[Table]) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("crowds/exits.wgsl")])?;
    let count = u32::try_from(cells.open.len()).unwrap_or(u32::MAX);
    let pass = Pass { constants: vec![("COUNT", f64::from(count))], ..Pass::new(shader, count) };
    let reference = |host: &Host| {
        let known = host.reading::<f32>(KNOWN)?;
        host.write(EXIT_DISTANCE)?.copy_from_slice(&known);
        host.write(NEXT)?.copy_from_slice(&known);
        Ok(())
    };
    Ok(cell_kernel("exits", vec![pass], (cells, tables), reference))
}

/// Some sweeps over all cells, to and fro between two fields.
fn sweeps(cells: &Arc<Cells>, tables: &[Table]) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("crowds/ways.wgsl")])?;
    let count = u32::try_from(cells.open.len()).unwrap_or(u32::MAX);
    let constants = vec![("COUNT", f64::from(count)), ("WIDTH", cells.count[0] as f64), ("SIDE", cells.side)];
    let pass = Pass { constants, ..Pass::new(shader, count) };
    let [one, other] = [EXIT_DISTANCE.name, NEXT.name];
    let there = pass.clone().on(&[("before", one.into()), ("after", other.into())]);
    let back = pass.on(&[("before", other.into()), ("after", one.into())]);
    let (own, passes) = (cells.clone(), (0..PAIRS).flat_map(|_| [there.clone(), back.clone()]).collect());
    let reference = move |host: &Host| {
        let known = host.reading::<f32>(KNOWN)?;
        let (mut here, mut next) = (host.write(EXIT_DISTANCE)?, host.write(NEXT)?);
        for _ in 0..PAIRS {
            swept(&own, &known, &here, &mut next);
            swept(&own, &known, &next, &mut here);
        }
        Ok(())
    };
    Ok(cell_kernel("ways", passes, (cells, tables), reference))
}

/// A sweep by Godunov's upwind differences (Rouy & Tourin, SIAM J. Numer. Anal. 29, 867, 1992).
fn swept(cells: &Cells, known: &[f64], before: &[f64], after: &mut [f64]) {
    let h = cells.side;
    for (k, to) in after.iter_mut().enumerate() {
        let [west, east, south, north] = cells.next(k).map(|next| next.map_or(FAR, |next| before[next]));
        let (a, b) = (west.min(east), south.min(north));
        let mut found = FAR;
        if known[k] >= FAR && a.min(b) < FAR {
            let apart = (a - b).abs();
            found = if apart < h { 0.5 * (a + b + (2.0 * h * h - apart * apart).sqrt()) } else { a.min(b) + h };
        }
        *to = before[k].min(found);
    }
}

/// The kernel that notes how long pedestrians are inside.
pub(crate) fn inside(problem: &Problem) -> Result<Kernel, Error> {
    let reference = |host: &Host| {
        let view = View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        let mut inside = host.write(INSIDE)?;
        let active = bodies.iter().filter(|me| me.is_active());
        active.for_each(|me| inside[me.index] = f64::from(world.step + 1) * world.dt);
        Ok(())
    };
    let files = [crate::shader!("world.wgsl"), crate::shader!("crowds/inside.wgsl"), problem.active()];
    Ok(Kernel::new("inside", Shader::join(&files)?, Vec::new(), problem.capacity, Arc::new(reference)).alone())
}

/// The law that drives pedestrians of a species, or all, to exits, within a relaxation time.
pub(crate) fn drive(plan: &FloorPlan, wgsl: Source, (time, species): (f64, Option<u32>), is_followed: bool) -> Law {
    let cells = plan.cells();
    let [width, height] = cells.count.map(|n| Scalar::Uint(u32::try_from(n).unwrap_or(u32::MAX)));
    let low = cells.low.as_vec2();
    let values = [
        ("low", Scalar::Vector(low.as_dvec2().extend(0.0))),
        ("side", Scalar::Float(cells.side)),
        ("relaxation_time", Scalar::Float(time)),
        ("width", width),
        ("height", height),
        ("species", Scalar::Uint(species.unwrap_or(u32::MAX))),
    ];
    let values = values.map(|(name, value)| (name.to_owned(), value)).to_vec();
    let tables = vec![(OPEN.into(), cells.open.clone())];
    let drive = Drive { name: "navigate", wgsl, values, tables, time, species };
    drive.law(is_followed, move |me: &Particle, _: &World| {
        way(&cells, me.all(EXIT_DISTANCE.name), me.position.truncate() - cells.low)
    })
}

/// The direction −∇T / |∇T| at a point relative to the lowest corner; 0 where there is no way.
fn way(cells: &Cells, distance: &[f64], x: DVec2) -> DVec3 {
    let [nx, ny] = cells.count;
    let place = x / cells.side - 0.5;
    let first = place.floor().clamp(DVec2::ZERO, DVec2::new(nx as f64 - 2.0, ny as f64 - 2.0));
    let part = (place - first).clamp(DVec2::ZERO, DVec2::ONE);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to cells")]
    let corner = first.y as usize * nx + first.x as usize;
    let at = |n: usize| corner + (n & 1) + (n >> 1) * nx;
    let weight = |n: usize| {
        let [x, y] = [(n & 1, part.x), (n >> 1, part.y)].map(|(high, part)| if high > 0 { part } else { 1.0 - part });
        x * y
    };
    let known = |n: &usize| cells.is_floor(at(*n)) && distance.get(at(*n)).is_some_and(|far| *far < FAR);
    let Some(nearest) = (0..4).filter(known).rev().max_by(|a, b| weight(*a).total_cmp(&weight(*b))) else {
        return DVec3::ZERO;
    };
    let bit = |n: usize, along_y: bool| match (along_y, n & 1 > 0, n & 2 > 0) {
        (false, high, _) => {
            if high {
                1
            } else {
                2
            }
        }
        (true, _, high) => {
            if high {
                4
            } else {
                8
            }
        }
    };
    let leads = |from: usize, n: usize, along_y: bool| cells.open[at(from)] & bit(n, along_y) > 0;
    let is_open = |n: &usize| match n ^ nearest {
        0 => true,
        1 => leads(nearest, nearest, false),
        2 => leads(nearest, nearest, true),
        _ => {
            leads(nearest, nearest, false)
                && leads(nearest, nearest, true)
                && leads(nearest ^ 1, nearest, true)
                && leads(nearest ^ 2, nearest, false)
        }
    };
    let sum: DVec2 = (0..4).filter(known).filter(is_open).map(|n| weight(n) * heading(cells, distance, at(n))).sum();
    sum.normalize_or_zero().extend(0.0)
}

/// The direction in a cell, by one-sided differences to the smaller neighbours.
fn heading(cells: &Cells, distance: &[f64], k: usize) -> DVec2 {
    let here = distance[k];
    let [west, east, south, north] = cells.next(k).map(|next| next.map_or(FAR, |next| distance[next]));
    let slope = |below: f64, above: f64| if below < above { -(here - below).max(0.0) } else { (here - above).max(0.0) };
    DVec2::new(slope(west, east), slope(south, north)).normalize_or_zero()
}
