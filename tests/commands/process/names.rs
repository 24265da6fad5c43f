//! Keys, and what is shown of files that are not the scene's to name.

use motes::scene::SECTIONS;

use crate::process::{Place, motes, output};

#[test]
fn every_section_and_every_key_is_listed() {
    let (code, all, _) = output(&mut motes(&["scenes", "--keys"]));
    assert_eq!(code, 0);
    assert!(SECTIONS.len() > 10);
    for section in SECTIONS {
        assert!(all.contains(&format!("\nsection = \"{}\": ", section.name)), "[{}] is not listed", section.name);
        let (code, one, stderr) = output(&mut motes(&["scenes", section.name, "--keys"]));
        assert_eq!(code, 0, "{stderr}");
        let names = section.own.iter().map(|own| own.name).chain(section.keys.iter().map(|key| key.name));
        for name in names {
            let row = |line: &&str| line.split_whitespace().next() == Some(name) && line.starts_with("    ");
            assert!(one.lines().any(|line| row(&line)), "`{name}` of [{}] is not listed:\n{one}", section.name);
        }
    }
    // What a scene says in the README and nowhere else.
    for (section, key) in [("simulation", "until"), ("output", "formats"), ("emitter", "speed"), ("drain", "outside")] {
        let (_, one, _) = output(&mut motes(&["scenes", section, "--keys"]));
        assert!(one.contains(&format!("\n    {key} ")), "{one}");
    }
}

#[cfg(unix)]
#[test]
fn a_link_out_of_the_folder_tells_nothing_of_what_is_there() {
    let place = Place::with(&[]);
    for folder in ["scene", "outside"] {
        std::fs::create_dir(place.at(folder)).expect("a folder");
    }
    place.put("outside/secret.csv", "x,y,z\n1,2,3\n");
    std::os::unix::fs::symlink(place.at("outside"), place.at("scene/up")).expect("a link");
    let shown = |file: &str| {
        let text = format!("[simulation]\ndt = 1\nsteps = 1\n[[particles]]\nfile = \"{file}\"\n");
        let (code, _, stderr) = output(&mut motes(&["check", &place.put("scene/a.toml", &text), "--backend", "cpu"]));
        assert_ne!(code, 0, "{file}");
        stderr
    };
    for file in ["up/secret.csv", "up/secrex.csv", "up/nothing/at/all.csv", "up/../outside/secrex.csv"] {
        let words = shown(file);
        assert!(words.contains("leads outside of the scene's folder"), "{file}: {words}");
        assert!(!words.contains("did you mean") && !words.contains("there is no file"), "{file}: {words}");
    }
    // What is missing inside is reported as before.
    place.put("scene/bodies.csv", "x,y,z\n1,2,3\n");
    assert!(shown("bodes.csv").contains("did you mean \"bodies.csv\"?"));
    assert!(shown("no/such/folder.csv").contains("there is no file"));
}
