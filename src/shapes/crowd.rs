//! Pedestrians in a rectangle, apart from each other.

use std::collections::HashMap;

use glam::{DVec2, DVec3, IVec2};

use super::build::{CENTER, COUNT, Reader, SEED, VELOCITY};
use super::random::Random;
use super::{Amount, Resolution, Shape, one_part};
use crate::crowds;
use crate::error::Error;
use crate::kernel::Array;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `crowd`.
pub const CROWD: Shape = Shape {
    name: "crowd",
    about: "pedestrians at random in a rectangle, apart from each other, with radii and desired speeds from distributions (Weidmann 1993)",
    keys: KEYS,
    build,
    amount: Amount::counted,
    parts: one_part,
    resolution: Resolution::Own,
};

const KEYS: &[Key] = &[
    COUNT,
    Key::required(
        "size",
        Kind::Vector,
        "the sides of the rectangle, within which all discs are; z is not used [length]",
    ),
    Key::new("min_radius", Kind::Positive, Value::Number(0.25), "radii are uniform between this [length]"),
    Key::new("max_radius", Kind::Positive, Value::Number(0.35), "and this [length]"),
    Key::new("mass", Kind::Positive, Value::Number(80.0), "mass of each pedestrian [mass]"),
    Key::new(
        "mean_speed",
        Kind::Positive,
        Value::Number(1.34),
        "desired speeds are normal with this mean [length / time]",
    ),
    Key::new("speed_spread", Kind::NotNegative, Value::Number(0.26), "and this standard deviation [length / time]"),
    Key::new("min_speed", Kind::Positive, Value::Number(0.5), "within this [length / time]"),
    Key::new(
        "max_speed",
        Kind::Positive,
        Value::Number(2.2),
        "and this: speeds outside are drawn again [length / time]",
    ),
    Key::new("gap", Kind::NotNegative, Value::Number(0.0), "the least distance between discs [length]"),
    SEED,
    CENTER,
    VELOCITY,
];

/// Places tried for one pedestrian: random discs cover 0.547 of a plane at most (Feder 1980), and nearly so after as many.
const TRIES: u32 = 20_000;
/// Speeds tried for one pedestrian.
const DRAWS: u32 = 10_000;

fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "crowd", settings };
    let (count, mut state) = reader.room()?;
    let [least, most] = [reader.positive("min_radius")?, reader.positive("max_radius")?];
    let [slow, fast] = [reader.positive("min_speed")?, reader.positive("max_speed")?];
    let (mass, mean, spread) =
        (reader.positive("mass")?, reader.positive("mean_speed")?, reader.not_negative("speed_spread")?);
    let (gap, size) = (reader.not_negative("gap")?, reader.vector("size")?.truncate());
    let (center, velocity) = (reader.vector("center")?, reader.vector("velocity")?);
    if least > most || slow > fast {
        return Err(reader.error("a minimum is above its maximum: exchange them"));
    }
    let mut random = Random::new(settings.whole("seed"));
    let cell = 2.0 * most + gap;
    let place = |x: DVec2| (x / cell).floor().as_ivec2();
    let mut cells: HashMap<IVec2, Vec<usize>> = HashMap::new();
    let (mut places, mut radii, mut speeds): (Vec<DVec2>, Vec<f64>, Vec<f64>) = Default::default();
    for i in 0..count {
        let radius = if most > least { random.between(least, most) } else { least };
        let half = 0.5 * size - radius;
        if half.min_element() < 0.0 {
            return Err(reader.error(&format!("no disc of radius {radius:.3} has room in {size}: make it larger")));
        }
        let free = |x: DVec2, cells: &HashMap<IVec2, Vec<usize>>, places: &[DVec2], radii: &[f64]| {
            let near = (0..9).map(|n| place(x) + IVec2::new(n % 3 - 1, n / 3 - 1));
            let mut near = near.filter_map(|at| cells.get(&at)).flatten();
            near.all(|j| places[*j].distance(x) >= radius + radii[*j] + gap)
        };
        let tried = (0..TRIES).find_map(|_| {
            let x = DVec2::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0)) * half;
            free(x, &cells, &places, &radii).then_some(x)
        });
        let Some(x) = tried else {
            let why = format!(
                "after {i} pedestrians no place was found in {TRIES} tries: make `size` larger, or `count` smaller than {i}"
            );
            return Err(reader.error(&why));
        };
        let drawn = (0..DRAWS).map(|_| mean + spread * random.normal()).find(|speed| (slow..=fast).contains(speed));
        let Some(speed) = drawn else {
            return Err(reader.error(&format!("no speed of mean {mean} is between {slow} and {fast}: choose others")));
        };
        cells.entry(place(x)).or_default().push(i);
        places.push(x);
        radii.push(radius);
        speeds.push(speed);
    }
    for (x, radius) in places.iter().zip(&radii) {
        state.push(DVec3::new(x.x, x.y, 0.0) + center, velocity, mass, *radius);
    }
    for (column, values) in [(crowds::radius(), radii), (crowds::desired_speed(), speeds)] {
        state.declare(&column)?;
        state.set(&column.name, Array::Float(values))?;
    }
    reader.finished(state)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Bounds;

    fn crowd(more: &[(&'static str, Value)]) -> Result<State, Error> {
        let given = [("count", Value::Number(400.0)), ("size", DVec3::new(20.0, 25.0, 0.0).into())];
        let all = given.into_iter().chain(more.iter().cloned());
        build(&all.fold(Settings::defaults(KEYS), |all, (key, value)| all.with(key, value)))
    }

    /// No two touch, all are inside, and radii and speeds have the means and deviations of their distributions: uniform between 0.25 and 0.35, and
    /// normal, of which the ends beyond 3.2 deviations hardly matter. Of 400 the error of a mean is a deviation / 20.
    #[test]
    fn pedestrians_are_apart_with_the_distributions_asked_for() {
        for seed in [1.0, 2.0, 3.0] {
            let all = crowd(&[("seed", Value::Number(seed)), ("gap", Value::Number(0.05))]).expect("a crowd");
            let [radii, speeds] = ["radius", "desired_speed"].map(|name| all.scalar(name).expect("values"));
            let wider: Vec<f64> = radii.iter().map(|r| r + 0.0249).collect();
            assert!(crate::grains::touching(all.position(), &wider, &Bounds::default(), |_| true).is_empty());
            let inside = |(x, r): (&DVec3, &f64)| x.x.abs() + r <= 10.0 && x.y.abs() + r <= 12.5 && x.z == 0.0;
            assert!(all.position().iter().zip(radii).all(inside));
            let statistics = |values: &[f64]| {
                let mean = values.iter().sum::<f64>() / 400.0;
                (mean, (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 400.0).sqrt())
            };
            let (mean, deviation) = statistics(speeds);
            assert!((mean - 1.34).abs() < 4.0 * 0.26 / 20.0 && (deviation - 0.26).abs() < 0.04, "{mean} {deviation}");
            assert!(speeds.iter().all(|v| (0.5..=2.2).contains(v)));
            let (mean, deviation) = statistics(radii);
            assert!(
                (mean - 0.3).abs() < 4.0 * 0.0289 / 20.0 && (deviation - 0.0289).abs() < 0.003,
                "{mean} {deviation}"
            );
        }
    }

    #[test]
    fn what_has_no_room_is_refused() {
        let why = |more: &[(&'static str, Value)]| crowd(more).expect_err("no room").to_string();
        assert!(why(&[("size", DVec3::new(8.0, 8.0, 0.0).into())]).contains("no place was found"));
        assert!(why(&[("size", DVec3::new(0.4, 8.0, 0.0).into())]).contains("has room in"));
        assert!(why(&[("min_radius", Value::Number(0.4))]).contains("above its maximum"));
        assert!(why(&[("mean_speed", Value::Number(90.0))]).contains("no speed of mean 90"));
    }
}
