//! The keys of `[picture]`.

use std::borrow::Cow;

use glam::DVec3;

use crate::settings::{Key, Kind, Preset, Value};

const fn word(text: &'static str) -> Value {
    Value::Text(Cow::Borrowed(text))
}

/// What a scene may say in `[picture]`.
pub const KEYS: &[Key] = &[
    Key::new("width", Kind::Count, Value::Number(1280.0), "from left to right [pixels]"),
    Key::new("height", Kind::Count, Value::Number(720.0), "from top to bottom [pixels]"),
    Key::new("eye", Kind::Direction, Value::Vector(DVec3::new(0.35, -1.0, 0.7)), "from the centre towards the eye"),
    Key::new("up", Kind::Direction, Value::Vector(DVec3::Z), "the direction that is up in the picture"),
    Key::new(
        "projection",
        Kind::Choice(&["perspective", "orthographic"]),
        word("perspective"),
        "perspective projection; false: parallel projection",
    ),
    Key::new(
        "auto_frame",
        Kind::Flag,
        Value::Flag(true),
        "look at all particles but the outermost, and at their trails; each picture by itself, a film once",
    ),
    Key::new("center", Kind::Vector, Value::Vector(DVec3::ZERO), "what to look at, without auto_frame [length]"),
    Key::new(
        "extent",
        Kind::Positive,
        Value::Number(1.0),
        "half the height of the picture at the centre, without auto_frame [length]",
    ),
    Key::new(
        "slab",
        Kind::NotNegative,
        Value::Number(0.0),
        "draw only a slab of this thickness about the centre, across the line of sight; 0: everything [length]",
    ),
    Key::new(
        "style",
        Kind::Choice(super::styles::NAMES),
        word("auto"),
        "how particles are drawn: as balls where they are few or large, as points of light, as balls, as the surface of a fluid, or as surface density, with notes unless annotate = false",
    )
    .with_presets(&[Preset { word: "density", defaults: &[("annotate", Value::Flag(true))] }]),
    Key::new(
        "size",
        Kind::Positive,
        Value::Number(1.0),
        "how large balls and lights are drawn, as a multiple of what they are: lights up to a radius of 100 pixels, balls of many up to 80",
    ),
    Key::new(
        "drop",
        Kind::NotNegative,
        Value::Number(0.0),
        "of a fluid: the radius of a drop; 0: 0.75 of the particle spacing at the start [length]",
    ),
    Key::new(
        "clarity",
        Kind::NotNegative,
        Value::Number(0.0),
        "of a fluid: the visibility depth; 0: that of water, or small where colours have a meaning [length]",
    ),
    Key::new(
        "foam",
        Kind::NotNegative,
        Value::Number(0.0),
        "of a fluid: the speed above which it is drawn as white foam; 0: never [length / time]",
    ),
    Key::new(
        "color",
        Kind::Choice(&["auto", "group", "speed", "heading", "column"]),
        word("auto"),
        "by group of particles, by speed, by heading (hue round the z axis, lighter upwards), by a column; auto: by speed where many are one group",
    ),
    Key::new(
        "column",
        Kind::Column,
        word(""),
        "with color = \"column\": its name, such as density; of vectors the length is shown; logarithmic where values are positive and 100 times apart",
    ),
    Key::new(
        "draw",
        Kind::Choice(&["auto", "points", "surface", "lines"]),
        word("auto"),
        "links: triangles as a surface and other springs and rods as lines; no links; only triangles; all springs and rods as lines",
    ),
    Key::new(
        "tail",
        Kind::NotNegative,
        Value::Number(0.0),
        "draw each particle as a streak from its position this long ago [time]",
    ),
    Key::new(
        "exposure",
        Kind::Positive,
        Value::Number(1.0),
        "brightness of lights, as a multiple of the automatic one",
    ),
    Key::new(
        "bloom",
        Kind::NotNegative,
        Value::Number(1.0),
        "brightness of the bloom around lights in the dark, as a multiple of the usual one; 0: none",
    ),
    Key::new(
        "annotate",
        Kind::Flag,
        Value::Flag(false),
        "write the time, the axes, a bar of length (at the centre) and the scale of colours in the corners, and outline a closed box",
    ),
    Key::new(
        "background",
        Kind::Choice(&["night", "black", "dusk", "day", "sea", "paper"]),
        word("night"),
        "a dark blue sky; nothing; a bright sky, at dusk or by day, with lights and trails as ink; water; or white paper, with coloured inks",
    ),
];
