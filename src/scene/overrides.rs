//! `--set key=value`: values from the command line, inserted into the tree before it is checked, so that the same checks apply.

use super::report::{Fault, Place, Report, shorten};
use super::sections::SECTIONS;
use super::tree::{self, Data, Entry, Node};

/// Keys that exclude one another: setting one from the command line removes the others of the scene.
const ALTERNATIVES: &[&[&str]] =
    &[&["steps", "until", "until_redshift"], &["file", "shape", "bodies"], &["kind", "wgsl"]];
/// The longest path; `particles.0.bodies.0.position.0` has 6 parts.
const LONGEST_PATH: usize = 8;

/// Inserts the overrides into the tree, in their order.
pub(super) fn apply(root: &mut Vec<Entry>, overrides: &[String], report: &mut Report) {
    for body in overrides {
        let text = report.add(None, body);
        if let Err(fault) = set(root, text, body, report) {
            report.push(fault);
        }
    }
}

/// One part of a path such as `particles.0.count`, with its place.
struct Part<'a> {
    word: &'a str,
    place: Place,
}

fn set(root: &mut Vec<Entry>, text: usize, body: &str, report: &Report) -> Result<(), Fault> {
    let Some((path, value)) = body.split_once('=') else {
        return Err(Fault::at(&Place { text, span: 0..body.len() }, "an override has the form key=value").note(EXAMPLE));
    };
    let path = parts(path, text)?;
    if let [only] = &path[..] {
        let homes = SECTIONS.iter().filter(|s| s.knows(only.word)).map(|s| s.path(only.word));
        let homes: Vec<_> = homes.collect();
        let fault = Fault::at(&only.place, format!("`{}` names no section", shorten(only.word)));
        return Err(if homes.is_empty() {
            fault.note(EXAMPLE)
        } else {
            fault.label(format!("write {}", homes.join(" or ")))
        });
    }
    let value = parse(value, text, body.len() - value.len())?;
    put(root, &path, "", value, report)
}

const EXAMPLE: &str = "help: for example --set simulation.dt=0.01 or --set force.0.g=2, where 0 is the first [[force]]";

fn parts(path: &str, text: usize) -> Result<Vec<Part<'_>>, Fault> {
    let mut list = Vec::new();
    let mut at = 0;
    for part in path.split('.') {
        let word = part.trim();
        let start = at + part.len() - part.trim_start().len();
        let place = Place { text, span: start..start + word.len() };
        at += part.len() + 1;
        if word.is_empty() {
            return Err(Fault::at(&place, "the name of the key is not complete").note(EXAMPLE));
        }
        list.push(Part { word, place });
        if list.len() > LONGEST_PATH {
            return Err(Fault::at(&Place { text, span: 0..path.len() }, "this key has too many dots").note(EXAMPLE));
        }
    }
    Ok(list)
}

/// A TOML value; or, if it does not begin like one, a text without its quotes.
fn parse(value: &str, text: usize, at: usize) -> Result<Node, Fault> {
    let start = at + value.len() - value.trim_start().len();
    let value = value.trim();
    let place = Place { text, span: start..start + value.len() };
    if value.is_empty() {
        return Err(Fault::at(&place, "there is no value after the `=`").note(EXAMPLE));
    }
    match tree::parse_value(text, start, value) {
        Ok(node) => Ok(node),
        Err(_) if !value.starts_with(|c: char| c.is_ascii_digit() || "\"'[{+-".contains(c)) => {
            Ok(Node { place, data: Data::Text(value.to_owned()) })
        }
        Err(why) => Err(Fault::at(&place, format!("this is not a TOML value: {why}"))
            .note("help: a number, true or false, \"text\", or a list such as [1, 0, 0]")),
    }
}

fn put(table: &mut Vec<Entry>, path: &[Part<'_>], done: &str, value: Node, report: &Report) -> Result<(), Fault> {
    let Some((first, rest)) = path.split_first() else { return Ok(()) };
    let key = first.word;
    if rest.is_empty() {
        if let Some(rivals) = ALTERNATIVES.iter().find(|a| a.contains(&key)) {
            table.retain(|e| e.place.text != 0 || !rivals.contains(&e.key.as_str()));
        }
        table.retain(|e| e.key != key);
        table.push(Entry { key: key.to_owned(), place: first.place.clone(), node: value });
        return Ok(());
    }
    let at = table.iter().position(|e| e.key == key);
    let at = match at {
        Some(at) => at,
        None if SECTIONS.iter().any(|s| s.many && s.name == key && done.is_empty()) => {
            return Err(Fault::at(&first.place, format!("the scene has no [[{key}]]"))
                .note("help: an override changes what is in the scene, and cannot add an entry to a list"));
        }
        None => {
            let node = Node { place: first.place.clone(), data: Data::Table(Vec::new()) };
            table.push(Entry { key: key.to_owned(), place: first.place.clone(), node });
            table.len() - 1
        }
    };
    descend(&mut table[at].node, rest, &join(done, key), value, report)
}

fn descend(node: &mut Node, path: &[Part<'_>], done: &str, value: Node, report: &Report) -> Result<(), Fault> {
    let Some((first, rest)) = path.split_first() else {
        *node = value;
        return Ok(());
    };
    let found = node.describe(report);
    match &mut node.data {
        Data::Table(entries) => put(entries, path, done, value, report),
        Data::List(list) => {
            let many = list.len();
            let element = first.word.parse::<usize>().map(|i| list.get_mut(i));
            match element {
                Ok(Some(element)) => descend(element, rest, &join(done, first.word), value, report),
                Ok(None) => Err(Fault::at(&first.place, format!("there is no `{}`", join(done, first.word)))
                    .label(format!("`{done}` has {many}, counted from 0"))),
                Err(_) => Err(Fault::at(&first.place, format!("`{done}` is a list, so its entries are numbered"))
                    .label(format!("write {done}.0.{} for the first", first.word))),
            }
        }
        _ => Err(Fault::at(&first.place, format!("`{done}` is {found}, not a section"))),
    }
}

fn join(done: &str, word: &str) -> String {
    if done.is_empty() { shorten(word) } else { format!("{done}.{}", shorten(word)) }
}
