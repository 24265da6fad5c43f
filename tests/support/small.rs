//! Small versions of the built-in scenes.

/// What makes a scene small: the reference of a search looks at all pairs.
pub const SMALLER: &[(&str, &[&str])] = &[
    ("galaxy", &["particles.0.count=120"]),
    ("merger", &["particles.0.count=100", "particles.1.count=100"]),
    ("plummer", &["particles.0.count=100"]),
    ("cold_collapse", &["particles.0.count=100"]),
    ("accretion", &["particles.0.count=100"]),
    ("periodic_box", &["particles.0.size=[5, 5, 5]"]),
    ("cosmic_web", &["particles.0.count_per_side=5"]),
    ("fountain", &["particles.0.count=100", "particles.1.count=100"]),
    ("fountain_pool", &["force.1.spacing=0.04"]),
    ("cloth", &["particles.0.columns=8", "particles.0.rows=8"]),
    ("flag", &["particles.0.columns=8", "particles.0.rows=6"]),
    ("tear", &["particles.0.columns=9", "particles.0.rows=9"]),
    ("jelly", &["particles.0.size=[3, 3, 3]"]),
    ("hair", &["particles.0.strands=12"]),
    ("dam_break", &["force.1.spacing=0.12"]),
    ("dam_break_2d", &["force.1.spacing=0.1"]),
    ("wave_tank", &["force.1.spacing=0.0625"]),
    ("droplet", &["force.0.spacing=0.04"]),
    ("two_drops", &["force.0.spacing=0.05"]),
    ("taylor_green", &["particles.0.spacing=0.05", "force.0.spacing=0.05"]),
    ("flock", &["particles.0.count=150"]),
    ("fish_school", &["particles.0.count=120"]),
    ("vicsek", &["particles.0.count=150"]),
    ("murmuration", &["particles.0.count=150"]),
    ("salt", &["force.0.range=5"]),
    ("argon", &["particles.0.cells=[3, 3, 3]"]),
    ("vapour", &["particles.0.cells=[3, 3, 3]"]),
    (
        "polymer",
        &[
            "particles.0.size=[5, 5, 6]",
            "box.low=[-2.63929375, -2.63929375, -3.1671525]",
            "box.size=[5.2785875, 5.2785875, 6.334305]",
        ],
    ),
    ("nanowire", THIN_WIRE),
    ("pile", FEW_GRAINS.split_at(3).0),
    ("hopper", FEW_GRAINS),
    ("column_collapse", FEW_BEADS),
    ("avalanche", FEW_ON_A_SLOPE),
    ("brazil_nut", &["particles.1.size=[0.05, 0.03, 0.05]"]),
    ("sandcastle", FEW_WET),
    ("room", &["particles.0.count=60"]),
    ("lanes", &["particles.0.count=30", "particles.1.count=30"]),
    ("drum", &["particles.0.size=[0.03, 0.03, 0.04]", "particles.1.size=[0.03, 0.03, 0.04]"]),
];

/// Layers of a few beads, across the whole channel.
const FEW_BEADS: &[&str] = &[
    "particles.0.size=[0.05, 0.06, 0.03]",
    "particles.1.size=[0.05, 0.06, 0.03]",
    "particles.2.size=[0.05, 0.06, 0.03]",
    "particles.3.size=[0.05, 0.06, 0.03]",
];

/// A wire of two cells across.
const THIN_WIRE: &[&str] = &[
    "particles.0.cells=[2, 2, 2]",
    "particles.1.cells=[4, 2, 2]",
    "particles.2.cells=[4, 2, 2]",
    "particles.3.cells=[4, 2, 2]",
    "particles.4.cells=[4, 2, 2]",
    "particles.5.cells=[2, 2, 2]",
];

/// Some beads before the post.
const FEW_ON_A_SLOPE: &[&str] = &[
    "particles.0.size=[0.04, 0.0495, 0.03]",
    "particles.1.size=[0.04, 0.0495, 0.03]",
    "particles.2.size=[0.04, 0.0495, 0.03]",
];

/// Moulds with a few wet grains.
const FEW_WET: &[&str] = &[
    "particles.0.size=[0.006, 0.006, 0.01]",
    "particles.1.size=[0.005, 0.005, 0.008]",
    "particles.2.size=[0.005, 0.005, 0.008]",
];

/// Layers of a few grains.
const FEW_GRAINS: &[&str] = &[
    "particles.0.size=[0.04, 0.04, 0.025]",
    "particles.1.size=[0.04, 0.04, 0.025]",
    "particles.2.size=[0.04, 0.04, 0.025]",
    "particles.3.size=[0.04, 0.04, 0.025]",
    "particles.4.size=[0.04, 0.04, 0.025]",
    // Of the hopper: grains below are removed at once, so that some have been removed wherever a run is cut in two.
    "drain.0.position=[0, 0, 0.1]",
];

/// The overrides that make a scene small; none where it is small as it is.
#[allow(dead_code, reason = "each test uses a part of it")]
pub fn smaller(scene: &str) -> &'static [&'static str] {
    SMALLER.iter().find(|(name, _)| *name == scene).map_or(&[][..], |(_, sets)| sets)
}
