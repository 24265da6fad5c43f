//! Bridges of liquid between wet grains, in f64: the reference of `shaders/grains/bridge.wgsl`.
//!
//! A bridge forms where two grains touch, or a grain and a wall, and pulls until they are farther apart than it can be stretched: the way in
//! is not the way out. Its force is added to that of the contact. What it presses together the contact has to hold, so that Coulomb's limit,
//! which is that of the contact's force, is higher for wet grains. Its volume does not change, and flow of the liquid has no force.

use super::{Material, Meeting, may_touch};

/// What a bridge does.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Bridge {
    /// The force with which it pulls \[mass length / time²\].
    pub pull: f64,
    /// Its energy, 0 where it breaks \[mass length² / time²\].
    pub energy: f64,
    /// The power of what is set free where it forms \[mass length² / time³\].
    pub heat: f64,
    /// Whether it is there.
    pub is_there: bool,
}

/// ∫ dx / (1 + 1.05 x + 2.5 x²).
fn stretched(x: f64, end: f64) -> f64 {
    let root = (4.0 * 2.5 - 1.05_f64.powi(2)).sqrt();
    let angle = |x: f64| ((2.0 * 2.5 * x + 1.05) / root).atan();
    2.0 / root * (angle(end) - angle(x))
}

impl Material {
    /// The distance at which a bridge breaks, of grains of which the smaller has this radius \[length\]; 0 without liquid.
    #[must_use]
    pub fn rupture(&self, smaller: f64) -> f64 {
        self.reach * smaller
    }
    /// Whether a contact may have ended in the last step there, or a bridge reaches as far.
    #[must_use]
    pub fn is_near(&self, at: &Meeting) -> bool {
        may_touch(at.overlap, at.radius) || -at.overlap < self.rupture(at.smaller)
    }
    /// The bridge of a meeting, after a step of length `dt` since the last, at the end of which there was one or not.
    #[must_use]
    pub fn bridge(&self, at: &Meeting, was_there: bool, dt: f64) -> Bridge {
        let (gap, rupture) = ((-at.overlap).max(0.0), self.rupture(at.smaller));
        let touches = at.overlap > 0.0;
        if self.pull <= 0.0 || !(touches || was_there && gap < rupture) {
            return Bridge::default();
        }
        let radius = 2.0 * at.radius;
        let length = (self.spread.powi(2) * at.smaller.powi(3) / radius).sqrt();
        let (x, most) = (gap / length, self.pull * radius);
        let pull = most / (1.0 + 1.05 * x + 2.5 * x * x);
        let energy = -most * length * stretched(x, rupture / length) - pull * at.overlap.max(0.0);
        let gained = 0.5 * pull * at.v.dot(at.n);
        let heat = if was_there || dt <= 0.0 { 0.0 } else { -energy / dt - gained };
        Bridge { pull, energy, heat, is_there: true }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::DVec3;

    use super::*;
    use crate::grains::{
        BRIDGE_VOLUME, CONTACT_ANGLE, FRICTION, MODEL, POISSON, RESTITUTION, ROLLING, ROLLING_DAMPING, ROLLING_MODEL,
        STIFFNESS, SURFACE_TENSION, TANGENTIAL_DAMPING, TANGENTIAL_STIFFNESS, TORSION, YOUNG,
    };
    use crate::settings::Settings;

    fn wet(tension: f64, angle: f64, volume: f64) -> Material {
        let keys = [
            BRIDGE_VOLUME,
            CONTACT_ANGLE,
            FRICTION,
            MODEL,
            POISSON,
            RESTITUTION,
            ROLLING,
            ROLLING_DAMPING,
            ROLLING_MODEL,
            STIFFNESS,
            SURFACE_TENSION,
            TANGENTIAL_DAMPING,
            TANGENTIAL_STIFFNESS,
            TORSION,
            YOUNG,
        ];
        let settings = Settings::defaults(&keys).with("surface_tension", tension.into());
        Material::of(&settings.with("contact_angle", angle.into()).with("bridge_volume", volume.into()))
    }

    fn at(gap: f64, [a, b]: [f64; 2]) -> Meeting {
        let (n, zero) = (DVec3::X, DVec3::ZERO);
        let radius = if b > 0.0 { a * b / (a + b) } else { a };
        let smaller = if b > 0.0 { a.min(b) } else { a };
        Meeting { n, overlap: -gap, arm: 0.0, v: zero, radius, smaller, spin: zero, mass: 1.0, rest: 0.0 }
    }

    /// Water on glass spheres of 1 mm, as a millionth of a newton: 2 π R γ cos θ at a touch, half of that at the gap where 1.05 x + 2.5 x² = 1, and
    /// nothing beyond (1 + θ / 2) V^(1/3). Between a sphere and a wall it is twice as much.
    #[test]
    fn bridges_pull_as_published() {
        let (tension, angle, radius, part) = (0.072, 0.3_f64, 1e-3, 0.02);
        let material = wet(tension, angle, part);
        let most = 2.0 * PI * radius * tension * angle.cos();
        for overlap in [0.0, 1e-5] {
            let held = material.bridge(&at(-overlap, [radius, radius]), true, 0.0);
            assert!((held.pull / most - 1.0).abs() < 1e-12, "{held:?}");
        }
        assert!((most * 1e6 - 432.2).abs() < 0.1, "{most}");
        let length = (part * radius.powi(3) / radius).sqrt();
        let half = length * ((1.05_f64.powi(2) + 10.0).sqrt() - 1.05) / 5.0;
        assert!((material.bridge(&at(half, [radius, radius]), true, 0.0).pull / most - 0.5).abs() < 1e-12);
        let rupture = (1.0 + 0.5 * angle) * (part * radius.powi(3)).cbrt();
        assert!(material.bridge(&at(0.999 * rupture, [radius, radius]), true, 0.0).pull > 0.01 * most);
        assert_eq!(material.bridge(&at(1.001 * rupture, [radius, radius]), true, 0.0), Bridge::default());
        // None forms before they touch.
        assert_eq!(material.bridge(&at(1e-9, [radius, radius]), false, 1.0), Bridge::default());
        let wall = material.bridge(&at(0.0, [radius, 0.0]), true, 0.0);
        assert!((wall.pull / most - 2.0).abs() < 1e-12, "{wall:?}");
    }

    /// F = −dU/ds for grains that overlap and that are apart, of different sizes; and U is 0 where the bridge breaks.
    #[test]
    fn pulls_are_the_slope_of_the_energy() {
        let material = wet(0.7, 0.4, 0.01);
        for radii in [[0.5, 0.5], [0.3, 0.9], [0.4, 0.0]] {
            let rupture = material.rupture(at(0.0, radii).smaller);
            let of = |gap: f64| material.bridge(&at(gap, radii), true, 0.0);
            for gap in [-0.05, -1e-4, 1e-4, 0.3 * rupture, 0.9 * rupture] {
                let h = 1e-6;
                let slope = (of(gap + h).energy - of(gap - h).energy) / (2.0 * h);
                assert!((of(gap).pull - slope).abs() < 1e-6 * of(0.0).pull, "{radii:?} {gap}: {slope}");
            }
            let last = of(rupture * (1.0 - 1e-9));
            assert!(last.energy <= 0.0 && -last.energy < 1e-8 * -of(0.0).energy, "{last:?}");
        }
    }

    /// What is set free where a bridge forms is its energy, less what the force gains in half a step; an old one sets free nothing.
    #[test]
    fn forming_sets_energy_free() {
        let (material, dt) = (wet(0.7, 0.0, 0.01), 1e-3);
        let meeting = Meeting { v: DVec3::new(2.0, 7.0, 0.0), ..at(-1e-3, [0.5, 0.5]) };
        let new = material.bridge(&meeting, false, dt);
        assert!((new.heat * dt + new.energy + 0.5 * dt * new.pull * 2.0).abs() < 1e-15 && new.heat > 0.0, "{new:?}");
        assert!(material.bridge(&meeting, true, dt).heat == 0.0);
        let dry = wet(0.0, 0.0, 0.01);
        assert_eq!(dry.bridge(&meeting, true, dt), Bridge::default());
    }
}
