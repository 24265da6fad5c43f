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
    "solar_system",
    "galaxy",
    "merger",
    "plummer",
    "cold_collapse",
    "periodic_box",
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
    "nanowire",
    "pile",
    "hopper",
    "column_collapse",
    "drum",
    "avalanche",
    "brazil_nut",
    "sandcastle",
    "room",
];
