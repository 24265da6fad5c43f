//! The scale of colours, over the picture.

use egui::{Align2, Color32, FontId, Rect, Ui, Vec2, pos2, vec2};

use super::controls::digits;
use crate::render::{Color, bytes, value_color};

/// Its size, and its distance from the edges of the picture \[points\].
const SIZE: Vec2 = vec2(180.0, 8.0);
const MARGIN: f32 = 12.0;
/// So many colours are drawn side by side.
const PARTS: u16 = 60;

/// Shows the scale of speeds or of a column, where colours have one.
pub fn show(color: &Color, ui: &Ui, place: Rect) {
    let (title, low, high) = match color {
        Color::Speed { slow, fast } => ("speed".to_owned(), *slow, *fast),
        Color::Value(scaled) => {
            let logarithmic = if scaled.logarithmic { ", logarithmic" } else { "" };
            (scaled.title() + logarithmic, scaled.low, scaled.high)
        }
        Color::Given(_) | Color::Column(_) | Color::Heading => return,
    };
    if place.width() < 2.0 * SIZE.x {
        return;
    }
    let painter = ui.painter_at(place);
    let bar = Rect::from_min_size(pos2(place.right() - MARGIN - SIZE.x, place.bottom() - MARGIN - 30.0), SIZE);
    let behind = Rect::from_min_max(bar.min - vec2(8.0, 20.0), bar.max + vec2(8.0, 22.0));
    painter.rect_filled(behind, 4.0, Color32::from_black_alpha(150));
    for part in 0..PARTS {
        let at = |n: u16| bar.left() + bar.width() * f32::from(n) / f32::from(PARTS);
        let from = Rect::from_x_y_ranges(at(part)..=at(part + 1) + 0.5, bar.y_range());
        let [r, g, b] = bytes(value_color((f64::from(part) + 0.5) / f64::from(PARTS)));
        painter.rect_filled(from, 0.0, Color32::from_rgb(r, g, b));
    }
    let font = || FontId::proportional(12.0);
    let light = Color32::from_gray(230);
    painter.text(bar.center_top() - vec2(0.0, 3.0), Align2::CENTER_BOTTOM, title, font(), light);
    painter.text(bar.left_bottom() + vec2(0.0, 3.0), Align2::LEFT_TOP, digits(low), font(), light);
    painter.text(bar.right_bottom() + vec2(0.0, 3.0), Align2::RIGHT_TOP, digits(high), font(), light);
}
