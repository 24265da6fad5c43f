//! The book: its reference pages are those of the registers, its equations those of the shaders, its links lead somewhere.
//! `UPDATE=1 cargo test --test book` rewrites the pages that are generated.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

fn pages() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/pages")
}

const GENERATED: &str = "<!-- Generated from the registers: UPDATE=1 cargo test --test book -->\n";

/// A table of a register.
fn table<'a>(title: &str, first: &str, rows: impl Iterator<Item = (&'a str, String)>) -> String {
    let mut page = format!("# {title}\n\n{GENERATED}\n| {first} | |\n|---|---|\n");
    for (name, about) in rows {
        let _ = writeln!(page, "| `{name}` | {about} |");
    }
    page
}

fn forces() -> String {
    let mut page = table("Forces", "force", motes::forces::entries().map(|e| (e.name, e.about.to_owned())));
    for entry in motes::forces::entries() {
        let _ = write!(page, "\n## `{}`\n\n{}.\n\n| key | default | |\n|---|---|---|\n", entry.name, entry.about);
        for key in entry.keys {
            let default = key.default.as_ref().map_or_else(|| "required".to_owned(), shown);
            let _ = writeln!(page, "| `{}` | {default} | {} |", key.name, key.about.replace('|', "\\|"));
            if let motes::settings::Kind::Pairs(keys) = key.kind {
                for of in keys {
                    let default = of.default.as_ref().map_or_else(|| "required".to_owned(), shown);
                    let _ = writeln!(page, "| `{}.{}` | {default} | {} |", key.name, of.name, of.about);
                }
            }
        }
    }
    page
}

fn measures() -> String {
    let mut page = table("Measures", "measure", motes::measure::MEASURES.iter().map(|m| (m.name, m.about.to_owned())));
    for measure in motes::measure::MEASURES {
        let _ = write!(page, "\n## `{}`\n\n{}.\n", measure.name, measure.about);
        if !measure.keys.is_empty() {
            page.push_str("\n| key | default | |\n|---|---|---|\n");
        }
        for key in measure.keys {
            let default = key.default.as_ref().map_or_else(|| "required".to_owned(), shown);
            let _ = writeln!(page, "| `{}` | {default} | {} |", key.name, key.about.replace('|', "\\|"));
        }
        let _ = write!(
            page,
            "\n| column of `{}.csv` | |\n|---|---|\n| `step` | steps done |\n| `time` | the time |\n",
            measure.name
        );
        for (name, about) in measure.cells {
            let _ = writeln!(page, "| `{name}` | {} |", about.replace('|', "\\|"));
        }
    }
    page
}

fn shown(value: &motes::settings::Value) -> String {
    use motes::settings::Value;
    match value {
        Value::Number(x) => format!("`{x}`"),
        Value::Vector(v) => format!("`[{}, {}, {}]`", v.x, v.y, v.z),
        Value::Flag(on) => format!("`{on}`"),
        Value::Pairs(_) => "a table".to_owned(),
        Value::Text(text) if text.is_empty() => String::new(),
        Value::Text(text) => format!("`{text:?}`"),
    }
}

/// The first sentence of what a scene says of itself.
fn first(about: &str) -> String {
    let flat = about.lines().take_while(|l| !l.trim().is_empty()).collect::<Vec<_>>().join(" ");
    flat.split_inclusive(". ").next().unwrap_or_default().trim().to_owned()
}

/// What the shaders of a folder say in their first lines.
fn equations(folder: &str, page: &mut String) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders").join(folder);
    let mut files: Vec<_> =
        std::fs::read_dir(&root).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    for file in files.iter().filter(|file| file.extension().is_some_and(|e| e == "wgsl")) {
        let text = std::fs::read_to_string(file).expect("a text");
        let head: Vec<_> = text.lines().take_while(|line| line.starts_with("//")).map(|line| &line[2..]).collect();
        let name = file.file_stem().expect("a name").to_string_lossy();
        let _ = write!(page, "\n### `shaders/{folder}/{name}.wgsl`\n\n```text\n");
        for line in head {
            let _ = writeln!(page, "{}", line.strip_prefix(' ').unwrap_or(line));
        }
        page.push_str("```\n");
    }
}

fn methods() -> String {
    let mut page = format!(
        "# Equations and sources\n\n{GENERATED}\nEach shader, and each measure, opens with what it computes and where that was published.\n"
    );
    for (title, folder) in [
        ("Interactions", "interactions"),
        ("Constraints", "constraints"),
        ("Updaters", "updaters"),
        ("Collisions", "collide"),
        ("Parts of thermostats", "thermostat"),
        ("Fluids", "sph"),
        ("DFSPH", "sph/dfsph"),
        ("Integrators", "integrators"),
        ("Columns that are advanced", "integrators/pairs"),
        ("Rigid bodies", "rotation"),
        ("Tree", "tree"),
    ] {
        let _ = write!(page, "\n## {title}\n");
        equations(folder, &mut page);
    }
    page.push_str("\n## Measures\n");
    for measure in motes::measure::MEASURES {
        let name = measure.name;
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("src/measure/{name}.rs"));
        let text = std::fs::read_to_string(file).expect("a text");
        let _ = write!(page, "\n### `src/measure/{name}.rs`\n\n```text\n");
        for line in text.lines().map_while(|line| line.strip_prefix("//!")) {
            let _ = writeln!(page, "{}", line.strip_prefix(' ').unwrap_or(line));
        }
        page.push_str("```\n");
    }
    page
}

#[test]
fn generated_pages_are_those_of_the_registers() {
    let integrators = motes::integrators::INTEGRATORS.iter().map(|e| (e.name, e.about.to_owned()));
    let shapes = motes::shapes::SHAPES.iter().map(|e| (e.name, e.about.to_owned()));
    let scenes = motes::scene::SCENES.iter().map(|s| (s.name, first(&s.about())));
    let all = [
        ("reference/forces.md", forces()),
        ("reference/integrators.md", table("Integrators", "integrator", integrators)),
        ("reference/shapes.md", table("Shapes", "shape", shapes)),
        ("reference/measures.md", measures()),
        ("reference/scenes.md", table("Built-in scenes", "scene", scenes)),
        ("methods/equations.md", methods()),
        ("methods/claims.md", claims()),
    ];
    let update = std::env::var_os("UPDATE").is_some();
    for (name, page) in all {
        let path = pages().join(name);
        if update {
            std::fs::write(&path, &page).expect("written");
        }
        let have = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(have == page, "docs/pages/{name} is not what the registers say: UPDATE=1 cargo test --test book");
    }
}

/// The claims of `motes validate`, as the program lists them.
fn claims() -> String {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_motes"));
    let output = command.args(["validate", "--list", "--json"]).output().expect("it starts");
    let value: serde_json::Value = serde_json::from_slice(&output.stdout).expect("a document");
    let mut page = format!(
        "# Claims that the command checks\n\n{GENERATED}\n`motes validate` runs these scenes on this machine and compares a number of each with the known one; `--all` adds the long ones,\n\
         `--controls` runs each once more with a value by which it has to fail, `-o FOLDER` writes this table with what was measured.\n\n\
         | claim | set-up | quantity | known value | limit | source |\n|---|---|---|---|---|---|\n"
    );
    for claim in value["claims"].as_array().expect("a list") {
        let text = |key: &str| claim[key].as_str().expect("a text").replace('|', "\\|");
        let long = if claim["long"] == true { " (long)" } else { "" };
        let [name, about, quantity, because, source] = ["name", "about", "quantity", "because", "source"].map(text);
        let (known, limit) = (&claim["published"], &claim["tolerance"]);
        let _ = writeln!(page, "| `{name}`{long} | {about} | {quantity} | {known} | {limit}: {because} | {source} |");
    }
    page
}

/// All pages of the book, with their texts.
fn all() -> Vec<(PathBuf, String)> {
    let (mut found, mut folders) = (Vec::new(), vec![pages()]);
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(&folder).expect("a folder").map(|entry| entry.expect("an entry").path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "md") {
                let text = std::fs::read_to_string(&path).expect("a text");
                found.push((path, text));
            }
        }
    }
    assert!(found.len() > 20, "the book has {} pages", found.len());
    found
}

#[test]
fn links_lead_to_pages_and_files_and_every_page_is_listed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let summary = std::fs::read_to_string(pages().join("SUMMARY.md")).expect("a summary");
    for (path, text) in all() {
        let inside = path.strip_prefix(pages()).expect("a page").to_string_lossy().replace('\\', "/");
        assert!(inside == "SUMMARY.md" || summary.contains(&format!("({inside})")), "{inside} is not in SUMMARY.md");
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let there = path.parent().expect("a folder").join(link.split('#').next().unwrap_or_default());
            assert!(link.starts_with("http") || there.exists(), "{inside}: {link}");
        }
        for word in text.split('`').skip(1).step_by(2) {
            let file =
                ["src/", "shaders/", "tests/", "benches/", "scenes/"].iter().any(|folder| word.starts_with(folder));
            let pattern = word.contains("NAME") || word.contains('*') || word.contains(' ');
            assert!(!file || pattern || root.join(word).exists(), "{inside}: {word}");
        }
    }
}

/// The fenced blocks of a language in a page.
fn blocks<'a>(text: &'a str, language: &str) -> Vec<&'a str> {
    text.split(&format!("```{language}\n")).skip(1).filter_map(|part| part.split("```").next()).collect()
}

#[test]
fn whole_scenes_of_the_book_have_no_faults() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut checked = 0;
    for (path, text) in all() {
        for (n, scene) in
            blocks(&text, "toml").into_iter().enumerate().filter(|(_, scene)| scene.contains("[simulation]\n"))
        {
            let file = folder.path().join(format!("{}_{n}.toml", path.file_stem().expect("a name").to_string_lossy()));
            std::fs::write(&file, scene).expect("written");
            let output = std::process::Command::new(env!("CARGO_BIN_EXE_motes"))
                .args(["check", file.to_str().expect("a path of words")])
                .output()
                .expect("the program starts");
            let words = String::from_utf8_lossy(&output.stdout);
            let faults = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success() && words.contains("no faults"), "{}:\n{words}{faults}", path.display());
            checked += 1;
        }
    }
    assert!(checked >= 4, "{checked} scenes are whole");
}
