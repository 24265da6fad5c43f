//! Errors of a scene as text: file, line, caret and advice.

use std::fmt;
use std::path::PathBuf;

/// The place where a fault must be corrected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mended {
    /// In the scene, or in an override of it.
    InScene,
    /// In a file that the scene names: it is missing, or its contents are invalid.
    InInput,
}

/// One fault.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// The place where it must be corrected.
    pub mended: Mended,
    /// The fault, in one line.
    pub message: String,
    /// The scene that contains it; `None` for an override from the command line.
    pub file: Option<String>,
    /// The line that contains it; `None` if there is none, as when a whole section is missing.
    pub excerpt: Option<Excerpt>,
    /// More lines: known names, and advice.
    pub notes: Vec<String>,
}

/// A line of a scene, and the marked part of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excerpt {
    /// Line and column, both counted from 1; `None` on the command line.
    pub position: Option<(usize, usize)>,
    /// The line, shortened if it is long, with tabs as spaces and without control characters.
    pub text: String,
    /// The number of columns of `text` before the marked part.
    pub before: usize,
    /// The number of columns of that part; at least one.
    pub under: usize,
    /// The text beside the carets; may be empty.
    pub label: String,
}

/// All faults of a scene at once, in the order of its text, then those of the overrides.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostics {
    /// The scene's file, or the name of a built-in one.
    pub scene: String,
    /// The faults; the first hundred when there are more.
    pub list: Vec<Diagnostic>,
    /// The total number.
    pub total: usize,
    /// The files that the scene names, as far as they were sought, also those that are missing; by absolute paths.
    pub files: Vec<PathBuf>,
    /// The number of faults to be corrected in the scene.
    pub(super) in_scene: usize,
}

impl Diagnostics {
    /// One fault without a line: the scene cannot be read at all.
    pub(super) fn alone(scene: &str, message: String, notes: Vec<String>) -> Self {
        let file = Some(scene.to_owned());
        let only = Diagnostic { mended: Mended::InScene, message, file, excerpt: None, notes };
        Self { scene: scene.to_owned(), list: vec![only], total: 1, files: Vec::new(), in_scene: 1 }
    }
    /// The exit code of the command `motes`: 4 when every fault must be corrected in an input file, otherwise 3.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        if self.in_scene == 0 { 4 } else { 3 }
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "error: {}", self.message)?;
        let position = self.excerpt.as_ref().and_then(|e| e.position);
        let number = position.map_or_else(String::new, |(line, _)| line.to_string());
        let gutter = number.len().max(2);
        let file = self.file.as_deref().unwrap_or("the command line");
        match position {
            Some((line, column)) => writeln!(f, "{:gutter$}--> {file}:{line}:{column}", "")?,
            None => writeln!(f, "{:gutter$}--> {file}", "")?,
        }
        if let Some(e) = &self.excerpt {
            let carets = "^".repeat(e.under);
            writeln!(f, "{:gutter$} |", "")?;
            writeln!(f, "{number:>gutter$} | {}", e.text)?;
            writeln!(
                f,
                "{}",
                format!("{:gutter$} | {:before$}{carets} {}", "", "", e.label, before = e.before).trim_end()
            )?;
        }
        for note in &self.notes {
            writeln!(f, "{:gutter$} = {note}", "")?;
        }
        Ok(())
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for diagnostic in &self.list {
            writeln!(f, "{diagnostic}")?;
        }
        let shown = self.list.len();
        let errors = if self.total == 1 { "error" } else { "errors" };
        write!(f, "{}: {} {errors}", self.scene, self.total)?;
        if shown < self.total {
            write!(f, ", the first {shown} are shown")?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}
