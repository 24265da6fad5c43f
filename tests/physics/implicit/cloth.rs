//! A rumpled cloth, and the linear system of its backward Euler step in f64, by a program of its own.

use glam::DVec3;
use motes::State;

use crate::implicit::{hold, tie};
use crate::support::Random;

/// A cloth of n × n particles and one without links, a metre wide, two corners held; springs to the next, across and
/// to the next but one, all as stiff.
pub fn cloth(n: u32, stiffness: f64) -> State {
    let mut particles = State::default();
    let mut random = Random::new(17);
    let step = 1.0 / f64::from(n - 1);
    let noise = 0.002 / (f64::from(n) / 32.0);
    let flat = |i: u32, j: u32| DVec3::new(f64::from(i), f64::from(j), 0.0) * step;
    for j in 0..n {
        for i in 0..n {
            particles.push((flat(i, j) + noise * random.vector()).as_vec3().as_dvec3(), DVec3::ZERO, 0.25, 0.0);
        }
    }
    let ways: [(i64, i64); 6] = [(1, 0), (0, 1), (1, 1), (1, -1), (2, 0), (0, 2)];
    for j in 0..n {
        for i in 0..n {
            for (di, dj) in ways {
                let [a, b] = [(i, di), (j, dj)].map(|(at, way)| u32::try_from(i64::from(at) + way).unwrap_or(u32::MAX));
                if a < n && b < n {
                    let rest = flat(i, j).distance(flat(a, b));
                    tie(&mut particles, [j * n + i, b * n + a], f64::from(rest as f32), stiffness, 0.0);
                }
            }
        }
    }
    particles.push(DVec3::new(0.3, 0.4, 1.0), DVec3::new(0.1, 0.2, 0.3), 0.25, 0.0);
    hold(&mut particles, 0);
    hold(&mut particles, n - 1);
    particles
}

/// The system (M − h² K) y = b.
pub struct System<'a> {
    pub particles: &'a State,
    pub h: f64,
    /// Whether compressed springs may push aside.
    pub exact: bool,
}

impl System<'_> {
    fn is_free(&self, id: usize) -> bool {
        self.particles.held.iter().all(|held| held.id as usize != id)
    }
    /// k h² (t (I − u uᵀ) + u uᵀ) for each spring.
    fn blocks(&self) -> Vec<([usize; 2], DVec3, f64, f64)> {
        let x = self.particles.position();
        let block = |link: &motes::links::Link| {
            let ends = link.ends.map(|id| id as usize);
            let r = x[ends[1]] - x[ends[0]];
            let t = 1.0 - link.rest / r.length();
            (ends, r.normalize(), if self.exact { t } else { t.max(0.0) }, link.stiffness * self.h * self.h)
        };
        self.particles.links.springs.iter().map(block).collect()
    }
    fn product(&self, blocks: &[([usize; 2], DVec3, f64, f64)], z: &[DVec3]) -> Vec<DVec3> {
        let mut y: Vec<DVec3> = z.iter().zip(self.particles.mass()).map(|(z, m)| *z * *m).collect();
        for ([a, b], u, t, k) in blocks {
            let way = z[*a] - z[*b];
            let force = *k * (*t * way + (1.0 - t) * u.dot(way) * *u);
            y[*a] += force;
            y[*b] -= force;
        }
        for (id, y) in y.iter_mut().enumerate() {
            *y *= f64::from(u8::from(self.is_free(id)));
        }
        y
    }
    /// b − A y, relative to b, without particles that have no links.
    pub fn residual(&self, b: &[DVec3], y: &[DVec3]) -> f64 {
        let image = self.product(&self.blocks(), y);
        let tied = self.particles.len() - 1;
        let free = |id: &usize| self.is_free(*id);
        let left: f64 = (0..tied).filter(free).map(|i| (b[i] - image[i]).length_squared()).sum();
        let all: f64 = (0..=tied).filter(free).map(|i| b[i].length_squared()).sum();
        (left / all).sqrt()
    }
    /// Preconditioned conjugate gradients as in every textbook (Hestenes & Stiefel 1952): iterations until the tolerance, or
    /// none where a direction of negative curvature comes.
    pub fn iterations(&self, b: &[DVec3], tolerance: f64, most: usize) -> Option<usize> {
        let blocks = self.blocks();
        let mut diagonal: Vec<DVec3> = self.particles.mass().iter().map(|m| DVec3::splat(*m)).collect();
        for ([a, c], u, t, k) in &blocks {
            let own = *k * (DVec3::splat(*t) + (1.0 - t) * *u * *u);
            diagonal[*a] += own;
            diagonal[*c] += own;
        }
        let dot = |a: &[DVec3], b: &[DVec3]| -> f64 { a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum() };
        let keep = |v: &[DVec3]| -> Vec<DVec3> {
            v.iter().enumerate().map(|(i, v)| if self.is_free(i) { *v } else { DVec3::ZERO }).collect()
        };
        let condition = |r: &[DVec3]| -> Vec<DVec3> { r.iter().zip(&diagonal).map(|(r, d)| *r / *d).collect() };
        let mut r = keep(b);
        let enough = tolerance * tolerance * dot(&r, &r);
        let mut z = condition(&r);
        let mut p = z.clone();
        let mut gamma = dot(&r, &z);
        for iteration in 0..most {
            if dot(&r, &r) <= enough {
                return Some(iteration);
            }
            let image = self.product(&blocks, &p);
            let bend = dot(&p, &image);
            if bend <= 0.0 {
                return None;
            }
            let alpha = gamma / bend;
            r.iter_mut().zip(&image).for_each(|(r, s)| *r -= alpha * *s);
            z = condition(&r);
            let next = dot(&r, &z);
            p.iter_mut().zip(&z).for_each(|(p, z)| *p = *z + next / gamma * *p);
            gamma = next;
        }
        Some(most)
    }
}
