//! The start of a linear solve.

use glam::{DVec3, DVec4};
use rayon::prelude::*;

use super::{
    ALONE, DIRECTIONS, HELD, OTHER, RESIDUALS, START_VELOCITY, STATE, State, System, TIED, on_states, plain, reference,
    with,
};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Host, Kernel, VELOCITY};
use crate::visit::{ROW, ROWS};

/// The resolution of single precision, relative to a position: about a third of its last place.
const RESOLUTION: f64 = 2e-8;

/// Solves a symmetric system of three by L D Lᵀ.
fn solved(diagonal: DVec3, across: DVec3, b: DVec3) -> DVec3 {
    let l = DVec3::new(across.x, across.z, 0.0) / diagonal.x;
    let yy = diagonal.y - l.x * across.x;
    let yz = across.y - l.x * across.z;
    let zz = diagonal.z - l.y * across.z - yz * yz / yy;
    let y = b.y - l.x * b.x;
    let z = (b.z - l.y * b.x - yz / yy * y) / zz;
    let v = (y - yz * z) / yy;
    DVec3::new(b.x / diagonal.x - l.x * v - l.y * z, v, z)
}

/// The kernel; `start`: the step is linearized about its start.
pub fn kernel(system: &System<'_>, start: bool) -> Result<Kernel, Error> {
    let factor = system.factor;
    let run = move |host: &Host| {
        let h = factor * host.world().dt;
        let before = State::of(&host.reading::<f32>(STATE)?);
        let settled = !start && before.settled > 0.0;
        let after = if settled {
            before
        } else if start {
            State::default()
        } else {
            State { first: before.first, total: before.total, broken: before.broken, ..State::default() }
        };
        host.writing::<f32>(OTHER)?.copy_from_slice(&after.words());
        if settled {
            return Ok(());
        }
        let (velocity, acceleration) = (host.read(VELOCITY)?, host.read(ACCELERATION)?);
        let began = host.read(START_VELOCITY)?;
        let (mut rows, mut residuals) = (host.write(ROWS)?, host.write(RESIDUALS)?);
        let mut directions = host.write(DIRECTIONS)?;
        let vectors = rows.par_chunks_mut(ROW).zip(residuals.par_chunks_mut(2)).zip(directions.par_chunks_mut(3));
        vectors.enumerate().for_each(|(i, ((row, residual), direction))| {
            let (way, weight, diagonal) = (row[0].w, row[1].w, row[0].truncate());
            let push = h * weight * acceleration[i].truncate();
            let due = if start { row[3].truncate() } else { weight * (began[i] - velocity[i]).truncate() };
            let whole = diagonal + row[2].truncate();
            let noise = whole.length() * row[3].w * RESOLUTION;
            let lost = !start && (push + due).length() * h <= noise;
            let b = if way == HELD || lost { DVec3::ZERO } else { push + due };
            let inverse = if way == TIED { 1.0 / whole } else { DVec3::ZERO };
            let y = if way == ALONE { solved(diagonal, row[1].truncate(), b) } else { DVec3::ZERO };
            row[2] = inverse.extend(0.0);
            residual.copy_from_slice(&[(inverse * b).extend(0.0), b.extend(0.0)]);
            direction.copy_from_slice(&[DVec4::ZERO, DVec4::ZERO, y.extend(0.0)]);
        });
        Ok(())
    };
    let kernel = plain("begin", system, crate::shader!("integrators/solve_begin.wgsl"), reference(run))?;
    let kernel = with(kernel, &[("FACTOR", factor), ("START", f64::from(u8::from(start)))]);
    Ok(on_states(kernel, false))
}
