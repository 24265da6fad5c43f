//! The README says what the registers say.

const README: &str = include_str!("../README.md");

/// The rows of the table under a heading cell, in their order: name and text.
fn table(heading: &str) -> Vec<(String, String)> {
    let start = README.find(&format!("\n| {heading} | |\n")).unwrap_or_else(|| panic!("no table of {heading}s"));
    let rows = README[start + 1..].lines().skip(2).take_while(|line| line.starts_with('|'));
    rows.map(|row| {
        let cells: Vec<_> = row.trim_matches('|').split(" | ").map(str::trim).collect();
        (cells[0].trim_matches('`').to_owned(), cells[1..].join(" | "))
    })
    .collect()
}

fn same<'a>(heading: &str, register: impl Iterator<Item = (&'a str, String)>) {
    let register: Vec<_> = register.map(|(name, about)| (name.to_owned(), about)).collect();
    assert_eq!(table(heading), register, "the table of {heading}s");
}

#[test]
fn tables_are_those_of_the_registers() {
    same("force", motes::forces::FORCES.iter().map(|e| (e.name, e.about.to_owned())));
    same("integrator", motes::integrators::INTEGRATORS.iter().map(|e| (e.name, e.about.to_owned())));
    same("shape", motes::particles::SHAPES.iter().map(|e| (e.name, e.about.to_owned())));
    let first = |about: String| {
        let flat = about.lines().take_while(|l| !l.trim().is_empty()).collect::<Vec<_>>().join(" ");
        flat.split_inclusive(". ").next().unwrap_or_default().trim().to_owned()
    };
    same("scene", motes::scene::SCENES.iter().map(|s| (s.name, first(s.about()))));
}

#[test]
fn what_it_shows_is_there_and_what_it_names_exists() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    for link in README.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
        assert!(link.starts_with("http") || root.join(link).exists(), "{link}");
    }
    for word in README.split('`').skip(1).step_by(2) {
        let file = ["src/", "shaders/", "tests/", "benches/", "scenes/"].iter().any(|folder| word.starts_with(folder));
        assert!(!file || word.contains("NAME") || root.join(word).exists(), "{word}");
    }
    assert!(
        !README.contains('@')
            || README.matches('@').count() == README.matches("@group").count() + README.matches("@binding").count()
    );
}

#[test]
fn its_scene_and_its_law_work() {
    let block = |language: &str, nth: usize| {
        let parts: Vec<_> = README.split(&format!("```{language}\n")).skip(1).collect();
        parts[nth].split("```").next().unwrap_or_default().to_owned()
    };
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("swirl.wgsl"), block("wgsl", 0)).expect("written");
    // The scene of the README, with the README's own force beside gravity.
    let text = format!("{}\n{}", block("toml", 0), block("toml", 1));
    let path = folder.path().join("orbit.toml");
    std::fs::write(&path, text).expect("written");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_motes"))
        .args(["check", path.to_str().expect("a path of words")])
        .output()
        .expect("the program starts");
    let words = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success() && words.contains("swirl") && words.contains("no faults"),
        "{words}{}",
        String::from_utf8_lossy(&output.stderr)
    );
}
