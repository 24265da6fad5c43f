//! Surface tension: cohesion, curvature, and adhesion to walls (Akinci, Akinci & Teschner 2013).

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec3, DVec4, Vec4};

use super::{FLOW, Medium, NORMAL};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Host, Kernel, Name, Problem, Scalar, Source};
use crate::neighbors::Grid;
use crate::visit::{Body, Sweep, gathered};

/// How a surface pulls.
///
/// γ is no σ. Cohesion goes with masses, σ = 0.003 γ ρ² h² where nothing else pulls (Kirkwood & Buff 1949), curvature with numbers of
/// neighbours; and in a drop of radius R both press as σ does on R − h, h being the support: p = 2 σ / (R − h). So measured in space,
/// for ρ = 1000 and drops of 6 to 13 spacings d, σ is γ d² times 25 000, 55 000 and 75 000 where the support is of 2, 2.5 and 3
/// spacings, to 10 %; a drop of 9 spacings swings (Rayleigh 1879) by 61 000 where that is 55 000. A quarter of γ had a fifth less than
/// a quarter of σ when drops seemed to be at rest. At other densities σ goes neither with ρ² nor with ρ: at 100 cohesion is weak.
/// Besides, cohesion presses on a fluid wherever it is, by 0.025 γ ρ² h, which changes no flow but makes it that much denser.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tension {
    /// γ, of the fluid to itself: the paper's number.
    pub tension: f64,
    /// β, of walls to the fluid.
    pub adhesion: f64,
}

/// The kernels that add what it does; it holds no potential energy, for curvature has none.
///
/// # Errors
/// When the range is none, or a shader does not compile.
pub fn tension(medium: &Medium, tension: Tension, problem: &Problem) -> Result<[Kernel; 2], Error> {
    Ok([normals(medium, problem)?, pull(medium, tension, problem)?])
}

/// A sweep over what flows, with the grid's fields that it binds.
fn sweep(name: &str, medium: &Medium, files: &[Source], problem: &Problem) -> Result<(Sweep, Grid), Error> {
    let grid = medium.grid(problem)?;
    let mut all = vec![medium.smoothing.source(), crate::shader!("fluids/medium.wgsl")];
    all.extend_from_slice(files);
    let twin = Arc::new(|_: &Host| Ok(()));
    let (name, blocks) = (name.to_owned(), vec![medium.block()]);
    Ok((Sweep { name, grid: grid.clone(), files: all, blocks, twin }, grid))
}

fn bound(mut kernel: Kernel, fields: &[(&'static str, Name)]) -> Kernel {
    kernel.passes.iter_mut().for_each(|pass| pass.fields.extend_from_slice(fields));
    kernel
}

fn normals(medium: &Medium, problem: &Problem) -> Result<Kernel, Error> {
    let files = [
        crate::shader!("fluids/flowing.wgsl"),
        crate::shader!("fluids/flowing_told.wgsl"),
        crate::shader!("fluids/normal.wgsl"),
    ];
    let (sweep, grid) = sweep("fluid normals", medium, &files, problem)?;
    let (me, slots) = (*medium, grid.clone());
    let twin = move |host: &Host| {
        let (ids, density) = densities(host, &slots)?;
        let flows = |body: &Body| density[body.index] > 0.0;
        let normals = gathered(host, me.range(), flows, |_, you, r, sum: &mut DVec3| {
            if flows(you) {
                *sum -= you.mass / density[you.index] * me.gradient(r) * me.range() * r;
            }
        })?;
        let mut normal = host.writing::<Vec4>(&slots.field(NORMAL).1)?;
        for (slot, id) in ids.iter().enumerate() {
            if let Some(sum) = normals[*id as usize] {
                normal[slot] = sum.extend(0.0);
            }
        }
        Ok(())
    };
    let kernel = Sweep { twin: Arc::new(twin), ..sweep }.kernel(problem)?;
    Ok(bound(kernel, &[FLOW, NORMAL].map(|name| grid.field(name))))
}

fn pull(medium: &Medium, tension: Tension, problem: &Problem) -> Result<Kernel, Error> {
    let files = [
        crate::shader!("fluids/bent.wgsl"),
        crate::shader!("fluids/bent_told.wgsl"),
        crate::shader!("fluids/tension.wgsl"),
    ];
    let (mut sweep, grid) = sweep("fluid tension", medium, &files, problem)?;
    let volume = medium.range().powi(if medium.dimensions == 2 { 2 } else { 3 });
    let [cohesion, curvature, adhesion] =
        [32.0 / PI * tension.tension / volume, tension.tension, 0.007 * tension.adhesion / volume];
    sweep.blocks.push((
        "params",
        vec![
            ("cohesion", Scalar::Float(cohesion)),
            ("curvature", Scalar::Float(curvature)),
            ("adhesion", Scalar::Float(adhesion)),
        ],
    ));
    let (me, slots) = (*medium, grid.clone());
    let twin = move |host: &Host| {
        let (ids, density) = densities(host, &slots)?;
        let mut normals = vec![DVec4::ZERO; ids.len()];
        let normal = host.reading::<Vec4>(&slots.field(NORMAL).1)?;
        ids.iter().zip(normal.iter()).for_each(|(id, normal)| normals[*id as usize] = *normal);
        let flows = |body: &Body| density[body.index] > 0.0;
        let felt = gathered(host, me.range(), flows, |a, b, r, sum: &mut DVec3| {
            let (q, way) = (r.length() / me.range(), r.try_normalize().unwrap_or_default());
            if flows(b) {
                let share = 2.0 * me.density / (density[a.index] + density[b.index]);
                let bend = (normals[a.index] - normals[b.index]).truncate();
                *sum += share * (cohesion * b.mass * hump(q) * way - curvature * bend);
            } else {
                *sum += adhesion * b.mass * (6.0 * q - 4.0 * q * q - 2.0).max(0.0).powf(0.25) * way;
            }
        })?;
        let mut acceleration = host.write(ACCELERATION)?;
        felt.iter().zip(acceleration.iter_mut()).for_each(|(felt, a)| *a += felt.unwrap_or_default().extend(0.0));
        Ok(())
    };
    let kernel = Sweep { twin: Arc::new(twin), ..sweep }.kernel(problem)?;
    Ok(bound(kernel, &[FLOW, NORMAL].map(|name| grid.field(name))))
}

/// Who stands in each slot, and densities by id: 0 for walls.
fn densities(host: &Host, grid: &Grid) -> Result<(Vec<u32>, Vec<f64>), Error> {
    let ids = grid.occupants(host)?;
    let flow = host.reading::<Vec4>(&grid.field(FLOW).1)?;
    let mut density = vec![0.0; host.world().count as usize];
    ids.iter().zip(flow.iter()).for_each(|(id, flow)| density[*id as usize] = flow.x);
    Ok((ids, density))
}

/// π h^D C / 32, of q = r / h.
fn hump(q: f64) -> f64 {
    let hump = (1.0 - q).powi(3) * q.powi(3);
    if q <= 0.5 { 2.0 * hump - 1.0 / 64.0 } else { hump }
}
