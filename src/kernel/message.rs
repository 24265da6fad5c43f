//! naga's messages, mapped back to the file and line that they come from.

use std::error::Error as _;

use naga::front::wgsl::ParseError;
use naga::valid::ValidationError;
use naga::{Span, WithSpan};

use super::Source;
use crate::error::Error;

/// A parse error as `message` · `--> file:line:column` · the line · a caret.
pub fn parse(sources: &[Source], error: &ParseError) -> Error {
    let mut message = error.message().to_owned();
    let mut labels = error.labels();
    if let Some((span, label)) = labels.next() {
        message = with_place(&message, sources, span, label);
    }
    for note in error.notes() {
        message.push_str("\n   = note: ");
        message.push_str(note);
    }
    Error::Shader { message }
}

/// A validation error in the same form.
pub fn validation(sources: &[Source], error: &WithSpan<ValidationError>) -> Error {
    let mut message = error.as_inner().to_string();
    let mut cause = error.as_inner().source();
    while let Some(inner) = cause {
        message.push_str(": ");
        message.push_str(&inner.to_string());
        cause = inner.source();
    }
    message = without_handles(&message);
    // The last span is the narrowest; a span in the user's own file is more useful than one in ours.
    let spans: Vec<_> = error.spans().collect();
    let theirs = spans.iter().rev().find(|(span, _)| {
        span.to_range().and_then(|r| place(sources, r.start)).is_some_and(|(source, _)| !source.ours)
    });
    if let Some((span, label)) = theirs.or(spans.last()) {
        // naga's labels name numbers of its own tables.
        message = with_place(&message, sources, *span, if label.starts_with("naga::") { "here" } else { label });
    }
    Error::Shader { message }
}

/// A message of naga without the numbers of its tables, such as `[4]` and `Some([1])`.
fn without_handles(message: &str) -> String {
    let is_handle = |word: &&str| {
        let word = word.trim_end_matches([':', ',']);
        let word = word.strip_prefix("Some(").and_then(|word| word.strip_suffix(')')).unwrap_or(word);
        let number = word.strip_prefix('[').and_then(|word| word.strip_suffix(']'));
        number.is_some_and(|number| number.bytes().all(|byte| byte.is_ascii_digit()))
    };
    message.split(' ').filter(|word| !is_handle(word)).collect::<Vec<_>>().join(" ")
}

/// The file and the position in it that correspond to a position in the joined text.
pub fn place(sources: &[Source], mut at: usize) -> Option<(&Source, usize)> {
    for source in sources {
        let length = source.compiled().len();
        if at <= length {
            return Some((source, source.written(at)));
        }
        at -= length + 1;
    }
    None
}

/// A message with the file, the line and a caret.
pub fn with_place(message: &str, sources: &[Source], span: Span, label: &str) -> String {
    let Some(range) = span.to_range() else { return message.to_owned() };
    let Some((source, start)) = place(sources, range.start) else { return message.to_owned() };
    let end = match place(sources, range.end) {
        Some((last, end)) if std::ptr::eq(last, source) => end,
        _ => source.text.len(),
    };
    let before = source.text.get(..start).unwrap_or_default();
    let line_start = before.rfind('\n').map_or(0, |i| i + 1);
    let line_number = before.matches('\n').count() + 1;
    let column = source.text.get(line_start..start).map_or(0, |s| s.chars().count());
    let line = source.text.get(line_start..).and_then(|s| s.lines().next()).unwrap_or_default();
    let marked = source.text.get(start..end).and_then(|s| s.lines().next()).map_or(1, |s| s.chars().count().max(1));
    let gutter = " ".repeat(line_number.to_string().len());
    format!(
        "{message}\n{gutter}--> {}:{line_number}:{}\n{gutter} |\n{line_number} | {line}\n{gutter} | {}{} {label}",
        source.file,
        column + 1,
        " ".repeat(column),
        "^".repeat(marked),
    )
}
