//! The references of the kernels that build a tree: sums over the bodies of each node, independent of its children.

use glam::{DMat3, DVec3, DVec4, Vec4};

use super::build::{CUBE, GREATEST, KEY, LEAST, ORIGIN, PART, PLACE, PULLS, UPPER};
use super::{
    GROUP, Opening, TREE_BODY, TREE_CENTER, TREE_DEMAND, TREE_HIGH, TREE_ID, TREE_LOW, TREE_MASS, TREE_SHAPE, Tree,
    curve,
};
use crate::error::Error;
use crate::kernel::{ACCELERATION, DUE, Host, POSITION, POSITION_LOW};

/// The corner of the cube, and cells per length; 0 where that overflows single precision.
pub(super) fn cube(_: &Tree, host: &Host) -> Result<(), Error> {
    let (least, greatest) = (host.read(LEAST)?, host.read(GREATEST)?);
    let low = least.first().map_or(DVec3::ZERO, |corner| corner.truncate());
    let high = greatest.first().map_or(DVec3::ZERO, |corner| corner.truncate());
    let side = (high - low).max_element();
    let scale = if side > 2.5e-32 && side < 3.4e38 { f64::from(1 << curve::BITS) / side } else { 0.0 };
    host.write(CUBE)?.iter_mut().take(1).for_each(|cube| *cube = low.extend(scale));
    Ok(())
}

/// Cells by the device's own arithmetic, so that a body at an edge is on the same side for both.
pub(super) fn keys(tree: &Tree, host: &Host) -> Result<(), Error> {
    let (position, cube) = (host.read(tree.places())?, host.read(CUBE)?);
    let cube = cube.first().map_or(Vec4::ZERO, |c| c.as_vec4());
    let (mut lower, mut upper) = (host.write(KEY)?, host.write(UPPER)?);
    let mut ids = host.writing::<u32>(&tree.field(TREE_ID).1)?;
    for (i, position) in position.iter().enumerate().take(tree.used as usize) {
        let away = (position.as_vec4().truncate() - cube.truncate()) * cube.w;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped; what is no number becomes 0"
        )]
        let cell = away.to_array().map(|x| (x as u32).min((1 << curve::BITS) - 1));
        let key = curve::hilbert(cell);
        lower[i] = u32::try_from(key & ((1 << curve::LOWER) - 1)).unwrap_or(0);
        upper[i] = u32::try_from(key >> curve::LOWER).unwrap_or(0);
        ids[i] = u32::try_from(i).unwrap_or(u32::MAX);
    }
    // Free rows come last.
    for i in tree.used as usize..tree.count as usize {
        (lower[i], upper[i], ids[i]) = (u32::MAX, u32::MAX, u32::try_from(i).unwrap_or(u32::MAX));
    }
    Ok(())
}

pub(super) fn upper(tree: &Tree, host: &Host) -> Result<(), Error> {
    let (ids, upper) = (host.reading::<u32>(&tree.field(TREE_ID).1)?, host.read(UPPER)?);
    for (key, id) in host.write(KEY)?.iter_mut().zip(ids.iter()) {
        *key = upper.get(*id as usize).copied().unwrap_or(0);
    }
    Ok(())
}

/// The high words hold all digits here; those of a device have a part of them in the low words.
pub(super) fn places(tree: &Tree, host: &Host) -> Result<(), Error> {
    let (position, low) = (host.read(POSITION)?, host.read(POSITION_LOW)?);
    let origin = host.read(ORIGIN)?.first().map_or(DVec3::ZERO, |corner| corner.truncate());
    let both = position.iter().zip(low.iter()).take(tree.used as usize);
    for (place, (x, rest)) in host.write(PLACE)?.iter_mut().zip(both) {
        *place = (x.truncate() - origin + rest.truncate()).extend(x.w);
    }
    Ok(())
}

pub(super) fn carry(tree: &Tree, host: &Host) -> Result<(), Error> {
    let (ids, position) = (host.reading::<u32>(&tree.field(TREE_ID).1)?, host.read(tree.places())?);
    for (body, id) in
        host.writing::<Vec4>(&tree.field(TREE_BODY).1)?.iter_mut().zip(ids.iter()).take(tree.used as usize)
    {
        *body = position.get(*id as usize).copied().unwrap_or(DVec4::ZERO);
    }
    Ok(())
}

pub(super) fn nodes(tree: &Tree, host: &Host) -> Result<(), Error> {
    let bodies = host.reading::<Vec4>(&tree.field(TREE_BODY).1)?;
    let field = |name| host.writing::<Vec4>(&tree.field(name).1);
    let (mut center, mut mass, mut shape) = (field(TREE_CENTER)?, field(TREE_MASS)?, field(TREE_SHAPE)?);
    let (mut low, mut high) = (field(TREE_LOW)?, field(TREE_HIGH)?);
    for above in 0..=tree.height() {
        let (first, nodes) = tree.level(above);
        for n in first..first + nodes {
            let node = Node::of(&bodies[tree.range(n)]);
            let (middle, sides) = (0.5 * (node.low + node.high), node.high - node.low);
            let offset = node.center.distance(middle);
            let side = sides.max_element();
            let reach = (tree.stretch() * side).max(tree.core + side * 3.0_f64.sqrt() / 2.0) + offset;
            let n = n as usize;
            let m = node.moments;
            center[n] = node.center.extend(reach);
            mass[n] = m.x_axis.extend(node.mass);
            shape[n] = DVec4::new(m.y_axis.y, m.y_axis.z, m.z_axis.z, side);
            (low[n], high[n]) = (node.low.extend(0.0), node.high.extend(0.0));
        }
    }
    Ok(())
}

pub(super) fn demand(tree: &Tree, host: &Host) -> Result<(), Error> {
    let Opening::Relative { alpha, g, .. } = tree.opening else { return Ok(()) };
    let (ids, acceleration) = (host.reading::<u32>(&tree.field(TREE_ID).1)?, host.read(ACCELERATION)?);
    let field = |name| host.reading::<Vec4>(&tree.field(name).1);
    let (bodies, center) = (field(TREE_BODY)?, field(TREE_CENTER)?);
    let (mass, shape) = (field(TREE_MASS)?, field(TREE_SHAPE)?);
    let (first, nodes) = tree.level(tree.height().saturating_sub(PULLS));
    let bounds = host.world().bounds;
    let pulls = |x: DVec3| -> f64 {
        let pull = |n: usize| {
            let square = bounds.shortest(center[n].truncate() - x).length_squared() + shape[n].w * shape[n].w;
            if square > 0.0 { mass[n].w.abs() / square } else { 0.0 }
        };
        PART * g * (first as usize..(first + nodes) as usize).map(pull).sum::<f64>()
    };
    let mut demand = host.writing::<f32>(&tree.field(TREE_DEMAND).1)?;
    let groups = ids[..tree.used as usize].chunks(GROUP as usize).zip(bodies.iter().step_by(GROUP as usize));
    for (demand, (group, body)) in demand.iter_mut().zip(groups) {
        let last = group.iter().filter_map(|id| acceleration.get(*id as usize)).map(|a| a.truncate().length());
        let least = last.fold(f64::INFINITY, f64::min);
        *demand = if least > 0.0 { g / (alpha * least.max(pulls(body.truncate()))) } else { 0.0 };
    }
    Ok(())
}

/// Groups without particles that are due have negative demands.
pub(super) fn due(tree: &Tree, host: &Host) -> Result<(), Error> {
    let (ids, due) = (host.reading::<u32>(&tree.field(TREE_ID).1)?, host.read(DUE)?);
    let mut demand = host.writing::<f32>(&tree.field(TREE_DEMAND).1)?;
    for (demand, group) in demand.iter_mut().zip(ids[..tree.used as usize].chunks(GROUP as usize)) {
        if !group.iter().any(|id| due.get(*id as usize).is_some_and(|due| *due != 0)) {
            *demand = -1.0;
        } else if !tree.opening.is_relative() {
            *demand = 0.0;
        }
    }
    Ok(())
}

/// The mass, centre and moments of some bodies.
struct Node {
    mass: f64,
    center: DVec3,
    /// Σ m y yᵀ about the centre.
    moments: DMat3,
    low: DVec3,
    high: DVec3,
}

impl Node {
    fn of(bodies: &[DVec4]) -> Self {
        let places = || bodies.iter().map(|b| b.truncate());
        let low = places().reduce(DVec3::min).unwrap_or_default();
        let high = places().reduce(DVec3::max).unwrap_or_default();
        let middle = 0.5 * (low + high);
        let mass: f64 = bodies.iter().map(|b| b.w).sum();
        let pull: DVec3 = bodies.iter().map(|b| b.w * (b.truncate() - middle)).sum();
        let center = if mass == 0.0 { middle } else { middle + pull / mass };
        let moment = |b: &DVec4| {
            let y = b.truncate() - center;
            b.w * DMat3::from_cols(y * y.x, y * y.y, y * y.z)
        };
        let moments = bodies.iter().map(moment).fold(DMat3::ZERO, |a, b| a + b);
        Self { mass, center, moments, low, high }
    }
}
