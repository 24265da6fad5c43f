//! Kinds of keys: the values that they accept.

use super::{Key, SIDES, Value, listed, nearest};

/// The values that a key accepts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// Any finite number.
    Number,
    /// A finite number above zero.
    Positive,
    /// A finite number, zero or above.
    NotNegative,
    /// A number above zero, at most one.
    Fraction,
    /// An integer, one or above, that fits 32 bits.
    Count,
    /// An integer, zero or above, that fits 53 bits (a seed).
    Whole,
    /// A species: an integer below 2³² − 1, or the word `all`.
    Species,
    /// Three finite numbers.
    Vector,
    /// Three finite numbers, not all zero: a direction.
    Direction,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// Yes or no.
    Flag,
    /// The name of a motion of the scene, or an empty text: none.
    Motion,
    /// The name of a column, or an empty text: none.
    Column,
    /// The name of a file of the scene, or an empty text: none. A shape gets the contents of the file.
    File,
    /// Some of [`SIDES`], with blanks between them, or an empty text: none.
    Sides,
    /// A colour by name or as "#ffcc88", or an empty text: none.
    Color,
    /// Coefficients of each pair of species, with these keys, as in `[{ species = [0, 1], epsilon = 1.0 }, …]`. Every pair of existing
    /// species is given once, in any order.
    Pairs(&'static [Key]),
}

impl Kind {
    /// Whether a value has the accepted type, regardless of its range.
    pub(super) fn takes(self, value: &Value) -> bool {
        match self {
            Self::Number | Self::Positive | Self::NotNegative | Self::Fraction | Self::Count | Self::Whole => {
                matches!(value, Value::Number(_))
            }
            Self::Species => matches!(value, Value::Number(_) | Value::Text(_)),
            Self::Vector | Self::Direction => matches!(value, Value::Vector(_)),
            Self::Choice(_) | Self::Motion | Self::Column | Self::File | Self::Sides | Self::Color => {
                matches!(value, Value::Text(_))
            }
            Self::Flag => matches!(value, Value::Flag(_)),
            Self::Pairs(keys) => matches!(value, Value::Pairs(rows) if rows.iter().all(|row| row.fits(keys))),
        }
    }
    /// A description of the accepted values, for "… must be …".
    #[must_use]
    pub fn wanted(self) -> String {
        match self {
            Self::Number => "a number".to_owned(),
            Self::Positive => "a number above zero".to_owned(),
            Self::NotNegative => "a number, zero or above".to_owned(),
            Self::Fraction => "a number above zero, 1 at most".to_owned(),
            Self::Count => "a whole number, one or above".to_owned(),
            Self::Whole => "a whole number, zero or above".to_owned(),
            Self::Species => "a whole number, zero or above, or \"all\"".to_owned(),
            Self::Vector => "three numbers".to_owned(),
            Self::Direction => "three numbers, not all zero".to_owned(),
            Self::Choice([only]) => format!("\"{only}\""),
            Self::Choice(known) => format!("one of {}", listed(known.iter().copied())),
            Self::Flag => "true or false".to_owned(),
            Self::Motion => "the name of a motion".to_owned(),
            Self::Column => "the name of a column".to_owned(),
            Self::File => "the name of a file".to_owned(),
            Self::Sides => format!("some of {}, with blanks between them", listed(SIDES.iter().copied())),
            Self::Color => "a colour such as \"#ffcc88\" or \"gold\"".to_owned(),
            Self::Pairs(_) => {
                "a list of tables, one for each pair of species, as in [{ species = [0, 1], epsilon = 1.0 }]".to_owned()
            }
        }
    }
    /// Whether it accepts only integers.
    #[must_use]
    pub fn is_whole(self) -> bool {
        matches!(self, Self::Count | Self::Whole | Self::Species)
    }
    /// The largest accepted number.
    #[must_use]
    pub fn largest(self) -> f64 {
        match self {
            Self::Count => f64::from(u32::MAX),
            Self::Whole => LARGEST_WHOLE,
            // The last one stands for all.
            Self::Species => f64::from(u32::MAX - 1),
            _ => f64::from(f32::MAX),
        }
    }
    /// The reason why a number is outside the accepted range, if it is.
    #[must_use]
    pub fn outside(self, x: f64) -> Option<Outside> {
        let low = match self {
            Self::Positive => x <= 0.0,
            Self::Fraction => x <= 0.0 || x > 1.0,
            Self::NotNegative | Self::Whole | Self::Species => x < 0.0,
            Self::Count => x < 1.0,
            _ => false,
        };
        if x.is_nan() || x.is_infinite() {
            Some(Outside::NotFinite)
        } else if self.is_whole() && x.fract() != 0.0 {
            Some(Outside::Broken)
        } else if low {
            Some(Outside::Range)
        } else if x.abs() > self.largest() {
            Some(Outside::TooLarge)
        } else if is_lost(x) && (matches!(self, Self::Positive | Self::Fraction) || x != 0.0) {
            Some(Outside::TooSmall)
        } else {
            None
        }
    }
    /// The reason for refusing a value of the accepted type: the number.
    pub(super) fn refuses(self, value: &Value) -> Option<String> {
        let number = |kind: Self, x: f64| kind.outside(x).map(|outside| format!("{x}{}", outside.because()));
        match (self, value) {
            (Self::Vector | Self::Direction, Value::Vector(v)) => {
                let zero = self == Self::Direction && v.to_array().into_iter().all(is_lost);
                let three = || v.to_array().into_iter().find_map(|x| number(Self::Number, x));
                if zero { Some(format!("{v}")) } else { three() }
            }
            (Self::Species, Value::Text(word)) => (word != "all").then(|| format!("\"{word}\"")),
            (Self::Choice(known), Value::Text(word)) => (!known.contains(&word.as_ref())).then(|| {
                let near = nearest(word, known.iter().copied()).map(|near| format!(" (did you mean \"{near}\"?)"));
                format!("\"{word}\"{}", near.unwrap_or_default())
            }),
            (Self::Sides, Value::Text(words)) => {
                words.split_whitespace().find(|word| !SIDES.contains(word)).map(|word| format!("\"{word}\""))
            }
            (Self::Pairs(keys), Value::Pairs(rows)) => rows.iter().flat_map(|row| &row.values).find_map(|(name, x)| {
                let key = keys.iter().find(|key| key.name == name)?;
                key.kind.outside(*x).map(|_| format!("{x} for `{name}`, which must be {}", key.kind.wanted()))
            }),
            (_, Value::Number(x)) => number(self, *x),
            _ => None,
        }
    }
}

/// The reasons why a number is not accepted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outside {
    /// It is NaN or infinite.
    NotFinite,
    /// It is not an integer.
    Broken,
    /// Below the minimum, or above the maximum of a fraction.
    Range,
    /// Beyond the range of the device.
    TooLarge,
    /// It would be zero in single precision.
    TooSmall,
}

impl Outside {
    fn because(self) -> &'static str {
        match self {
            Self::NotFinite | Self::Range => "",
            Self::Broken => ", which is not whole",
            Self::TooLarge => ", which is too large",
            Self::TooSmall => ", which is zero in single precision",
        }
    }
}

/// Above this integers are no longer exact in f64.
pub const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// Whether a number that is not zero becomes zero in single precision, subnormal numbers being flushed as GPUs may do.
#[must_use]
pub fn is_lost(value: f64) -> bool {
    value.abs() < f64::from(f32::MIN_POSITIVE)
}
