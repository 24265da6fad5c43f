//! The scenes that come with motes, with a picture of each.

use egui::{Align, Button, Image, Layout, Rect, ScrollArea, TextureId, Ui, Vec2, load::SizedTexture, pos2, vec2};

use super::action::Action;
use crate::scene::SCENES;

/// Pictures in a row of the contact sheet, which has them in the order of the scenes, and the size of each \[pixels\].
pub const COLUMNS: usize = 7;
pub const CELL: [usize; 2] = [160, 100];
/// Pictures in a row of the window.
const ROW: usize = 4;

/// The part of the contact sheet with a scene.
fn part(place: usize) -> Rect {
    let rows = SCENES.len().div_ceil(COLUMNS);
    let size = vec2(1.0 / COLUMNS as f32, 1.0 / rows as f32);
    let at = pos2((place % COLUMNS) as f32 * size.x, (place / COLUMNS) as f32 * size.y);
    Rect::from_min_size(at, size)
}

/// A window with all of them; a click opens one.
pub fn show(contact: TextureId, now: &str, ui: &Ui, is_open: &mut bool, actions: &mut Vec<Action>) {
    let size = Vec2::from(CELL.map(|side| side as f32));
    let window = egui::Window::new("Scenes").open(is_open).resizable(false).collapsible(false);
    window.default_height(520.0).show(ui.ctx(), |ui| {
        ScrollArea::vertical().show(ui, |ui| {
            egui::Grid::new("scenes").show(ui, |ui| {
                for (place, scene) in SCENES.iter().enumerate() {
                    let picture = Image::from_texture(SizedTexture::new(contact, size)).uv(part(place));
                    ui.with_layout(Layout::top_down(Align::Center), |ui| {
                        let button = Button::image(picture).selected(scene.name == now);
                        let response = ui.add(button).on_hover_text(scene.about());
                        let name = ui.label(scene.name);
                        if response.labelled_by(name.id).clicked() {
                            actions.push(Action::Open(scene.name.to_owned()));
                        }
                    });
                    if place % ROW == ROW - 1 {
                        ui.end_row();
                    }
                }
            });
        });
    });
}
