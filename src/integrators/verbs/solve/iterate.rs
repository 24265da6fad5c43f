//! The two halves of an iteration of conjugate gradients.

use glam::{DVec3, DVec4};
use rayon::prelude::*;

use super::rows::Ties;
use super::{ALONE, DIRECTIONS, DOTS, RESIDUALS, State, System, names, on_states, reference, with};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Shader};
use crate::visit::{ROW, ROWS, Tables, View};

/// A z and the parts of the sums; `turned`: the two states are swapped.
pub fn product(system: &System<'_>, turned: bool) -> Result<Kernel, Error> {
    let (factor, (chunk, _)) = (system.factor, system.cut());
    let jacobian = system.links.as_ref().and_then(|law| law.jacobian.clone());
    let tables = Tables::of(system.problem);
    let run = move |host: &Host| {
        if State::of(&host.reading::<f32>(names(turned).0)?).code > 0.0 {
            return Ok(());
        }
        let view = View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        let h = factor * world.dt;
        let residuals = host.read(RESIDUALS)?;
        let ties = Ties::of(jacobian.as_ref(), tables, &bodies, host)?;
        let mut rows = host.write(ROWS)?;
        rows.par_chunks_mut(ROW).take(bodies.len()).enumerate().for_each(|(i, row)| {
            let z = residuals[2 * i].truncate();
            let (diagonal, across) = (row[0].truncate(), row[1].truncate());
            let own = diagonal * z
                + DVec3::new(across.x * z.y, across.y * z.z, across.z * z.x)
                + DVec3::new(across.z * z.z, across.x * z.x, across.y * z.y);
            let pull = ties.as_ref().map_or(DVec3::ZERO, |ties| {
                ties.sum(i, |you| {
                    let way = residuals[2 * you].truncate() - z;
                    (h * h * way, h * way)
                })
            });
            row[3] = (own - pull).extend(0.0);
        });
        let mut dots = host.write(DOTS)?;
        for (block, dots) in dots.chunks_exact_mut(4).enumerate() {
            let of = |i: usize| {
                let (z, r, image) = (residuals[2 * i], residuals[2 * i + 1], rows[ROW * i + 3]);
                let alone = rows[ROW * i].w == ALONE;
                let square = r.truncate().length_squared();
                let (tied, alone) = if alone { (0.0, square) } else { (square, 0.0) };
                DVec4::new(r.truncate().dot(z.truncate()), image.truncate().dot(z.truncate()), tied, alone)
            };
            let first = block * chunk as usize;
            let last = (first + chunk as usize).min(bodies.len());
            let sum: DVec4 = (first..last).map(of).sum();
            dots.copy_from_slice(&sum.to_array());
        }
        Ok(())
    };
    let files = [crate::shader!("integrators/solve_product.wgsl"), crate::shader!("integrators/solve_total.wgsl")];
    let kernel = with(system.tied("product", &files, reference(run))?, &[("FACTOR", factor)]);
    let mut kernel = on_states(system.in_runs(kernel)?, turned);
    for pass in &mut kernel.passes {
        pass.work += u64::from(system.problem.network.ends());
    }
    Ok(kernel)
}

/// One step along the direction, unless `limit` iterations are done, or the residual meets the tolerance: `part` of the given one, so that
/// Newton's method is not limited by the residuals of its linear solves.
pub fn advance(system: &System<'_>, turned: bool, limit: u32, part: f64) -> Result<Kernel, Error> {
    let (limit, tolerance) = (f64::from(limit), system.problem.solver.tolerance);
    let run = move |host: &Host| {
        let (from, to) = names(turned);
        let before = State::of(&host.reading::<f32>(from)?);
        let mut next = host.writing::<f32>(to)?;
        if before.code > 0.0 {
            next.copy_from_slice(&before.words());
            return Ok(());
        }
        let dots = host.read(DOTS)?;
        let parts = dots.chunks_exact(4).map(|part| DVec4::new(part[0], part[1], part[2], part[3]));
        let after = advanced(before, parts.sum(), (tolerance, part), limit);
        next.copy_from_slice(&after.words());
        if after.code > 0.0 {
            return Ok(());
        }
        let beta = if before.iterations == 0.0 { 0.0 } else { after.gamma / before.gamma };
        let alpha = after.alpha;
        let rows = host.read(ROWS)?;
        let (mut residuals, mut directions) = (host.write(RESIDUALS)?, host.write(DIRECTIONS)?);
        let vectors = residuals.par_chunks_mut(2).zip(directions.par_chunks_mut(3));
        vectors.zip(rows.par_chunks(ROW)).for_each(|((residual, direction), row)| {
            let inverse = row[2];
            if inverse.x != 0.0 {
                direction[0] = residual[0] + beta * direction[0];
                direction[1] = row[3] + beta * direction[1];
                direction[2] += alpha * direction[0];
                residual[1] -= alpha * direction[1];
                residual[0] = inverse * residual[1];
            }
        });
        Ok(())
    };
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("broken.wgsl"),
        crate::shader!("integrators/solve_row.wgsl"),
        crate::shader!("integrators/solve_total.wgsl"),
        crate::shader!("integrators/solve_advance.wgsl"),
    ])?;
    let kernel = system.sized(Kernel::new("advance", shader, Vec::new(), system.problem.capacity, reference(run)));
    let kernel = with(kernel, &[("TOLERANCE", tolerance), ("LIMIT", limit), ("PART", part)]);
    Ok(on_states(system.in_runs(kernel)?, turned))
}

/// The next state, by the sums r · z, z · A z, and r · r of the linked and of the unlinked particles.
fn advanced(before: State, sum: DVec4, (tolerance, part): (f64, f64), limit: f64) -> State {
    let fresh = before.iterations == 0.0;
    let mut after = before;
    if before.first == 0.0 {
        after.first = sum.z + sum.w;
    }
    after.residual = if fresh { sum.z + sum.w } else { sum.z };
    let goal = tolerance * tolerance * after.first;
    let enough = part * part * goal;
    if fresh && sum.is_finite() && after.residual <= goal {
        after.settled = 1.0;
    }
    let beta = if fresh { 0.0 } else { sum.x / before.gamma };
    let bend = if fresh { sum.y } else { sum.y - beta * sum.x / before.alpha };
    if !sum.is_finite() {
        after.code = 2.0;
    } else if sum.z <= enough || after.settled > 0.0 {
        after.code = 1.0;
    } else if before.iterations >= limit {
        after.code = 3.0;
    } else if sum.x <= 0.0 || bend <= 0.0 {
        after.code = 2.0;
    }
    if after.code > 1.5 && after.code < 2.5 {
        after.broken = 1.0;
    }
    if after.code == 0.0 {
        after.gamma = sum.x;
        after.alpha = sum.x / bend;
        after.iterations += 1.0;
        after.total += 1.0;
    }
    after
}
