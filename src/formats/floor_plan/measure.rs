//! Lengths of a plan whose file does not have them.

use std::str::FromStr;

/// The side of the pixels that drawings are drawn on, unless it is given or would make too many \[m\].
pub const PIXEL: f64 = 0.02;

/// The scale of a plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scale {
    /// The length of a unit of the file \[m\].
    Unit(f64),
    /// How many times larger the floor is than the paper: 100 for 1:100.
    Paper(f64),
}

/// What is known of lengths beside the file.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Measure {
    /// Its scale, where it is given.
    pub scale: Option<Scale>,
    /// The side of a pixel, where it is given \[m\].
    pub pixel: Option<f64>,
}

/// A length for a message, to a thousandth.
pub(super) fn rounded(x: f64) -> f64 {
    (1e3 * x).round() / 1e3
}

impl FromStr for Scale {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|x| (1e-9..=1e9).contains(x));
        let scale = match text.split_once(':') {
            Some((one, of)) => number(one).zip(number(of)).map(|(one, of)| Self::Paper(of / one)),
            None => number(text).map(Self::Unit),
        };
        scale.ok_or_else(|| {
            "it must be the length of a unit of the file in metres, as in 0.01, or that of a drawing on paper, as in 1:100".to_owned()
        })
    }
}

impl Measure {
    /// The side of the pixels of a picture \[m\].
    #[cfg(feature = "images")]
    pub(super) fn of_picture(&self) -> Result<f64, String> {
        match (self.pixel, self.scale) {
            (Some(side), None) | (None, Some(Scale::Unit(side))) => Ok(side),
            (Some(_), Some(_)) => {
                Err("the length of its pixels is given twice, as pixel and as scale: leave one of them out".to_owned())
            }
            (None, Some(Scale::Paper(_))) => {
                Err("a picture has no paper: give the side of a pixel in metres, as in --pixel 0.02".to_owned())
            }
            (None, None) => Err("a picture has no scale: give the side of a pixel in metres, as in --pixel 0.02, or pixel = 0.02 in [plan]".to_owned()),
        }
    }
    /// The length of a unit of files in metres \[m\].
    pub(super) fn unit_or_metres(&self) -> Result<f64, String> {
        Ok(self.unit()?.unwrap_or(1.0))
    }
    /// The length of a unit of a file without paper, where it is given \[m\].
    pub(super) fn unit(&self) -> Result<Option<f64>, String> {
        match self.scale {
            None => Ok(None),
            Some(Scale::Unit(unit)) => Ok(Some(unit)),
            Some(Scale::Paper(of)) => Err(format!(
                "a scale of 1:{of} is that of a drawing on paper (SVG), and this file has none: give the length of a unit in metres, as in --scale 0.001"
            )),
        }
    }
    /// Refuses a side of pixels where there are none.
    pub(super) fn without_pixel(&self, why: &str) -> Result<(), String> {
        match self.pixel {
            None => Ok(()),
            Some(side) => {
                Err(format!("a pixel of {side} m is given, and {why}: leave it out; lengths are those of scale"))
            }
        }
    }
}
