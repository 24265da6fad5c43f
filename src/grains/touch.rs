//! The force and the torque of a contact, in f64: the reference of `shaders/grains/touch.wgsl`.

use glam::DVec3;

use super::{Material, Meeting, Model};

/// The words of [`Wound`].
pub const WORDS: usize = 8;

/// What a contact keeps from step to step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Wound {
    /// The sliding distance ξ of the tangential spring \[length\].
    pub slide: DVec3,
    /// The angle ψ of the rolling spring.
    pub roll: DVec3,
    /// The angle of the torsional spring.
    pub twist: f64,
    /// Whether liquid bridges it.
    pub is_wet: bool,
}

/// The force and the torque of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The force on the sphere \[mass length / time²\].
    pub push: DVec3,
    /// The torque beside that of the force \[mass length² / time²\].
    pub turn: DVec3,
    /// What it keeps for the next step.
    pub wound: Wound,
    /// The energy of its springs, as they are at the start of the step \[mass length² / time²\].
    pub energy: f64,
    /// The power that dashpots, sliding and rolling dissipate \[mass length² / time³\].
    pub heat: f64,
}

impl Wound {
    /// From its words, of which the last may be missing.
    #[must_use]
    pub fn of(word: impl Fn(usize) -> f64) -> Self {
        let vector = |first: usize| DVec3::new(word(first), word(first + 1), word(first + 2));
        Self { slide: vector(0), roll: vector(3), twist: word(6), is_wet: word(7) > 0.0 }
    }
    /// Its words.
    #[must_use]
    pub fn words(&self) -> [f64; WORDS] {
        let ([a, b, c], [d, e, f]) = (self.slide.to_array(), self.roll.to_array());
        [a, b, c, d, e, f, self.twist, f64::from(u8::from(self.is_wet))]
    }
}

/// 7/5 m R², the moment about the contact of a sphere \[mass length²\].
#[must_use]
pub fn moment(mass: f64, radius: f64) -> f64 {
    1.4 * mass * radius * radius
}

/// The distance below which spheres may have touched a step before, as a part of the reduced radius: what overlaps by a fifth of it and
/// touches for twenty steps parts by less.
pub const MARGIN: f64 = 1.0 / 16.0;

/// Whether spheres touch, or a contact may have ended in the last step.
#[must_use]
pub fn may_touch(overlap: f64, radius: f64) -> bool {
    overlap > -MARGIN * radius
}

/// a b / (a + b); where one is 0 the other: what has no mass is moved by nothing, as if it had an infinite one.
#[must_use]
pub fn reduced(a: f64, b: f64) -> f64 {
    if a > 0.0 && b > 0.0 { a * b / (a + b) } else { a.max(b) }
}

impl Material {
    /// The contact of a meeting, after a step of length `dt` since the last.
    #[must_use]
    pub fn touch(&self, at: &Meeting, last: &Wound, dt: f64) -> Touch {
        let n = at.n;
        let across = |v: DVec3| v - v.dot(n) * n;
        let (stiffness, part) = match self.model {
            Model::Linear => (self.stiffness, 1.0),
            Model::Hertz => (self.stiffness * (at.radius * at.overlap).sqrt(), 2.0 / 3.0),
        };
        let secant = part * stiffness;
        let damping = self.damping * (stiffness * at.mass).sqrt();
        let normal = secant * at.overlap + damping * at.v.dot(n);
        let pressed = normal.max(0.0);

        // By Hertz all springs were softer by this where the overlap was smaller.
        let (filled, before) = match self.model {
            Model::Linear => (0.5, 1.0),
            Model::Hertz => (0.4, (1.0 - dt * at.v.dot(n) / at.overlap).max(0.0).sqrt()),
        };
        // What a spring gains in the step, as a power.
        let gain = |k: f64, last: f64, next: f64| if dt > 0.0 { 0.5 * k * (next - before * last) / dt } else { 0.0 };
        let impulse = if at.mass > 0.0 { 0.5 * dt / at.mass } else { 0.0 };
        let mut energy = filled * secant * at.overlap.powi(2);
        let mut heat = damping * at.v.dot(n) * (at.v.dot(n) - impulse * normal);

        let (limit, spring, drag) =
            (self.friction * pressed, self.shear * stiffness, self.drag * damping * across(at.v));
        let mut slide = across(last.slide) + dt * across(at.v);
        let mut tangential = -spring * slide - drag;
        if tangential.length() > limit {
            tangential = tangential.normalize() * limit;
            if spring > 0.0 {
                slide = -(tangential + drag) / spring;
            }
        }
        energy += 0.5 * spring * last.slide.length_squared();
        // Where two spheres touch they are 2/7 as heavy across.
        heat -= tangential.dot(across(at.v) + 3.5 * impulse * tangential);
        heat -= gain(spring, last.slide.length_squared(), slide.length_squared());

        let (rolls, most) = (across(at.spin), self.rolling * at.radius * pressed);
        let (mut roll, mut turn) = (DVec3::ZERO, DVec3::ZERO);
        if self.elastic && self.rolling > 0.0 {
            let back = secant * (1.5 * self.rolling * at.radius).powi(2);
            roll = across(last.roll) + dt * rolls;
            let slowed = 2.0 * self.rolling_damping * (back * at.rest).sqrt() * rolls;
            turn = -back * roll - slowed;
            if turn.length() > most {
                turn = turn.normalize() * most;
                roll = -(turn + slowed) / back;
            }
            energy += 0.5 * back * last.roll.length_squared();
            heat -= gain(back, last.roll.length_squared(), roll.length_squared());
        } else if rolls.length() > 0.0 {
            turn = -most * rolls.normalize();
        }
        heat -= turn.dot(rolls);

        let mut twist = 0.0;
        if self.torsion > 0.0 {
            let back = secant * (1.5 * self.torsion * at.radius).powi(2);
            let (most, about) = (self.torsion * at.radius * pressed, at.spin.dot(n));
            twist = last.twist + dt * about;
            // About its own axis a sphere has 2/5 m R².
            let slowed = 2.0 * self.rolling_damping * (back * at.rest * 2.0 / 7.0).sqrt() * about;
            let mut torsion = -back * twist - slowed;
            if torsion.abs() > most {
                torsion = torsion.signum() * most;
                twist = -(torsion + slowed) / back;
            }
            turn += torsion * n;
            energy += 0.5 * back * last.twist.powi(2);
            heat -= torsion * about + gain(back, last.twist.powi(2), twist.powi(2));
        }
        Touch {
            push: tangential - normal * n,
            turn,
            wound: Wound { slide, roll, twist, is_wet: last.is_wet },
            energy,
            heat,
        }
    }
    /// The power of what springs still held a step before where spheres do not touch any more; 0 where they did not then.
    #[must_use]
    pub fn left(&self, at: &Meeting, last: &Wound, dt: f64) -> f64 {
        if dt <= 0.0 {
            return 0.0;
        }
        let overlap = (at.overlap - dt * at.v.dot(at.n)).max(0.0);
        let (stiffness, part) = match self.model {
            Model::Linear => (self.stiffness, 1.0),
            Model::Hertz => (self.stiffness * (at.radius * overlap).sqrt(), 2.0 / 3.0),
        };
        let [roll, twist] = [self.rolling, self.torsion].map(|limit| (1.5 * limit * at.radius).powi(2));
        let turned = roll * last.roll.length_squared() + twist * last.twist.powi(2);
        0.5 * (self.shear * stiffness * last.slide.length_squared() + part * stiffness * turned) / dt
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grains::{
        FRICTION, MODEL, NAMES, POISSON, RESTITUTION, ROLLING, ROLLING_DAMPING, ROLLING_MODEL, STIFFNESS,
        TANGENTIAL_DAMPING, TANGENTIAL_STIFFNESS, TORSION, YOUNG,
    };
    use crate::settings::{Key, Settings, Value};

    static KEYS: [Key; 12] = [
        MODEL,
        STIFFNESS,
        YOUNG,
        POISSON,
        RESTITUTION,
        FRICTION,
        TANGENTIAL_STIFFNESS,
        TANGENTIAL_DAMPING,
        ROLLING,
        ROLLING_MODEL,
        ROLLING_DAMPING,
        TORSION,
    ];

    fn material(more: &[(&'static str, Value)]) -> Material {
        let all = KEYS.iter().filter_map(|key| Some((key.name, key.default.clone()?)));
        let settings = Settings(all.chain(more.iter().cloned()).collect());
        let values = NAMES.map(|name| settings.number(name));
        Material::new(&settings, &values)
    }

    fn hertz(restitution: f64) -> Material {
        material(&[("model", "hertz".into()), ("young_modulus", 5e7.into()), ("restitution", restitution.into())])
    }

    /// Of a sphere that another, or a wall, meets head-on.
    fn head_on(overlap: f64, speed: f64, mass: f64) -> Meeting {
        let (n, zero) = (DVec3::Z, DVec3::ZERO);
        Meeting { n, overlap, arm: 0.0, v: speed * n, radius: 0.0025, smaller: 0.005, spin: zero, mass, rest: 0.0 }
    }

    /// Two spheres of radius 5 mm, E = 50 MPa and ν = 0.25 that overlap by a hundredth of it: F = 0.62854 N, Sₙ = 18 856 N/m and
    /// Sₜ = 16 162 N/m, computed from the published formulas by hand.
    #[test]
    fn hertz_and_mindlin_agree_with_numbers() {
        let (steel, zero) =
            (material(&[("model", "hertz".into()), ("young_modulus", 5e7.into()), ("friction", 1e3.into())]), 5e-5);
        let rest = steel.touch(&head_on(zero, 0.0, 1.0), &Wound::default(), 0.0);
        assert!((-rest.push.z - 0.62854).abs() < 5e-6, "{}", rest.push.z);
        let slope = |step: f64| {
            let deeper = steel.touch(&head_on(zero + step, 0.0, 1.0), &Wound::default(), 0.0);
            (rest.push.z - deeper.push.z) / step
        };
        assert!((slope(1e-10) - 18_856.0).abs() < 1.0, "{}", slope(1e-10));
        let wound = Wound { slide: 1e-7 * DVec3::X, ..Wound::default() };
        let across = steel.touch(&head_on(zero, 0.0, 1.0), &wound, 0.0).push.x;
        assert!((-across / 1e-7 - 16_162.0).abs() < 1.0, "{across}");
    }

    /// An impact, integrated by kicks and drifts: the coefficient of restitution, the time of contact, and the largest overlap. A force
    /// that does not pull, `cut`, ends earlier.
    fn impact(material: &Material, speed: f64, mass: f64, dt: f64, cut: bool) -> [f64; 3] {
        let (mut x, mut v, mut time, mut deepest) = (0.0, speed, 0.0, 0.0_f64);
        while x >= 0.0 && time < 1e6 * dt {
            x += 0.5 * dt * v;
            if x > 0.0 {
                let force = material.touch(&head_on(x, v, mass), &Wound::default(), dt).push.z;
                // The damping is that of the middle of the kick: implicit to second order.
                let middle = v + 0.5 * dt * force / mass;
                let force = material.touch(&head_on(x, middle, mass), &Wound::default(), dt).push.z;
                v += dt * (if cut { force.min(0.0) } else { force }) / mass;
            }
            x += 0.5 * dt * v;
            time += dt;
            deepest = deepest.max(x);
        }
        [-v / speed, time, deepest]
    }

    /// Both models part with e times the speed of the impact, for e from 0.1 to 0.95 and speeds over two decades, where a contact ends
    /// at δ = 0. Negative control: where the force may not pull, e = 0.5 becomes 0.550.
    #[test]
    fn restitution_is_met_exactly() {
        let mass = 1e-3;
        for target in [0.1, 0.3, 0.5, 0.7, 0.9, 0.95] {
            let linear = material(&[("stiffness", 1e4.into()), ("restitution", target.into())]);
            for (material, scale) in [(linear, 0.0), (hertz(target), -0.2)] {
                for speed in [0.1, 1.0, 10.0_f64] {
                    let dt = 1e-8 * (speed / 10.0).powf(scale);
                    let [e, ..] = impact(&material, speed, mass, dt, false);
                    // A step is 1e-4 of the contact, and parting is found up to a step late.
                    assert!((e - target).abs() < 1e-3, "{:?} {target} at {speed}: {e}", material.model);
                }
            }
        }
        for material in [material(&[("stiffness", 1e4.into()), ("restitution", 0.5.into())]), hertz(0.5)] {
            let [e, ..] = impact(&material, 1.0, mass, 1e-8, true);
            assert!((e - 0.55).abs() < 2e-3, "{e}");
        }
    }

    /// Without damping δ = (15 m v² / 16 √R E*)^(2/5) and t = 2.943 δ / v (Timoshenko & Goodier 1970), to 1 % at steps of t / 200.
    #[test]
    fn hertz_contacts_last_as_published() {
        let (mass, radius, young) = (1e-3, 0.0025_f64, 5e7 / (2.0 * (1.0 - 0.0625)));
        for speed in [0.1, 1.0, 10.0_f64] {
            let deepest = (15.0 * mass * speed * speed / (16.0 * radius.sqrt() * young)).powf(0.4);
            let lasts = 2.943 * deepest / speed;
            let [_, time, depth] = impact(&hertz(1.0), speed, mass, lasts / 200.0, false);
            assert!((time / lasts - 1.0).abs() < 0.01, "{time} is not {lasts}");
            assert!((depth / deepest - 1.0).abs() < 0.01, "{depth} is not {deepest}");
        }
    }

    /// Rolling back and forth below the limit gives back the angle, beyond it the torque is the limit; torsion likewise.
    #[test]
    fn rolling_and_torsion_yield_at_their_limits() {
        let more =
            [("rolling_friction", 0.2.into()), ("torsional_friction", 0.1.into()), ("rolling_damping", 0.0.into())];
        let material = material(&more);
        let turning = |spin: DVec3| Meeting { spin, ..head_on(1e-4, 0.0, 1.0) };
        let normal = 1000.0 * 1e-4;
        let mut wound = Wound::default();
        let (spin, dt) = (DVec3::new(0.3, 0.0, 0.4), 1e-3);
        let mut torques = Vec::new();
        for _ in 0..1000 {
            let touch = material.touch(&turning(spin), &wound, dt);
            (wound, torques) = (touch.wound, [torques, vec![touch.turn]].concat());
        }
        let last = torques[999];
        assert!(
            (last.x + 0.2 * 0.0025 * normal).abs() < 1e-12 && (last.z + 0.1 * 0.0025 * normal).abs() < 1e-12,
            "{last}"
        );
        assert!(torques[0].x > last.x && torques[0].z > last.z && last.y == 0.0, "{}", torques[0]);
        // k = 2.25 k μ² R² of the first step.
        let first = -2.25 * 1000.0 * (0.2_f64 * 0.0025).powi(2) * 0.3 * dt;
        assert!((torques[0].x / first - 1.0).abs() < 1e-12, "{}", torques[0]);
    }
}
