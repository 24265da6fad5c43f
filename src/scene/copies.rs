//! `copies` of the particles of a file, or of listed ones: molecules.

use std::borrow::Cow;

use glam::DVec3;

use crate::kernel::Bounds;
use crate::settings::{Key, Kind, Value};
use crate::shapes::Amount;
use crate::shapes::copies::Copies;
use crate::state::State;

use super::particles::OFFSETS;
use super::report::{Fault, Report};
use super::resolved::Writer;
use super::walk::Table;

/// How particles of a file, or listed ones, are placed several times.
pub(super) const COPIES: &[Key] = &[
    Key::new("copies", Kind::Count, Value::Number(1.0), "how many times they are placed, turned at random: molecules"),
    Key::new(
        "room",
        Kind::Vector,
        Value::Vector(DVec3::ZERO),
        "copies: edges of the box about `center` in which their centres of mass lie; 0: from side to side of [box] [length]",
    ),
    Key::new(
        "arrangement",
        Kind::Choice(&["random", "lattice"]),
        Value::Text(Cow::Borrowed("random")),
        "copies: their centres are anywhere, or in the middles of equal cells",
    ),
    Key::new(
        "separation",
        Kind::NotNegative,
        Value::Number(0.0),
        "copies: the least distance of particles of two of them [length]",
    ),
    Key::new(
        "temperature",
        Kind::NotNegative,
        Value::Number(0.0),
        "copies: k T of Maxwellian velocities about the mean of those given [energy]; 0: velocities as given",
    ),
    Key::new("seed", Kind::Whole, Value::Number(1.0), "copies: seed of the random numbers"),
];

/// All copies of particles, where the entry asks for them; `room` is the most particles that there may be.
pub(super) fn read(
    table: &Table<'_>,
    particles: Option<State>,
    (room, bounds): (u32, &Bounds),
    out: &mut Writer,
    report: &mut Report,
) -> Option<State> {
    let Some(given) = table.get("copies") else {
        for given in COPIES.iter().filter_map(|key| table.get(key.name)) {
            let fault = Fault::at(&given.place, format!("`{}` has no effect without `copies`", given.key));
            report.push(fault.label("remove it, or add `copies`"));
        }
        return particles;
    };
    let (faults, place) = (report.len(), &given.node.place);
    let known = |keys: &[Key]| -> Vec<_> {
        table.entries.iter().filter(|entry| keys.iter().any(|key| key.name == entry.key)).cloned().collect()
    };
    let (own, offsets) = (known(COPIES), known(OFFSETS));
    let settings = Table { entries: &own, ..table.clone() }.settings(COPIES, &[], report);
    // What is wrong with these is in the report already.
    let offsets = Table { entries: &offsets, ..table.clone() }.settings(OFFSETS, &[], &mut Report::default());
    let particles = particles.filter(|_| report.len() == faults)?;
    let all = settings.number("copies") * particles.len() as f64;
    if all > f64::from(room) {
        report.push(Fault::at(place, format!("{all} particles are too many")).label(format!("the maximum is {room}")));
        return None;
    }
    if let Err(why) = Amount::of(all).fits() {
        report.push(Fault::at(place, why));
        return None;
    }
    let (center, edges) = (offsets.vector("center"), settings.vector("room"));
    let has_box = bounds.high != bounds.low;
    if !has_box && faults > 0 {
        // The box may be what is wrong.
        return None;
    }
    let fills = edges.abs().max_element() <= 0.0 && center != DVec3::ZERO;
    if let (Some(given), true) = (table.get("center"), fills) {
        let fault = Fault::at(&given.place, "`center` has no effect on `copies` that fill the [box]");
        report.push(fault.label("remove it, or add `room`"));
        return None;
    }
    for axis in 0..bounds.dimensions as usize {
        if edges[axis] < 0.0 || edges[axis] == 0.0 && !has_box {
            let place = table.get("room").map_or(place, |room| &room.node.place);
            let fault = Fault::at(
                place,
                format!("`copies` need `room`, and that along {} is {}", ["x", "y", "z"][axis], edges[axis]),
            );
            report.push(fault.label("three edges above 0, as in [10, 10, 10], or a [box]"));
            return None;
        }
    }
    let corner = |axis: usize, side: f64| match edges[axis] {
        _ if axis >= bounds.dimensions as usize => center[axis],
        edge if edge > 0.0 => side.mul_add(0.5 * edge, center[axis]),
        _ if side < 0.0 => bounds.low[axis],
        _ => bounds.high[axis],
    };
    let copies = Copies {
        count: u32::try_from(settings.whole("copies")).unwrap_or(u32::MAX),
        room: [-1.0, 1.0].map(|side| DVec3::new(corner(0, side), corner(1, side), corner(2, side))),
        lattice: settings.text("arrangement") == "lattice",
        separation: settings.number("separation"),
        temperature: settings.number("temperature"),
        seed: settings.whole("seed"),
    };
    out.settings(COPIES, &settings);
    match copies.of(&particles, bounds) {
        Ok(all) => Some(all),
        Err(why) => {
            report.push(Fault::at(place, why.to_string()));
            None
        }
    }
}
