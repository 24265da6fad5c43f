//! TOML as a tree in which every key and value knows its place.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};
use toml_parser::lexer::TokenKind;

use super::report::{Fault, Place, Report};

/// The longest dotted key. The parser bounds brackets (80 levels) but not dots, and a tree a million levels deep would
/// overflow the stack when it is dropped.
const LONGEST_KEY: usize = 8;
/// Above this many bytes only the first fault of syntax is looked for: each costs memory.
const RECOVERABLE: usize = 1 << 20;

/// A value with its place.
#[derive(Debug, Clone)]
pub(super) struct Node {
    pub(super) place: Place,
    pub(super) data: Data,
}

/// What a value is.
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
    /// What it is, for "…, not …".
    pub(super) fn describe(&self, report: &Report) -> String {
        let quote = || report.quote(&self.place);
        match &self.data {
            Data::Text(text) if text.is_empty() => "an empty text".to_owned(),
            Data::Text(text) => format!("the text \"{}\"", super::report::shorten(text)),
            Data::Integer(_) | Data::Float(_) | Data::Flag(_) => quote(),
            Data::Date => format!("the date {}", quote()),
            Data::List(list) if list.is_empty() => "an empty list".to_owned(),
            Data::List(list) => format!("a list of {}", list.len()),
            Data::Table(_) => "a table".to_owned(),
        }
    }
}

/// Parses a scene. What does not parse is reported; what does is in the tree.
pub(super) fn parse(text: usize, body: &str, report: &mut Report) -> Vec<Entry> {
    if let Some(span) = too_long_a_key(body) {
        report.push_syntax(
            Fault::at(&Place { text, span }, "this key has too many dots").label("no scene needs more than 3"),
        );
        return Vec::new();
    }
    let (table, faults) = if body.len() <= RECOVERABLE {
        DeTable::parse_recoverable(body)
    } else {
        match DeTable::parse(body) {
            Ok(table) => (table, Vec::new()),
            Err(fault) => (Spanned::new(0..0, DeTable::new()), vec![fault]),
        }
    };
    report_syntax(text, body, faults, report);
    entries(table.into_inner(), text, 0)
}

/// Parses one value that starts at byte `at` of the text; the error says what is wrong with it.
pub(super) fn parse_value(text: usize, at: usize, body: &str) -> Result<Node, String> {
    if too_long_a_key(body).is_some() {
        return Err("a key in it has too many dots".to_owned());
    }
    DeValue::parse(body).map(|value| node(value, text, at)).map_err(|fault| fault.message().to_owned())
}

/// Reports what the parser found, in words that say what to do.
fn report_syntax(text: usize, body: &str, faults: Vec<toml::de::Error>, report: &mut Report) {
    for fault in faults {
        let span = fault.span().unwrap_or(body.len()..body.len());
        let span_start = span.start;
        let words = body.get(span.clone()).unwrap_or("").trim_matches(['"', '\'']);
        let place = Place { text, span };
        let (message, label) = match fault.message() {
            "duplicate key" => (format!("`{}` is given twice", super::report::shorten(words)), "the second one"),
            m if m.starts_with("cannot recurse further") => {
                ("this is nested too deeply".to_owned(), "80 levels at most")
            }
            m if m.starts_with("string values must be quoted") && words.is_empty() => {
                ("the value is missing".to_owned(), "")
            }
            m if m.starts_with("string values must be quoted") => {
                (format!("text must stand in quotes: \"{}\"", super::report::shorten(words)), "")
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

/// The first dotted key with more than [`LONGEST_KEY`] parts.
fn too_long_a_key(body: &str) -> Option<Range<usize>> {
    let mut dots = 0;
    for token in toml_parser::Source::new(body).lex() {
        match token.kind() {
            TokenKind::Dot => dots += 1,
            TokenKind::Atom | TokenKind::Whitespace | TokenKind::BasicString | TokenKind::LiteralString => {}
            _ => dots = 0,
        }
        if dots > LONGEST_KEY {
            return Some(token.span().start()..token.span().end());
        }
    }
    None
}

fn entries(table: DeTable<'_>, text: usize, at: usize) -> Vec<Entry> {
    // Where a value is missing, the parser puts one without any extent in its place.
    let mut list: Vec<_> = table
        .into_iter()
        .filter(|(_, value)| !value.span().is_empty())
        .map(|(key, value)| {
            let place = place(text, at, key.span());
            Entry { key: key.into_inner().into_owned(), place, node: node(value, text, at) }
        })
        .collect();
    list.sort_by_key(|e| e.place.span.start);
    list
}

fn node(value: Spanned<DeValue<'_>>, text: usize, at: usize) -> Node {
    let place = place(text, at, value.span());
    let data = match value.into_inner() {
        DeValue::String(s) => Data::Text(s.into_owned()),
        DeValue::Integer(i) => Data::Integer(i64::from_str_radix(i.as_str(), i.radix()).ok()),
        // The grammar has been checked; what does not parse was reported as a fault of syntax.
        DeValue::Float(f) => Data::Float(f.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(b) => Data::Flag(b),
        DeValue::Datetime(_) => Data::Date,
        DeValue::Array(list) => Data::List(list.into_iter().map(|v| node(v, text, at)).collect()),
        DeValue::Table(table) => Data::Table(entries(table, text, at)),
    };
    Node { place, data }
}

fn place(text: usize, at: usize, span: Range<usize>) -> Place {
    Place { text, span: at + span.start..at + span.end }
}
