//! Contents of a picture besides particles: links between them, and obstacles.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::camera::FEW;
use super::fluid::{Plane, drop_of};
use super::frame::{AROUND, AROUND_START, EDGE, FACET, Frame, HIDDEN, NONE, SLOT, SOLID};
use super::solid::{Shape, Solid};
use super::tank;
use crate::cosmology::Expansion;
use crate::error::Error;
use crate::kernel::{Bounds, Kernel, Name, Side};
use crate::links::{Half, Links, MOST_LINKS, Network, WORDS};
use crate::motion::{Hold, Motion};
use crate::solids::Standing;
use crate::state::State;

/// The objects of a picture in addition to particles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scenery {
    /// Links between the particles, by their ids.
    pub links: Arc<Links>,
    /// Solids.
    pub solids: Vec<Solid>,
    /// Boxes, or rectangles, of which a picture of a fluid shows the edges.
    pub tanks: Vec<Solid>,
    /// The first of those, where it is no container of the scene.
    pub bounded: Option<Solid>,
    /// The sides of a plane at which a fluid ends.
    pub plane: Plane,
    /// The radius of the drops of a fluid, by how far apart particles are at the start \[length\]; zero: as they are now.
    pub drop: f64,
    /// The fixed particles, by id: in a fluid those are walls.
    pub held: Arc<Vec<u32>>,
    /// The expansion of space, where it expands.
    pub expansion: Option<Arc<Expansion>>,
    /// The obstacles of a scene, and the motions that they follow: see [`Scenery::at`].
    pub standing: (Vec<Standing>, Vec<Motion>),
}

impl Scenery {
    /// Links between particles, and no solids.
    #[must_use]
    pub fn of(particles: &State) -> Self {
        let held = particles.held.iter().map(|one| one.id).collect();
        let bounded = around_walls(particles);
        let tanks = bounded.into_iter().collect();
        Self {
            links: Arc::new(particles.links.clone()),
            tanks,
            bounded,
            drop: drop_of(particles),
            held: Arc::new(held),
            ..Self::default()
        }
    }
    /// The same with a box, if it is closed along every axis.
    #[must_use]
    pub fn within(mut self, bounds: &Bounds) -> Self {
        let axes = usize::try_from(bounds.dimensions).unwrap_or(3).min(3);
        self.plane = Plane::of(bounds);
        if !bounds.sides[..axes].contains(&Side::Open) {
            let flat = |x: DVec3| if axes < 3 { x.with_z(0.0) } else { x };
            let (low, high) = (flat(bounds.low), flat(bounds.high));
            self.bounded = Some(upright(low, high));
            self.tanks = self.bounded.into_iter().collect();
        }
        self
    }
    /// The same with the obstacles of a scene, on the motions of these particles, as at the time 0.
    #[must_use]
    pub fn beside(self, standing: Vec<Standing>, particles: &State) -> Self {
        Self { standing: (standing, particles.motions.clone()), ..self }.at(0.0)
    }
    /// The same with its solids at their positions at a time.
    #[must_use]
    pub fn at(&self, time: f64) -> Self {
        let (standing, motions) = &self.standing;
        if standing.is_empty() {
            return self.clone();
        }
        let of = |inside| {
            // The surface of a cone is seen from within, and so hides nothing.
            let open = |one: &Standing| matches!(one.solid, crate::solids::Solid::Cone { .. });
            let those = standing.iter().filter(move |one| (one.inside && !open(one)) == inside);
            those.map(|one| Solid::at(one, motions, time)).collect()
        };
        // Where walls are held, a container is but what stands behind them.
        let walled = self.bounded.is_some() && !self.held.is_empty();
        let behind = if walled { Vec::new() } else { of(true) };
        let tanks = self.bounded.into_iter().chain(behind).collect();
        Self { solids: of(false), tanks, ..self.clone() }
    }
}

/// The field of springs that a simulation holds, and breaks.
pub const LINK: &str = "link";
/// The maximum number of solids in one picture: every sample tests all of them, twice.
const MOST_SOLIDS: usize = 1024;

/// Facets, triangles first and lines behind them, as tables for the device.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Facets {
    pub triangles: u32,
    pub count: u32,
    solids: Vec<Solid>,
    tanks: Vec<Solid>,
    facet: Arc<Vec<u32>>,
    slot: Arc<Vec<u32>>,
    around_start: Arc<Vec<u32>>,
    around: Arc<Vec<u32>>,
    hidden: Arc<Vec<u32>>,
    link: Arc<Vec<u32>>,
}

impl Facets {
    /// Those that are drawn of `count` particles, as the key `draw` says; `hidden` are not, whatever it says.
    pub fn new(scenery: &Scenery, count: u32, draw: &str, hidden: &[u32]) -> Result<Self, Error> {
        let links = &*scenery.links;
        if scenery.solids.len() > MOST_SOLIDS {
            let (n, most) = (scenery.solids.len(), MOST_SOLIDS);
            return Err(Error::Scene(format!("a picture of {n} solids: {most} are the most that it draws")));
        }
        let (solids, tanks) = (scenery.solids.clone(), scenery.tanks.clone());
        let mut walls = vec![false; count as usize];
        for id in hidden {
            *walls.get_mut(*id as usize).ok_or_else(|| beyond(*id, count))? = true;
        }
        if links.is_empty() || draw == "points" {
            let hidden = if hidden.is_empty() { Vec::new() } else { walls.into_iter().map(u32::from).collect() };
            return Ok(Self { solids, tanks, hidden: Arc::new(hidden), ..Self::default() });
        }
        let mut cloth = vec![false; count as usize];
        let mut tied = cloth.clone();
        let mut facets: Vec<[u32; 3]> = if draw == "lines" { Vec::new() } else { links.triangles.clone() };
        for id in facets.iter().flatten() {
            *cloth.get_mut(*id as usize).ok_or_else(|| beyond(*id, count))? = true;
        }
        let triangles = facets.len();
        if draw != "surface" {
            let ends = links.springs.iter().map(|s| s.ends).chain(links.rods.iter().map(|r| r.ends));
            for [a, b] in ends {
                for id in [a, b] {
                    *tied.get_mut(id as usize).ok_or_else(|| beyond(id, count))? = true;
                }
                // On a cloth they are seen as the cloth.
                if !(cloth[a as usize] && cloth[b as usize]) {
                    facets.push([a.min(b), a.max(b), NONE]);
                }
            }
        }
        let network = Network::new(count, links);
        let slot = |[a, b]: [u32; 2]| {
            let row = network.link_start[a as usize]..network.link_start[a as usize + 1];
            row.into_iter().find(|k| network.link.get(4 * *k as usize) == Some(&b)).unwrap_or(NONE)
        };
        let sides = |[a, b, c]: [u32; 3]| {
            if c == NONE { [slot([a, b]), NONE, NONE] } else { [slot([a, b]), slot([b, c]), slot([c, a])] }
        };
        let slots = facets.iter().flat_map(|facet| sides(*facet)).collect();
        let few = count as usize <= FEW;
        let alone = cloth.iter().zip(&tied).zip(&walls);
        let hidden = alone.map(|((cloth, tied), wall)| u32::from(*cloth || *tied && !few || *wall)).collect();
        let (around_start, around) = around(&facets, &cloth, count)?;
        Ok(Self {
            triangles: number(triangles)?,
            count: number(facets.len())?,
            solids,
            tanks,
            facet: Arc::new(facets.into_iter().flatten().collect()),
            slot: Arc::new(slots),
            around_start: Arc::new(around_start),
            around: Arc::new(around),
            hidden: Arc::new(hidden),
            link: network.link,
        })
    }
    /// The number of edges of tanks.
    pub fn edges(&self) -> u32 {
        self.tanks.iter().map(tank::number).sum()
    }
    /// The edges of tanks in the picture.
    pub fn tank_edges(&self, frame: &Frame) -> Vec<tank::Edge> {
        self.tanks.iter().flat_map(|tank| tank::edges(tank, frame)).collect()
    }
    /// The ids of a facet's corners; of a line the third is [`NONE`].
    pub fn corners(&self, facet: usize) -> [u32; 3] {
        [0, 1, 2].map(|k| self.facet[3 * facet + k])
    }
    /// The facets of each of `count` particles.
    pub fn around(&self, count: usize) -> impl Iterator<Item = (usize, &[u32])> {
        let row = |id: usize| Some(*self.around_start.get(id)? as usize..*self.around_start.get(id + 1)? as usize);
        (0..count).filter_map(move |id| Some((id, self.around.get(row(id)?)?)))
    }
    /// Whether a side of a facet is a broken spring; without the present table of links, as at the start.
    pub fn is_broken(&self, facet: usize, link: Option<&[u32]>) -> bool {
        let link = link.unwrap_or(&self.link);
        let words = |slot: &u32| link.get(*slot as usize * WORDS..).and_then(|rest| rest.get(..WORDS));
        let sides = self.slot[3 * facet..3 * facet + 3].iter().filter(|slot| **slot != NONE);
        sides.filter_map(words).any(|words| Half::new(words).is_broken())
    }
    /// The particles that are not drawn by themselves.
    pub fn hidden(&self) -> impl Iterator<Item = usize> {
        self.hidden.iter().enumerate().filter(|(_, hidden)| **hidden == 1).map(|(id, _)| id)
    }
    /// All solids.
    pub fn standing(&self) -> &[Solid] {
        &self.solids
    }
    /// Whether there is nothing beside particles.
    pub fn is_empty(&self) -> bool {
        self.count == 0 && self.solids.is_empty()
    }
    /// The number of solids.
    pub fn solids(&self) -> u32 {
        u32::try_from(self.solids.len()).unwrap_or(0)
    }
    /// Replaces the tanks.
    pub fn contain(&mut self, tanks: Vec<Solid>) {
        self.tanks = tanks;
    }
    /// Whether some particles are not drawn by themselves.
    pub fn hides(&self) -> bool {
        self.hidden.contains(&1)
    }
    /// Replaces the solids.
    pub fn set(&mut self, solids: Vec<Solid>) {
        self.solids = solids;
    }
    /// The kernel, with what the fields that it names hold.
    pub fn bind(&self, mut kernel: Kernel, frame: &Frame) -> Kernel {
        let edge = self.tank_edges(frame).iter().flat_map(tank::Edge::words).collect();
        let solid = self.solids.iter().flat_map(|solid| solid.words(frame)).collect();
        let tables = [
            (FACET.name, &self.facet),
            (SLOT.name, &self.slot),
            (AROUND_START.name, &self.around_start),
            (AROUND.name, &self.around),
            (HIDDEN.name, &self.hidden),
            (LINK, &self.link),
            (SOLID.name, &Arc::new(solid)),
            (EDGE.name, &Arc::new(edge)),
        ];
        for (field, words) in tables {
            let stride = kernel.bindings().filter(|(name, _)| *name == field).map(|(_, b)| b.stride).max();
            if let Some(stride) = stride {
                let field: Name = field.into();
                kernel.sizes.retain(|(name, _)| *name != field);
                kernel.sizes.push((field.clone(), 4 * words.len() as u64 / stride.max(1)));
                kernel.tables.push((field, words.clone()));
            }
        }
        kernel
    }
}

/// The facets around each particle: of cloth its triangles, of a thread its lines.
fn around(facets: &[[u32; 3]], cloth: &[bool], count: u32) -> Result<(Vec<u32>, Vec<u32>), Error> {
    let corners = || {
        let numbered = (0..).zip(facets);
        let each = numbered.flat_map(|(n, facet)| facet.iter().map(move |id| (*id, n, facet[2] == NONE)));
        each.filter(|(id, _, line)| *id != NONE && !(*line && cloth[*id as usize]))
    };
    let mut start = vec![0; count as usize + 1];
    corners().for_each(|(id, _, _)| start[id as usize + 1] += 1);
    if let Some(id) = start.iter().position(|n| *n > MOST_LINKS) {
        let text = format!("particle {} is a corner of {} triangles or lines", id - 1, start[id]);
        return Err(Error::Scene(format!("{text}: {MOST_LINKS} are the most that a picture draws")));
    }
    for i in 1..start.len() {
        start[i] += start[i - 1];
    }
    let mut next = start.clone();
    let mut around = vec![0; start.last().map_or(0, |n| *n as usize)];
    for (id, n, _) in corners() {
        around[next[id as usize] as usize] = n;
        next[id as usize] += 1;
    }
    Ok((start, around))
}

fn beyond(id: u32, count: u32) -> Error {
    Error::Scene(format!("a picture of {count} particles has a link to particle {id}: ids go from 0"))
}

fn number(n: usize) -> Result<u32, Error> {
    let fits = u32::try_from(n).ok().filter(|n| *n < NONE / 3);
    fits.ok_or_else(|| Error::Scene(format!("{n} triangles and lines are more than a picture draws")))
}

/// A box along the axes.
fn upright(low: DVec3, high: DVec3) -> Solid {
    Solid { shape: Shape::Box { half: 0.5 * (high - low) }, place: 0.5 * (low + high), turn: DQuat::IDENTITY }
}

/// The box around all particles that stay where they are.
fn around_walls(particles: &State) -> Option<Solid> {
    let fixed = particles.held.iter().filter(|one| one.by == Hold::Fixed);
    let places = fixed.filter_map(|one| particles.position().get(one.id as usize)).filter(|x| x.is_finite());
    let ends = places.fold(None, |ends, x| {
        let (low, high) = ends.unwrap_or((*x, *x));
        Some((low.min(*x), high.max(*x)))
    });
    ends.map(|(low, high)| upright(low, high))
}
