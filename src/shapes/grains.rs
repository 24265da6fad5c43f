//! Grains at rest, apart from each other: spheres with a distribution of radii.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::build::{CENTER, Reader, SEED, VELOCITY};
use super::random::Random;
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::grains;
use crate::kernel::Array;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `grains`.
pub const GRAINS: Shape = Shape {
    name: "grains",
    about: "solid spheres that do not touch, on a disordered lattice in a box or a cylinder, with their radii and moments of inertia",
    keys: KEYS,
    build,
    amount,
    parts: one_part,
    resolution: Resolution::Own,
};

const KEYS: &[Key] = &[
    Key::required(
        "size",
        Kind::Vector,
        "the sides of the box; of a cylinder x and y are its diameter, and z is its height [length]",
    ),
    Key::required("radius", Kind::Positive, "the mean radius [length]"),
    Key::new(
        "spread",
        Kind::NotNegative,
        Value::Number(0.0),
        "radii are uniform between 1 − this and 1 + this times the mean, below 1",
    ),
    Key::new("density", Kind::Positive, Value::Number(2500.0), "the density of the material [mass / length³]"),
    Key::new(
        "gap",
        Kind::NotNegative,
        Value::Number(0.1),
        "the least distance of the largest spheres in the lattice, in their radii; within it they are displaced",
    ),
    Key::new("cylinder", Kind::Flag, Value::Flag(false), "whether they fill the cylinder along z in the box"),
    SEED,
    CENTER,
    VELOCITY,
];

/// The distance of the places of the lattice.
fn spacing(settings: &Settings) -> f64 {
    largest(settings) * (2.0 + settings.number("gap"))
}

/// The radius of the largest sphere.
fn largest(settings: &Settings) -> f64 {
    settings.number("radius") * (1.0 + settings.number("spread"))
}

fn numbers(settings: &Settings) -> DVec3 {
    let size = settings.vector("size");
    // A side that is a whole number of spacings is not short of one by rounding; one as long as the largest sphere is wide has room for it.
    let single = (0.5 * size / largest(settings) + 1e-9).floor().clamp(DVec3::ZERO, DVec3::ONE);
    (size / spacing(settings) + 1e-9).floor().max(single)
}

/// The part of a way from a place of the lattice that stays within an ellipse of such half axes; none, if the place lies outside.
fn within_ellipse(place: DVec2, way: DVec2, half: DVec2) -> Option<f64> {
    // |p + t w|² = 1 in units of the half axes.
    let (p, w) = (place / half, way / half);
    let (beyond, along, square) = (p.length_squared() - 1.0, p.dot(w), w.length_squared());
    if beyond > 1e-9 {
        return None;
    }
    let reaches = beyond + 2.0 * along + square > 0.0;
    let root = (along * along - square * beyond).max(0.0).sqrt();
    Some(if reaches { ((root - along) / square).clamp(0.0, 1.0) } else { 1.0 })
}

fn amount(settings: &Settings) -> Amount {
    Amount::of(numbers(settings).element_product())
}

fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "grains", settings };
    let (radius, density) = (reader.positive("radius")?, reader.positive("density")?);
    let spread = reader.number("spread", "0 or above, and below 1", |x| (0.0..1.0).contains(&x))?;
    let (gap, center, velocity) = (reader.not_negative("gap")?, reader.vector("center")?, reader.vector("velocity")?);
    let (size, step, numbers) = (reader.vector("size")?, spacing(settings), numbers(settings));
    reader.fits(numbers.element_product())?;
    let largest = largest(settings);
    // Displaced within the gap, and no farther than the sides.
    let reach =
        (0.5 * size - 0.5 * step * (numbers - 1.0) - largest).clamp(DVec3::ZERO, DVec3::splat(0.5 * gap * largest));
    let round = settings.flag("cylinder");
    let mut random = Random::new(settings.whole("seed"));
    let (mut state, mut radii) = (State::default(), Vec::new());
    for column in grains::columns() {
        state.declare(&column)?;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked to be few")]
    let [nx, ny, nz] = numbers.to_array().map(|n| n as u32);
    for (z, y, x) in (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| (z, y, x)))) {
        let mut between = |most: f64| random.between(-most, most);
        let r = radius * (1.0 + between(spread));
        let off = DVec3::new(between(1.0), between(1.0), between(1.0)) * reach;
        let cell = DVec3::new(f64::from(x), f64::from(y), f64::from(z)) + 0.5;
        let place = step * (cell - 0.5 * numbers);
        // One half axis may be 0.
        let half = 0.5 * size.truncate() - largest + 1e-9 * largest;
        let part = if round { within_ellipse(place.truncate(), off.truncate(), half) } else { Some(1.0) };
        if let Some(part) = part {
            let off = DVec3::new(part, part, 1.0) * off;
            state.push(place + off + center, velocity, 4.0 / 3.0 * PI * r * r * r * density, r);
            radii.push(r);
        }
    }
    if radii.is_empty() {
        return Err(reader.error(&format!("no sphere of radius {largest} has room in {size}: make it larger")));
    }
    let moment = |(r, m): (&f64, &f64)| DVec3::splat(0.4 * m * r * r);
    let moments = radii.iter().zip(state.mass()).map(moment).collect();
    state.set("inertia", Array::Vec3(moments))?;
    state.set("radius", Array::Float(radii))?;
    reader.finished(state)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Bounds;

    /// A tube as wide as a sphere holds a row of them on its axis; a narrower one is refused.
    #[test]
    fn tubes_as_wide_as_a_sphere_hold_a_row() {
        let tube = |width: f64| {
            let more =
                [("size", DVec3::new(width, width, 0.1).into()), ("radius", 0.005.into()), ("cylinder", true.into())];
            build(&more.into_iter().fold(Settings::defaults(KEYS), |all, (key, value)| all.with(key, value)))
        };
        let row = tube(0.01).expect("a row");
        assert!(row.len() == 9 && row.position().iter().all(|x| x.truncate().length() < 1e-12), "{}", row.len());
        let radii = row.scalar("radius").expect("radii");
        assert!(grains::touching(row.position(), radii, &Bounds::default(), |_| true).is_empty());
        let narrow = tube(0.0099).expect_err("too narrow").to_string();
        assert!(narrow.contains("no sphere of radius 0.005 has room"), "{narrow}");
    }

    /// However they are displaced, tubes hold all the grains that their lattice has, within their walls: at widths from one grain to three, and
    /// with an ellipse among them, over many seeds. Displaced places that leave a round tube of 1.04 grains are a fifth of all.
    #[test]
    fn no_seed_loses_grains_of_a_tube() {
        for (wide, deep, columns) in [
            (1.0, 1.0, 1),
            (1.004, 1.004, 1),
            (1.04, 1.04, 1),
            (1.2, 1.04, 1),
            (2.6, 2.6, 4),
            (3.2, 3.2, 5),
            (3.18, 3.5, 5),
        ] {
            let mut farthest = 0.0_f64;
            for seed in 0..200 {
                let size = DVec3::new(0.01 * wide, 0.01 * deep, 0.05);
                let more = [
                    ("size", size.into()),
                    ("radius", 0.005.into()),
                    ("cylinder", true.into()),
                    ("seed", f64::from(seed).into()),
                ];
                let tube = more.into_iter().fold(Settings::defaults(KEYS), |all, (key, value)| all.with(key, value));
                let grains = build(&tube).expect("grains");
                assert_eq!(grains.len(), 4 * columns, "{wide} {deep}, seed {seed}");
                let half = 0.5 * size.truncate() - 0.005 + 1e-11;
                let out = grains.position().iter().map(|x| (x.truncate() / half).length()).fold(0.0, f64::max);
                assert!(out < 1.0 + 1e-6, "{wide} {deep}, seed {seed}: {out}");
                farthest = farthest.max(out);
                let radii = grains.scalar("radius").expect("radii");
                assert!(grains::touching(grains.position(), radii, &Bounds::default(), |_| true).is_empty());
            }
            // Some reach the wall, or all are on the axis.
            assert!(farthest > 0.9 || wide < 1.001, "{wide} {deep}: {farthest}");
        }
    }

    /// No two grains touch, however they are displaced; radii are spread as asked for, and masses and moments are those of spheres.
    #[test]
    fn grains_are_apart_and_as_heavy_as_spheres() {
        let more = [("size", DVec3::new(0.1, 0.12, 0.2).into()), ("radius", 0.005.into()), ("spread", 0.2.into())];
        let box_of = more.into_iter().fold(Settings::defaults(KEYS), |all, (key, value)| all.with(key, value));
        let tube = box_of.clone().with("cylinder", true.into());
        let [all, some] = [&box_of, &tube].map(|settings| build(settings).expect("grains"));
        assert!((amount(&box_of).particles - all.len() as f64).abs() < 0.5);
        assert!(some.len() < all.len() * 9 / 10 && some.len() > all.len() / 2, "{} of {}", some.len(), all.len());
        let radii = all.scalar("radius").expect("radii");
        let (least, most) = radii.iter().fold((1.0_f64, 0.0_f64), |(a, b), r| (a.min(*r), b.max(*r)));
        assert!(least > 0.004 && least < 0.0042 && most < 0.006 && most > 0.0058, "{least} {most}");
        assert!(grains::touching(all.position(), radii, &Bounds::default(), |_| true).is_empty());
        // Negative control: a tenth larger, some touch.
        let larger: Vec<f64> = radii.iter().map(|r| 1.2 * r).collect();
        assert!(!grains::touching(all.position(), &larger, &Bounds::default(), |_| true).is_empty());
        let moments = all.vector("inertia").expect("moments");
        for ((r, m), moment) in radii.iter().zip(all.mass()).zip(moments) {
            assert!((m / (4.0 / 3.0 * PI * r.powi(3) * 2500.0) - 1.0).abs() < 1e-12);
            assert!((*moment - DVec3::splat(0.4 * m * r * r)).length() < 1e-18);
        }
        let inside = |x: &DVec3| x.abs().cmple(DVec3::new(0.05, 0.06, 0.1) - 0.004).all();
        assert!(all.position().iter().all(inside));
    }
}
