//! What names of layers, elements and properties say of shapes.

/// What a shape is by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layer {
    Walls,
    Exits,
    Floor,
    /// What is no part of the plan.
    LeftOut,
}

/// Words of names, and what they say; of several words the first of this list counts.
const WORDS: &[(&str, Layer)] = &[
    ("exit", Layer::Exits),
    ("exits", Layer::Exits),
    ("furniture", Layer::LeftOut),
    ("door", Layer::LeftOut),
    ("doors", Layer::LeftOut),
    ("dimension", Layer::LeftOut),
    ("dimensions", Layer::LeftOut),
    ("text", Layer::LeftOut),
    ("texts", Layer::LeftOut),
    ("label", Layer::LeftOut),
    ("labels", Layer::LeftOut),
    ("annotation", Layer::LeftOut),
    ("annotations", Layer::LeftOut),
    ("wall", Layer::Walls),
    ("walls", Layer::Walls),
    ("floor", Layer::Floor),
];

impl Layer {
    /// What a name says, as of `A-WALL`, `outer walls` or `exit_2`.
    pub fn of(name: &str) -> Option<Self> {
        let has = |word: &str| name.split(|c: char| !c.is_alphabetic()).any(|part| part.eq_ignore_ascii_case(word));
        WORDS.iter().find(|(word, _)| has(word)).map(|(_, layer)| *layer)
    }
}
