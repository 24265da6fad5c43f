//! Passes for cloth, lines and obstacles.

use glam::Vec4;

use super::super::frame::{Frame, HOLDER, LIT, LIT_VERTEX, NEAREST, NONE, VERTEX};
use super::super::light::from_lamp;
use super::super::scenery::Facets;
use crate::error::Error;
use crate::kernel::{Field, Kernel, Pass, Plan, Source, Threads};
use crate::primitives::fill;

/// Iterations of one invocation's loops in one layer, at most: half of the 65 535 that lavapipe allows.
const TURNS: u32 = 1 << 15;

/// The fields that facets are read from and written to.
#[derive(Clone, Copy)]
struct Fields {
    vertex: Field<Vec4>,
    nearest: Field<u32>,
    /// The facet of each sample, where it is needed.
    holder: Option<Field<u32>>,
}

/// Hides particles that a surface or a line represents.
pub fn hide(frame: &Frame, facets: &Facets) -> Result<Kernel, Error> {
    let kernel = frame.simple("hidden", &[crate::shader!("render/hidden.wgsl")], frame.count, 1)?;
    Ok(facets.bind(kernel, frame))
}

/// Surfaces, lines and obstacles, drawn before particles.
pub fn surfaces(frame: &Frame, facets: &Facets, plan: &mut Plan) -> Result<(), Error> {
    let lamp = from_lamp(frame);
    let mut add = |kernel: Kernel| plan.add(facets.bind(kernel, frame));
    if frame.facets > 0 {
        add(frame.simple("broken facets", &[crate::shader!("render/broken_facets.wgsl")], frame.facets, 3)?);
        add(vertices("vertex", frame, VERTEX)?);
        add(vertices("vertex of the lamp", &lamp, LIT_VERTEX)?);
    }
    add(raster("raster", frame, Fields { vertex: VERTEX, nearest: NEAREST, holder: Some(HOLDER) })?);
    add(raster("raster of the lamp", &lamp, Fields { vertex: LIT_VERTEX, nearest: LIT, holder: None })?);
    let files = [
        crate::shader!("render/flat.wgsl"),
        crate::shader!("render/facet.wgsl"),
        crate::shader!("render/solid.wgsl"),
        crate::shader!("render/light.wgsl"),
        crate::shader!("render/shade.wgsl"),
    ];
    let each = u64::from(frame.fine * frame.fine) * u64::from(8 + 4 * frame.solids);
    add(frame.simple("shade", &files, frame.area(), each)?);
    Ok(())
}

/// The projected vertices of facets in a frame.
fn vertices(name: &str, frame: &Frame, to: Field<Vec4>) -> Result<Kernel, Error> {
    let files = [crate::shader!("render/flat.wgsl"), crate::shader!("render/vertex.wgsl")];
    let pass = frame.pass(&files, Threads::new(frame.count), 8)?.on(&[("vertex", to.name.into())]);
    Ok(frame.kernel(name, vec![pass]))
}

/// Clears samples, then finds the nearest triangles and lines, and their facets.
fn raster(name: &str, frame: &Frame, fields: Fields) -> Result<Kernel, Error> {
    let samples = frame.samples();
    let mut passes = fill::passes(&fields.nearest.name.into(), samples, NONE)?;
    passes.extend(sweep(frame, crate::shader!("render/facet_depth.wgsl"), fields)?);
    if let Some(holder) = fields.holder {
        passes.extend(fill::passes(&holder.name.into(), samples, NONE)?);
        passes.extend(sweep(frame, crate::shader!("render/facet_id.wgsl"), fields)?);
    }
    Ok(frame.kernel(name, passes))
}

/// A dispatch over triangles and one over lines, in as many layers as the largest facet may need.
fn sweep(frame: &Frame, file: Source, fields: Fields) -> Result<Vec<Pass>, Error> {
    let files = [
        crate::shader!("render/flat.wgsl"),
        crate::shader!("render/facet.wgsl"),
        crate::shader!("render/samples.wgsl"),
        file,
    ];
    let (columns, rows) = (frame.width * frame.fine, frame.height * frame.fine);
    let fine = f64::from(frame.fine);
    // Twice its width along the longest line, and one iteration at the ends of each row besides one for the row.
    let longest = f64::from(columns).hypot(f64::from(rows)) + 2.0 * frame.thread * fine;
    let line = 2.0 * frame.thread * fine * longest + 4.0 * f64::from(rows);
    let mut passes = Vec::new();
    for (first, end, turns) in
        [(0, frame.triangles, f64::from(columns) * f64::from(rows)), (frame.triangles, frame.facets, line)]
    {
        if first == end {
            continue;
        }
        // One iteration for each row, besides one for each sample in it.
        let band = if turns <= f64::from(TURNS) { rows } else { (TURNS / (columns + 1)).max(1) };
        let threads = Threads { count: end - first, layers: rows.div_ceil(band) };
        let mut pass = frame.pass(&files, threads, 64)?;
        pass.constants = vec![("FIRST", f64::from(first)), ("END", f64::from(end)), ("ROWS", f64::from(band))];
        pass = pass.on(&[("vertex", fields.vertex.name.into()), ("nearest", fields.nearest.name.into())]);
        if let Some(holder) = fields.holder {
            pass = pass.on(&[("holder", holder.name.into())]);
        }
        passes.push(pass);
    }
    Ok(passes)
}
