//! The solves once more, as the paper writes them: velocities instead of accelerations, lists of neighbours, f64.

use glam::DVec3;
use motes::sph::{Medium, Smoothed, Smoothing};

use crate::dfsph::{DENSITY, SPACING};

/// Where particles are, and how they move.
pub struct Flow {
    pub medium: Medium,
    smoothed: Smoothed,
    pub position: Vec<DVec3>,
    pub velocity: Vec<DVec3>,
    pub mass: Vec<f64>,
    /// Which are of a wall.
    pub wall: Vec<bool>,
    neighbors: Vec<Vec<usize>>,
    shortest: Box<dyn Fn(DVec3) -> DVec3>,
}

/// What a solve did.
pub struct Solved {
    pub iterations: u32,
    pub error: f64,
    pub kappa: Vec<f64>,
}

pub fn medium(dimensions: u32) -> Medium {
    Medium {
        density: DENSITY,
        spacing: SPACING,
        support: 2.0,
        smoothing: Smoothing::Cubic,
        sound: 0.0,
        exponent: 7,
        negative: false,
        dimensions,
    }
}

impl Flow {
    pub fn new(
        medium: Medium,
        position: Vec<DVec3>,
        velocity: Vec<DVec3>,
        mass: Vec<f64>,
        wall: Vec<bool>,
        shortest: impl Fn(DVec3) -> DVec3 + 'static,
    ) -> Self {
        let shortest: Box<dyn Fn(DVec3) -> DVec3> = Box::new(shortest);
        let near = |i: usize, j: &usize| *j != i && shortest(position[i] - position[*j]).length() < medium.range();
        let neighbors = (0..position.len()).map(|i| (0..position.len()).filter(|j| near(i, j)).collect()).collect();
        Self { medium, smoothed: medium.smoothed(), position, velocity, mass, wall, neighbors, shortest }
    }
    fn volume(&self, j: usize) -> f64 {
        self.mass[j] / self.medium.density
    }
    /// ∇W at i, of j.
    fn slope(&self, i: usize, j: usize) -> DVec3 {
        let r = (self.shortest)(self.position[i] - self.position[j]);
        self.smoothed.gradient(r) * r
    }
    /// ρ / ρ₀
    pub fn density(&self, i: usize) -> f64 {
        let of =
            |j: &usize| self.volume(*j) * self.smoothed.kernel((self.shortest)(self.position[i] - self.position[*j]));
        self.neighbors[i].iter().map(of).sum::<f64>() + self.volume(i) * self.smoothed.kernel(DVec3::ZERO)
    }
    /// Σ V (v − v') · ∇W
    pub fn divergence(&self, i: usize) -> f64 {
        let of = |j: &usize| self.volume(*j) * (self.velocity[i] - self.velocity[*j]).dot(self.slope(i, *j));
        self.neighbors[i].iter().map(of).sum()
    }
    fn alpha(&self, i: usize) -> f64 {
        let all: DVec3 = self.neighbors[i].iter().map(|j| self.volume(*j) * self.slope(i, *j)).sum();
        let walls = self.neighbors[i].iter().filter(|j| self.wall[**j]);
        let walls: DVec3 = walls.map(|j| self.volume(*j) * self.slope(i, *j)).sum();
        let fluid = self.neighbors[i].iter().filter(|j| !self.wall[**j]);
        let squares: f64 = fluid.map(|j| self.volume(i) * self.volume(*j) * self.slope(i, *j).length_squared()).sum();
        1.0 / ((all + walls).dot(all) + squares)
    }
    pub fn fluid(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.wall.len()).filter(|i| !self.wall[*i])
    }
    /// What κ makes of a velocity.
    fn pressed(&self, start: &[DVec3], kappa: &[f64], dt: f64) -> Vec<DVec3> {
        let one = |i: usize| {
            let push = |j: &usize| {
                self.volume(*j) * (kappa[i] + if self.wall[*j] { kappa[i] } else { kappa[*j] }) * self.slope(i, *j)
            };
            let push: DVec3 = self.neighbors[i].iter().map(push).sum();
            if self.wall[i] { start[i] } else { start[i] - dt * push }
        };
        (0..start.len()).map(one).collect()
    }
    /// Solves such that over ρ / ρ₀ = `density` the velocity leaves no more than 1; those with a true `free` may be compressed.
    pub fn solve(&mut self, density: &[f64], free: &[bool], dt: f64, tolerance: f64, most: u32) -> Solved {
        let (start, count) = (self.velocity.clone(), self.fluid().count() as f64);
        let alpha: Vec<f64> =
            (0..start.len()).map(|i| if self.wall[i] || free[i] { 0.0 } else { self.alpha(i) }).collect();
        let omega = 1.25 / if self.medium.dimensions == 2 { 2.75 } else { 3.5 };
        let (mut kappa, mut reached) = (vec![0.0; start.len()], vec![0.0; start.len()]);
        for iterations in 1..=most {
            self.velocity = self.pressed(&start, &kappa, dt);
            let mut error = 0.0;
            let mut next = kappa.clone();
            for i in self.fluid().filter(|i| !free[*i]) {
                let over = density[i] + dt * self.divergence(i) - 1.0;
                let weight = omega * alpha[i] / (dt * dt);
                next[i] = (kappa[i] + weight * over).max(0.0);
                error += (next[i] - kappa[i]).abs() / weight / count;
            }
            let onward = f64::from(iterations - 1) / f64::from(iterations + 2);
            kappa =
                next.iter().zip(&reached).map(|(next, reached)| (next + onward * (next - reached)).max(0.0)).collect();
            reached = next;
            if error <= tolerance && iterations >= 2 || iterations == most {
                return Solved { iterations, error, kappa };
            }
        }
        unreachable!("there is a last iteration")
    }
    /// Which have few neighbours.
    pub fn few(&self) -> Vec<bool> {
        let fewest = if self.medium.dimensions == 2 { 7 } else { 20 };
        self.neighbors.iter().map(|near| near.len() < fewest).collect()
    }
}
