//! Files: the scene's own, and those that it names.

use std::fs;
use std::path::Path;

use motes::forces::Over;
use motes::scene::{Options, SCENES, Scene, Source};
use motes::tree::Opening;

use crate::scenes::SMALL;

/// Loads `scene.toml` from a folder with these files.
fn report_in(files: &[(&str, &[u8])], options: &Options) -> Result<Scene, (String, u8)> {
    let folder = tempfile::tempdir().expect("a folder");
    let scenes = folder.path().join("scenes");
    fs::create_dir_all(scenes.join("data")).expect("a folder");
    for (name, bytes) in files {
        fs::write(scenes.join(name), bytes).expect("a file");
    }
    let path = scenes.join("scene.toml");
    Scene::load(&Source::File(path), &[], options).map_err(|faults| {
        let place = format!("{}/", scenes.display());
        (faults.to_string().replace(&place, ""), faults.exit_code())
    })
}

fn particles(entry: &str) -> Vec<u8> {
    format!("[simulation]\ndt = 0.1\nsteps = 10\n[[particles]]\n{entry}\n").into_bytes()
}

fn fault(files: &[(&str, &[u8])]) -> (String, u8) {
    report_in(files, &Options::default()).err().expect("the scene is at fault")
}

#[test]
fn a_file_of_a_similar_name_is_offered() {
    let (report, code) =
        fault(&[("scene.toml", &particles("file = \"bodys.csv\"")), ("bodies.csv", b"x,y,z\n1,2,3\n")]);
    let expected = r#"error: there is no file bodys.csv
  --> scene.toml:5:8
   |
 5 | file = "bodys.csv"
   |        ^^^^^^^^^^^ did you mean "bodies.csv"?

scene.toml: 1 error"#;
    assert_eq!((report.as_str(), code), (expected, 4));
}

#[test]
fn a_missing_file_is_said_to_be_missing_and_where() {
    let (report, code) = fault(&[("scene.toml", &particles("file = \"data/stars.csv\""))]);
    let expected = r#"error: there is no file data/stars.csv
  --> scene.toml:5:8
   |
 5 | file = "data/stars.csv"
   |        ^^^^^^^^^^^^^^^^
   = it is sought at data/stars.csv

scene.toml: 1 error"#;
    assert_eq!((report.as_str(), code), (expected, 4));
}

#[test]
fn a_folder_is_no_file() {
    let (report, code) = fault(&[("scene.toml", &particles("file = \"data\""))]);
    assert!(report.starts_with("error: data is a folder\n  --> scene.toml:5:8\n"), "{report}");
    assert_eq!(code, 4);
}

#[test]
fn files_outside_of_the_folder_need_trust() {
    for name in ["../secret.csv", "data/../../secret.csv", "/etc/hostname"] {
        let (report, code) =
            fault(&[("scene.toml", &particles(&format!("file = \"{name}\""))), ("../secret.csv", b"x,y,z\n1,2,3\n")]);
        let carets = "^".repeat(name.len() + 2);
        let expected = format!(
            r#"error: `file` leads outside of the scene's folder
  --> scene.toml:5:8
   |
 5 | file = "{name}"
   |        {carets}
   = help: move the file beside the scene, or use --allow-outside if you trust the scene

scene.toml: 1 error"#
        );
        assert_eq!((report.as_str(), code), (expected.as_str(), 3));
    }
    let trusting = Options { allow_outside: true, ..Options::default() };
    let files: &[(&str, &[u8])] =
        &[("scene.toml", &particles("file = \"../secret.csv\"")), ("../secret.csv", b"x,y,z\n1,2,3\n")];
    assert_eq!(report_in(files, &trusting).expect("trusted").particles.len(), 1);
}

#[cfg(unix)]
#[test]
fn a_link_that_leads_outside_needs_trust() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenes = folder.path().join("scenes");
    fs::create_dir(&scenes).expect("a folder");
    fs::write(folder.path().join("secret.csv"), "x,y,z\n1,2,3\n").expect("a file");
    std::os::unix::fs::symlink("../secret.csv", scenes.join("open.csv")).expect("a link");
    fs::write(scenes.join("scene.toml"), particles("file = \"open.csv\"")).expect("a file");
    let source = Source::File(scenes.join("scene.toml"));
    let faults = Scene::load(&source, &[], &Options::default()).err().expect("the link leads outside");
    assert!(faults.to_string().starts_with("error: `file` leads outside of the scene's folder"), "{faults}");
    let trusting = Options { allow_outside: true, ..Options::default() };
    assert_eq!(Scene::load(&source, &[], &trusting).expect("trusted").particles.len(), 1);
}

#[test]
fn a_faulty_file_points_at_its_name_and_is_the_files_fault() {
    let (report, code) = fault(&[("scene.toml", &particles("file = \"bodies.csv\"")), ("bodies.csv", b"x,y,z\n1,2\n")]);
    assert!(report.starts_with("error: bodies.csv: "), "{report}");
    assert!(report.contains("\n 5 | file = \"bodies.csv\"\n   |        ^^^^^^^^^^^^\n"), "{report}");
    assert_eq!(code, 4);
}

#[test]
fn files_are_moved_by_center_and_velocity() {
    let entry = "file = \"bodies.csv\"\ncenter = [10, 0, 0]\nvelocity = [0, 5, 0]\nvelocity_factor = 0.5";
    let files: &[(&str, &[u8])] =
        &[("scene.toml", &particles(entry)), ("bodies.csv", b"x,y,z,vx,vy,vz\n1,2,3,4,2,1\n")];
    let scene = report_in(files, &Options::default()).expect("a good scene");
    assert_eq!(scene.particles.position()[0].to_array(), [11.0, 2.0, 3.0]);
    assert_eq!(scene.particles.velocity()[0].to_array(), [2.0, 6.0, 0.5]);
    assert_eq!(scene.name, "scene");
}

#[test]
fn a_file_may_hold_too_many() {
    let files: &[(&str, &[u8])] =
        &[("scene.toml", &particles("file = \"bodies.csv\"")), ("bodies.csv", b"x,y,z\n1,2,3\n4,5,6\n")];
    let most = |most_particles| report_in(files, &Options { most_particles, ..Options::default() });
    assert_eq!(most(2).map(|scene| scene.particles.len()), Ok(2));
    let (report, code) = most(1).err().expect("two are too many");
    assert!(report.starts_with("error: 2 particles are too many\n"), "{report}");
    assert!(report.contains("^^^^^^^^^^^^ the maximum is 1\n"), "{report}");
    assert_eq!(code, 4);
}

#[test]
fn a_scene_must_be_utf8_and_not_too_long() {
    let start = |text: &[u8]| fault(&[("scene.toml", text)]).0;
    let report = start(b"[simulation]\ndt = 0.1 # \xff\n");
    assert_eq!(
        report,
        "error: the scene is not UTF-8 text: byte 24, in line 2, is 0xff\n  --> scene.toml\n\nscene.toml: 1 error"
    );
    let report = start(b"\xff\xfe[\0s\0");
    assert_eq!(report, "error: the scene is UTF-16 text: save it as UTF-8\n  --> scene.toml\n\nscene.toml: 1 error");
    let long = vec![b'#'; (16 << 20) + 1];
    let report = start(&long);
    assert_eq!(
        report,
        "error: the scene is longer than 16 MiB: put particles into a file of their own (CSV, Tipsy) and name it with `file`\n  \
         --> scene.toml\n\nscene.toml: 1 error"
    );
    // At the limit it is read; so long a comment holds no section, which is its only fault.
    assert!(start(&long[1..]).contains("the section [simulation] is missing"));
}

#[test]
fn the_command_line_finds_scenes_by_name_or_by_file() {
    assert!(matches!(Source::find("kepler"), Ok(Source::Builtin(b)) if b.name == "kepler"));
    assert!(matches!(Source::find("Cargo.toml"), Ok(Source::File(path)) if path == Path::new("Cargo.toml")));
    let report = Source::find("galaxi").expect_err("there is none").to_string();
    let names: Vec<_> = SCENES.iter().map(|s| format!("`{}`", s.name)).collect();
    let expected = format!(
        "error: there is no such file, and no built-in scene of this name\n  --> galaxi\n   = help: did you mean the built-in \
         scene `galaxy`?\n   = built-in scenes: {}\n\ngalaxi: 1 error",
        names.join(", ")
    );
    assert_eq!(report, expected);
    let report = Source::find("src").expect_err("a folder").to_string();
    assert!(report.starts_with("error: this is a folder, not a scene\n"), "{report}");
}

#[test]
fn a_law_of_ones_own_is_read_from_its_file() {
    let scene = format!(
        "{SMALL}[[force]]\nwgsl = \"swirl.wgsl\"\nover = \"each\"\nparams = {{ strength = 2.0, axis = [0, 0, 1], on = true }}\n"
    );
    let files: &[(&str, &[u8])] = &[("scene.toml", scene.as_bytes()), ("swirl.wgsl", b"fn force() {}")];
    let scene = report_in(files, &Options::default()).expect("a good scene");
    let laws = scene.forces[0].laws();
    assert_eq!(laws[0].name, "swirl");
    assert!(
        scene.resolved.contains("params = { strength = 2.0, axis = [0.0, 0.0, 1.0], on = true }"),
        "{}",
        scene.resolved
    );

    // Which pairs, and how far or how many that are; and the same again out of the resolved scene.
    for (over, more, want) in [
        ("near", "range = 0.1", Over::Near { range: 0.1, of: None }),
        ("within", "range = 2", Over::Within { range: 2.0 }),
        ("list", "range = 0.1", Over::List { range: 0.1, skin: None, slots: 0 }),
        ("list", "range = 0.1\nskin = 0.03\nslots = 3", Over::List { range: 0.1, skin: Some(0.03), slots: 3 }),
        ("nearest", "neighbors = 7", Over::Nearest { count: 7 }),
        ("pairs", "", Over::Pairs),
        ("tree", "theta = 0.25", Over::Tree { opening: Opening::Geometric { theta: 0.25 }, core: 0.0, auto: false }),
        ("auto", "range = 0.75", Over::Auto { range: 0.75, skin: None }),
        ("auto", "range = 0.75\nskin = 0.25", Over::Auto { range: 0.75, skin: Some(0.25) }),
        ("auto", "theta = 0.75", Over::Tree { opening: Opening::Geometric { theta: 0.75 }, core: 0.0, auto: true }),
    ] {
        let scene = format!("{SMALL}[[force]]\nwgsl = \"swirl.wgsl\"\nover = \"{over}\"\n{more}\n");
        let files: &[(&str, &[u8])] = &[("scene.toml", scene.as_bytes()), ("swirl.wgsl", b"fn gather() {}")];
        let scene = report_in(files, &Options::default()).expect("a good scene");
        assert_eq!(scene.forces[0].laws()[0].over, want);
        assert!(
            scene.resolved.contains(&format!("over = \"{over}\"\n{}", more.replace("= 2", "= 2.0"))),
            "{}",
            scene.resolved
        );
    }

    for (over, bonds) in [("list", 3), ("auto", 1)] {
        let scene =
            format!("{SMALL}[[force]]\nwgsl = \"swirl.wgsl\"\nover = \"{over}\"\nrange = 0.1\nexclude = {bonds}\n");
        let law: &[u8] = b"fn gather() {}";
        let made = report_in(&[("scene.toml", scene.as_bytes()), ("swirl.wgsl", law)], &Options::default());
        let made = made.expect("a good scene");
        assert_eq!(made.forces[0].laws()[0].exclude, bonds);
        assert!(made.resolved.contains(&format!("\nexclude = {bonds}\n")), "{}", made.resolved);
        for wrong in ["10000000000", "-1", "9"] {
            let text = scene.replace(&format!("exclude = {bonds}"), &format!("exclude = {wrong}"));
            let (report, code) = fault(&[("scene.toml", text.as_bytes()), ("swirl.wgsl", law)]);
            assert!(code == 3 && report.contains(wrong) && report.contains("exclude"), "{report}");
        }
        let text = scene.replace(over, "near");
        let (report, _) = fault(&[("scene.toml", text.as_bytes()), ("swirl.wgsl", law)]);
        assert!(report.contains("a law over \"near\" does not use `exclude`"), "{report}");
    }

    let heap =
        "[simulation]\ndt = 0.1\nsteps = 10\n[[particles]]\nshape = \"grains\"\nsize = [1, 1, 1]\nradius = 0.1\n";
    let scene = format!("{heap}[[force]]\nwgsl = \"swirl.wgsl\"\nover = \"list\"\nrange = 0.3\ngrains = true\n");
    for text in [scene.clone(), scene.replace("range = 0.3", "range = 0.1")] {
        let files: &[(&str, &[u8])] = &[("scene.toml", text.as_bytes()), ("swirl.wgsl", b"fn gather() {}")];
        let made = report_in(files, &Options::default()).expect("a good scene");
        assert!(made.forces[0].columns().iter().any(|column| column.name == "torque"));
        assert!(made.resolved.contains("\ngrains = true\n"), "{}", made.resolved);
        assert_eq!(made.forces[0].properties().largest[0].value, if text == scene { 0.15 } else { 0.05 });
    }

    let wrong =
        format!("{SMALL}[[force]]\nwgsl = \"swirl.wgsl\"\nover = \"all_of_it\"\nparams = {{ strength = \"2\" }}\n");
    let (report, code) = fault(&[("scene.toml", wrong.as_bytes()), ("swirl.wgsl", b"\xff")]);
    let expected = r#"error: cannot read swirl.wgsl: stream did not contain valid UTF-8
  --> scene.toml:7:8
   |
 7 | wgsl = "swirl.wgsl"
   |        ^^^^^^^^^^^^

error: unknown visit "all_of_it"
  --> scene.toml:8:8
   |
 8 | over = "all_of_it"
   |        ^^^^^^^^^^^
   = known: `each`, `pairs`, `within`, `near`, `list`, `nearest`, `tree`, `auto`, `links`, `joints`, `dihedrals`, `triangles`

error: `strength` must be a number, three numbers, or true or false, not the text "2"
  --> scene.toml:9:23
   |
 9 | params = { strength = "2" }
   |                       ^^^ remove the quotes: 2

scene.toml: 3 errors"#;
    assert_eq!((report.as_str(), code), (expected, 3));
}

/// A scene in memory with a law in memory, as a page in a browser has them.
#[test]
fn scenes_in_memory_bring_their_files() {
    let text = "[simulation]\ndt = 0.01\nsteps = 1\n[[particles]]\nshape = \"sphere\"\ncount = 9\n[[force]]\nwgsl = \"law.wgsl\"\nover = \"each\"\n";
    let law = "fn force(me: Particle) -> vec4f { return vec4f(-me.position, 0.0); }";
    let load = |files: &[(&str, &str)], text: &str| {
        let files = files.iter().map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec())).collect();
        let source = Source::Memory { name: "mine.toml".to_owned(), text: text.to_owned(), files };
        Scene::load(&source, &[], &Options::default()).map_err(|faults| faults.to_string())
    };
    let scene = load(&[("law.wgsl", law)], text).expect("a scene");
    assert_eq!((scene.name.as_str(), scene.forces.len(), scene.files.len()), ("mine", 1, 0));
    let refused = |files: &[(&str, &str)], text: &str| load(files, text).err().expect("faults");
    let absent = refused(&[], text);
    assert!(absent.contains("there is no file law.wgsl") && absent.contains("mine.toml:8"), "{absent}");
    let long = format!("//{}\n{law}", " ".repeat(1 << 20));
    let long = refused(&[("law.wgsl", &long)], text);
    assert!(long.contains("more than the 1048576 that a shader may have"), "{long}");
    let of_file = "[simulation]\ndt = 0.1\nsteps = 1\n[[particles]]\nfile = \"a.csv\"\n";
    let scene = load(&[("a.csv", "x,y,z\n1,2,3\n4,5,6\n")], of_file).expect("particles");
    assert_eq!(scene.particles.position()[1], glam::DVec3::new(4.0, 5.0, 6.0));
    let broken = refused(&[("a.csv", "x,y,z\n1,2,3\n\n4,five,6\n")], of_file);
    assert!(broken.contains("a.csv") && broken.contains("line 4") && broken.contains("five"), "{broken}");
}

/// Every format that is read from a disk is read from memory, to the same numbers; what is cut short is refused by both in the same words.
#[test]
fn files_in_memory_are_read_as_those_of_a_disk() {
    use motes::formats::{FORMATS, Input, Options, read, read_from};
    let columns = motes::kernel::Columns::default();
    let mut state = motes::State::default();
    for n in 0..40 {
        let x = f64::from(n);
        state.push(glam::DVec3::new(x, 0.5 * x, -x), glam::DVec3::splat(0.25 * x), 1.0 + x, 0.5);
    }
    let folder = tempfile::tempdir().expect("a folder");
    let mut seen = 0;
    for format in FORMATS.iter().filter(|format| format.read.is_some()) {
        let Some(write) = format.write else { continue };
        let path = folder.path().join("a").with_extension(format.endings[0]);
        motes::formats::atomically(&path, |out| write(out, &state, &Options::default())).expect("written");
        let bytes = std::fs::read(&path).expect("bytes");
        let name = std::path::Path::new(path.file_name().expect("a name"));
        let [disk, memory] = [read(&path, &columns), read_from(&Input::memory(name, &bytes), &columns)];
        assert_eq!(
            disk.expect("disk"),
            memory.unwrap_or_else(|why| panic!("{}: {why}", format.name)),
            "{}",
            format.name
        );
        let half = &bytes[..bytes.len() / 2];
        std::fs::write(&path, half).expect("half");
        let said = |result: Result<motes::State, motes::Error>| {
            result.map_err(|why| why.to_string().replace(&*path.to_string_lossy(), &name.to_string_lossy()))
        };
        assert_eq!(
            said(read(&path, &columns)),
            said(read_from(&Input::memory(name, half), &columns)),
            "{}",
            format.name
        );
        seen += 1;
    }
    assert!(seen >= 6, "{seen} formats");
}

/// A file beside a scene: particles in the place of its own, a law as one more force.
#[test]
fn what_is_put_beside_a_scene_becomes_a_part_of_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let put = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("written");
        path.to_string_lossy().into_owned()
    };
    let table = put("mine.csv", "x,y,z,mass\n1,2,3,1\n4,5,6,2\n");
    let law = put("law.wgsl", "fn force(me: Particle) -> vec4f { return vec4f(-me.position, 0.0); }");
    let options = Options { allow_outside: true, ..Options::default() };
    for name in ["plummer", "room"] {
        let source = Source::find(name).expect("a scene").beside(&law).expect("with a law");
        let before =
            Scene::load(&Source::find(name).expect("a scene"), &[], &options).unwrap_or_else(|why| panic!("{why}"));
        let scene = Scene::load(&source, &[], &options).unwrap_or_else(|why| panic!("{name}: {why}"));
        assert_eq!(
            (scene.forces.len(), scene.particles.len()),
            (before.forces.len() + 1, before.particles.len()),
            "{name}"
        );
        assert_eq!((scene.name.as_str(), &scene.about), (name, &before.about));
    }
    let both =
        Source::find("plummer").expect("a scene").beside(&table).and_then(|source| source.beside(&law)).expect("both");
    let scene = Scene::load(&both, &[], &options).unwrap_or_else(|why| panic!("{why}"));
    assert_eq!((scene.particles.mass(), scene.forces.len()), (&[1.0, 2.0][..], 2));
    let absent =
        Source::find("plummer").expect("a scene").beside("/nowhere/law.wgsl").expect_err("no file").to_string();
    assert!(absent.contains("/nowhere/law.wgsl"), "{absent}");
}
