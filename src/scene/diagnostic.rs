//! Errors of a scene as text: file, line, caret and advice.

use std::fmt;

/// Where a fault is mended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mended {
    /// In the scene, or in an override of it.
    InScene,
    /// In a file that the scene names: it is missing, or what it holds is wrong.
    InInput,
}

/// One fault.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// Where it is mended.
    pub mended: Mended,
    /// What is wrong, in one line.
    pub message: String,
    /// The scene it is in; `None` for an override from the command line.
    pub file: Option<String>,
    /// The line it is in; `None` when it is in no line, as when a whole section is missing.
    pub excerpt: Option<Excerpt>,
    /// More lines: what is known, what would help.
    pub notes: Vec<String>,
}

/// A line of a scene and the part of it that is meant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excerpt {
    /// Line and column, both counted from 1; `None` on the command line.
    pub position: Option<(usize, usize)>,
    /// The line, shortened when it is long, with tabs as spaces and without what a terminal would act upon.
    pub text: String,
    /// How many columns of `text` stand before the part that is meant.
    pub before: usize,
    /// How many columns the part has; at least one.
    pub under: usize,
    /// What stands beside the carets; may be empty.
    pub label: String,
}

/// All faults of a scene at once, in the order of its text, then those of the overrides.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostics {
    /// The scene's file, or the name of a built-in one.
    pub scene: String,
    /// The faults; the first hundred when there are more.
    pub list: Vec<Diagnostic>,
    /// How many there are.
    pub total: usize,
    /// How many of them are mended in the scene.
    pub(super) in_scene: usize,
}

impl Diagnostics {
    /// One fault that has no line: the scene cannot be read at all.
    pub(super) fn alone(scene: &str, message: String, notes: Vec<String>) -> Self {
        let file = Some(scene.to_owned());
        let only = Diagnostic { mended: Mended::InScene, message, file, excerpt: None, notes };
        Self { scene: scene.to_owned(), list: vec![only], total: 1, in_scene: 1 }
    }
    /// The exit code of the command `motes`: 4 when every fault is mended in an input file, else 3.
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
