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

/// Words of names, and what they say.
const WORDS: &[(&[&str], Layer)] = &[
    (&["exit", "exits"], Layer::Exits),
    (&["door", "doors", "furniture", "stair", "stairs", "dimension", "dimensions"], Layer::LeftOut),
    (&["text", "texts", "label", "labels", "annotation", "annotations"], Layer::LeftOut),
    // No way leads through windows and columns, either.
    (&["wall", "walls", "window", "windows", "column", "columns", "pillar", "pillars"], Layer::Walls),
];
/// The whole name of a floor: with more, as in `Floor 2` or `ground floor`, it is that of a storey.
const FLOOR: [&str; 2] = ["floor", "floors"];

impl Layer {
    /// What a name says, as of `A-WALL`, `outer walls` or `exit_2`; of several words the first of the list counts.
    pub fn of(name: &str) -> Option<Self> {
        let has = |word: &&str| name.split(|c: char| !c.is_alphabetic()).any(|part| part.eq_ignore_ascii_case(word));
        let by_word = WORDS.iter().find(|(words, _)| words.iter().any(&has)).map(|(_, layer)| *layer);
        let is_floor = FLOOR.iter().any(|word| name.trim().eq_ignore_ascii_case(word));
        by_word.or_else(|| is_floor.then_some(Self::Floor))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_whole_names_say_what_it_is() {
        for (name, layer) in [
            ("A-WALL", Some(Layer::Walls)),
            ("outer walls", Some(Layer::Walls)),
            ("Windows_2", Some(Layer::Walls)),
            ("exit-to-wall-street", Some(Layer::Exits)),
            ("exit_2", Some(Layer::Exits)),
            ("wall of the door", Some(Layer::LeftOut)),
            ("Floor", Some(Layer::Floor)),
            ("Floor 2", None),
            ("3-floor", None),
            ("wallpaper", None),
            ("outdoors", None),
            ("", None),
        ] {
            assert_eq!(Layer::of(name), layer, "{name}");
        }
    }
}
