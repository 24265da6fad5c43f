//! A flock.

use std::borrow::Cow;

use glam::{DVec3, Vec3};

use super::{Component, Law, Over, Problem, Properties, SKIN, SPECIES, Stage, evaluate, species, speed_limit, params, over, is_nearer};
use crate::error::Error;
use crate::kernel::{Bounds, Plan, Scalar};
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::Particle;

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("range", Kind::Positive, Value::Number(0.5), "the range of view, near and within [length]"),
    Key::new("separation_range", Kind::NotNegative, Value::Number(0.2), "the range of separation; no larger than the range of view [length]"),
    Key::new("separation", Kind::NotNegative, Value::Number(1.5), "the weight of separation"),
    Key::new("alignment", Kind::NotNegative, Value::Number(1.0), "the weight of alignment"),
    Key::new("cohesion", Kind::NotNegative, Value::Number(1.0), "the weight of cohesion"),
    Key::new("vision", Kind::NotNegative, Value::Number(135.0), "half of the angle of view; 180 or more: all directions, as for a bird at rest [degrees]"),
    Key::new("max_speed", Kind::Positive, Value::Number(1.0), "the desired speed, and the maximum speed [length / time]"),
    Key::new("min_speed", Kind::NotNegative, Value::Number(0.0), "the minimum speed; a bird at rest sets off along x [length / time]"),
    Key::new("max_force", Kind::Positive, Value::Number(1.5), "the maximum acceleration of each rule, and of all together [length / time²]"),
    SPECIES,
    Key::new("over", Kind::Choice(&["near", "list", "auto", "within", "nearest"]), Value::Text(Cow::Borrowed("near")), "how neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force; or the k nearest neighbours, of all species, at any distance (Ballerini et al. 2008)"),
    SKIN,
    Key::new("neighbors", Kind::Count, Value::Number(7.0), "over = \"nearest\": the number k of neighbours"),
];

/// `boids`: separation, alignment and cohesion (Reynolds 1987), each as steering (Reynolds 1999), bounded one by one and in
/// all. Separation and cohesion are directions, wished for at full speed; alignment is a mean velocity, wished for as it is.
/// A bird without neighbours flies straight on. Forces are not mutual: momentum is not kept.
#[derive(Clone)]
pub struct Boids(Settings);

/// The sums over the neighbours of a particle.
#[derive(Default)]
struct Seen {
    separation: DVec3,
    neighbors: f64,
    velocity: DVec3,
    displacement: DVec3,
}

impl Boids {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
    /// The cosine of the half angle of view; below all cosines where one sees all round.
    fn cosine(&self) -> f64 {
        let vision = self.0.number("vision");
        if vision < 180.0 { vision.to_radians().cos() } else { -2.0 }
    }
}

impl Component for Boids {
    fn check(&self, _: &Bounds) -> Result<(), Error> {
        let (range, least) = (self.0.number("range"), self.0.number("separation_range"));
        // The nearest neighbours are seen however far they are.
        if least <= range || self.0.text("over") == "nearest" {
            return Ok(());
        }
        let why = format!("boids have separation_range = {least} and range = {range}: no neighbour is seen beyond the range; choose a smaller separation_range, or a larger range");
        Err(Error::Setting { key: "separation_range", why })
    }
    fn properties(&self) -> Properties {
        let statistics_radius = Some((self.0.number("range"), self.0.species("species")));
        Properties { statistics_radius, constrains: true, ..Properties::default() }
    }
    fn laws(&self) -> Vec<Law> {
        let number = |name| self.0.number(name);
        let weights = ["separation", "alignment", "cohesion"].map(number);
        let (speed, force, apart, cosine) =
            (number("max_speed"), number("max_force"), number("separation_range"), self.cosine());
        let (kind, kind_value) = species(&self.0, "species");
        let names = ["separation_range", "separation", "alignment", "cohesion", "max_speed", "max_force"];
        let mut values = params(&self.0, &names);
        values.extend([("cosine".to_owned(), Scalar::Float(cosine)), ("species".to_owned(), kind_value)]);
        let over = match self.0.text("over") {
            "nearest" => Over::Nearest { count: u32::try_from(self.0.whole("neighbors")).unwrap_or(u32::MAX) },
            _ => over(&self.0, None),
        };
        let gather = move |me: &Particle, you: &Particle, r: DVec3, seen: &mut Seen| {
            if !(in_view(me.velocity, r, cosine) && kind.has(me) && kind.has(you)) {
                return;
            }
            let d2 = r.length_squared();
            if is_nearer(r, apart) && d2 > 1e-30 {
                seen.separation -= r / d2;
            }
            seen.neighbors += 1.0;
            seen.velocity += you.velocity;
            seen.displacement += r;
        };
        let finish = move |me: &Particle, seen: &Seen, _: &crate::kernel::World| {
            if seen.neighbors == 0.0 {
                return glam::DVec4::ZERO;
            }
            let toward = |way: DVec3| match way.try_normalize() {
                Some(way) => (speed * way - me.velocity).clamp_length_max(force),
                None => DVec3::ZERO,
            };
            let along = (seen.velocity / seen.neighbors - me.velocity).clamp_length_max(force);
            let a = weights[0] * toward(seen.separation) + weights[1] * along + weights[2] * toward(seen.displacement);
            a.clamp_length_max(force).extend(0.0)
        };
        vec![Law::gathering("boids", over, crate::shader!("interactions/boids.wgsl"), values, gather, finish)]
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if let Stage::Evaluate { earlier } = stage {
            return evaluate(self.laws(), earlier, plan, problem);
        }
        if stage != Stage::AfterKick {
            return Ok(());
        }
        let (least, most) = (self.0.number("min_speed"), self.0.number("max_speed"));
        speed_limit::kernel(problem, [least, most], species(&self.0, "species").0).map(|kernel| plan.add(kernel))
    }
}

/// Whether the direction r is within the angle of view around the velocity, by the device's own arithmetic.
fn in_view(velocity: DVec3, r: DVec3, cosine: f64) -> bool {
    #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
    let (v, r, cosine): (Vec3, Vec3, f32) = (velocity.as_vec3(), r.as_vec3(), cosine as f32);
    v.dot(r) >= cosine * (v.dot(v) * r.dot(r)).sqrt()
}
