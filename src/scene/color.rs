//! Colours by name or by number.

use crate::settings::Kind;

use super::report::{Fault, Report, nearest, shorten};
use super::tree::{Data, Node};

/// The sixteen basic colours of CSS, and a few for pictures of particles.
const NAMED: &[(&str, [u8; 3])] = &[
    ("black", [0x00, 0x00, 0x00]),
    ("silver", [0xc0, 0xc0, 0xc0]),
    ("gray", [0x80, 0x80, 0x80]),
    ("white", [0xff, 0xff, 0xff]),
    ("maroon", [0x80, 0x00, 0x00]),
    ("red", [0xff, 0x00, 0x00]),
    ("purple", [0x80, 0x00, 0x80]),
    ("fuchsia", [0xff, 0x00, 0xff]),
    ("green", [0x00, 0x80, 0x00]),
    ("lime", [0x00, 0xff, 0x00]),
    ("olive", [0x80, 0x80, 0x00]),
    ("yellow", [0xff, 0xff, 0x00]),
    ("navy", [0x00, 0x00, 0x80]),
    ("blue", [0x00, 0x00, 0xff]),
    ("teal", [0x00, 0x80, 0x80]),
    ("aqua", [0x00, 0xff, 0xff]),
    ("cyan", [0x00, 0xff, 0xff]),
    ("magenta", [0xff, 0x00, 0xff]),
    ("orange", [0xff, 0xa5, 0x00]),
    ("gold", [0xff, 0xd7, 0x00]),
    ("coral", [0xff, 0x7f, 0x50]),
    ("pink", [0xff, 0xc0, 0xcb]),
    ("violet", [0xee, 0x82, 0xee]),
    ("skyblue", [0x87, 0xce, 0xeb]),
];

/// Reads `"#ffcc88"`, `"#fc8"` or a name; returns red, green and blue in sRGB.
pub(super) fn read(node: &Node, key: &str, report: &mut Report) -> Option<[u8; 3]> {
    let Data::Text(text) = &node.data else { return super::value::refuse(node, key, &Kind::Color.wanted(), report) };
    let hex = known(text);
    if hex.is_none() {
        let mut fault =
            Fault::at(&node.place, format!("`{key}` must be {}, not \"{}\"", Kind::Color.wanted(), shorten(text)));
        if text.starts_with('#') {
            fault = fault.label("three or six digits, 0 to 9 and a to f");
        } else if let Some(near) = nearest(text, NAMED.iter().map(|(name, _)| *name)) {
            fault = fault.label(format!("did you mean \"{near}\"?"));
        }
        report.push(fault);
    }
    hex
}

/// The colour of this name, if there is one.
pub(super) fn known(text: &str) -> Option<[u8; 3]> {
    let named = NAMED.iter().find(|(name, _)| *name == text).map(|(_, rgb)| *rgb);
    named.or_else(|| text.strip_prefix('#').and_then(digits))
}

/// A colour as six digits.
pub(super) fn shown([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn digits(text: &str) -> Option<[u8; 3]> {
    let d: Option<Vec<u8>> = text.chars().map(|c| c.to_digit(16).and_then(|d| u8::try_from(d).ok())).collect();
    match d?[..] {
        [r, g, b] => Some([r * 17, g * 17, b * 17]),
        [r, r2, g, g2, b, b2] => Some([r * 16 + r2, g * 16 + g2, b * 16 + b2]),
        _ => None,
    }
}
