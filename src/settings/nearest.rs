//! Suggestions for misspelt names.

use std::fmt::Write as _;

/// Words as a list: `` `a`, `b`, `c` ``.
#[must_use]
pub fn listed<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    let mut out = String::new();
    for word in words {
        let separator = if out.is_empty() { "" } else { ", " };
        // Writing to a String cannot fail.
        let _ = write!(out, "{separator}`{word}`");
    }
    out
}

/// The known word that is nearest to the given one, if it is near enough.
#[must_use]
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if word.len() > 64 {
        return None;
    }
    let plain = |w: &str| w.to_lowercase().replace('-', "_");
    let written = plain(word);
    let limit = (written.chars().count() / 3).max(1);
    known
        .into_iter()
        .map(|k| {
            let extended = written.len() >= 3 && (k.starts_with(&written) || written.starts_with(k) && k.len() >= 3);
            let distance = strsim::osa_distance(&written, &plain(k));
            (if extended { distance.min(limit) } else { distance }, k)
        })
        .filter(|&(distance, _)| distance <= limit)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, k)| k)
}

/// The message for an unknown name.
#[must_use]
pub fn unknown<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.collect();
    let meant = nearest(name, known.iter().copied()).map(|near| format!(" (did you mean `{near}`?)"));
    if known.is_empty() {
        return format!("has no key `{name}`, and no other");
    }
    format!("has no key `{name}`{}; its keys are {}", meant.unwrap_or_default(), known.join(", "))
}
