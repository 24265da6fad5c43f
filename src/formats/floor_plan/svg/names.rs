//! What names say of shapes. A shape is what the nearest name of it or of a group around it says, in its `id`, `class`, `data-name`, or as the label of a layer in
//! Inkscape. The tree that is drawn knows ids alone, so that shapes without one get one.

use std::collections::{BTreeMap, HashMap, HashSet};

use usvg::roxmltree::{Document, Node};

use super::super::layer::Layer;

const SVG: &str = "http://www.w3.org/2000/svg";
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
/// Shapes, and what draws them again.
const SHAPES: [&str; 8] = ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "use"];
/// Elements that draw nothing of their own.
const SILENT: [&str; 26] = [
    "svg",
    "g",
    "a",
    "defs",
    "symbol",
    "clipPath",
    "mask",
    "marker",
    "style",
    "linearGradient",
    "radialGradient",
    "stop",
    "pattern",
    "title",
    "desc",
    "metadata",
    "switch",
    "view",
    "script",
    "animate",
    "animateMotion",
    "animateTransform",
    "set",
    "cursor",
    "color-profile",
    "filter",
];

/// What is known of a named shape.
#[derive(Debug, Clone)]
pub struct Named {
    pub layer: Layer,
    /// The name itself, for an exit.
    pub name: Option<String>,
    /// The line of the element.
    pub line: u32,
}

/// What a name says.
#[derive(Debug, Clone)]
struct Said {
    layer: Layer,
    name: Option<String>,
}

/// An id that is added to an element.
struct Edit {
    at: usize,
    id: String,
}

/// The names of a drawing.
#[derive(Default)]
pub struct Names {
    /// By ids.
    pub shapes: HashMap<String, Named>,
    /// Elements that draw something that is not understood, by their names.
    pub others: BTreeMap<String, usize>,
    edits: Vec<Edit>,
}

impl Names {
    pub fn of(parsed: &Document<'_>) -> Self {
        let mut names = Self::default();
        let text = parsed.input_text();
        let used: HashSet<&str> = parsed.descendants().filter_map(|node| node.attribute("id")).collect();
        let fresh = |number: usize| {
            (0..=used.len()).map(|k| format!("shape-{number}-{k}")).find(|id| !used.contains(id.as_str()))
        };
        let mut edited = HashSet::new();
        // Of each element around the present one, what it is.
        let mut around: Vec<(Node<'_, '_>, Option<Said>)> = Vec::new();
        for node in parsed.descendants().filter(Node::is_element) {
            let line = || parsed.text_pos_at(node.range().start).row;
            while around.last().is_some_and(|(last, _)| Some(*last) != node.parent_element()) {
                around.pop();
            }
            let own = said(&node);
            let said = own.or_else(|| around.last().and_then(|(_, said)| said.clone()));
            around.push((node, said.clone()));
            let tag = node.tag_name();
            if tag.namespace().is_none_or(|space| space == SVG) {
                let is_shape = SHAPES.contains(&tag.name());
                // Parts of text and of filters are counted with them.
                let is_part = ["tspan", "textPath", "tref"].contains(&tag.name()) || tag.name().starts_with("fe");
                if !is_shape && !is_part && !SILENT.contains(&tag.name()) {
                    *names.others.entry(tag.name().to_owned()).or_default() += 1;
                }
                let Some(Said { layer, name }) = said.filter(|_| is_shape) else { continue };
                let name = title(&node).filter(|_| layer == Layer::Exits).or(name);
                let id = if let Some(id) = node.attribute("id") {
                    id.to_owned()
                } else {
                    let Some(id) = fresh(names.edits.len()) else { continue };
                    // After the name of the element; entities may stand for the same text several times.
                    let start = node.range().start;
                    let open = text[start..].find(|c: char| c.is_whitespace() || matches!(c, '/' | '>'));
                    let Some(at) = open.map(|length| start + length).filter(|at| edited.insert(*at)) else { continue };
                    names.edits.push(Edit { at, id: id.clone() });
                    id
                };
                names.shapes.entry(id).or_insert(Named { layer, name, line: line() });
            }
        }
        names
    }
    /// Whether shapes are named so.
    pub fn has(&self, layer: Layer) -> bool {
        self.shapes.values().any(|named| named.layer == layer)
    }
    /// The text with the ids that were added.
    pub fn edited(&self, text: &str) -> String {
        let mut edits: Vec<&Edit> = self.edits.iter().collect();
        edits.sort_by_key(|edit| edit.at);
        let mut out = String::with_capacity(text.len() + 24 * edits.len());
        let mut from = 0;
        for Edit { at, id } in edits {
            out.push_str(&text[from..*at]);
            out.push_str(&format!(" id=\"{id}\""));
            from = *at;
        }
        out.push_str(&text[from..]);
        out
    }
}

/// What an element itself says, and the name of an exit.
fn said(node: &Node<'_, '_>) -> Option<Said> {
    let label = node.attribute((INKSCAPE, "label"));
    let given = [label, node.attribute("id"), node.attribute("data-name")].into_iter().flatten();
    let classes = node.attribute("class").unwrap_or_default().split_ascii_whitespace();
    let (layer, name) = given.chain(classes).find_map(|name| Layer::of(name).map(|layer| (layer, name)))?;
    // `exits` and `exit_2` are no names that people read.
    let is_plain = name.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty()).count() < 2;
    Some(Said { layer, name: (layer == Layer::Exits && !is_plain).then(|| name.trim().to_owned()) })
}

/// The title of an element, for an exit.
fn title(node: &Node<'_, '_>) -> Option<String> {
    let title = node.children().find(|child| child.tag_name().name() == "title").and_then(|title| title.text());
    title.map(|title| title.trim().to_owned()).filter(|title| !title.is_empty())
}
