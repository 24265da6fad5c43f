//! How deep a drawing is with what it refers to: groups that `use` draws again, clip paths, masks and patterns.

use std::collections::HashMap;

use usvg::roxmltree::{Document, Node, NodeId};

use super::{DEEPEST, MOST};

/// References in style sheets, at most: which elements have them is not known here.
const STYLED: usize = 2000;

/// Refuses what is deeper than [`DEEPEST`], has more elements than [`MOST`], or refers to itself.
pub fn check(parsed: &Document<'_>) -> Result<(), String> {
    let mut count = 0_u32;
    let (mut ids, mut styled) = (HashMap::new(), 0);
    let mut inside: Vec<Node<'_, '_>> = Vec::new();
    for node in parsed.descendants().filter(Node::is_element) {
        while inside.last().is_some_and(|last| Some(*last) != node.parent_element()) {
            inside.pop();
        }
        inside.push(node);
        count += 1;
        if count > MOST || inside.len() > DEEPEST {
            let line = line(parsed, node);
            return Err(if count > MOST {
                format!("it has more than {MOST} elements, up to line {line}: leave out what is no plan")
            } else {
                format!("it is nested more than {DEEPEST} deep in line {line}: take groups apart")
            });
        }
        if let Some(id) = node.attribute("id") {
            ids.entry(id).or_insert(node);
        }
        if node.tag_name().name() == "style" {
            styled += node.text().map_or(0, |text| text.matches("url(").count());
        }
    }
    if styled > STYLED {
        return Err(format!(
            "its style sheets refer to {styled} elements, and the most is {STYLED}: save it as plain SVG"
        ));
    }
    Depth { parsed, ids, heights: HashMap::new() }.height(parsed.root_element(), 0).map(|_| ())
}

struct Depth<'a, 'input> {
    parsed: &'a Document<'input>,
    ids: HashMap<&'a str, Node<'a, 'input>>,
    /// The levels below each element; `None` while they are counted.
    heights: HashMap<NodeId, Option<usize>>,
}

impl<'a, 'input> Depth<'a, 'input> {
    fn height(&mut self, node: Node<'a, 'input>, above: usize) -> Result<usize, String> {
        match self.heights.get(&node.id()) {
            Some(Some(height)) if above + height <= DEEPEST => return Ok(*height),
            Some(None) => {
                let line = line(self.parsed, node);
                return Err(format!(
                    "the element in line {line} is drawn within itself, by what it refers to: take it apart"
                ));
            }
            _ => {}
        }
        if above > DEEPEST {
            return Err(format!(
                "it is nested more than {DEEPEST} deep in line {}, with what it refers to: take groups apart",
                line(self.parsed, node)
            ));
        }
        self.heights.insert(node.id(), None);
        let mut most = 0;
        for child in node.children().filter(Node::is_element) {
            most = most.max(self.height(child, above + 1)?);
        }
        for attribute in node.attributes() {
            let value = attribute.value();
            let referred = value.split("url(").skip(1).map(|rest| rest.split(')').next().unwrap_or_default());
            let linked = (attribute.name() == "href").then_some(value);
            for target in referred.chain(linked) {
                let id = target.trim_matches(|c: char| c.is_whitespace() || matches!(c, '"' | '\'' | '#'));
                if let Some(target) = self.ids.get(id).copied() {
                    most = most.max(self.height(target, above + 1)?);
                }
            }
        }
        self.heights.insert(node.id(), Some(most + 1));
        Ok(most + 1)
    }
}

fn line(parsed: &Document<'_>, node: Node<'_, '_>) -> u32 {
    parsed.text_pos_at(node.range().start).row
}
