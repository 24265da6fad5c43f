//! Pictures (a stand-in until the real ones land).

use crate::settings::{Key, Kind, Value};

/// What [picture] may say.
pub const KEYS: &[Key] = &[Key::new("width", Kind::Count, Value::Number(1024.0), "pixels")];
