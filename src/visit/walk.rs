//! The reference of the walk of a tree: the same nodes are opened as on the device, and interactions add up in f64.

use std::sync::Arc;

use glam::{DMat3, DVec3, DVec4, Vec3};
use rayon::prelude::*;

use super::particle::{Particle, View};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Bounds, Reference, Side, World};
use crate::tree::{GROUP, Nodes, Opening, Tree};

/// A far group of particles, as a law's reference sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Group {
    /// Mass.
    pub mass: f64,
    /// Its second moments Σ m y yᵀ about its centre of mass \[mass length²\].
    pub moments: DMat3,
}

/// The bounds of a group of targets, as the device has them.
struct Place {
    targets: Vec<Vec3>,
    middle: Vec3,
    half_side: Vec3,
    demand: f32,
}

impl Place {
    #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
    fn new(bodies: &[DVec4], demand: f64) -> Self {
        let targets: Vec<Vec3> = bodies.iter().map(|x| x.truncate().as_vec3()).collect();
        let low = targets.iter().copied().fold(Vec3::INFINITY, Vec3::min);
        let high = targets.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
        Self { targets, middle: 0.5 * (low + high), half_side: 0.5 * (high - low), demand: demand as f32 }
    }
    /// The minimum distance from the box of the targets to a point, squared, by the device's own arithmetic.
    fn apart(&self, x: DVec3, bounds: &Bounds) -> f32 {
        let r = bounds.shortest_single((x.as_vec3() - self.middle).as_dvec3());
        squared_size((r.abs() - self.half_side).max(Vec3::ZERO))
    }
    /// The minimum distance from any of the targets to a point, squared.
    fn nearest(&self, x: DVec3, bounds: &Bounds) -> f32 {
        let away = |target: &Vec3| squared_size(bounds.shortest_single((x.as_vec3() - *target).as_dvec3()));
        self.targets.iter().map(away).fold(f32::INFINITY, f32::min)
    }
    /// Whether a node is opened: if it reaches the box of the targets and, where that is four times as wide as the node's reach, one of the
    /// targets.
    fn opens(&self, tree: &Tree, nodes: &Nodes<'_>, node: u32, bounds: &Bounds) -> bool {
        let reaches = |d| self.reaches(tree, nodes, node, d);
        let longest = self.half_side.max_element();
        let wide = 0.25 * longest * longest;
        let center = nodes.center(node);
        reaches(self.apart(center, bounds)) && (reaches(wide) || reaches(self.nearest(center, bounds)))
    }
    /// Whether the reach of a node, squared, exceeds `d`.
    #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
    fn reaches(&self, tree: &Tree, nodes: &Nodes<'_>, node: u32, d: f32) -> bool {
        let reach = nodes.reach(node);
        let Opening::Relative { theta, .. } = tree.opening else { return d <= reach * reach };
        let (mass, length) = (nodes.mass(node) as f32, nodes.length(node) as f32);
        let widened = (1.0 / theta - 1.0) as f32;
        let reach = if self.demand == 0.0 { reach + widened * length } else { reach };
        d <= reach * reach || self.demand * mass * (length * length / d) > d
    }
}

/// Adds in the order of the device.
fn squared_size(d: Vec3) -> f32 {
    d.x * d.x + d.y * d.y + d.z * d.z
}

/// Every group of targets, from the root on.
pub fn reference(
    opening: Opening,
    core: f64,
    rule: Arc<impl Fn(&Particle, &Particle, DVec3, &World) -> DVec4 + Send + Sync + 'static>,
    far: impl Fn(&Particle, &Group, DVec3, &World) -> DVec4 + Send + Sync + 'static,
) -> Reference {
    Arc::new(move |host| {
        let view = View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        let tree = Tree { opening, core, count: world.capacity(), used: world.count, two_words: false };
        let nodes = Nodes::of(&tree, host)?;
        if nodes.ids().iter().take(tree.used as usize).any(|id| *id as usize >= bodies.len()) {
            return Err(Error::Scene(format!("the tree {opening} is not one of these {} particles", bodies.len())));
        }
        // Positions may have two words, of which a view has one: the places of the tree have both.
        let place = |slot: usize| nodes.bodies()[slot].truncate();
        let periodic = world.bounds.has(Side::Periodic);
        let shortest = |r: DVec3| if periodic { world.bounds.shortest(r) } else { r };
        let body = |slot: usize| (place(slot), &bodies[nodes.ids()[slot] as usize]);
        let cell = |node: &u32| {
            let group = Group { mass: nodes.mass(*node), moments: nodes.moments(*node) };
            (nodes.center(*node), group)
        };
        let slots: Vec<usize> = (0..tree.used as usize).collect();
        let sums: Vec<(usize, DVec4)> = slots
            .par_chunks(GROUP as usize)
            .enumerate()
            .filter(|(group, _)| nodes.demand(*group) >= 0.0)
            .flat_map_iter(|(group, slots)| {
                let targets: Vec<DVec4> = slots.iter().map(|slot| nodes.bodies()[*slot]).collect();
                let place = Place::new(&targets, nodes.demand(group));
                let mut met = Met::default();
                met.look(
                    1,
                    &|node| !place.opens(&tree, &nodes, node, &world.bounds),
                    &nodes,
                    slots[0]..slots[0] + slots.len(),
                );
                let near: Vec<_> = met.leaves.iter().flat_map(|leaf| nodes.range(*leaf)).map(body).collect();
                let groups: Vec<_> = met.far.iter().map(cell).collect();
                let sum = |slot: &usize| {
                    let (x, me) = body(*slot);
                    let others = near.iter().filter(|(_, you)| you.index != me.index);
                    let near: DVec4 = others.map(|(y, you)| rule(me, you, shortest(*y - x), &world)).sum();
                    let far: DVec4 = groups.iter().map(|(y, group)| far(me, group, shortest(*y - x), &world)).sum();
                    (me.index, near + far)
                };
                slots.iter().map(sum).collect::<Vec<_>>()
            })
            .collect();
        let mut acceleration = host.write(ACCELERATION)?;
        for (id, a) in sums {
            // Each of a pair holds half of its potential energy.
            acceleration[id] += a * DVec4::new(1.0, 1.0, 1.0, 0.5);
        }
        Ok(())
    })
}

/// The interactions of a group.
#[derive(Default)]
struct Met {
    far: Vec<u32>,
    leaves: Vec<u32>,
}

impl Met {
    fn look(&mut self, node: u32, shut: &impl Fn(u32) -> bool, nodes: &Nodes<'_>, own: std::ops::Range<usize>) {
        if !nodes.exists(node) {
            return;
        }
        let range = nodes.range(node);
        let holds = range.start <= own.start && own.end <= range.end;
        if !holds && !own.contains(&range.start) && shut(node) {
            self.far.push(node);
        } else if nodes.is_leaf(node) {
            self.leaves.push(node);
        } else {
            self.look(2 * node, shut, nodes, own.clone());
            self.look(2 * node + 1, shut, nodes, own);
        }
    }
}
