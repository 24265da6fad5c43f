//! The references of visits: they evaluate all pairs, so that they cannot share a fault of the cell list.

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec3};
use rayon::prelude::*;

use super::particle::{Particle, View};
use super::tied::{Tables, Tied, row};
use super::{Outcome, Over, Search, result};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Bounds, Host, Reference, World};
use crate::links::{Exclusions, Half, Shared};
use crate::neighbors::exclusions;

/// Particles that a thread takes at least, where each is looked at alone or with few others: fewer are done before another thread is awake.
pub(super) const PIECE: usize = 128;
/// The same for pairs.
const PAIRS: usize = 4096;

/// Particles that a thread takes at least, where each meets all of so many.
pub(super) fn piece(count: usize) -> usize {
    PAIRS / count.max(1) + 1
}

/// Each particle alone.
pub fn each(rule: impl Fn(&Particle, &World) -> DVec4 + Send + Sync + 'static) -> Reference {
    Arc::new(move |host| {
        let view = View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        let mut acceleration = host.write(ACCELERATION)?;
        acceleration.par_iter_mut().zip(&bodies).with_min_len(PIECE).for_each(|(a, me)| *a += rule(me, &world));
        Ok(())
    })
}

/// Each particle alone, for a law that writes columns.
pub fn updating(rule: impl Fn(&Particle, &World, &mut Outcome) + Send + Sync + 'static) -> Reference {
    Arc::new(move |host| {
        let view = View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        let outcome = |me: &Particle| {
            let mut outcome = Outcome::default();
            rule(me, &world, &mut outcome);
            (me.index, outcome)
        };
        let outcomes: Vec<_> = bodies.par_iter().with_min_len(PIECE).map(outcome).collect();
        result::write(host, 1.0, None, outcomes)
    })
}

/// Pairs of particles, the partners in the order of their ids.
pub fn gathering<S: Default>(
    over: Over,
    gather: impl Fn(&Particle, &Particle, DVec3, &World, &mut S) + Send + Sync + 'static,
    finish: impl Fn(&Particle, &S, &World) -> DVec4 + Send + Sync + 'static,
) -> Reference {
    let finish = move |me: &Particle, sum: &S, world: &World, outcome: &mut Outcome| {
        *outcome = Outcome::of_acceleration(finish(me, sum, world));
    };
    computing(over, gather, finish)
}

/// The same for a law that writes columns.
pub fn computing<S: Default>(
    over: Over,
    gather: impl Fn(&Particle, &Particle, DVec3, &World, &mut S) + Send + Sync + 'static,
    finish: impl Fn(&Particle, &S, &World, &mut Outcome) + Send + Sync + 'static,
) -> Reference {
    meeting(over, None, gather, finish)
}

/// The same for a law of a method with a search of its own.
pub fn searching<S: Default>(
    over: Over,
    search: Search,
    gather: impl Fn(&Particle, &Particle, DVec3, &World, &mut S) + Send + Sync + 'static,
    finish: impl Fn(&Particle, &S, &World, &mut Outcome) + Send + Sync + 'static,
) -> Reference {
    meeting(over, Some(search), gather, finish)
}

/// The pairs that a law leaves out: those that the list lacks, where it is over that.
pub(super) fn left_out(host: &Host, over: Over) -> Result<Exclusions, Error> {
    if matches!(over, Over::List { .. } | Over::Auto { .. }) { exclusions(host) } else { Ok(Exclusions::default()) }
}

fn meeting<S: Default>(
    over: Over,
    search: Option<Search>,
    gather: impl Fn(&Particle, &Particle, DVec3, &World, &mut S) + Send + Sync + 'static,
    finish: impl Fn(&Particle, &S, &World, &mut Outcome) + Send + Sync + 'static,
) -> Reference {
    Arc::new(move |host| {
        let mut view = View::of(host)?;
        if let Some(search) = &search {
            view.extend(search.by_particle(host)?);
        }
        let (bodies, world) = (view.particles(), host.world());
        let left_out = left_out(host, over)?;
        let outcome = |me: &Particle| {
            let mut sum = S::default();
            let mut meet = |you: &Particle| {
                gather(me, you, world.bounds.shortest(you.position - me.position), &world, &mut sum);
            };
            // An inactive particle is in no cell list; where all pairs are evaluated, it has no mass.
            let searches =
                |over| matches!(over, Over::Near { .. } | Over::Nearest { .. } | Over::List { .. } | Over::Auto { .. });
            let in_grid = searches(over);
            if !me.is_active() && in_grid && !matches!(over, Over::Near { of: Some(_), .. }) {
                return None;
            }
            let others = bodies.iter().filter(|you| you.index != me.index && (you.is_active() || !in_grid));
            let others = others.filter(|you| !left_out.has(me.index, you.index));
            match (over, over.range()) {
                (Over::Nearest { count }, _) => {
                    nearest(me, others, count as usize, &world.bounds).into_iter().for_each(&mut meet);
                }
                (_, Some(range)) => {
                    others.filter(|you| world.bounds.within(you.position - me.position, range)).for_each(meet);
                }
                (_, None) => others.for_each(meet),
            }
            let mut outcome = Outcome::default();
            finish(me, &sum, &world, &mut outcome);
            Some((me.index, outcome))
        };
        let outcomes: Vec<_> = bodies.par_iter().with_min_len(piece(bodies.len())).filter_map(outcome).collect();
        // Each of a pair holds half of its potential energy.
        result::write(host, 0.5, search.as_ref(), outcomes)
    })
}

/// The accelerations of chosen targets by direct summation, by their rows, and their shares of the potential per unit mass.
pub type Sample = Arc<dyn Fn(&Host, &[usize]) -> Result<Vec<DVec4>, Error> + Send + Sync>;

/// Like [`gathering`] for a pairwise additive law, for some targets only.
pub fn sample(rule: Arc<impl Fn(&Particle, &Particle, DVec3, &World) -> DVec4 + Send + Sync + 'static>) -> Sample {
    Arc::new(move |host, targets| {
        let view = View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        let summed = |id: &usize| -> Option<DVec4> {
            let me = bodies.get(*id)?;
            let others = bodies.iter().filter(|you| you.index != me.index);
            let met = others.map(|you| rule(me, you, world.bounds.shortest(you.position - me.position), &world));
            Some(met.sum::<DVec4>() * DVec4::new(1.0, 1.0, 1.0, 0.5))
        };
        Ok(targets.par_iter().with_min_len(piece(bodies.len())).filter_map(summed).collect())
    })
}

/// The reference of a law over links, given the tables that it reads.
pub type ByTables = Arc<dyn Fn(Tables) -> Reference + Send + Sync>;

/// The linked particles, in the order of the tables.
pub fn links<S: Default>(
    gather: impl Fn(&Particle, &Particle, DVec3, &Half, &mut S) + Send + Sync + 'static,
    finish: impl Fn(&Particle, &S) -> DVec4 + Send + Sync + 'static,
) -> ByTables {
    let rule = Arc::new((gather, finish));
    Arc::new(move |tables| linked(tables, rule.clone()))
}

fn linked<S: Default>(
    tables: Tables,
    rule: Arc<(
        impl Fn(&Particle, &Particle, DVec3, &Half, &mut S) + Send + Sync + 'static,
        impl Fn(&Particle, &S) -> DVec4 + Send + Sync + 'static,
    )>,
) -> Reference {
    Arc::new(move |host| {
        let view = View::of(host)?;
        let (bodies, bounds) = (view.particles(), host.world().bounds);
        let (tied, (gather, finish)) = (Tied::of(host, tables)?, &*rule);
        let mut acceleration = host.write(ACCELERATION)?;
        acceleration.par_iter_mut().zip(&bodies).with_min_len(PIECE).for_each(|(a, me)| {
            let mut sum = S::default();
            for half in tied.halves(me.index) {
                let you = &bodies[half.partner];
                gather(me, you, bounds.shortest(you.position - me.position), &half, &mut sum);
            }
            *a += finish(me, &sum) * DVec4::new(1.0, 1.0, 1.0, 0.5);
        });
        Ok(())
    })
}

/// The table of what several particles share: its starts, and its elements.
pub(super) fn shared_tables(over: Over) -> [&'static str; 2] {
    match over {
        Over::Joints => ["joint_start", "joint"],
        Over::Dihedrals => ["dihedral_start", "dihedral"],
        _ => ["triangle_start", "triangle"],
    }
}

/// The corners of joints, dihedrals or triangles, in the order of the table.
pub fn corners<const N: usize, C: Shared<N>>(
    over: Over,
    rule: impl Fn([&Particle; N], &C, &World) -> DVec4 + Send + Sync + 'static,
) -> Reference {
    let names = shared_tables(over);
    Arc::new(move |host| {
        let view = View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        if !host.contains(names[1]) {
            return Ok(());
        }
        let (start, corner) = (host.reading::<u32>(names[0])?, host.reading::<u32>(names[1])?);
        let mut acceleration = host.write(ACCELERATION)?;
        acceleration.par_iter_mut().zip(&bodies).with_min_len(PIECE).for_each(|(a, me)| {
            let corners = row(&start, &corner, me.index, C::WORDS).map(C::new);
            let sum: DVec4 = corners.map(|corner| rule(corner.ids().map(|id| &bodies[id]), &corner, &world)).sum();
            *a += sum / me.mass * DVec3::ONE.extend(1.0 / N as f64);
        });
        Ok(())
    })
}

/// The nearest neighbours by the device's own distances, the lower id first where two distances are equal.
fn nearest<'a, 'b: 'a>(
    me: &Particle,
    others: impl Iterator<Item = &'a Particle<'b>>,
    count: usize,
    bounds: &Bounds,
) -> Vec<&'a Particle<'b>> {
    let mut near: Vec<(f32, &Particle<'_>)> = Vec::with_capacity(count + 1);
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
