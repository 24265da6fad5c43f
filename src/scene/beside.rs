//! A scene with a file that was put beside it: particles in the place of its own, or a law.

use std::path::Path;

use super::Source;
use super::source::about;
use crate::error::Error;
use crate::formats;

/// The text of a scene in which a file has a part, by its extension: a file of particles takes the place of all of its `[[particles]]`, and a WGSL file becomes one
/// more `[[force]]`, over pairs where its function `force` takes two particles and over each else. A scene that names a law of this name already stays as it is.
/// Of the comments only the first one is kept where particles are replaced. `law` is the text of a WGSL file; of others it is not needed.
///
/// # Errors
/// [`Error::Scene`] when the file is of another kind, or the scene is no TOML.
pub fn with_file(text: &str, name: &str, law: &str) -> Result<String, Error> {
    let path = Path::new(name);
    let mut scene: toml::Table = text
        .parse()
        .map_err(|why: toml::de::Error| Error::Scene(format!("the scene cannot be read: {}", why.message())))?;
    let words = |pairs: &[(&str, &str)]| {
        let text = |(key, value): &(&str, &str)| ((*key).to_owned(), toml::Value::String((*value).to_owned()));
        toml::Value::Table(pairs.iter().map(text).collect())
    };
    if is_law(name) {
        let forces = scene.get("force").and_then(toml::Value::as_array);
        let named = |one: &toml::Value| one.get("wgsl").and_then(toml::Value::as_str) == Some(name);
        let is_there = forces.is_some_and(|all| all.iter().any(named));
        let over = if particles(law) == 2 { "pairs" } else { "each" };
        let entry = toml::Value::Array(vec![words(&[("wgsl", name), ("over", over)])]);
        let entry = toml::Table::from_iter([("force".to_owned(), entry)]);
        let inline = forces.is_some() && !text.contains("[[force]]");
        return match (is_there, inline) {
            (true, _) => Ok(text.to_owned()),
            (_, true) => Err(Error::Scene(
                "its forces are a list in one line: write them as `[[force]]`, so that another can follow".to_owned(),
            )),
            _ => Ok(format!("{}\n\n{entry}", text.trim_end())),
        };
    }
    if formats::by_ending(path).is_none_or(|format| format.read.is_none()) {
        let endings = formats::FORMATS.iter().filter(|format| format.read.is_some()).flat_map(|format| format.endings);
        let known: Vec<String> = endings.map(|ending| format!(".{ending}")).collect();
        return Err(Error::Scene(format!(
            "{name} is neither a scene (.toml), nor a law (.wgsl), nor particles ({}): rename it, or name it in a scene",
            known.join(", ")
        )));
    }
    scene.insert("particles".to_owned(), toml::Value::Array(vec![words(&[("file", name)])]));
    let first: String = about(text).lines().map(|line| format!("# {line}").trim_end().to_owned() + "\n").collect();
    Ok(format!("{first}{}{scene}", if first.is_empty() { "" } else { "\n" }))
}

/// Whether a file is one of WGSL.
#[must_use]
pub fn is_law(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("wgsl"))
}

/// The number of particles that the function `force` of a law takes.
fn particles(law: &str) -> usize {
    let rest = law.split_once("fn force(").map_or("", |(_, rest)| rest);
    rest.split(')').next().unwrap_or_default().matches(": Particle").count()
}

impl Source {
    /// The same scene [with a file](with_file) that was put beside it.
    ///
    /// # Errors
    /// As for [`with_file`], and when the scene or the law cannot be read.
    pub fn beside(&self, name: &str) -> Result<Self, Error> {
        let opened = self.open().map_err(|faults| Error::Scene(faults.to_string()))?;
        // What is too long for a law is refused where the scene is loaded.
        let law = if is_law(name) { std::fs::read_to_string(name) } else { Ok(String::new()) };
        let law = law.map_err(|why| Error::Scene(format!("cannot read {name}: {why}")))?;
        let text = with_file(&opened.text, name, &law)?;
        let name = format!("{}.toml", opened.name);
        Ok(match opened.folder {
            Some(folder) if opened.embedded.is_empty() => Self::Text { name, text, folder },
            _ => Self::Memory { name, text, files: opened.embedded },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: &str = "// fn\nfn force(me: Particle, other: Particle) -> vec4f { return vec4f(); }";
    const SCENE: &str = "# Two of them.\n#\n# They meet.\n\n# Here.\n[simulation]\ndt = 0.01\nsteps = 10\n\n[[particles]]\nshape = \"plummer\"\ncount = 10\n\n[[particles]]\nshape = \"disk\"\n\n[[force]]\nkind = \"gravity\"\n";

    #[test]
    fn particles_take_the_place_of_all_and_the_rest_stays() {
        for name in ["a.csv", "b b.NPZ", "c\".tipsy", "snap.hdf5"] {
            let text = with_file(SCENE, name, "").expect("a scene");
            assert!(text.starts_with("# Two of them.\n#\n# They meet.\n\n"), "{text}");
            let scene: toml::Table = text.parse().expect("TOML");
            let particles = scene["particles"].as_array().expect("a list");
            assert_eq!((particles.len(), particles[0]["file"].as_str()), (1, Some(name)));
            assert_eq!(particles[0].as_table().map(toml::Table::len), Some(1));
            let before: toml::Table = SCENE.parse().expect("TOML");
            assert_eq!((&scene["force"], &scene["simulation"]), (&before["force"], &before["simulation"]));
        }
    }
    #[test]
    fn a_law_is_one_more_force_and_once() {
        let text = with_file(SCENE, "my law.wgsl", LAW).expect("a scene");
        assert!(text.starts_with(SCENE.trim_end()), "what was written stays: {text}");
        let scene: toml::Table = text.parse().expect("TOML");
        let forces = scene["force"].as_array().expect("a list");
        assert_eq!(
            (forces.len(), forces[1]["wgsl"].as_str(), forces[1]["over"].as_str()),
            (2, Some("my law.wgsl"), Some("pairs"))
        );
        assert_eq!(with_file(&text, "my law.wgsl", LAW).expect("a scene"), text);
        let none = SCENE.split("[[force]]").next().expect("a part");
        assert!(
            with_file(none, "a.wgsl", "fn force(me: Particle) -> vec4f { return vec4f(); }")
                .expect("a scene")
                .contains("over = \"each\"")
        );
    }
    #[test]
    fn what_is_not_known_is_refused() {
        let said = |text: &str, name: &str| with_file(text, name, "").expect_err("no").to_string();
        assert!(said(SCENE, "a.docx").contains(".csv") && said(SCENE, "noname").contains(".toml"));
        assert!(said("a = [", "a.csv").contains("cannot be read"), "{}", said("a = [", "a.csv"));
        assert!(said("force = [{ kind = \"gravity\" }]", "a.wgsl").contains("[[force]]"));
    }
}
