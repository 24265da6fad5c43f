//! What users read, as files that can be read in one sitting: `UPDATE=1 cargo test --test inputs messages` writes them anew.

#![cfg(feature = "scene")]

mod binary;
mod library;
mod scenes;

/// A text without the folder of this machine, and without the ends of lists of names, which grow with the registers.
fn cleaned(text: &str, folder: &std::path::Path) -> String {
    let real = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let text = text.replace(&real.display().to_string(), "FOLDER").replace(&folder.display().to_string(), "FOLDER");
    text.lines().map(shortened).collect::<Vec<_>>().join("\n")
}

/// A line that lists what is known, up to the fourth name.
fn shortened(line: &str) -> String {
    match line.split_once("known") {
        Some((_, list)) if list.matches(", ").count() > 5 => {
            let kept: Vec<_> = line.splitn(5, ", ").take(4).collect();
            format!("{}, …", kept.join(", "))
        }
        _ => line.to_owned(),
    }
}
