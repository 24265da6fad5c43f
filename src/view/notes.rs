//! The box, the axes and a bar of length over the picture, as they are written on pictures that are saved.

use egui::{Align2, Color32, FontId, Pos2, Rect, Stroke, Ui, Vec2, pos2, vec2};
use glam::{DVec2, DVec3};

use crate::render::Picture;

/// The length of an axis, and its distance from the edges of the picture \[points\].
const AXIS: f32 = 32.0;
const MARGIN: f32 = 12.0;
/// The picture's height below which nothing is written \[points\].
const LEAST: f32 = 200.0;

/// Shows them.
#[expect(clippy::cast_possible_truncation, reason = "places on the screen")]
pub fn show(picture: &Picture, ui: &Ui, place: Rect) {
    let frame = &picture.frame;
    let painter = ui.painter_at(place);
    let scale = place.height() / frame.height as f32;
    let middle = 0.5 * vec2(frame.width as f32, frame.height as f32);
    let point = |pixel: DVec2| place.center() + scale * (vec2(pixel.x as f32, pixel.y as f32) - middle);
    let line = |ends: [Pos2; 2], light: f32| {
        painter.line_segment(ends, Stroke::new(3.0, Color32::from_black_alpha(90).gamma_multiply(light)));
        painter.line_segment(ends, Stroke::new(1.2, Color32::from_white_alpha(220).gamma_multiply(light)));
    };
    for [from, to] in picture.outline() {
        line([point(from), point(to)], 0.5);
    }
    if place.height() < LEAST {
        return;
    }
    let text = |at: Pos2, align: Align2, words: &str| {
        for shift in [vec2(1.0, 1.0), vec2(-1.0, -1.0), vec2(1.0, -1.0), vec2(-1.0, 1.0)] {
            painter.text(at + shift, align, words, FontId::proportional(13.0), Color32::from_black_alpha(110));
        }
        painter.text(at, align, words, FontId::proportional(13.0), Color32::from_gray(240));
    };
    // The axes towards the eye come last.
    let camera = &frame.camera;
    let mut axes = [(DVec3::X, "x"), (DVec3::Y, "y"), (DVec3::Z, "z")];
    axes.sort_by(|a, b| a.0.dot(camera.back).total_cmp(&b.0.dot(camera.back)));
    let from = place.min + Vec2::splat(MARGIN + 1.2 * AXIS);
    for (axis, name) in axes {
        let seen = vec2(axis.dot(camera.right) as f32, -axis.dot(camera.up) as f32);
        line([from, from + AXIS * seen], 1.0);
        if seen.length() > 0.3 {
            text(from + AXIS * seen + 9.0 * seen.normalized(), Align2::CENTER_CENTER, name);
        }
    }
    // The scale of colours is at the right.
    if let Some((pixels, length)) = picture.bar() {
        let low = pos2(place.left() + MARGIN, place.bottom() - MARGIN);
        let high = low + vec2(scale * pixels as f32, 0.0);
        line([low, high], 1.0);
        [low, high].into_iter().for_each(|end| line([end, end - vec2(0.0, 5.0)], 1.0));
        text(low.lerp(high, 0.5) - vec2(0.0, 3.0), Align2::CENTER_BOTTOM, &length);
    }
}
