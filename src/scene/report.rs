//! The collector of all faults of a scene, each with its place.

use std::collections::BTreeSet;
use std::ops::Range;

use unicode_width::UnicodeWidthChar;

pub(super) use crate::settings::{listed, nearest};

use super::diagnostic::{Diagnostic, Diagnostics, Excerpt, Mended};

/// The number of faults that are kept; the others are counted.
const KEPT: usize = 100;
/// The number of columns of a long line that are shown.
const SHOWN: usize = 100;

/// A range of one of the texts of a [`Report`]: the scene is text 0, the overrides follow.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) text: usize,
    pub(super) span: Range<usize>,
}

impl Place {
    /// The end of the scene, for parts that are missing as a whole.
    pub(super) fn end() -> Self {
        Self { text: 0, span: usize::MAX..usize::MAX }
    }
}

/// A fault under construction.
#[derive(Debug)]
pub(super) struct Fault {
    place: Place,
    message: String,
    label: String,
    notes: Vec<String>,
    mended: Mended,
    missing: bool,
}

impl Fault {
    pub(super) fn at(place: &Place, message: impl Into<String>) -> Self {
        Self {
            place: place.clone(),
            message: message.into(),
            label: String::new(),
            notes: Vec::new(),
            mended: Mended::InScene,
            missing: false,
        }
    }
    /// A missing part. It is not reported if the text does not parse, since it may exist then.
    pub(super) fn missing(place: &Place, message: impl Into<String>) -> Self {
        Self { missing: true, ..Self::at(place, message) }
    }
    /// The text beside the carets.
    pub(super) fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }
    /// A line below the excerpt.
    pub(super) fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }
    /// The file that the scene names is at fault, not the scene itself.
    pub(super) fn in_input(mut self) -> Self {
        self.mended = Mended::InInput;
        self
    }
}

struct Text {
    /// The file's name, or `None` for an override.
    name: Option<String>,
    body: String,
    lines: Vec<usize>,
}

/// All texts and all faults.
#[derive(Default)]
pub(super) struct Report {
    texts: Vec<Text>,
    faults: Vec<Fault>,
    broken: BTreeSet<(usize, usize)>,
}

impl Report {
    /// Adds the scene's text (first) or an override (`name` is `None`) and returns its number.
    pub(super) fn add(&mut self, name: Option<String>, body: &str) -> usize {
        let lines = std::iter::once(0).chain(body.match_indices('\n').map(|(i, _)| i + 1)).collect();
        self.texts.push(Text { name, body: body.to_owned(), lines });
        self.texts.len() - 1
    }
    /// Adds a fault.
    pub(super) fn push(&mut self, fault: Fault) {
        self.faults.push(fault);
    }
    /// Adds a syntax error: one for each line, since one mistake often invalidates the rest of its line.
    pub(super) fn push_syntax(&mut self, fault: Fault) {
        if self.broken.insert((fault.place.text, self.line(&fault.place))) {
            self.faults.push(fault);
        }
    }
    /// The number of faults so far.
    pub(super) fn len(&self) -> usize {
        self.faults.len()
    }
    /// The text at a place, shortened if it is long.
    pub(super) fn quote(&self, place: &Place) -> String {
        let body = self.texts.get(place.text).map_or("", |t| t.body.as_str());
        let text = body.get(place.span.clone()).unwrap_or("").lines().next().unwrap_or("");
        shorten(text)
    }
    fn line(&self, place: &Place) -> usize {
        self.texts
            .get(place.text)
            .map_or(0, |t| t.lines.partition_point(|&start| start <= place.span.start).saturating_sub(1))
    }
    /// The faults in the order of the text; `None` when there are none.
    pub(super) fn finish(mut self) -> Option<Diagnostics> {
        let mut faults = std::mem::take(&mut self.faults);
        if !self.broken.is_empty() {
            let syntax: BTreeSet<_> = std::mem::take(&mut self.broken);
            let mut first = syntax.clone();
            faults.retain(|f| {
                let line = (f.place.text, self.line(&f.place));
                // The first fault added for an invalid line is the syntax error.
                first.remove(&line) || !(f.missing || syntax.contains(&line))
            });
        }
        faults.sort_by_key(|f| (f.place.text, f.place.span.start));
        // The settings of a force are read again for each shape that uses them.
        let mut seen = BTreeSet::new();
        faults.retain(|f| seen.insert((f.place.text, f.place.span.start, f.message.clone())));
        let in_scene = faults.iter().filter(|f| f.mended == Mended::InScene).count();
        let total = faults.len();
        let list: Vec<_> = faults.into_iter().take(KEPT).map(|f| self.diagnostic(f)).collect();
        let scene = self.texts.first().and_then(|t| t.name.clone()).unwrap_or_default();
        (total > 0).then_some(Diagnostics { scene, list, total, files: Vec::new(), in_scene })
    }
    fn diagnostic(&self, fault: Fault) -> Diagnostic {
        let (file, excerpt) = match self.texts.get(fault.place.text) {
            Some(text) => (text.name.clone(), text.excerpt(&fault.place.span, fault.label, self.line(&fault.place))),
            None => (None, None),
        };
        Diagnostic { mended: fault.mended, message: fault.message, file, excerpt, notes: fault.notes }
    }
}

impl Text {
    fn excerpt(&self, span: &Range<usize>, label: String, line: usize) -> Option<Excerpt> {
        if span.start == usize::MAX {
            return None;
        }
        let start = self.boundary(span.start);
        let from = self.lines.get(line).copied().unwrap_or(0).min(start);
        let to = self.lines.get(line + 1).map_or(self.body.len(), |next| next - 1);
        // The windows shorten long lines, and keep a megabyte without a line break cheap.
        let left = self.boundary(from.max(start.saturating_sub(4 * SHOWN)));
        let right = self.boundary(to.min(start.saturating_add(4 * SHOWN))).max(start);
        let end = self.boundary(span.end.clamp(start, right));
        let mut before = cells(self.body.get(left..start).unwrap_or(""));
        let under = cells(self.body.get(start..end).unwrap_or(""));
        let mut after = cells(self.body.get(end..right).unwrap_or("").trim_end());
        let cut = before.len().saturating_sub(SHOWN / 2);
        if cut > 0 || left > from {
            before.splice(..cut, ['…']);
        }
        let room = SHOWN.saturating_sub(before.len() + under.len());
        if after.len() > room || right < to {
            after.truncate(room);
            after.push('…');
        }
        let width = |cells: &[char]| cells.iter().map(|c| c.width().unwrap_or(0)).sum::<usize>();
        let prefix = if self.name.is_none() { "--set " } else { "" };
        let mut text = String::from(prefix);
        text.extend(before.iter().chain(&under).chain(&after));
        Some(Excerpt {
            position: self.name.is_some().then(|| {
                let column =
                    self.body.get(from..start).map_or(0, |s| s.chars().filter(|&c| c != '\u{feff}').count()) + 1;
                (line + 1, column)
            }),
            text,
            before: prefix.len() + width(&before),
            under: width(&under).max(1),
            label,
        })
    }
    /// The nearest start of a character at or before `at`.
    fn boundary(&self, at: usize) -> usize {
        let mut at = at.min(self.body.len());
        while !self.body.is_char_boundary(at) {
            at -= 1;
        }
        at
    }
}

/// Text that is safe for a terminal: tabs as spaces, and no character that moves the cursor or changes the direction of writing.
fn cells(text: &str) -> Vec<char> {
    let mut out = Vec::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\t' => out.extend([' '; 4]),
            '\u{feff}' => {}
            c if is_unsafe(c) => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

fn is_unsafe(c: char) -> bool {
    c.is_control() || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}')
}

/// Untrusted text, shortened and cleaned for a message.
pub(super) fn shorten(text: &str) -> String {
    let mut out: String = cells(text).into_iter().take(60).collect();
    if text.chars().nth(60).is_some() {
        out.push('…');
    }
    out
}
