//! TOML as a tree in which every key and value has its place in the text.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::report::{Fault, Place, Report};

/// The maximum nesting. The parser limits brackets and the dots of a key to 80 each, which together allow thousands.
const LEVELS: usize = 16;
const TOO_DEEP: (&str, &str) = ("this is nested too deeply", "no scene needs more than 6 levels");
/// In texts with more bytes than this only the first syntax error is reported: each costs memory.
const RECOVERABLE: usize = 1 << 20;

/// A value with its place.
#[derive(Debug, Clone)]
pub(super) struct Node {
    pub(super) place: Place,
    pub(super) data: Data,
}

/// The data of a value.
#[derive(Debug, Clone)]
pub(super) enum Data {
    Text(String),
    /// `None`: more digits than fit 64 bits.
    Integer(Option<i64>),
    Float(f64),
    Flag(bool),
    Date,
    List(Vec<Node>),
    Table(Vec<Entry>),
}

/// A key with its place, and its value.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub(super) key: String,
    pub(super) place: Place,
    pub(super) node: Node,
}

impl Node {
    /// A description of the value, for "…, not …".
    pub(super) fn describe(&self, report: &Report) -> String {
        let quote = || report.quote(&self.place);
        match &self.data {
            Data::Text(text) if text.is_empty() => "an empty text".to_owned(),
            Data::Text(text) => format!("the text \"{}\"", super::report::shorten(text)),
            Data::Integer(_) | Data::Float(_) | Data::Flag(_) => quote(),
            Data::Date => format!("the date {}", quote()),
            Data::List(list) if list.is_empty() => "an empty list".to_owned(),
            Data::List(list) => format!("a list of length {}", list.len()),
            Data::Table(_) => "a table".to_owned(),
        }
    }
}

/// Parses a scene. Invalid parts are reported; valid ones are in the tree.
pub(super) fn parse(text: usize, body: &str, report: &mut Report) -> Vec<Entry> {
    let (table, faults) = if body.len() <= RECOVERABLE {
        DeTable::parse_recoverable(body)
    } else {
        match DeTable::parse(body) {
            Ok(table) => (table, Vec::new()),
            Err(fault) => (Spanned::new(0..0, DeTable::new()), vec![fault]),
        }
    };
    report_syntax(text, body, faults, report);
    let mut planter = Planter { text, at: 0, too_deep: None };
    let entries = planter.entries(table.into_inner(), LEVELS);
    if let Some(place) = planter.too_deep {
        report.push_syntax(Fault::at(&place, TOO_DEEP.0).label(TOO_DEEP.1));
    }
    entries
}

/// Parses one value that starts at byte `at` of the text; the error describes its fault.
pub(super) fn parse_value(text: usize, at: usize, body: &str) -> Result<Node, String> {
    let value = DeValue::parse(body).map_err(|fault| fault.message().to_owned())?;
    let mut planter = Planter { text, at, too_deep: None };
    let node = planter.node(value, LEVELS);
    if planter.too_deep.is_some() { Err(TOO_DEEP.0.to_owned()) } else { Ok(node) }
}

/// Reports the errors of the parser, with advice.
fn report_syntax(text: usize, body: &str, faults: Vec<toml::de::Error>, report: &mut Report) {
    for fault in faults {
        // The parser gives no position where a key has too many dots.
        let span = fault.span().unwrap_or(Place::end().span);
        let span_start = span.start;
        let words = body.get(span.clone()).unwrap_or("").trim_matches(['"', '\'']);
        let place = Place { text, span };
        let (message, label) = match fault.message() {
            "duplicate key" => (format!("`{}` is given twice", super::report::shorten(words)), "remove one of them"),
            m if m.starts_with("cannot recurse further") || m.starts_with("recursion limit") => {
                (TOO_DEEP.0.to_owned(), TOO_DEEP.1)
            }
            m if m.starts_with("string values must be quoted") && words.is_empty() => {
                ("the value is missing".to_owned(), "")
            }
            m if m.starts_with("string values must be quoted") => {
                (format!("text must be in quotes: \"{}\"", super::report::shorten(words)), "")
            }
            "invalid basic string, expected `\"`" | "invalid literal string, expected `'`" => {
                ("this text has no closing quote".to_owned(), "")
            }
            _ if is_decimal_comma(body, span_start) => {
                ("a number has a point, not a comma".to_owned(), "write a point")
            }
            m => (format!("this is not TOML: {m}"), ""),
        };
        report.push_syntax(Fault::at(&place, message).label(label));
    }
}

fn is_decimal_comma(body: &str, at: usize) -> bool {
    let digit = |at: Option<usize>| at.and_then(|at| body.as_bytes().get(at)).is_some_and(u8::is_ascii_digit);
    body.as_bytes().get(at) == Some(&b',') && digit(at.checked_sub(1)) && digit(at.checked_add(1))
}

/// Drops a value level by level: as a whole it is dropped by calls that nest as deeply as it does, for which stacks have no room.
fn take_apart(value: DeValue<'_>) {
    let mut rest = vec![value];
    while let Some(value) = rest.pop() {
        match value {
            DeValue::Array(list) => rest.extend(list.into_iter().map(Spanned::into_inner)),
            DeValue::Table(table) => rest.extend(table.into_iter().map(|(_, value)| value.into_inner())),
            _ => {}
        }
    }
}

/// Builds the tree of a text whose part from byte `at` on was parsed.
struct Planter {
    text: usize,
    at: usize,
    /// The first value beyond [`LEVELS`].
    too_deep: Option<Place>,
}

impl Planter {
    fn entries(&mut self, table: DeTable<'_>, levels: usize) -> Vec<Entry> {
        // Where a value is missing, the parser inserts one with an empty span.
        let given = table.into_iter().filter(|(_, value)| !value.span().is_empty());
        let mut list: Vec<_> = given
            .map(|(key, value)| {
                let place = self.place(key.span());
                Entry { key: key.into_inner().into_owned(), place, node: self.node(value, levels) }
            })
            .collect();
        list.sort_by_key(|e| e.place.span.start);
        list
    }

    fn node(&mut self, value: Spanned<DeValue<'_>>, levels: usize) -> Node {
        let place = self.place(value.span());
        let data = match value.into_inner() {
            DeValue::String(s) => Data::Text(s.into_owned()),
            DeValue::Integer(i) => Data::Integer(i64::from_str_radix(i.as_str(), i.radix()).ok()),
            // The grammar has been checked; invalid numbers were reported as syntax errors.
            DeValue::Float(f) => Data::Float(f.as_str().parse().unwrap_or(f64::NAN)),
            DeValue::Boolean(b) => Data::Flag(b),
            DeValue::Datetime(_) => Data::Date,
            deep @ (DeValue::Array(_) | DeValue::Table(_)) if levels == 0 => {
                self.too_deep.get_or_insert_with(|| place.clone());
                take_apart(deep);
                Data::List(Vec::new())
            }
            DeValue::Array(list) => Data::List(list.into_iter().map(|v| self.node(v, levels - 1)).collect()),
            DeValue::Table(table) => Data::Table(self.entries(table, levels - 1)),
        };
        Node { place, data }
    }

    fn place(&self, span: Range<usize>) -> Place {
        Place { text: self.text, span: self.at + span.start..self.at + span.end }
    }
}
