//! Files of cases, each with the text that it must give: `UPDATE=1` writes the texts anew.
//!
//! A file is a comment, then cases: a line `==== title`, the input, a line `----`, and the text.

use std::fmt::Write as _;
use std::path::Path;

const TITLE: &str = "==== ";
const END: &str = "----";

/// The input of a case.
pub struct Case {
    /// What it is about.
    pub title: String,
    /// Its lines.
    pub input: String,
}

/// Compares what all cases of a file give with what the file says; `path` is relative to the package.
pub fn compare(path: &str, text_of: impl Fn(&Case) -> String) {
    let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let have = std::fs::read_to_string(&whole).unwrap_or_else(|e| panic!("{path}: {e}"));
    let (about, cases) = parsed(&have);
    assert!(!cases.is_empty(), "{path} has no cases");
    let (mut text, mut silent) = (about, Vec::new());
    for case in &cases {
        let output = text_of(case);
        if output.trim().is_empty() {
            silent.push(case.title.as_str());
        }
        let _ = write!(text, "{TITLE}{}\n{}{END}\n{}\n\n", case.title, case.input, output.trim_end());
    }
    matched(path, &have, &text);
    assert!(silent.is_empty(), "{path}: no message is given by: {}", silent.join("; "));
}

/// Compares a text with a file, or writes it there.
pub fn matched(path: &str, have: &str, text: &str) {
    let text = format!("{}\n", text.trim_end());
    if std::env::var_os("UPDATE").is_some() {
        let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        return std::fs::write(whole, text).unwrap_or_else(|e| panic!("{path}: {e}"));
    }
    let number = have.lines().zip(text.lines()).take_while(|(had, is)| had == is).count();
    let [had, is] = [have, text.as_str()].map(|text| text.lines().nth(number).unwrap_or("(the end)"));
    assert!(
        have == text,
        "{path}, line {}:\n  {had}\nis now\n  {is}\nread it as a stranger; if it is right, UPDATE=1 keeps it",
        number + 1
    );
}

/// The comment before the cases, and these.
fn parsed(text: &str) -> (String, Vec<Case>) {
    let (mut about, mut cases, mut is_input) = (String::new(), Vec::<Case>::new(), false);
    for line in text.lines() {
        if let Some(title) = line.strip_prefix(TITLE) {
            cases.push(Case { title: title.to_owned(), input: String::new() });
            is_input = true;
        } else if line == END {
            is_input = false;
        } else if let (Some(case), true) = (cases.last_mut(), is_input) {
            case.input.push_str(line);
            case.input.push('\n');
        } else if cases.is_empty() {
            about.push_str(line);
            about.push('\n');
        }
    }
    (about, cases)
}
