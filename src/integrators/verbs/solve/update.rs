//! The update by a solution.

use super::{DIRECTIONS, START_POSITION, START_VELOCITY, STATE, State, System, plain, reference, with};
use crate::error::Error;
use crate::kernel::{Host, Kernel, POSITION, Shader, VELOCITY};

/// v ← v + Δv; `start`: the step is linearized about its start.
pub fn kernel(system: &System<'_>, start: bool) -> Result<Kernel, Error> {
    let run = move |host: &Host| {
        if start || State::of(&host.reading::<f32>(STATE)?).settled == 0.0 {
            let directions = host.read(DIRECTIONS)?;
            for (v, direction) in host.write(VELOCITY)?.iter_mut().zip(directions.chunks_exact(3)) {
                *v += direction[2].truncate().extend(0.0);
            }
        }
        Ok(())
    };
    let kernel = plain("update", system, crate::shader!("integrators/solve_update.wgsl"), reference(run))?;
    Ok(with(kernel, &[("START", f64::from(u8::from(start)))]))
}

/// x ← x₀ + c v dt
pub fn reach(count: u32, factor: f64) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/reach.wgsl")])?;
    let run = move |host: &Host| {
        let dt = factor * host.world().dt;
        let (start, velocity) = (host.read(START_POSITION)?, host.read(VELOCITY)?);
        for (x, (x0, v)) in host.write(POSITION)?.iter_mut().zip(start.iter().zip(velocity.iter())) {
            *x = *x0 + (v.truncate() * dt).extend(0.0);
        }
        Ok(())
    };
    Ok(Kernel::new("reach", shader, vec![("FACTOR", factor)], count, reference(run)).alone())
}

/// v ← 2 v − v₀
pub fn extrapolate(count: u32) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/extrapolate.wgsl")])?;
    let run = |host: &Host| {
        let start = host.read(START_VELOCITY)?;
        for (v, v0) in host.write(VELOCITY)?.iter_mut().zip(start.iter()) {
            *v = 2.0 * *v - *v0;
        }
        Ok(())
    };
    Ok(Kernel::new("extrapolate", shader, Vec::new(), count, reference(run)).alone())
}
