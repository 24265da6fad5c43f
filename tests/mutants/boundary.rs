//! Stages in a box: what brings particles back, and the nearest image.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use glam::{DVec3, Vec4};
use motes::forces::{Component, Problem};
use motes::kernel::{Backend, Machine, World};
use motes::settings::Value;
use motes::{Bounds, Gpu, POSITION, Side, Simulation};

use crate::stages::{Device, FEW, Stage, moving, stage};
use crate::support::Random;
use crate::support::machines::kernel_in;
use crate::support::states::force;

use Side::{Open, Periodic, Reflecting};

/// Numbers whose multiples f32 holds, so that device and references agree exactly at the sides; along x what is next to the
/// lower one rounds to the upper one, a period on; along y so far from the origin
/// that what stands behind the last particle is outside.
fn box_of(sides: [Side; 3]) -> Bounds {
    Bounds { low: DVec3::new(0.125, 3.0, -2.5), high: DVec3::new(1.625, 3.75, 0.5), sides, dimensions: 3 }
}

/// Particles inside and up to four lengths away; some at the very sides, or next to them.
fn in_a_box(device: &Device, bounds: Bounds) -> Simulation<Gpu> {
    let mut simulation = moving(device, FEW, None);
    let clock = pollster::block_on(simulation.backend().world()).expect("a clock");
    simulation.backend().set_world(World { bounds, ..clock }).expect("a world");
    let mut random = Random::new(5);
    let (low, size) = (bounds.low, bounds.high - bounds.low);
    let place = |id: usize, axis: usize, random: &mut Random| {
        let anywhere = (low[axis] + size[axis] * (0.5 + 4.5 * random.next())) as f32;
        let side = |turns: f64| (low[axis] + turns * size[axis]) as f32;
        match (id + axis) % 13 {
            0 => side(0.0),
            1 => side(1.0),
            2 => side(((4.0 * random.next()).round()).clamp(-4.0, 4.0)),
            3 => side(0.0).next_down(),
            4 => side(1.0).next_down(),
            5 => side(1.0).next_up(),
            _ => anywhere,
        }
    };
    let places: Vec<Vec4> = (0..FEW)
        .map(|id| Vec4::new(place(id, 0, &mut random), place(id, 1, &mut random), place(id, 2, &mut random), 0.3))
        .collect();
    simulation.write(POSITION, &places).expect("places");
    simulation
}

/// Every kind of side at every axis, and the nearest image along one axis and along all.
pub fn boundary(device: &Device, stages: &mut Vec<Stage>) {
    let machine = Machine::HOST;
    for sides in [[Periodic, Reflecting, Open], [Reflecting, Open, Periodic], [Open, Periodic, Reflecting]] {
        let bounds = box_of(sides);
        let kernels =
            motes::boundary::kernels(&Problem::new(u32::try_from(FEW).expect("few"), machine).at(&[], bounds))
                .expect("kernels");
        for kernel in kernels {
            let name = format!("{} {sides:?}", kernel.name);
            stages.push(stage(&name, in_a_box(device, bounds), kernel));
        }
    }
    let gravity: Box<dyn Component> = force("gravity", &[("softening", Value::Number(0.17))]);
    let bounds = box_of([Periodic, Open, Periodic]);
    let kernel = kernel_in(bounds, gravity.as_ref(), FEW, &machine);
    stages.push(stage("nearest image", in_a_box(device, bounds), kernel));
}
