//! The README is short, its links lead somewhere, and what it shows works.

const README: &str = include_str!("../../README.md");

#[test]
fn it_is_short() {
    assert!(README.lines().count() <= 200, "{} lines", README.lines().count());
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

/// The page's snippet is compiled as documentation of the crate.
#[test]
fn its_program_is_that_of_the_book() {
    let program = |text: &'static str| {
        let rest = text.split_once("```rust,no_run\n").expect("a program").1;
        rest.split_once("```").expect("an end").0
    };
    assert_eq!(program(README), program(include_str!("../../docs/pages/tutorials/embed.md")));
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
