//! The visits' twins: they visit everybody, so that they cannot share a fault of the grid.

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec3};
use rayon::prelude::*;

use super::Over;
use super::body::{Body, bodies};
use crate::kernel::{ACCELERATION, Bounds, Twin, World};

/// Each particle alone.
pub fn each(rule: impl Fn(&Body, &World) -> DVec4 + Send + Sync + 'static) -> Twin {
    Arc::new(move |host| {
        let (bodies, world) = (bodies(host)?, host.world());
        let mut acceleration = host.write(ACCELERATION)?;
        acceleration.par_iter_mut().zip(&bodies).for_each(|(a, me)| *a += rule(me, &world));
        Ok(())
    })
}

/// Those that meet, in the order of their ids.
pub fn meetings<S: Default>(
    over: Over,
    gather: impl Fn(&Body, &Body, DVec3, &mut S) + Send + Sync + 'static,
    finish: impl Fn(&Body, &S, &World) -> DVec4 + Send + Sync + 'static,
) -> Twin {
    Arc::new(move |host| {
        let (bodies, world) = (bodies(host)?, host.world());
        let mut acceleration = host.write(ACCELERATION)?;
        acceleration.par_iter_mut().zip(&bodies).for_each(|(a, me)| {
            let mut sum = S::default();
            let mut meet = |you: &Body| {
                gather(me, you, world.bounds.shortest(you.position - me.position), &mut sum);
            };
            let others = bodies.iter().filter(|you| you.index != me.index);
            match (over, over.range()) {
                (Over::Nearest { count }, _) => {
                    nearest(me, others, count as usize, &world.bounds).into_iter().for_each(&mut meet);
                }
                (_, Some(range)) => {
                    others.filter(|you| world.bounds.within(you.position - me.position, range)).for_each(meet);
                }
                (_, None) => others.for_each(meet),
            }
            // Each of a pair holds half of its potential energy.
            *a += finish(me, &sum, &world) * DVec4::new(1.0, 1.0, 1.0, 0.5);
        });
        Ok(())
    })
}

/// The nearest by the device's own distances, the lower id first where two are the same.
fn nearest<'a>(me: &Body, others: impl Iterator<Item = &'a Body>, count: usize, bounds: &Bounds) -> Vec<&'a Body> {
    let mut near: Vec<(f32, &Body)> = Vec::with_capacity(count + 1);
    for you in others {
        let r: Vec3 = bounds.shortest_single(you.position - me.position);
        let distance = r.x * r.x + r.y * r.y + r.z * r.z;
        let place = near.partition_point(|(d, other)| (*d, other.index) < (distance, you.index));
        if place < count && !distance.is_nan() {
            near.insert(place, (distance, you));
            near.truncate(count);
        }
    }
    near.into_iter().map(|(_, you)| you).collect()
}
