//! The results of a reference for inputs within rounding to single precision of the given ones.

use glam::{DVec3, DVec4};

use crate::error::Error;
use crate::kernel::{Array, Host, POSITION, Reference, World};

/// What it says of inputs that are off by what they are rounded by, at random, and of places to all sides.
pub struct Nudged {
    sway: Host,
    aside: Vec<Host>,
}

impl Nudged {
    /// What it says of one field.
    pub fn of(&self, name: &str) -> (Option<Array>, Vec<Array>) {
        (self.sway.get(name), self.aside.iter().filter_map(|host| host.get(name)).collect())
    }
}

/// How far to a side, in units in the last place of the largest coordinate: a place less a middle, and a size, are each rounded by
/// half of one, and so are the numbers of the scene that they are of.
const ASIDE: f64 = 2.0;

/// Asks a reference.
pub fn nudged(reference: &Reference, inputs: &[(&str, Option<&Array>)], world: World) -> Result<Nudged, Error> {
    let sides =
        (0..8u32).map(|octant| DVec3::from_array([0, 1, 2].map(|axis| f64::from(octant >> axis & 1) * 2.0 - 1.0)));
    let aside = sides.map(|side| ask(reference, inputs, world, |name, array| shifted(name, array, side)));
    Ok(Nudged { sway: sway(reference, inputs, world)?, aside: aside.collect::<Result<_, Error>>()? })
}

/// Places a little to one side, all else as it is.
fn shifted(name: &str, array: &Array, side: DVec3) -> Array {
    match array {
        Array::Vec4(all) if name == POSITION.name => {
            let most = all.iter().map(|x| x.truncate().abs().max_element()).fold(0.0, f64::max);
            let way = ASIDE * f64::from(f32::EPSILON) * most * side;
            Array::Vec4(all.iter().map(|x| *x + way.extend(0.0)).collect::<Vec<DVec4>>())
        }
        other => other.clone(),
    }
}

fn ask(
    reference: &Reference,
    inputs: &[(&str, Option<&Array>)],
    world: World,
    mut change: impl FnMut(&str, &Array) -> Array,
) -> Result<Host, Error> {
    let mut host = Host::default();
    for (name, array) in inputs {
        if let Some(array) = array {
            host.insert(name, change(name, array));
        }
    }
    host.set_world(world);
    reference(&host)?;
    Ok(host)
}

/// The reference's results for inputs that are off by half a unit in the last place of single precision.
fn sway(reference: &Reference, inputs: &[(&str, Option<&Array>)], world: World) -> Result<Host, Error> {
    // A multiplier of Knuth's: signs without a pattern.
    let mut state = 1u64;
    let mut off = |x: f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        x * (1.0 + if state >> 63 == 0 { 0.5 } else { -0.5 } * f64::from(f32::EPSILON))
    };
    let nudged = |_: &str, array: &Array| match array {
        Array::Vec4(all) => Array::Vec4(all.iter().map(|v| v.to_array().map(&mut off).into()).collect()),
        Array::Float(all) => Array::Float(all.iter().map(|x| off(*x)).collect()),
        Array::Vec3(all) => Array::Vec3(all.iter().map(|v| v.to_array().map(&mut off).into()).collect()),
        Array::Uint(all) => Array::Uint(all.clone()),
    };
    ask(reference, inputs, world, nudged)
}
