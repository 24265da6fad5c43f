//! A sheet of springs in plain Rust, in f32 on one thread: forces are scattered from edge to ends, then all particles move.
//! Nothing by hand; the instruction set is the one cargo compiled for.

use motes::State;

/// A net of springs under gravity.
pub struct Sheet {
    position: Vec<[f32; 4]>,
    velocity: Vec<[f32; 4]>,
    force: Vec<[f32; 4]>,
    edges: Vec<Edge>,
}

#[derive(Clone, Copy)]
struct Edge {
    a: u32,
    b: u32,
    rest: f32,
    stiffness: f32,
    damping: f32,
}

#[expect(clippy::cast_possible_truncation, reason = "the baseline is in single precision")]
impl Sheet {
    /// The same as a simulation has, ropes left out.
    pub fn new(particles: &State) -> Self {
        let narrow = |v: &glam::DVec3, w: f64| v.extend(w).as_vec4().to_array();
        let edge = |link: &motes::links::Link| Edge {
            a: link.ends[0],
            b: link.ends[1],
            rest: link.rest as f32,
            stiffness: link.stiffness as f32,
            damping: link.damping as f32,
        };
        Self {
            position: particles.position().iter().zip(particles.mass()).map(|(x, m)| narrow(x, 1.0 / m)).collect(),
            velocity: particles.velocity().iter().map(|v| narrow(v, 0.0)).collect(),
            force: vec![[0.0; 4]; particles.len()],
            edges: particles.links.springs.iter().map(edge).collect(),
        }
    }
    /// One step of the symplectic Euler method.
    pub fn step(&mut self, dt: f32, gravity: f32) {
        self.force.fill([0.0; 4]);
        for edge in &self.edges {
            let (a, b) = (edge.a as usize, edge.b as usize);
            let (x, y) = (self.position[a], self.position[b]);
            let (v, w) = (self.velocity[a], self.velocity[b]);
            let r = [y[0] - x[0], y[1] - x[1], y[2] - x[2]];
            let length = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt();
            let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
            let u = r.map(|r| r * inverse);
            let along = u[0] * (w[0] - v[0]) + u[1] * (w[1] - v[1]) + u[2] * (w[2] - v[2]);
            let tension = edge.stiffness * (length - edge.rest) + edge.damping * along;
            for (k, u) in u.into_iter().enumerate() {
                self.force[a][k] += tension * u;
                self.force[b][k] -= tension * u;
            }
        }
        for ((x, v), f) in self.position.iter_mut().zip(&mut self.velocity).zip(&self.force) {
            let inverse = x[3];
            for k in 0..3 {
                v[k] += dt * (f[k] * inverse + if k == 2 { gravity } else { 0.0 });
                x[k] += dt * v[k];
            }
        }
    }
    /// Where they are, and one over their masses.
    pub fn positions(&self) -> &[[f32; 4]] {
        &self.position
    }
}
