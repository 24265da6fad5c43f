//! Descriptions of keys that a section's own file reads: lists, tables and names, for which [`Key`](crate::settings::Key) has no kind.

/// A key that a section reads by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Own {
    /// The name in the scene.
    pub name: &'static str,
    /// The default, in words.
    pub default: &'static str,
    /// One line: what it means, and its unit.
    pub about: &'static str,
}

const fn own(name: &'static str, default: &'static str, about: &'static str) -> Own {
    Own { name, default, about }
}

pub(super) const SIMULATION: &[Own] = &[
    own("steps", "or until, or until_redshift", "how many steps"),
    own(
        "until",
        "or steps",
        "the time at which the run ends; if it is not a multiple of dt, dt is reduced, and a note says so [time]",
    ),
    own(
        "until_redshift",
        "or steps",
        "where space expands, the redshift at which the run ends: dt is reduced such that whole steps end there",
    ),
    own("integrator", "\"leapfrog\"", "the integrator, by its name"),
];
pub(super) const BOX: &[Own] = &[
    own("x", "as boundary", "the boundary at the two sides across x"),
    own("y", "as boundary", "the boundary at the two sides across y"),
    own("z", "as boundary", "the boundary at the two sides across z"),
    own("dimensions", "3; flat: 2", "2 or 3: in 2 all particles stay in one plane"),
];
pub(super) const PLAN: &[Own] = &[
    own("file", "this or wkt", "a file with the plan, as WKT, GeoJSON, SVG, DXF or PNG"),
    own(
        "wkt",
        "this or file",
        "the plan as well-known text, in the scene itself: POLYGONs are the floor, each LINESTRING on it is an exit",
    ),
    own("exits", "those of the file; else exit 1, exit 2, …", "the names of exits, in their order in the file"),
    own(
        "scale",
        "that of the file",
        "the length of a unit of the file, or the scale of a drawing on paper, as in \"1:100\" [length]",
    ),
    own(
        "pixel",
        "0.02, or more where these are too many",
        "the side of the pixels on which drawings (SVG, DXF, GeoJSON with walls) are drawn, or of those of a picture (PNG) [length]",
    ),
];
pub(super) const MOTION: &[Own] = &[
    own("name", "must be given", "the name by which particles and obstacles refer to it"),
    own(
        "keys",
        "must be given",
        "poses by time: [{ time = 0 }, { time = 2, shift = [1, 0, 0], turn = [0, 0, 90] }] [time, length, degrees]",
    ),
];
pub(super) const COLUMN: &[Own] = &[
    own("name", "must be given", "its name in WGSL, in scenes and in files"),
    own("unit", "none", "its unit, such as \"length / time\""),
    own("initial", "must be given by all", "the value of particles for which none is given"),
    own("rate", "none", "the column that is its rate of change, by which integrators advance it"),
];
pub(super) const PARTICLES: &[Own] = &[
    own("shape", "or file, bodies", "a shape by its name, with its keys"),
    own("file", "or shape, bodies", "a CSV, NPZ or Tipsy file in the scene's folder"),
    own(
        "bodies",
        "or shape, file",
        "written out: [{ position = [1, 0, 0], velocity = [0, 1, 0], mass = 1, size = 0 }]",
    ),
    own("color", "by the palette", "a colour by name, or as \"#ffcc88\""),
    own(
        "fixed",
        "none",
        "fixed particles, which forces do not move: \"all\", or a list of ids, counted from 0 in this entry",
    ),
    own("motion", "none", "the name of the motion that moves the fixed particles"),
];
pub(super) const EMITTER: &[Own] = &[
    own("color", "by the palette", "a colour by name, or as \"#ffcc88\""),
    own("species", "0", "the species of its particles"),
    own("first", "behind all others", "the first id of its particles, where a file has them as pending particles"),
];
pub(super) const LINKS: &[Own] = &[
    own(
        "file",
        "or pairs, joints, dihedrals",
        "a CSV file with the columns a, b and any of c, d, rest, stiffness, damping, tie, angle, multiplicity, phase",
    ),
    own("pairs", "or file, joints, dihedrals", "ids of the two: [[0, 1], [1, 2]]"),
    own("joints", "or file, pairs, dihedrals", "ids of the three, the second in the middle: [[0, 1, 2], [1, 2, 3]]"),
    own("dihedrals", "or file, pairs, joints", "ids of the four along the bonds: [[0, 1, 2, 3]]"),
];
pub(super) const FORCE: &[Own] = &[
    own("kind", "or wgsl", "a force by its name, with its keys"),
    own("wgsl", "or kind", "a file of your own law in WGSL"),
    own(
        "over",
        "must be given",
        "wgsl: each, pairs, within, near, list, nearest, tree, auto, links, joints, dihedrals or triangles",
    ),
    own("range", "must be given", "wgsl over within, near and list: the cut-off radius [length]"),
    own(
        "skin",
        "a fifth of the range",
        "wgsl over list: the skin of its list beyond the range; without one it is chosen anew while it runs [length]",
    ),
    own("exclude", "0", "wgsl over list or auto: pairs up to so many bonds apart are left out, as in lennard_jones"),
    own("slots", "0", "wgsl over list: history variables of each pair, which persist from step to step"),
    own("neighbors", "must be given", "wgsl over nearest: the number k of neighbours"),
    own("theta", "must be given", "wgsl over tree and auto: the opening angle, at most 1"),
    own("params", "{}", "wgsl: the members of its Params, as in { strength = 2.0, axis = [0, 0, 1] }"),
    own("pairs", "none", "wgsl: parameters of pairs of species"),
    own("tables", "none", "wgsl: tables of numbers, by the names under which the file binds them"),
    own("into", "[\"acceleration\"]", "wgsl: the columns that it writes"),
    own(
        "grains",
        "false",
        "wgsl: whether its particles are grains with radius, inertia, orientation, angular_velocity and torque, as those of `contact`",
    ),
];
pub(super) const OUTPUT: &[Own] = &[
    own("every", "a tenth of steps", "the number of steps between written states"),
    own(
        "formats",
        "[\"csv\", \"png\"]",
        "formats of states: any of npz, xyz, csv, …, and png for pictures; []: only energy.csv",
    ),
    own(
        "columns",
        "[]",
        "additional columns of written states: quantities that laws compute, as in [\"acceleration\"]",
    ),
    own("frames", "0", "pictures of a film, evenly spaced over the run; 0 for none"),
];
pub(super) const MEASURE: &[Own] = &[
    own("kind", "must be given", "a measure by its name, with its keys"),
    own("every", "as [output]", "the number of steps between rows, or \"0.5 time\" of the scene"),
];
pub(super) const CHECKPOINT: &[Own] = &[own(
    "every",
    "\"10 min\"",
    "the interval between checkpoints: \"10 min\" (or s, h) of wall-clock time, \"5000 steps\", \"0.5 time\" of the scene, or \"never\"; a \
     run that is stopped writes one in any case",
)];
