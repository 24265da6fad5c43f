//! A particle as a law's twin sees it.

use glam::{DVec3, DVec4};

use crate::error::Error;
use crate::kernel::{Host, POSITION, SPECIES, VELOCITY};

/// A particle as a law's twin sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Its id.
    pub index: usize,
    /// Where it is.
    pub position: DVec3,
    /// How it moves.
    pub velocity: DVec3,
    /// How heavy it is.
    pub mass: f64,
    /// How large it is drawn.
    pub radius: f64,
    /// Of which kind it is; 0 where nobody says.
    pub species: u32,
    /// Whether it takes part.
    pub lives: bool,
}

impl Body {
    fn new(index: usize, position: DVec4, velocity: DVec4, (species, lives): (u32, bool)) -> Self {
        let (mass, radius) = (position.w, velocity.w);
        Self { index, position: position.truncate(), velocity: velocity.truncate(), mass, radius, species, lives }
    }
}

/// All particles of a host.
///
/// # Errors
/// When it lacks position or velocity, or they are being written.
pub fn bodies(host: &Host) -> Result<Vec<Body>, Error> {
    let count = host.world().count as usize;
    let (position, velocity) = (host.read(POSITION)?, host.read(VELOCITY)?);
    let species = if host.contains(SPECIES.name) { host.read(SPECIES)?.to_vec() } else { Vec::new() };
    let lives = host.lives()?;
    let kind = |i: usize| (species.get(i).copied().unwrap_or(0), lives(i));
    let body = |i: usize| Body::new(i, position[i], velocity[i], kind(i));
    Ok((0..count.min(position.len())).map(body).collect())
}
