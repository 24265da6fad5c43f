//! Floor plans as SVG, drawn as a picture: dark strokes and areas are walls, coloured ones are exits, and light ones cover what is below. Names of elements and of
//! groups say more (see [`names`]). Coordinates of the plan are metres from the lower left corner of the drawing.

mod depth;
mod names;
mod paint;
mod path;
mod size;

use std::collections::BTreeMap;

use usvg::roxmltree::{Document, ParsingOptions};

use super::Plan;
use super::canvas::{Canvas, Ink};
use super::layer::Layer;
use super::measure::Measure;
use names::Names;
use paint::Painter;

/// Elements, at most.
const MOST: u32 = 500_000;
/// Elements within each other, with what they refer to.
const DEEPEST: usize = 200;
/// The stack for that \[bytes\].
#[cfg(not(target_arch = "wasm32"))]
const STACK: usize = 1 << 26;
/// What entities of a DTD may add up to \[bytes\].
const LONGEST: usize = 1 << 26;
/// Markers are arrowheads and the like, and no walls.
const STYLE: &str =
    "*{marker-start:none !important;marker-mid:none !important;marker-end:none !important;filter:none !important}";

/// Reads a plan.
///
/// # Errors
/// A sentence, with the line where there is one: what is no SVG, has no size or no scale, is nested too deeply, or has no exit.
pub fn read(text: &str, measure: &Measure) -> Result<Plan, String> {
    // Parsers and trees call themselves for what is nested.
    #[cfg(not(target_arch = "wasm32"))]
    return std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, || on_stack(text, measure));
        let thread = thread.map_err(|why| format!("no thread can be started to read it ({why})"))?;
        thread.join().unwrap_or_else(|_| Err("its reader failed: save it as plain SVG".to_owned()))
    });
    #[cfg(target_arch = "wasm32")]
    return on_stack(text, measure);
}

fn on_stack(text: &str, measure: &Measure) -> Result<Plan, String> {
    entities_fit(text)?;
    let parsed = parsed(text)?;
    let root = parsed.root_element();
    if root.tag_name().name() != "svg" {
        let name = super::super::shortened(root.tag_name().name());
        return Err(format!("its first element is <{name}>, and that of an SVG is <svg>"));
    }
    depth::check(&parsed)?;
    let names = Names::of(&parsed);
    let written = size::Written::of(&root)?;
    drop(parsed);
    let text = names.edited(text);
    let options = usvg::Options {
        style_sheet: Some(STYLE.to_owned()),
        image_href_resolver: usvg::ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..usvg::Options::default()
    };
    let tree =
        usvg::Tree::from_xmltree(&self::parsed(&text)?, &options).map_err(|why| format!("it is no SVG ({why})"))?;
    let size = size::Size::of(&tree, &written, measure)?;
    let background = if names.has(Layer::Floor) { Ink::Wall } else { Ink::Open };
    let canvas = Canvas::over(glam::DVec2::ZERO, size.metres, measure, background)?;
    let mut painter = Painter::new(canvas, &names, size.per_pixel, &tree);
    painter.draw(&tree)?;
    let (canvas, mut remarks) = painter.done();
    remarks.extend(size.remark);
    let mut plan = canvas.plan()?;
    plan.remarks.extend(remarks);
    Ok(plan)
}

fn parsed(text: &str) -> Result<Document<'_>, String> {
    let options = ParsingOptions { allow_dtd: true, nodes_limit: 4 * MOST, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|why| format!("it is no SVG, or damaged ({why})"))
}

/// Refuses entities that may become larger than memory: those of each other, and long ones.
fn entities_fit(text: &str) -> Result<(), String> {
    let Some(start) = text.find("<!DOCTYPE") else { return Ok(()) };
    let dtd = &text[start..];
    let dtd = &dtd[..dtd.find("]>").or_else(|| dtd.find('>')).unwrap_or(dtd.len())];
    if !dtd.contains("<!ENTITY") {
        return Ok(());
    }
    let uses = text.bytes().filter(|byte| *byte == b'&').count();
    if dtd.contains('&') || uses.saturating_mul(dtd.len()) > LONGEST {
        return Err(format!(
            "its DTD has entities of entities, or {uses} uses of {} bytes: save it without a DTD, as plain SVG",
            dtd.len()
        ));
    }
    Ok(())
}

/// Numbers of things, as "3 text, 1 image".
fn listed(all: &BTreeMap<String, usize>) -> String {
    all.iter().map(|(name, count)| format!("{count} {name}")).collect::<Vec<_>>().join(", ")
}
