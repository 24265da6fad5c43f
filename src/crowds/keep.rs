//! What keeps pedestrians from passing walls: a safety net below the forces of walls, which is counted.

use std::sync::Arc;

use glam::{DVec4, Vec4};

use super::walls::{WALLS, rounded, table};
use crate::error::Error;
use crate::floor_plan::FloorPlan;
use crate::kernel::{Column, Field, Host, Kernel, Kind as Element, POSITION, Pass, Problem, Shader, VELOCITY};

/// The last position of each pedestrian that no wall was before, and in `w` how often it was put back there.
pub(crate) const ALLOWED: Field<Vec4> = Field::new("allowed_position");

/// The name of that number.
pub(crate) const CORRECTIONS: &str = "wall_corrections";

/// The columns of that.
pub(crate) fn allowed_columns() -> Vec<Column> {
    let count = Column::new(CORRECTIONS, Element::Scalar, "", "how often it was put back in front of a wall");
    vec![
        Column::new(ALLOWED.name, Element::Vector, "length", "the last position in front of walls"),
        count.within(ALLOWED.name, 3),
    ]
}

/// The kernel that allows the positions at the start.
pub(crate) fn begin(problem: &Problem) -> Result<Kernel, Error> {
    let reference = |host: &Host| {
        let position = host.read(POSITION)?;
        for (allowed, x) in host.write(ALLOWED)?.iter_mut().zip(position.iter()) {
            *allowed = x.truncate().extend(allowed.w);
        }
        Ok(())
    };
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("crowds/begin.wgsl")])?;
    Ok(Kernel::new("walls begin", shader, Vec::new(), problem.capacity, Arc::new(reference)))
}

/// The kernel that puts back pedestrians of a species that have passed a wall.
pub(crate) fn keep(plan: &FloorPlan, species: Option<u32>, problem: &Problem) -> Result<Kernel, Error> {
    let (holding, mut tables) = problem.holding();
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("law/species.wgsl"),
        crate::shader!("crowds/crosses.wgsl"),
        crate::shader!("crowds/keep.wgsl"),
        holding,
        problem.active(),
    ])?;
    let (of, walls) = (problem.clone(), rounded(plan));
    let count = walls.len();
    let reference = move |host: &Host| {
        let view = crate::visit::View::of(host)?;
        let bodies = view.particles();
        let (mut position, mut velocity) = (host.write(POSITION)?, host.write(VELOCITY)?);
        let mut allowed = host.write(ALLOWED)?;
        for me in &bodies {
            let (x, last) = (position[me.index], allowed[me.index]);
            let is_kept = me.is_active() && !of.is_held(me.index) && species.is_none_or(|own| own == me.species());
            let (from, to) = (last.truncate().truncate(), x.truncate().truncate());
            if is_kept && walls.iter().any(|wall| wall.crosses(from, to)) {
                let (v, way) = (velocity[me.index].truncate(), (x - last).truncate());
                position[me.index] = last.truncate().extend(x.w);
                velocity[me.index] -= ((v.dot(way) / way.length_squared()).max(0.0) * way).extend(0.0);
                allowed[me.index] += DVec4::W;
            } else {
                allowed[me.index] = x.truncate().extend(last.w);
            }
        }
        Ok(())
    };
    let constants = vec![("COUNT", count as f64), ("SPECIES", f64::from(species.unwrap_or(u32::MAX)))];
    let pass = Pass { constants, alone: true, ..Pass::new(shader, problem.capacity) };
    tables.push(table(plan));
    Ok(Kernel {
        name: "walls keep".to_owned(),
        passes: vec![pass],
        reference: Some(Arc::new(reference)),
        sizes: vec![(WALLS.into(), count as u64)],
        scratch: Vec::new(),
        tables,
    })
}
