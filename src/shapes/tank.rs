//! A tank: walls around a fluid.
//!
//! Walls of particles, those of [`TANK`] and of the shape `wall`, are part of the fluid's sums: it is as dense beside them as
//! elsewhere, leans on them with its pressure, and rubs. They are what a fluid should stand in. The force `solid` is no part of
//! them: it puts back particles inside, after every drift, so that none gets through, however fast and whatever the step; but
//! beside it the fluid misses what is not there, is too thin by some 15 %, and sinks together into layers there. It serves for
//! what few particles touch, for what is out of the way, and behind walls of particles, a little beyond their face, for those
//! that a burst would throw through them: the scene `dam_break` has both.

use std::borrow::Cow;

use glam::DVec3;

use super::build::{CENTER, Reader};
use super::skin::{DENSITY, KERNEL, LAYERS, RADIUS, SPACING, SUPPORT, Skin, WALL_MASS, cells, steps};
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `tank`.
pub const TANK: Shape = Shape {
    name: "tank",
    about: "a box, or a rectangle, of walls around a fluid, as fixed particles, without gaps at the edges (Akinci et al. 2012)",
    keys: KEYS,
    build,
    amount,
    parts: one_part,
    resolution: Resolution::Spacing,
};

const KEYS: &[Key] = &[
    Key::required("size", Kind::Vector, "the sides of the space inside; 0 along z for a rectangle [length]"),
    SPACING,
    Key::new(
        "open",
        Kind::Sides,
        Value::Text(Cow::Borrowed("")),
        "which sides are left out, such as \"+z\" or \"-x +x\"; none: it is closed",
    ),
    SUPPORT,
    KERNEL,
    WALL_MASS,
    LAYERS,
    DENSITY,
    CENTER,
    RADIUS,
];

/// All layers of the sides that are there, less the space inside; none where the settings are no tank, which `build` says.
fn amount(settings: &Settings) -> Amount {
    let reader = Reader { shape: "tank", settings };
    let counted = || {
        let size = reader.vector("size")?;
        let skin = Skin::of(&reader, size.z == 0.0)?;
        let numbers = cells(&reader, size, skin.spacing)?;
        let open: Vec<&str> = settings.text("open").split_whitespace().collect();
        let closed = |side: &&&str| !(open.contains(*side) || size.z == 0.0 && side.ends_with('z'));
        let sides = [["-x", "+x"], ["-y", "+y"], ["-z", "+z"]].map(|names| names.iter().filter(closed).count() as f64);
        let whole = numbers + DVec3::from(sides) * f64::from(skin.layers);
        Ok::<_, Error>(whole.element_product() - numbers.element_product())
    };
    Amount::of(counted().unwrap_or(0.0))
}

/// The walls of a room that is as many spacings long as fit best, so that a block of the same size fills it. They stand on the
/// fluid's own lattice, but for the distance from the face: there the first layer of the fluid is at rest.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "tank", settings };
    let size = reader.vector("size")?;
    let flat = size.z == 0.0;
    let skin = Skin::of(&reader, flat)?;
    let numbers = cells(&reader, size, skin.spacing)?;
    let center = reader.vector("center")?;
    let open: Vec<&str> = settings.text("open").split_whitespace().collect();
    if let Some(word) = open.iter().find(|word| !crate::settings::SIDES.contains(word)) {
        let known = crate::settings::SIDES.join(", ");
        return Err(reader.error(&format!("open names the side {word}; there are {known}")));
    }
    // Along each axis the layers of the low wall, those of the room, and those of the high wall.
    let axis = |axis: usize| {
        let (names, half) = ([["-x", "+x"], ["-y", "+y"], ["-z", "+z"]][axis], 0.5 * numbers[axis] * skin.spacing);
        let closed = |end: usize| !(flat && axis == 2 || open.contains(&names[end]));
        let walls: Vec<f64> = skin.depths().map(|depth| half + depth).collect();
        let mut all = Vec::new();
        all.extend(walls.iter().rev().filter(|_| closed(0)).map(|x| (-x, true)));
        all.extend(steps(numbers[axis]).map(|i| ((i + 0.5) * skin.spacing - half, false)));
        all.extend(walls.iter().filter(|_| closed(1)).map(|x| (*x, true)));
        all
    };
    // Counted before memory is taken: a slip in the spacing must not fill it.
    let sides = numbers + 2.0 * f64::from(skin.layers);
    let wanted = sides.element_product() - numbers.element_product();
    reader.fits(wanted)?;
    let [xs, ys, zs] = [axis(0), axis(1), axis(2)];
    let ends: Vec<(f64, bool)> = xs.iter().copied().filter(|(_, wall)| *wall).collect();
    let mut places = Vec::new();
    for (z, z_wall) in &zs {
        for (y, y_wall) in &ys {
            let row = if *z_wall || *y_wall { &xs } else { &ends };
            places.extend(row.iter().map(|(x, _)| DVec3::new(*x, *y, *z) + center));
        }
    }
    skin.filled(&reader, places)
}
