//! How large a drawing is.

use glam::DVec2;
use usvg::roxmltree::Node;

use super::super::measure::{Measure, Scale, rounded};

/// An inch has so many pixels of CSS, and 0.0254 m.
const PIXEL: f64 = 0.0254 / 96.0;
/// What is at least as large on paper is no paper \[m\].
const PAPER: f64 = 3.0;

/// What the root element says.
pub struct Written {
    /// Whether its width or height has a unit of length, as mm.
    has_length: bool,
    /// Width and height of the view box, where there is one.
    view: Option<DVec2>,
    stretches: bool,
}

impl Written {
    pub fn of(root: &Node<'_, '_>) -> Result<Self, String> {
        let is_length = |name: &str| {
            let value = root.attribute(name).unwrap_or_default().trim().to_ascii_lowercase();
            ["mm", "cm", "in", "pt", "pc", "q"].iter().any(|unit| value.ends_with(unit))
        };
        let view = root.attribute("viewBox").map(|text| {
            let parts = text.split(|c: char| c == ',' || c.is_whitespace()).filter(|part| !part.is_empty());
            let numbers: Vec<f64> = parts.filter_map(|part| part.parse().ok()).collect();
            match numbers[..] {
                [_, _, width, height] if width > 0.0 && height > 0.0 && width.is_finite() && height.is_finite() => {
                    Ok(DVec2::new(width, height))
                }
                _ => Err(format!(
                    "its viewBox is \"{}\", and it must be four numbers, the last two above 0",
                    super::super::super::shortened(text)
                )),
            }
        });
        let aspect = root.attribute("preserveAspectRatio").unwrap_or_default();
        Ok(Self {
            has_length: is_length("width") || is_length("height"),
            view: view.transpose()?,
            stretches: aspect.trim_start().starts_with("none"),
        })
    }
}

/// The size of a drawing.
pub struct Size {
    /// Its width and height \[m\].
    pub metres: DVec2,
    /// The length of a pixel of CSS \[m\].
    pub per_pixel: f64,
    pub remark: Option<String>,
}

impl Size {
    pub fn of(tree: &usvg::Tree, written: &Written, measure: &Measure) -> Result<Self, String> {
        let size = DVec2::new(f64::from(tree.size().width()), f64::from(tree.size().height()));
        // Pixels in a unit of the view box.
        let view = written.view.unwrap_or(size);
        let ratio = size / view;
        let unit = ratio.min_element();
        if written.stretches && (ratio.max_element() / unit - 1.0).abs() > 1e-3 {
            return Err(format!(
                "its view box of {} by {} is stretched to {} by {} (preserveAspectRatio is none): a floor has the same scale along x and y",
                rounded(view.x),
                rounded(view.y),
                rounded(size.x),
                rounded(size.y)
            ));
        }
        let (per_pixel, remark) = match measure.scale {
            Some(Scale::Unit(length)) => (length / unit, None),
            Some(Scale::Paper(times)) => (times * PIXEL, None),
            None if written.has_length && (size * PIXEL).max_element() >= PAPER => {
                let [x, y] = (size * PIXEL).to_array();
                (
                    PIXEL,
                    Some(format!(
                        "the drawing has no scale, and is taken in its full size, {x:.2} by {y:.2} m, as no paper is so large: give --scale if it is another"
                    )),
                )
            }
            None if written.has_length => {
                let [x, y] = (size * PIXEL).to_array();
                return Err(format!(
                    "the drawing is {:.0} by {:.0} mm large, on paper, and has no scale: give it as in --scale 1:100, or scale = \"1:100\" in [plan], \
                     which makes {:.1} by {:.1} m of it",
                    1e3 * x,
                    1e3 * y,
                    100.0 * x,
                    100.0 * y
                ));
            }
            None => {
                return Err(format!(
                    "the drawing is {} by {} units large, and has no scale: give the length of a unit in metres as in --scale 0.01, or scale = 0.01 \
                     in [plan], which makes {} by {} m of it",
                    rounded(view.x),
                    rounded(view.y),
                    rounded(0.01 * view.x),
                    rounded(0.01 * view.y)
                ));
            }
        };
        Ok(Self { metres: size * per_pixel, per_pixel, remark })
    }
}
