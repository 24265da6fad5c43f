//! One value against its kind.

use std::borrow::Cow;

use glam::DVec3;

use crate::settings::{Kind, SIDES, Value};

use super::report::{Fault, Report, listed, nearest};
use super::tree::{Data, Node};
use super::{color, pairs};

/// Above this whole numbers are no longer exact in f64.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// What a kind wants, for "… must be …".
pub(super) fn wanted(kind: Kind) -> String {
    match kind {
        Kind::Number => "a number".to_owned(),
        Kind::Positive => "a number above zero".to_owned(),
        Kind::NotNegative => "a number, zero or above".to_owned(),
        Kind::Fraction => "a number above zero, 1 at most".to_owned(),
        Kind::Count => "a whole number, one or above".to_owned(),
        Kind::Whole => "a whole number, zero or above".to_owned(),
        Kind::Species => "a whole number, zero or above, or \"all\"".to_owned(),
        Kind::Vector => "three numbers".to_owned(),
        Kind::Direction => "three numbers, not all zero".to_owned(),
        Kind::Choice([only]) => format!("\"{only}\""),
        Kind::Choice(known) => format!("one of {}", listed(known.iter().copied())),
        Kind::Flag => "true or false".to_owned(),
        Kind::Motion => "the name of a motion".to_owned(),
        Kind::File => "the name of a file".to_owned(),
        Kind::Sides => format!("some of {}, with blanks between them", listed(SIDES.iter().copied())),
        Kind::Color => color::WANTED.to_owned(),
        Kind::Pairs(_) => pairs::WANTED.to_owned(),
    }
}

/// Reads a value of this kind; what is wrong goes into the report.
pub(super) fn read(node: &Node, key: &str, kind: Kind, report: &mut Report) -> Option<Value> {
    match kind {
        Kind::Number | Kind::Positive | Kind::NotNegative | Kind::Fraction | Kind::Count | Kind::Whole => {
            number(node, key, kind, &wanted(kind), report).map(Value::Number)
        }
        Kind::Species => match &node.data {
            Data::Text(text) if text == "all" => Some(Value::Text(Cow::Borrowed("all"))),
            _ => number(node, key, kind, &wanted(kind), report).map(Value::Number),
        },
        Kind::Vector | Kind::Direction => vector(node, key, kind, report).map(Value::Vector),
        Kind::Choice(known) => choice(node, key, key, known, report).map(|word| Value::Text(Cow::Borrowed(word))),
        Kind::Flag => match node.data {
            Data::Flag(flag) => Some(Value::Flag(flag)),
            _ => refuse(node, key, &wanted(kind), report),
        },
        Kind::Sides => match &node.data {
            Data::Text(text) if text.split_whitespace().all(|word| SIDES.contains(&word)) => {
                Some(Value::Text(Cow::Owned(text.clone())))
            }
            _ => refuse(node, key, &wanted(kind), report),
        },
        // Whether there is a motion or a file of that name, the section says that knows them.
        Kind::Motion | Kind::File => match &node.data {
            Data::Text(name) => Some(Value::Text(Cow::Owned(name.clone()))),
            _ => refuse(node, key, &wanted(kind), report),
        },
        Kind::Pairs(keys) => pairs::read(node, key, keys, report).map(Value::Pairs),
        Kind::Color => match &node.data {
            Data::Text(text) if text.is_empty() => Some(Value::Text(Cow::Borrowed(""))),
            _ => color::read(node, key, report).map(|rgb| Value::Text(Cow::Owned(color::shown(rgb)))),
        },
    }
}

/// A number of this kind; `wanted` says it in words.
pub(super) fn number(node: &Node, key: &str, kind: Kind, wanted: &str, report: &mut Report) -> Option<f64> {
    let whole = matches!(kind, Kind::Count | Kind::Whole | Kind::Species);
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
    let largest = match kind {
        Kind::Count => f64::from(u32::MAX),
        Kind::Whole => LARGEST_WHOLE,
        // The last one stands for all.
        Kind::Species => f64::from(u32::MAX - 1),
        _ => f64::from(f32::MAX),
    };
    let low = match kind {
        Kind::Positive => value <= 0.0,
        Kind::Fraction => value <= 0.0 || value > 1.0,
        Kind::NotNegative | Kind::Whole | Kind::Species => value < 0.0,
        Kind::Count => value < 1.0,
        _ => false,
    };
    if !value.is_finite() && !report.quote(&node.place).chars().any(|c| c.is_ascii_digit()) {
        report.push(Fault::at(&node.place, format!("`{key}` must be finite, not {}", node.describe(report))));
    } else if low {
        return refuse(node, key, wanted, report);
    } else if value.abs() > largest {
        let end =
            if whole { format!("it may be at most {largest}") } else { "single precision ends at 3.4e38".to_owned() };
        report.push(Fault::at(&node.place, format!("`{key}` is too large")).label(end));
    } else if is_lost(value) && (matches!(kind, Kind::Positive | Kind::Fraction) || value != 0.0) {
        report.push(Fault::at(&node.place, format!("`{key}` is too small")).label("it is zero in single precision"));
    } else {
        return Some(value);
    }
    None
}

/// Whether a number that is not zero becomes zero in single precision, subnormal numbers being flushed as GPUs may do.
fn is_lost(value: f64) -> bool {
    value.abs() < f64::from(f32::MIN_POSITIVE)
}

fn vector(node: &Node, key: &str, kind: Kind, report: &mut Report) -> Option<DVec3> {
    let Data::List(list) = &node.data else {
        return refuse(node, key, &format!("{}, as in [0, 0, 1]", wanted(kind)), report);
    };
    let before = report.len();
    let [x, y, z] = &list[..] else {
        return refuse(node, key, &format!("{}, as in [0, 0, 1]", wanted(kind)), report);
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

/// One of some words; `noun` is what they name.
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

/// Reports that a value is not what is wanted.
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
