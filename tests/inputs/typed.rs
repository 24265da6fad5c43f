//! Typed settings are the keys of the registers, each once: `UPDATE=1` writes the lists anew.

use std::fmt::Write as _;
use std::path::Path;

use motes::forces::{self, Component};
use motes::settings::{Key, Kind, Settings};
use motes::typed::{self, Gravity, Plummer, Solid, Wind, default};
use motes::{Bounds, Cpu, Error, Setup, Simulation, Solver, integrators, shapes};

/// The type of a field.
fn field(kind: Kind) -> &'static str {
    match kind {
        Kind::Number | Kind::Positive | Kind::NotNegative | Kind::Fraction => "f64",
        Kind::Count => "u32",
        Kind::Whole => "u64",
        Kind::Species => "Option<u32>",
        Kind::Vector | Kind::Direction => "DVec3",
        Kind::Flag => "bool",
        Kind::Pairs(_) => "Vec<Pair>",
        Kind::Choice(_) | Kind::Motion | Kind::Column | Kind::File | Kind::Sides | Kind::Color => "Cow<'static, str>",
    }
}

/// The name of a function; one is a word of Rust's own.
fn function(name: &str) -> &str {
    if name == "box" { "random_box" } else { name }
}

fn camel(name: &str) -> String {
    let upper = |word: &str| word[..1].to_uppercase() + &word[1..];
    function(name).split('_').map(upper).collect()
}

/// A line of documentation.
fn about(text: &str) -> String {
    let text = text.replace('[', "\\[").replace(']', "\\]").replace('<', "\\<");
    // A Greek letter stays as it is: it is a quantity.
    let (first, rest) = text.split_at(text.chars().next().map_or(0, char::len_utf8));
    let first = if first.is_ascii() { first.to_uppercase() } else { first.to_owned() };
    first + rest.trim_end_matches('.') + "."
}

fn listed(head: &str, register: &str, entries: &[(&str, &str, &[Key])]) -> String {
    let mut body = String::new();
    for (name, says, keys) in entries {
        let given: Vec<_> = keys.iter().filter(|key| key.default.is_none()).collect();
        let given: Vec<_> = given.iter().map(|key| format!("{}: {}", key.name, field(key.kind))).collect();
        let (kind, make) = (camel(name), function(name));
        let _ = writeln!(body, "    /// {}", about(says));
        let _ = writeln!(body, "    {kind} \"{name}\" {make}({}) {{", given.join(", "));
        for key in *keys {
            let words = match key.kind {
                Kind::Choice(words) if words.len() > 1 => format!(": {}", words.join(", ")),
                _ => String::new(),
            };
            let _ = writeln!(body, "        /// {}", about(&format!("{}{words}", key.about)));
            let _ = writeln!(body, "        {}: {},", key.name, field(key.kind));
        }
        let _ = writeln!(body, "    }}");
    }
    let mut text = format!("//! {head}, written from the register.\n\n");
    let mut uses = String::new();
    if body.contains("Cow<") {
        text.push_str("use std::borrow::Cow;\n\n");
    }
    if body.contains(": DVec3") {
        text.push_str("use glam::DVec3;\n\n");
    }
    uses.push_str(if body.contains("<Pair>") {
        "use crate::settings::{Pair, Settings};"
    } else {
        "use crate::settings::Settings;"
    });
    let _ = write!(text, "use super::{{Field, typed}};\n{uses}\n\ntyped! {{\n    {register};\n{body}}}\n");
    text
}

#[test]
fn every_key_of_every_register_is_a_field() {
    let forces =
        |list: &'static [forces::Entry]| -> Vec<_> { list.iter().map(|e| (e.name, e.about, e.keys)).collect() };
    let shapes: Vec<_> = shapes::SHAPES.iter().map(|s| (s.name, s.about, s.keys)).collect();
    let lists = [
        ("interactions", listed("Interactions", "force", &forces(motes::interactions::INTERACTIONS))),
        ("constraints", listed("Constraints", "force", &forces(motes::constraints::CONSTRAINTS))),
        ("updaters", listed("Updaters", "force", &forces(motes::updaters::UPDATERS))),
        ("shapes", listed("Shapes", "shape", &shapes)),
    ];
    for (name, wanted) in lists {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("src/typed/{name}.rs"));
        if std::env::var_os("UPDATE").is_some() {
            std::fs::write(&path, &wanted).expect("written");
        }
        let is = std::fs::read_to_string(&path).expect("a list");
        assert!(is == wanted, "src/typed/{name}.rs is not what the register says: UPDATE=1 writes it anew");
    }
}

fn built(force: Box<dyn Component>) -> Result<(), Error> {
    let (bounds, solver) = (Bounds::default(), Solver::default());
    let state = typed::plummer(10).build()?;
    let setup =
        Setup { state, forces: vec![force], integrator: Box::new(integrators::Leapfrog), dt: 0.01, bounds, solver };
    Simulation::on(Cpu::new(10)?, &setup).map(|_| ())
}

#[test]
fn fields_are_settings_by_the_same_names_defaults_and_checks() {
    let entry = forces::entry("gravity").expect("gravity");
    assert_eq!(Gravity::default().settings(), Settings::defaults(entry.keys));
    let set = Gravity { softening: 0.05, ..default() };
    assert_eq!(set.settings(), Settings::defaults(entry.keys).with("softening", 0.05.into()));
    built(set.into()).expect("it makes sense");
    built(Wind { velocity: glam::DVec3::Z, ..default() }.into()).expect("it makes sense");
    built(Solid { species: Some(3), ..default() }.into()).expect("it makes sense");
    let said = |force: Box<dyn Component>| built(force).expect_err("it makes no sense").to_string();
    let low = said(Gravity { softening: -0.5, ..default() }.into());
    assert!(low.contains("`softening`") && low.contains("-0.5") && low.contains("zero or above"), "{low}");
    let word = said(Gravity { over: "tre".into(), ..default() }.into());
    assert!(word.contains("\"tre\"") && word.contains("did you mean \"tree\""), "{word}");
    let none = Plummer { count: 0, ..typed::plummer(5) }.build().expect_err("none").to_string();
    assert!(none.contains("count is 0") && none.contains("1 or above"), "{none}");
    assert_eq!(typed::plummer(1000).build().expect("stars").len(), 1000);
}
