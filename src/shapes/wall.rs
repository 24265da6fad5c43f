//! A wall of a fluid: a flat piece, a box, a sphere, or a mesh of triangles.

use std::borrow::Cow;
use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::build::{CENTER, Reader};
use super::mesh::Mesh;
use super::skin::{DENSITY, KERNEL, LAYERS, RADIUS, SPACING, SUPPORT, Skin, WALL_MASS, cells, steps};
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `wall`.
pub const WALL: Shape = Shape {
    name: "wall",
    about: "a plane, a box, a sphere or a mesh as a wall of a fluid, of fixed particles or with a prescribed motion (Akinci et al. 2012)",
    keys: KEYS,
    build,
    amount: |_| Amount::default(),
    parts: one_part,
    resolution: Resolution::Spacing,
};

/// The maximum number of points of a mesh that are tried: a minute's work.
const MOST_TRIES: f64 = 2e8;

const SURFACES: &[&str] = &["plane", "box", "sphere", "mesh"];

const KEYS: &[Key] = &[
    Key::new("surface", Kind::Choice(SURFACES), Value::Text(Cow::Borrowed("plane")), "the shape of the surface"),
    Key::new(
        "size",
        Kind::Vector,
        Value::Vector(DVec3::ONE),
        "box and sphere: the sides, or three times the diameter, 0 along z for a rectangle or a circle; plane: along the level and \
         up, where 0 up is a line [length]",
    ),
    Key::new("normal", Kind::Direction, Value::Vector(DVec3::Z), "plane: the direction to the fluid"),
    Key::new(
        "mesh",
        Kind::File,
        Value::Text(Cow::Borrowed("")),
        "mesh: a file in Wavefront's OBJ; its faces point towards the fluid",
    ),
    Key::new("scale", Kind::Positive, Value::Number(1.0), "mesh: by how much it is made larger"),
    Key::new("inside", Kind::Flag, Value::Flag(false), "box, sphere and mesh: whether the fluid is within"),
    SPACING,
    SUPPORT,
    KERNEL,
    WALL_MASS,
    LAYERS,
    DENSITY,
    CENTER,
    RADIUS,
];

/// One or more layers of particles behind a face, at the depth at which the first layer of fluid in front of it is at rest.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "wall", settings };
    let (size, surface) = (reader.vector("size")?, settings.text("surface"));
    let flat = match surface {
        "plane" => size.y == 0.0,
        "mesh" => false,
        _ => size.z == 0.0,
    };
    let skin = Skin::of(&reader, flat)?;
    // Inwards where the fluid is outside.
    let side = if settings.flag("inside") { 1.0 } else { -1.0 };
    let places = match surface {
        "box" => hull(&reader, &skin, side, size)?,
        "sphere" => sphere(&reader, &skin, side, size)?,
        "mesh" => mesh(&reader, &skin, side)?,
        _ => plane(&reader, &skin, size)?,
    };
    let center = reader.vector("center")?;
    skin.filled(&reader, places.into_iter().map(|place| place + center).collect())
}

/// A flat piece, as many spacings large as fit best.
fn plane(reader: &Reader<'_>, skin: &Skin, size: DVec3) -> Result<Vec<DVec3>, Error> {
    if size.x <= 0.0 || size.y < 0.0 {
        return Err(
            reader.error(&format!("size is {size}; a plane has a size above 0 along x, and of 0 or above along y"))
        );
    }
    let normal = reader.direction("normal")?;
    let level = DVec3::Z.cross(normal).try_normalize().unwrap_or(DVec3::X);
    let up = normal.cross(level);
    let numbers = (size / skin.spacing).round().max(DVec3::ONE);
    reader.fits(numbers.x * numbers.y * f64::from(skin.layers))?;
    let mut places = Vec::new();
    for depth in skin.depths() {
        for j in steps(numbers.y) {
            for i in steps(numbers.x) {
                let [i, j] = [i - 0.5 * (numbers.x - 1.0), j - 0.5 * (numbers.y - 1.0)];
                places.push((level * i + up * j) * skin.spacing - normal * depth);
            }
        }
    }
    Ok(places)
}

/// The hull of a box, on the lattice of the fluid around it or within it but for the outermost layer.
fn hull(reader: &Reader<'_>, skin: &Skin, side: f64, size: DVec3) -> Result<Vec<DVec3>, Error> {
    let numbers = cells(reader, size, skin.spacing)?;
    let layers = f64::from(skin.layers);
    reader.fits(
        (numbers + 2.0 * layers).element_product() - (numbers - 2.0 * layers).max(DVec3::ZERO).element_product(),
    )?;
    let axis = |axis: usize| -> Vec<(f64, bool)> {
        let half = 0.5 * numbers[axis] * skin.spacing;
        let inner = |i: f64| (i + 0.5) * skin.spacing - half;
        if size[axis] == 0.0 {
            return vec![(0.0, false)];
        }
        let depths: Vec<f64> = if side > 0.0 {
            skin.depths().collect()
        } else {
            // A thin wall has two faces at least a spacing apart, or is one layer.
            skin.depths().take_while(|depth| half - depth >= 0.5 * skin.spacing).collect()
        };
        let walls: Vec<f64> = depths.iter().map(|depth| half + side * depth).collect();
        let Some(deepest) = walls.last().copied() else { return vec![(0.0, true)] };
        let room = if side > 0.0 { half } else { deepest - 0.5 * skin.spacing };
        let mut all: Vec<(f64, bool)> = walls.iter().flat_map(|x| [(*x, true), (-x, true)]).collect();
        all.extend(steps(numbers[axis]).map(inner).filter(|x| x.abs() < room).map(|x| (x, false)));
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all
    };
    let [xs, ys, zs] = [axis(0), axis(1), axis(2)];
    let mut places = Vec::new();
    for (z, z_wall) in &zs {
        for (y, y_wall) in &ys {
            let row = xs.iter().filter(|(_, x_wall)| *x_wall || *y_wall || *z_wall);
            places.extend(row.map(|(x, _)| DVec3::new(*x, *y, *z)));
        }
    }
    Ok(places)
}

/// A sphere along a spiral (Swinbank & Purser 2006), or a circle.
fn sphere(reader: &Reader<'_>, skin: &Skin, side: f64, size: DVec3) -> Result<Vec<DVec3>, Error> {
    let flat = size.z == 0.0;
    let uneven = (size - size.x).abs();
    let round = size.x > 0.0 && uneven.y == 0.0 && (flat || uneven.z == 0.0);
    if !round {
        return Err(reader
            .error(&format!("size is {size}; a sphere has the same size along all axes, or 0 along z for a circle")));
    }
    let radii = skin.depths().map(|depth| 0.5 * size.x + side * depth);
    // A shape smaller than the thickness of its walls is one particle.
    let first = |(k, radius): (usize, f64)| if k == 0 { radius.max(0.0) } else { radius };
    let radii: Vec<f64> = radii.enumerate().map(first).filter(|radius| *radius >= 0.0).collect();
    let number = |radius: f64| {
        let around = radius / skin.spacing;
        (if flat { TAU * around } else { 4.0 * PI * around * around }).round().max(1.0)
    };
    reader.fits(radii.iter().map(|radius| number(*radius)).sum())?;
    let golden = PI * (3.0 - 5f64.sqrt());
    let mut places = Vec::new();
    for radius in radii {
        let all = number(radius);
        for i in steps(all) {
            let z = if flat { 0.0 } else { 1.0 - (2.0 * i + 1.0) / all };
            let angle = if flat { TAU * (i + 0.5) / all } else { golden * i };
            let way = DVec3::new(libm::cos(angle), libm::sin(angle), 0.0);
            places.push(radius * (way * (1.0 - z * z).sqrt() + DVec3::Z * z));
        }
    }
    Ok(places)
}

fn mesh(reader: &Reader<'_>, skin: &Skin, side: f64) -> Result<Vec<DVec3>, Error> {
    let text = reader.settings.text("mesh");
    if text.is_empty() {
        return Err(reader.error("surface is \"mesh\"; name the file, as in mesh = \"hull.obj\""));
    }
    let mut mesh = Mesh::read(text).map_err(|why| reader.error(&format!("mesh: {why}")))?;
    let scale = reader.positive("scale")?;
    mesh.places.iter_mut().for_each(|place| *place *= scale);
    let area = mesh.area();
    if area <= 0.0 {
        return Err(reader.error("mesh: all its faces together have no area"));
    }
    reader.fits(area / (skin.spacing * skin.spacing) * f64::from(skin.layers))?;
    // Depths move corners, by less than three spacings each.
    let tries = mesh.tries(skin.spacing) * f64::from(skin.layers);
    if tries > MOST_TRIES {
        return Err(reader.error(&format!(
            "mesh: with spacing = {} its edges and faces would be sampled at {tries:.1e} points, and the maximum is {MOST_TRIES:.0e}: \
             choose a larger spacing or a smaller scale, or look for triangles that are long and thin",
            skin.spacing
        )));
    }
    // Faces point outwards, and the inside is on their other side.
    Ok(skin.depths().flat_map(|depth| mesh.behind(-side * depth).sampled(skin.spacing)).collect())
}
