//! The surface of a fluid (van der Laan, Green & Sainz 2009).

use super::super::fluid::ROUNDS;
use super::super::frame::{
    COVER, CREST, DYE, Frame, LEVEL, NEXT_COVER, NEXT_DYE, NEXT_LEVEL, NEXT_THICKNESS, NONE, RIM, SOURCE, THICKNESS,
    VOLUME, WALL,
};
use super::super::scenery::Facets;
use super::particles::layers;
use crate::error::Error;
use crate::kernel::{Kernel, Plan, Threads};
use crate::primitives::fill;

/// From drops to light on their surface.
pub fn fluid(frame: &Frame, facets: &Facets, plan: &mut Plan) -> Result<(), Error> {
    plan.add(frame.simple("foam", &[crate::shader!("render/foam.wgsl")], frame.count, 1)?);
    plan.add(drops(frame)?);
    plan.add(outline(frame)?);
    plan.add(frame.simple("surface", &[crate::shader!("render/surface.wgsl")], frame.area(), 1)?);
    plan.add(smooth(frame)?);
    let files = [
        crate::shader!("render/flat.wgsl"),
        crate::shader!("render/sky.wgsl"),
        crate::shader!("render/tank_edge.wgsl"),
        crate::shader!("render/within.wgsl"),
        crate::shader!("render/water.wgsl"),
    ];
    let water = frame.simple("water", &files, frame.area(), 16 + 2 * u64::from(frame.water.edges))?;
    plan.add(facets.bind(water, frame));
    Ok(())
}

/// The nearest front in each pixel, how much there is behind it, and its particle: two dispatches over all drops.
fn drops(frame: &Frame) -> Result<Kernel, Error> {
    let mut passes = Vec::new();
    for (field, value) in [(CREST, NONE), (VOLUME, 0), (RIM, 0), (WALL, 0), (SOURCE, NONE)] {
        passes.extend(fill::passes(&field.name.into(), frame.area(), value)?);
    }
    let (threads, rows) = layers(frame);
    for file in [crate::shader!("render/drops.wgsl"), crate::shader!("render/drop_id.wgsl")] {
        let files = [crate::shader!("render/disc.wgsl"), crate::shader!("render/drop.wgsl"), file];
        let mut pass = frame.pass(&files, threads, 64)?;
        pass.constants = vec![("ROWS", f64::from(rows))];
        passes.push(pass);
    }
    if frame.water.turn == 0.0 {
        let mut pass =
            frame.pass(&[crate::shader!("render/disc.wgsl"), crate::shader!("render/wall.wgsl")], threads, 64)?;
        pass.constants = vec![("ROWS", f64::from(rows)), ("WALLS", 1.0)];
        passes.push(pass);
    }
    Ok(frame.kernel("drops", passes))
}

/// A smooth outline.
fn outline(frame: &Frame) -> Result<Kernel, Error> {
    let files = [crate::shader!("render/within.wgsl"), crate::shader!("render/cover.wgsl")];
    let covers = frame.pass(&files, Threads::new(frame.area()), 4)?;
    // As far as either outline is made smooth.
    let each = 4 * u64::from(frame.water.soft.max(frame.water.softer));
    let across = frame.pass(&[crate::shader!("render/soft.wgsl")], Threads::new(frame.area()), each)?;
    let mut down = across.clone().on(&[("cover", NEXT_COVER.name.into()), ("next_cover", COVER.name.into())]);
    down.constants = vec![("DOWN", 1.0)];
    Ok(Kernel { scratch: vec![NEXT_COVER.name.into()], ..frame.kernel("outline", vec![covers, across, down]) })
}

/// A smooth surface: twice as many dispatches as rounds.
fn smooth(frame: &Frame) -> Result<Kernel, Error> {
    let each = 4 * u64::from(frame.water.farthest);
    let across = frame.pass(&[crate::shader!("render/smooth.wgsl")], Threads::new(frame.area()), each)?;
    let mut down = across.clone().on(&[
        ("level", NEXT_LEVEL.name.into()),
        ("thickness", NEXT_THICKNESS.name.into()),
        ("dye", NEXT_DYE.name.into()),
        ("next_level", LEVEL.name.into()),
        ("next_thickness", THICKNESS.name.into()),
        ("next_dye", DYE.name.into()),
    ]);
    down.constants = vec![("DOWN", 1.0)];
    let mut passes: Vec<_> = (0..ROUNDS).flat_map(|_| [across.clone(), down.clone()]).collect();
    passes[..2].iter_mut().for_each(|pass| pass.constants.push(("FILL", 1.0)));
    let scratch = vec![NEXT_LEVEL.name.into(), NEXT_THICKNESS.name.into(), NEXT_DYE.name.into()];
    Ok(Kernel { scratch, ..frame.kernel("smooth", passes) })
}
