//! The house rules, read off the sources: small rooms, one direction, one place for each thing.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;

/// A file of the project: its path with slashes, its text.
struct File {
    path: String,
    text: String,
}

impl File {
    /// Its lines without comments, numbered from 1.
    fn code(&self) -> impl Iterator<Item = (usize, &str)> {
        self.text.lines().map(|line| line.split("//").next().unwrap_or_default()).zip(1..).map(|(l, n)| (n, l))
    }
    fn stem(&self) -> &str {
        self.path.rsplit('/').next().unwrap_or_default().split('.').next().unwrap_or_default()
    }
    /// The module under `src/` that it belongs to.
    fn module(&self) -> Option<&str> {
        self.path.strip_prefix("src/")?.split(['/', '.']).next()
    }
}

/// All files of an ending, under the folders that hold sources.
fn files(ending: &str) -> Vec<File> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = ["src", "shaders", "tests", "examples", "benches", "page"];
    let files: Vec<File> = folders.iter().flat_map(|folder| texts(&root.join(folder), root, ending)).collect();
    assert!(files.len() > 20, "{} files in .{ending} are not the project", files.len());
    files
}

/// All files of an ending in a folder and below, by their paths.
fn texts(folder: &Path, root: &Path, ending: &str) -> Vec<File> {
    let (mut files, mut folders) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(folder) = folders.pop() {
        let Ok(entries) = std::fs::read_dir(&folder) else { continue };
        for path in entries.map(|e| e.expect("an entry").path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == ending) {
                let name = path.strip_prefix(root).expect("inside").to_string_lossy().replace('\\', "/");
                files.push(File { path: name, text: std::fs::read_to_string(&path).expect("a text") });
            }
        }
    }
    files.sort_by(|a, b| a.path.cmp(&b.path));
    files
}

/// The words of a line of code.
fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|w| !w.is_empty())
}

fn assert_none(rule: &str, faults: &[String]) {
    let mut list = String::new();
    for fault in faults {
        let _ = write!(list, "\n  {fault}");
    }
    assert!(faults.is_empty(), "{rule}{list}");
}

#[test]
fn rooms_are_small() {
    let long = |ending, most: usize| -> Vec<String> {
        // The lists of `typed` are written from the registers, and as long as these.
        let files =
            files(ending).into_iter().filter(|f| !f.path.starts_with("src/typed/") || f.path == "src/typed/mod.rs");
        let files = files.map(|f| (f.text.lines().count(), f.path));
        files.filter(|(lines, _)| *lines > most).map(|(lines, path)| format!("{path}: {lines}")).collect()
    };
    assert_none("a .rs has 500 lines at most; split it along a noun", &long("rs", 500));
    assert_none("a .wgsl has 200 lines at most", &long("wgsl", 200));
}

#[test]
fn files_are_named_after_what_they_hold() {
    let vague = ["utils", "util", "helpers", "helper", "common", "misc", "stuff"];
    let all = files("rs").into_iter().chain(files("wgsl"));
    let faults: Vec<_> = all.filter(|f| f.path.split(['/', '.']).any(|p| vague.contains(&p))).map(|f| f.path).collect();
    assert_none("a file is named after a noun of the field", &faults);
}

#[test]
fn nothing_is_put_off() {
    // In two parts, so that this line is none.
    let marks = [["TO", "DO"].concat(), ["FIX", "ME"].concat()];
    let all = files("rs").into_iter().chain(files("wgsl"));
    let marked = |f: &File| f.text.lines().any(|line| words(line).any(|w| marks.iter().any(|m| m == w)));
    let faults: Vec<_> = all.filter(marked).map(|f| f.path).collect();
    assert_none("a known bug is a test that says so", &faults);
}

/// Where a device is named outside of the folder that runs it: the door of rendering apps, and signatures that pass on
/// what the owner of a device has.
const DOORS: [&str; 4] = ["src/simulation.rs", "src/lib.rs", "src/selftest.rs", "src/cli/engine.rs"];

#[test]
fn wgpu_lives_in_one_folder() {
    let mut faults = Vec::new();
    for file in files("rs").iter().filter(|f| f.module().is_some_and(|m| m != "gpu")) {
        if DOORS.contains(&file.path.as_str()) {
            // No more than types: nothing is made or called there.
            let calls = |l: &str| l.contains("wgpu::") && l.contains("Descriptor") || l.contains("device.create");
            faults.extend(file.code().filter(|(_, l)| calls(l)).map(|(n, _)| format!("{}:{n}: a call", file.path)));
        } else {
            let named = file.code().filter(|(_, l)| words(l).any(|w| w == "wgpu"));
            faults.extend(named.map(|(n, _)| format!("{}:{n}", file.path)));
        }
    }
    assert_none("wgpu is named in src/gpu alone", &faults);
}

#[test]
fn waiting_is_for_the_edge() {
    let mut faults = Vec::new();
    for file in files("rs").iter().filter(|f| f.module().is_some_and(|m| !["main", "cli"].contains(&m))) {
        let waits = file.code().filter(|(_, l)| words(l).any(|w| w == "block_on" || w == "pollster"));
        faults.extend(waits.map(|(n, _)| format!("{}:{n}", file.path)));
    }
    assert_none("the library never blocks: block_on is for main, tests and examples", &faults);
}

#[test]
fn no_binding_number_is_written_in_rust() {
    let mut faults = Vec::new();
    for file in files("rs").iter().filter(|f| f.module().is_some()) {
        for (n, line) in file.code() {
            // `binding: 3` of a layout or a bind group, `set_bind_group(1, …)`; a message may show a user what to write.
            let number_after = |text: &str| {
                line.split(text).skip(1).any(|rest| rest.trim_start().starts_with(|c: char| c.is_ascii_digit()))
            };
            let shown = line.contains('`') && line.contains("@group");
            if number_after("binding:") || number_after("set_bind_group(") || line.contains("@binding") && !shown {
                faults.push(format!("{}:{n}: {}", file.path, line.trim()));
            }
        }
    }
    assert_none("names are the contract: reflection reads the numbers", &faults);
}

/// A module may name only what stands before it.
const ORDER: [&str; 44] = [
    "error",
    "settings",
    "links",
    "motion",
    "solids",
    "life",
    "floor_plan",
    "kernel",
    "state",
    "boundary",
    "primitives",
    "rotation",
    "neighbors",
    "tree",
    "visit",
    "grains",
    "crowds",
    "cosmology",
    "ewald",
    "sph",
    "component",
    "constraints",
    "interactions",
    "updaters",
    "forces",
    "shapes",
    "typed",
    "integrators",
    "cpu",
    "gpu",
    "formats",
    "render",
    "simulation",
    "measure",
    "stability",
    "diagnose",
    "lockstep",
    "selftest",
    "scene",
    "run",
    "evacuation",
    "view",
    "cli",
    "examples",
];
/// The backends know kernels and nothing of physics; only these know them.
const KNOW_BACKENDS: [&str; 5] = ["simulation", "stability", "lockstep", "selftest", "cli"];

/// The modules that a line names, in `crate::…` or `motes::…`.
fn named(line: &str) -> Vec<&str> {
    let after = |rest: &'static str| line.split(rest).skip(1);
    let roots = after("crate::").chain(after("motes::"));
    roots
        .flat_map(|rest| match rest.strip_prefix('{') {
            Some(list) => words(list.split('}').next().unwrap_or_default()).collect(),
            None => words(rest).take(1).collect::<Vec<_>>(),
        })
        .collect()
}

#[test]
fn modules_stand_in_one_line() {
    let mut faults = Vec::new();
    let mut seen = BTreeSet::new();
    for file in files("rs") {
        let Some(module) = file.module().filter(|m| !["lib", "main"].contains(m)) else { continue };
        seen.insert(module.to_owned());
        let Some(place) = ORDER.iter().position(|m| *m == module) else {
            faults.push(format!("{}: `{module}` has no place in the line", file.path));
            continue;
        };
        for (n, line) in file.code() {
            for other in named(line).into_iter().filter(|m| ORDER.contains(m) && *m != module) {
                let later = ORDER.iter().position(|m| *m == other).is_some_and(|p| p > place);
                let physics = ["cpu", "gpu"].contains(&module) && !["error", "kernel"].contains(&other);
                let backend = ["cpu", "gpu"].contains(&other) && !KNOW_BACKENDS.contains(&module);
                if later || physics || backend {
                    faults.push(format!("{}:{n}: `{module}` names `{other}`", file.path));
                }
            }
        }
    }
    for module in ORDER.iter().filter(|m| !seen.contains(**m)) {
        faults.push(format!("there is no module `{module}` any more"));
    }
    assert_none(&format!("a module names only what stands before it in {ORDER:?}"), &faults);
}

/// The folders of components, each with a register.
const ROLES: [(&str, &[motes::forces::Entry]); 3] = [
    ("constraints", motes::constraints::CONSTRAINTS),
    ("interactions", motes::interactions::INTERACTIONS),
    ("updaters", motes::updaters::UPDATERS),
];

#[test]
fn every_component_is_one_shader_and_one_rust_file_of_its_name() {
    let mut faults = Vec::new();
    let (rust, wgsl) = (files("rs"), files("wgsl"));
    for (folder, register) in ROLES {
        let inside = |list: &[File], top: &str| -> Vec<String> {
            let folder = format!("{top}/{folder}/");
            list.iter().filter(|f| f.path.starts_with(&folder)).map(|f| f.stem().to_owned()).collect()
        };
        let (hosts, shaders) = (inside(&rust, "src"), inside(&wgsl, "shaders"));
        let hosted = |file: &&File| file.path.starts_with(&format!("src/{folder}/"));
        for entry in register {
            for (list, what) in [(&hosts, "src/{}.rs"), (&shaders, "shaders/{}.wgsl")] {
                // What takes a method of several searches has its shaders where the method is.
                let method =
                    |host: &&File| hosted(host) && host.stem() == entry.name && host.text.contains("crate::sph");
                let elsewhere = what.ends_with("wgsl") && rust.iter().any(|host| method(&host));
                if !elsewhere && !list.iter().any(|stem| stem == entry.name) {
                    faults.push(format!(
                        "`{}` has no {}",
                        entry.name,
                        what.replace("{}", &format!("{folder}/{}", entry.name))
                    ));
                }
            }
        }
        // A second law of a component is named after it: gravity_spline is gravity's.
        for shader in &shaders {
            let owner = |host: &&File| {
                let its = host.stem() == shader || shader.strip_prefix(host.stem()).is_some_and(|r| r.starts_with('_'));
                its && hosted(host) && host.text.contains(&format!("shader!(\"{folder}/{shader}.wgsl\")"))
            };
            if !rust.iter().any(|host| owner(&host)) {
                faults.push(format!("shaders/{folder}/{shader}.wgsl belongs to no src/{folder}/*.rs of its name"));
            }
        }
        // What is no component has no shader.
        for host in rust.iter().filter(hosted) {
            let registered = register.iter().any(|e| e.name == host.stem());
            if !registered && host.text.contains("shader!(") {
                faults.push(format!("{} has a shader, and is not in the register", host.path));
            }
        }
    }
    for entry in motes::integrators::INTEGRATORS {
        if !rust.iter().any(|f| f.path == format!("src/integrators/{}.rs", entry.name)) {
            faults.push(format!("`{}` has no file of its name", entry.name));
        }
    }
    assert_none("one concept, one name", &faults);
}

#[test]
fn shaders_are_used_and_say_what_they_are() {
    let mut faults = Vec::new();
    let rust = files("rs");
    for shader in files("wgsl").iter().filter(|f| f.path.starts_with("shaders/")) {
        let first = shader.text.lines().next().unwrap_or_default();
        if !first.starts_with("// ") || first.to_lowercase().contains("shader") {
            faults.push(format!("{}: its first line is no equation, rule or source: `{first}`", shader.path));
        }
        let call = format!("shader!(\"{}\")", shader.path.trim_start_matches("shaders/"));
        if !rust.iter().any(|f| f.path.starts_with("src/") && f.text.contains(&call)) {
            faults.push(format!("{}: no kernel joins it", shader.path));
        }
        for (n, line) in shader.code() {
            let sides = |op: &str| line.split(op).collect::<Vec<_>>();
            for pair in sides(" != ").windows(2).chain(sides(" == ").windows(2)) {
                let (left, right) = (words(pair[0]).last(), words(pair[1]).next());
                // The self test asks what a driver makes of just that.
                let asked = shader.path.starts_with("shaders/selftest/");
                if !asked && left.is_some() && left == right && pair[0].ends_with(left.unwrap_or_default()) {
                    faults.push(format!("{}:{n}: `x != x` is false for NaN here: test the bits", shader.path));
                }
            }
            for mark in ["{{", "#if", "#include", "#define"] {
                if line.contains(mark) {
                    faults.push(format!("{}:{n}: plain WGSL has no `{mark}`", shader.path));
                }
            }
        }
    }
    assert_none("shaders are plain, used, and open with what they compute", &faults);
}

/// Words for persons; in two parts, so that this list is no fault of its own. `whose` is said of things as well: it is left to readers.
const PERSONS: [[&str; 2]; 8] = [
    ["wh", "o"],
    ["wh", "om"],
    ["whoe", "ver"],
    ["every", "body"],
    ["no", "body"],
    ["some", "body"],
    ["fe", "lt"],
    ["to", "ld"],
];

/// Particles are things, in sources, tests, pages, scenes and the history: also in parts of names.
#[test]
fn particles_are_no_persons() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut all: Vec<File> = files("rs").into_iter().chain(files("wgsl")).collect();
    for (folder, ending) in [("docs", "md"), ("scenes", "toml"), ("benches", "md")] {
        all.extend(texts(&root.join(folder), root, ending));
    }
    for path in ["README.md", "CHANGELOG.md"] {
        all.push(File { path: path.to_owned(), text: std::fs::read_to_string(root.join(path)).expect("a text") });
    }
    let persons = PERSONS.map(|parts| parts.concat());
    let mut faults = Vec::new();
    for file in &all {
        for (line, n) in file.text.lines().zip(1..) {
            let line = line.to_lowercase();
            let mut parts = line.split(|c: char| !c.is_alphabetic());
            if let Some(word) = parts.find(|w| persons.iter().any(|p| p == w)) {
                faults.push(format!("{}:{n}: `{word}`", file.path));
            }
        }
    }
    assert_none("particles are things: write `particle i`, `neighbours`, `all pairs`, `none`, …", &faults);
}
