//! The start of a fluid: its density before the first step, and whether it is over-dense.

use std::f64::consts::SQRT_2;

use glam::DVec3;
use rayon::prelude::*;

use super::nearby::Nearby;
use super::{COURANT, Medium, Smoothed, WallMass, gap, overdense};
use crate::error::Error;
use crate::kernel::Bounds;

/// The maximum Mach number of the flow that the initial pressure of a fluid may drive. The speed of sound is ten times that of the fastest
/// expected flow (Monaghan 1994), so that a burst at Mach 0.2 is twice as fast, and has four times the energy: with c = 10 √(2 g H) it
/// rises to four times the depth.
const MACH: f64 = 0.2;
/// Two particles nearer than this \[spacings\] hardly repel each other, since the gradient of the kernel vanishes at distance zero: they
/// never separate.
const SAME_PLACE: f64 = 0.1;

/// A fluid that a force makes of all particles that are not fixed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Continuum {
    /// The fluid.
    pub medium: Medium,
    /// The masses of its walls.
    pub walls: WallMass,
    /// Whether its density is summed over masses around; else it begins at rest, whatever is around.
    pub summed: bool,
    /// The gravity that it uses, if any \[length / time²\].
    pub weight: Option<DVec3>,
}

/// Particles before the first step.
#[derive(Debug, Clone, Copy)]
pub struct Still<'a> {
    /// Their positions.
    pub position: &'a [DVec3],
    /// Mass; what walls weigh is found here.
    pub mass: &'a [f64],
    /// Whether each particle is a wall, by id.
    pub walls: &'a [bool],
    /// The box and its boundaries.
    pub bounds: &'a Bounds,
}

/// The initial state of a fluid.
#[derive(Debug, Clone, PartialEq)]
pub struct Start {
    /// The fluid.
    pub medium: Medium,
    /// Whether its density is that of the start, or only that of a summation over masses: see [`Continuum`].
    pub summed: bool,
    /// The number of fluid particles.
    pub fluid: u32,
    /// The number of wall particles.
    pub walls: u32,
    /// The extent of the fluid \[length\].
    pub extent: (DVec3, DVec3),
    /// The lightest and the heaviest of the fluid \[mass\].
    pub mass: (f64, f64),
    /// The fastest of the fluid \[length / time\].
    pub speed: f64,
    /// The densest particle of the fluid, and how dense it is, as a part of the density at rest.
    pub densest: (u32, f64),
    /// The thinnest, likewise.
    pub thinnest: (u32, f64),
    /// Two fluid particles at the same position, if any, and their distance.
    pub same: Option<(u32, u32, f64)>,
    /// The number of particles that are too dense.
    pub dense: u32,
    /// The minimum displacement of the fastest particle in the first step, where pressure is solved for, since the solve removes all excess
    /// density at once; otherwise 0 \[spacings\].
    pub thrust: f64,
    /// The cause of the maximum density.
    cause: String,
}

impl Start {
    /// Looks at a start.
    ///
    /// # Errors
    /// [`Error::Scene`] when there is nothing of the fluid, or something of it weighs nothing.
    pub fn of(fluid: &Continuum, still: &Still<'_>) -> Result<Self, Error> {
        let medium = &fluid.medium;
        let ids: Vec<usize> = (0..still.position.len()).filter(|id| !still.walls[*id]).collect();
        if ids.is_empty() {
            let text = "there is a fluid without particles: all particles are fixed, and fixed particles are its walls; add a \
                        [[particles]] of shape = \"block\"";
            return Err(Error::Scene(text.to_owned()));
        }
        medium.weighs(ids.iter().map(|id| (*id, still.mass[*id])))?;
        let (nearby, smoothed) = (Nearby::new(still.position, still.bounds, medium.range()), medium.smoothed());
        let mass = masses(fluid, still, &nearby);
        let densities: Vec<(f64, Option<(usize, f64)>)> =
            ids.par_iter().map(|id| density_at(&smoothed, still, &nearby, &mass, *id)).collect();
        let (mut densest, mut thinnest) = ((0, 0.0), (0, f64::INFINITY));
        let (mut same, mut dense) = (None, 0);
        for (id, (density, nearest)) in ids.iter().zip(&densities) {
            let ratio = density / medium.density;
            dense += u32::from(speed(medium, ratio) > MACH * medium.sound);
            if ratio > densest.1 {
                densest = (*id, ratio);
            }
            if ratio < thinnest.1 {
                thinnest = (*id, ratio);
            }
            if let Some((other, r)) = nearest.filter(|(_, r)| *r < SAME_PLACE * medium.spacing) {
                same = same.or(Some((id32(*id), id32(other), r)));
            }
        }
        let overdense: Vec<_> =
            ids.iter().zip(&densities).map(|(id, (density, _))| (still.position[*id], mass[*id], *density)).collect();
        let low = ids.iter().map(|id| still.position[*id]).reduce(DVec3::min).unwrap_or_default();
        let high = ids.iter().map(|id| still.position[*id]).reduce(DVec3::max).unwrap_or_default();
        Ok(Self {
            medium: *medium,
            summed: fluid.summed,
            fluid: id32(ids.len()),
            walls: id32(still.position.len() - ids.len()),
            extent: (low, high),
            mass: ids.iter().map(|id| still.mass[*id]).fold((f64::INFINITY, 0.0), |(a, b), m| (m.min(a), m.max(b))),
            speed: 0.0,
            densest: (id32(densest.0), densest.1),
            thinnest: (id32(thinnest.0), thinnest.1),
            same,
            dense,
            thrust: if medium.sound > 0.0 { 0.0 } else { overdense::thrust(medium, &overdense) },
            cause: cause(fluid, still, &nearby, &mass, densest.0),
        })
    }
    /// The pressure of the densest particle \[mass / (length time²)\].
    #[must_use]
    pub fn pressure(&self) -> f64 {
        let density = self.densest.1 * self.medium.density;
        self.medium.state(density).0 * density * density
    }
    /// The speed to which that pressure accelerates the fluid into a void, by the Riemann invariant of Tait's equation: u = 2 c / (γ − 1)
    /// ((ρ/ρ₀)^((γ − 1)/2) − 1) \[length / time\].
    #[must_use]
    pub fn burst(&self) -> f64 {
        speed(&self.medium, self.densest.1)
    }
    /// Refuses what would blow apart.
    ///
    /// # Errors
    /// [`Error::Scene`] that names the particles, and the cause.
    pub fn check(&self) -> Result<(), Error> {
        let (id, ratio) = self.densest;
        let hidden = if self.summed { "" } else { " by summation, which density by continuity does not detect" };
        if self.dense > 0 {
            return Err(Error::Scene(format!(
                "this start would explode: {} of {} particles of the fluid are too dense; particle {id}, the densest, is at {ratio:.3} times \
                 the density at rest{hidden}, which is a pressure of {:.3e} and accelerates it to {:.2} of the speed of sound (the limit is {MACH}): {}",
                self.dense,
                self.fluid,
                self.pressure(),
                self.burst() / self.medium.sound,
                self.cause
            )));
        }
        if self.thrust > COURANT {
            return Err(Error::Scene(format!(
                "this start would explode: particle {id} of the fluid, the densest, is at {ratio:.3} times the density at rest, and the pressure \
                 solve removes the excess density in the first step: a particle would have to move at least {:.2} spacings in \
                 it, for any dt (the limit is {COURANT}): {}",
                self.thrust, self.cause
            )));
        }
        if let Some((a, b, r)) = self.same {
            return Err(Error::Scene(format!(
                "particles {a} and {b} of the fluid are {r:.1e} apart, and the spacing is {}: pressure cannot separate particles at \
                 the same position: move one of them, or the block that it is part of",
                self.medium.spacing
            )));
        }
        Ok(())
    }
}

fn id32(id: usize) -> u32 {
    u32::try_from(id).unwrap_or(u32::MAX)
}

fn speed(medium: &Medium, ratio: f64) -> f64 {
    let power = 0.5 * f64::from(medium.exponent - 1);
    (medium.sound / power * (ratio.powf(power) - 1.0)).max(0.0)
}

/// The mass of each particle: walls have that of the fluid that they replace.
fn masses(fluid: &Continuum, still: &Still<'_>, nearby: &Nearby<'_>) -> Vec<f64> {
    let (medium, smoothed) = (&fluid.medium, fluid.medium.smoothed());
    let of = |id: usize| {
        if !still.walls[id] {
            return still.mass[id];
        }
        if fluid.walls == WallMass::Lattice {
            return medium.mass();
        }
        let mut sum = smoothed.kernel(DVec3::ZERO);
        nearby.of(id, |you, r| sum += if still.walls[you] { smoothed.kernel(r) } else { 0.0 });
        medium.density / sum
    };
    (0..still.position.len()).into_par_iter().map(of).collect()
}

/// The density of the fluid at a particle, and the nearest fluid particle.
fn density_at(
    smoothed: &Smoothed,
    still: &Still<'_>,
    nearby: &Nearby<'_>,
    mass: &[f64],
    id: usize,
) -> (f64, Option<(usize, f64)>) {
    let mut density = mass[id] * smoothed.kernel(DVec3::ZERO);
    let mut nearest: Option<(usize, f64)> = None;
    nearby.of(id, |you, r| {
        density += mass[you] * smoothed.kernel(r);
        if !still.walls[you] && nearest.is_none_or(|(_, least)| r.length() < least) {
            nearest = Some((you, r.length()));
        }
    });
    (density, nearest)
}

/// Why it is so dense there: the first that is out of the way among masses, spacings, walls and nearby particles.
fn cause(fluid: &Continuum, still: &Still<'_>, nearby: &Nearby<'_>, mass: &[f64], id: usize) -> String {
    let (medium, smoothed) = (&fluid.medium, fluid.medium.smoothed());
    let (own, lattice, d) = (mass[id], medium.mass(), medium.spacing);
    let (mut walls, mut wall) = (0.0, None::<(usize, f64)>);
    nearby.of(id, |you, r| {
        if still.walls[you] {
            walls += mass[you] * smoothed.kernel(r) / medium.density;
            if wall.is_none_or(|(_, least)| r.length() < least) {
                wall = Some((you, r.length()));
            }
        }
    });
    // It may be farther away than the kernel reaches.
    let others = (0..still.position.len()).filter(|other| *other != id && !still.walls[*other]);
    let away = others.map(|other| (other, still.bounds.shortest(still.position[other] - still.position[id]).length()));
    let nearest = away.reduce(|a, b| if b.1 < a.1 { b } else { a });
    if (own / lattice - 1.0).abs() > 0.01 {
        let dimensions = medium.dimensions;
        let power = (own / medium.density).powf(1.0 / f64::from(dimensions));
        // A distance that goes with the mass is another lattice, and not another density.
        let spaced = nearest.is_some_and(|(_, r)| (r / power - 1.0).abs() < 0.05) && (power / d - 1.0).abs() > 0.01;
        return if spaced {
            format!("particles have the spacing {power:.6}, and the force has {d}: give both the same")
        } else {
            format!(
                "its mass is {own:.6e}, and density × spacing^{dimensions} is {lattice:.6e}: give its shape the density and the \
                 spacing of the force"
            )
        };
    }
    let rest = match fluid.walls {
        WallMass::Sampled => d * gap(medium.smoothing, medium.support, 1, medium.dimensions),
        WallMass::Lattice => d,
    };
    if let Some((other, r)) = nearest.filter(|(_, r)| *r < 0.9 * d) {
        return format!(
            "particle {other} of the fluid is {r:.3e} away from it, and the spacing is {d}: two blocks overlap, or stand too near to \
             each other; between two there is one spacing from the last layer to the first"
        );
    }
    match wall {
        Some((other, r)) if r < rest.max(SQRT_2 * d) => format!(
            "particle {other} of a wall is {r:.3e} away from it, and leaves the fluid at rest at {rest:.3e} (for a support \
             of {} spacings): move it away, or let the shapes tank and wall place it",
            medium.support
        ),
        _ => format!(
            "{:.0} % of that is from walls, the rest from fluid around it: increase the distance",
            100.0 * walls
        ),
    }
}
