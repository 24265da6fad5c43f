//! Facets at the samples of a picture: the nearest, and its facet.

use glam::{DVec2, DVec3, DVec4, Vec4};

use super::frame::{FACET, Frame, NONE, TORN, key, whole};
use super::scenery::Facets;
use crate::error::Error;
use crate::kernel::{Field, Host, Kernel, Pass, Source, Threads};
use crate::primitives::fill;

/// Turns of one invocation's loops in one layer, at most: half of the 65 535 that lavapipe allows.
const TURNS: u32 = 1 << 15;
const SLACK: f64 = 1e-4;
const SLIVER: f64 = 1e-6;
const SAME: u32 = 64;

/// Where facets come from and go to.
#[derive(Clone, Copy)]
pub struct Fields {
    pub vertex: Field<Vec4>,
    pub nearest: Field<u32>,
    /// The facet of each sample, where it is needed.
    pub holder: Option<Field<u32>>,
}

/// A facet in the picture.
#[derive(Debug, Clone, Copy)]
pub struct Facet {
    pub ids: [usize; 3],
    pub line: bool,
    pub corners: [DVec4; 3],
}

impl Facet {
    pub fn of(facet: &[u32], vertex: &[DVec4], i: usize) -> Self {
        let words = &facet[3 * i..3 * i + 3];
        let line = words[2] == NONE;
        let ids = [words[0], words[1], if line { words[1] } else { words[2] }].map(|id| id as usize);
        Self { ids, line, corners: ids.map(|id| vertex[2 * id]) }
    }
    pub fn places(&self) -> [DVec2; 3] {
        self.corners.map(|c| c.truncate().truncate())
    }
    /// Parts of the corners, and how far inside a place is.
    pub fn parts(&self, thread: f64, p: DVec2) -> DVec4 {
        let [a, b, c] = self.places().map(|corner| corner - p);
        if self.line {
            let way = b - a;
            let s = (-a.dot(way) / way.length_squared().max(SLIVER)).clamp(0.0, 1.0);
            return DVec4::new(1.0 - s, s, 0.0, thread - (a + s * way).length());
        }
        let area = (b - a).perp_dot(c - a);
        if area.abs() < SLIVER {
            return DVec4::NEG_ONE;
        }
        let w = DVec3::new(b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)) / area;
        w.extend(w.min_element() + SLACK)
    }
    pub fn depth(&self, frame: &Frame, w: DVec4) -> f64 {
        let [a, b, c] = self.corners.map(|corner| corner.z);
        let bulge = if self.line { frame.thread / frame.scale() } else { 0.0 };
        frame.flat_depth(w.truncate().dot(DVec3::new(a, b, c))) - bulge
    }
}

/// The kernel: blank samples, the nearest of triangles and lines, and their facets.
pub fn kernel(name: &str, frame: &Frame, facets: &Facets, fields: Fields) -> Result<Kernel, Error> {
    let samples = frame.samples();
    let mut passes = fill::passes(&fields.nearest.name.into(), samples, NONE)?;
    passes.extend(sweep(frame, crate::shader!("render/facet_cover.wgsl"), fields)?);
    if let Some(holder) = fields.holder {
        passes.extend(fill::passes(&holder.name.into(), samples, NONE)?);
        passes.extend(sweep(frame, crate::shader!("render/facet_claim.wgsl"), fields)?);
    }
    let on = *frame;
    let reference = move |host: &Host| {
        let mut nearest = host.write(fields.nearest)?;
        nearest.fill(NONE);
        let mut holder = fields.holder.map(|holder| host.write(holder)).transpose()?;
        if let Some(holder) = &mut holder {
            holder.fill(NONE);
        }
        if on.facets == 0 {
            return Ok(());
        }
        let (facet, torn, vertex) = (host.read(FACET)?, host.read(TORN)?, host.read(fields.vertex)?);
        let drawn = |i: &u32| torn[*i as usize] == 0;
        let each = |draw: &mut dyn FnMut(u32, usize, u32)| {
            for i in (0..on.facets).filter(drawn) {
                let f = Facet::of(&facet, &vertex, i as usize);
                if f.corners.iter().all(|c| c.w > 0.0) {
                    touched(&on, &f, |at, depth| draw(i, at, key(depth)));
                }
            }
        };
        each(&mut |_, at, depth| nearest[at] = nearest[at].min(depth));
        if let Some(holder) = &mut holder {
            each(&mut |i, at, depth| {
                if depth - nearest[at] <= SAME {
                    holder[at] = holder[at].min(i);
                }
            });
        }
        Ok(())
    };
    Ok(facets.bind(frame.kernel(name, passes, reference), frame))
}

/// A dispatch over triangles and one over lines, in as many layers as the largest that there may be needs.
fn sweep(frame: &Frame, file: Source, fields: Fields) -> Result<Vec<Pass>, Error> {
    let files = [
        crate::shader!("render/flat.wgsl"),
        crate::shader!("render/facet.wgsl"),
        crate::shader!("render/samples.wgsl"),
        file,
    ];
    let (columns, rows) = (frame.width * frame.fine, frame.height * frame.fine);
    let fine = f64::from(frame.fine);
    // Twice its width along the longest line, and a turn at the ends of each row beside one for the row.
    let longest = f64::from(columns).hypot(f64::from(rows)) + 2.0 * frame.thread * fine;
    let line = 2.0 * frame.thread * fine * longest + 4.0 * f64::from(rows);
    let mut passes = Vec::new();
    for (first, end, turns) in
        [(0, frame.triangles, f64::from(columns) * f64::from(rows)), (frame.triangles, frame.facets, line)]
    {
        if first == end {
            continue;
        }
        // A turn for each row, besides one for each sample in it.
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

/// Every sample of a facet. The device looks at fewer of those that a line passes.
fn touched(frame: &Frame, f: &Facet, mut draw: impl FnMut(usize, f64)) {
    let fine = f64::from(frame.fine);
    let [a, b, c] = f.places();
    let reach = if f.line { frame.thread } else { 0.0 };
    let size = fine * frame.size();
    let low = ((a.min(b).min(c) - reach) * fine).floor().clamp(DVec2::ZERO, size);
    let high = ((a.max(b).max(c) + reach) * fine).ceil().clamp(DVec2::ZERO, size);
    for y in whole(low.y)..whole(high.y) {
        for x in whole(low.x)..whole(high.x) {
            let w = f.parts(frame.thread, super::frame::middle(x, y) / fine);
            if w.w >= 0.0 {
                draw(y as usize * (frame.width * frame.fine) as usize + x as usize, f.depth(frame, w));
            }
        }
    }
}
