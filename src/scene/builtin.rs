//! The built-in scenes: `motes run galaxy`.

/// A built-in scene.
#[derive(Debug)]
pub struct Builtin {
    /// Its name for `motes run`.
    pub name: &'static str,
    /// The scene.
    pub text: &'static str,
    /// The files that it names, by name, with their text.
    pub files: &'static [(&'static str, &'static str)],
}

impl Builtin {
    /// Its first comment: what the run shows.
    #[must_use]
    pub fn about(&self) -> String {
        super::source::about(self.text)
    }
}

macro_rules! scenes {
    ($($name:literal),* $(,)?) => {
        &[$(Builtin { name: $name, text: include_str!(concat!("../../scenes/", $name, ".toml")), files: &[] }),*]
    };
}

/// All of them, in the order in which a newcomer would try them.
pub const SCENES: &[Builtin] = scenes![
    "throw",
    "kepler",
    "figure_eight",
    "pythagorean",
    "solar_system",
    "galaxy",
    "merger",
    "plummer",
    "cold_collapse",
    "accretion",
    "periodic_box",
    "cosmic_web",
    "fountain",
    "fountain_pool",
    "pendulum",
    "double_pendulum",
    "spring_chain",
    "stiff",
    "cloth",
    "flag",
    "tear",
    "jelly",
    "hair",
    "dam_break",
    "dam_break_2d",
    "wave_tank",
    "droplet",
    "two_drops",
    "hydrostatic",
    "taylor_green",
    "poiseuille",
    "flock",
    "fish_school",
    "vicsek",
    "murmuration",
    "salt",
    "argon",
    "vapour",
    "polymer",
    "nanowire",
    "pile",
    "hopper",
    "column_collapse",
    "drum",
    "avalanche",
    "brazil_nut",
    "sandcastle",
    "room",
    "lanes",
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Machine;
    use crate::scene::{Options, Scene, Source};

    /// Every dispatch that claims to treat particles alone, in all built-in scenes and with every integrator, names an element by the index of
    /// its own invocation.
    #[test]
    fn kernels_that_are_marked_look_at_no_other_particle() {
        let mut seen = std::collections::BTreeSet::new();
        for scene in SCENES {
            let source = Source::find(scene.name).expect("a built-in scene");
            for integrator in ["", "rk4", "beeman", "implicit_midpoint"] {
                let set = format!("simulation.integrator={integrator}");
                let overrides = if integrator.is_empty() { vec![] } else { vec![set] };
                // Not every scene goes with every integrator.
                let Ok(mut loaded) = Scene::load(&source, &overrides, &Options::default()) else { continue };
                let Ok(plans) = loaded.setup().plans(Machine::HOST) else { continue };
                let marked = |kernel: &&crate::kernel::Kernel| kernel.passes.iter().any(|pass| pass.alone);
                for kernel in plans.all().flat_map(|plan| &plan.kernels).filter(marked) {
                    assert!(crate::visit::looks_at_own(kernel), "{}: {}", scene.name, kernel.name);
                    seen.insert(kernel.name.split_whitespace().next().unwrap_or_default().to_owned());
                }
            }
        }
        assert!(seen.len() > 25, "{seen:?}");
    }
}
