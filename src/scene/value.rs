//! Checks of a value against its kind.

use std::borrow::Cow;

use glam::DVec3;

use crate::settings::{Kind, Outside, SIDES, Value, is_lost};

use super::report::{Fault, Report, listed, nearest};
use super::tree::{Data, Node};
use super::{color, pairs};

/// Reads a value of this kind; errors go into the report.
pub(super) fn read(node: &Node, key: &str, kind: Kind, report: &mut Report) -> Option<Value> {
    match kind {
        Kind::Number | Kind::Positive | Kind::NotNegative | Kind::Fraction | Kind::Count | Kind::Whole => {
            number(node, key, kind, &kind.wanted(), report).map(Value::Number)
        }
        Kind::Species => match &node.data {
            Data::Text(text) if text == "all" => Some(Value::Text(Cow::Borrowed("all"))),
            _ => number(node, key, kind, &kind.wanted(), report).map(Value::Number),
        },
        Kind::Vector | Kind::Direction => vector(node, key, kind, report).map(Value::Vector),
        Kind::Choice(known) => choice(node, key, key, known, report).map(|word| Value::Text(Cow::Borrowed(word))),
        Kind::Flag => match node.data {
            Data::Flag(flag) => Some(Value::Flag(flag)),
            _ => refuse(node, key, &kind.wanted(), report),
        },
        Kind::Sides => match &node.data {
            Data::Text(text) if text.split_whitespace().all(|word| SIDES.contains(&word)) => {
                Some(Value::Text(Cow::Owned(text.clone())))
            }
            _ => refuse(node, key, &kind.wanted(), report),
        },
        // Whether such a motion, column or file exists is checked by its section.
        Kind::Motion | Kind::Column | Kind::File => match &node.data {
            Data::Text(name) => Some(Value::Text(Cow::Owned(name.clone()))),
            _ => refuse(node, key, &kind.wanted(), report),
        },
        Kind::Pairs(keys) => pairs::read(node, key, keys, report).map(Value::Pairs),
        Kind::Color => match &node.data {
            Data::Text(text) if text.is_empty() => Some(Value::Text(Cow::Borrowed(""))),
            _ => color::read(node, key, report).map(|rgb| Value::Text(Cow::Owned(color::shown(rgb)))),
        },
    }
}

/// A number of this kind; `wanted` describes the kind.
pub(super) fn number(node: &Node, key: &str, kind: Kind, wanted: &str, report: &mut Report) -> Option<f64> {
    let whole = kind.is_whole();
    let value = match node.data {
        #[expect(
            clippy::cast_precision_loss,
            reason = "the loss is checked for whole numbers, and harmless for others"
        )]
        Data::Integer(Some(i)) => i as f64,
        Data::Integer(None) => {
            report.push(Fault::at(&node.place, format!("`{key}` is too large")).label(if whole {
                "whole numbers end at 2^53".to_owned()
            } else {
                format!("write it with an exponent, as in {:e}", report.quote(&node.place).parse().unwrap_or(1e20_f64))
            }));
            return None;
        }
        Data::Float(x) if whole && x.fract() != 0.0 => return refuse(node, key, wanted, report),
        Data::Float(x) => x,
        _ => return refuse(node, key, wanted, report),
    };
    let fault = match kind.outside(value) {
        None => return Some(value),
        // A number with digits that is too large is reported as such, not as infinity.
        Some(Outside::NotFinite) if !report.quote(&node.place).chars().any(|c| c.is_ascii_digit()) => {
            Fault::at(&node.place, format!("`{key}` must be finite, not {}", node.describe(report)))
        }
        Some(Outside::NotFinite | Outside::TooLarge) => {
            let end = if whole {
                format!("it may be at most {}", kind.largest())
            } else {
                "single precision ends at 3.4e38".to_owned()
            };
            Fault::at(&node.place, format!("`{key}` is too large")).label(end)
        }
        Some(Outside::Broken | Outside::Range) => return refuse(node, key, wanted, report),
        Some(Outside::TooSmall) => {
            Fault::at(&node.place, format!("`{key}` is too small")).label("it is zero in single precision")
        }
    };
    report.push(fault);
    None
}

fn vector(node: &Node, key: &str, kind: Kind, report: &mut Report) -> Option<DVec3> {
    let Data::List(list) = &node.data else {
        return refuse(node, key, &format!("{}, as in [0, 0, 1]", kind.wanted()), report);
    };
    let before = report.len();
    let [x, y, z] = &list[..] else {
        return refuse(node, key, &format!("{}, as in [0, 0, 1]", kind.wanted()), report);
    };
    let [x, y, z] = [x, y, z].map(|n| number(n, key, Kind::Number, "three numbers", report).unwrap_or(0.0));
    let v = DVec3::new(x, y, z);
    if report.len() > before {
        return None;
    }
    if kind == Kind::Direction && v.to_array().into_iter().all(is_lost) {
        report.push(Fault::at(&node.place, format!("`{key}` must be a direction: three numbers, not all zero")));
        return None;
    }
    Some(v)
}

/// One of several words; `noun` describes them.
pub(super) fn choice<'a>(
    node: &Node,
    key: &str,
    noun: &str,
    known: &[&'a str],
    report: &mut Report,
) -> Option<&'a str> {
    let wanted =
        if let [only] = known { format!("\"{only}\"") } else { format!("one of {}", listed(known.iter().copied())) };
    let Data::Text(text) = &node.data else { return refuse(node, key, &wanted, report) };
    if let Some(word) = known.iter().find(|w| *w == text) {
        return Some(word);
    }
    let mut fault = Fault::at(&node.place, format!("unknown {noun} \"{}\"", super::report::shorten(text)));
    if let Some(near) = nearest(text, known.iter().copied()) {
        fault = fault.label(format!("did you mean \"{near}\"?"));
    }
    report.push(fault.note(format!("known: {}", listed(known.iter().copied()))));
    None
}

/// A text.
pub(super) fn text<'a>(node: &'a Node, key: &str, wanted: &str, report: &mut Report) -> Option<&'a str> {
    match &node.data {
        Data::Text(text) if !text.is_empty() => Some(text),
        _ => refuse(node, key, wanted, report),
    }
}

/// Reports a value of the wrong kind.
pub(super) fn refuse<T>(node: &Node, key: &str, wanted: &str, report: &mut Report) -> Option<T> {
    let mut fault = Fault::at(&node.place, format!("`{key}` must be {wanted}, not {}", node.describe(report)));
    if let Data::Text(text) = &node.data {
        let bare = text.trim();
        if wanted.contains("number") && bare.parse::<f64>().is_ok()
            || wanted == "true or false" && bare.parse::<bool>().is_ok()
        {
            fault = fault.label(format!("remove the quotes: {bare}"));
        }
    }
    report.push(fault);
    None
}
