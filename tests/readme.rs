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
fn its_scenes_and_its_law_work() {
    let blocks = |language: &str| -> Vec<&str> {
        let parts = README.split(&format!("```{language}\n")).skip(1).collect::<Vec<_>>();
        parts.into_iter().filter_map(|part| part.split("```").next()).collect()
    };
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("swirl.wgsl"), blocks("wgsl")[0]).expect("written");
    let scenes = blocks("toml");
    assert!(scenes[0].contains("[simulation]") && scenes.iter().any(|text| text.contains("swirl.wgsl")));
    // The first one is whole, and so is one with a simulation of its own; the others say more of the first.
    for (n, more) in scenes.iter().enumerate() {
        let text = if n == 0 || more.contains("\n[simulation]\n") {
            (*more).to_owned()
        } else {
            format!("{}\n{more}", scenes[0])
        };
        let path = folder.path().join("orbit.toml");
        std::fs::write(&path, text).expect("written");
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_motes"))
            .args(["check", path.to_str().expect("a path of words")])
            .output()
            .expect("the program starts");
        let words = String::from_utf8_lossy(&output.stdout);
        assert!(
            output.status.success() && words.contains("no faults") && words.contains("swirl") == more.contains("swirl"),
            "{more}\n{words}{}",
            String::from_utf8_lossy(&output.stderr)
        );
    }
}
