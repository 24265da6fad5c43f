//! The panel, and the place of the picture.

use egui::{
    CentralPanel, CollapsingHeader, Color32, ComboBox, Frame, Image, Label, Panel, PointerButton, Pos2, Rect, Response,
    ScrollArea, Sense, Stroke, Ui, Vec2, load::SizedTexture, pos2,
};

use super::action::Action;
use super::tool::{self, Tool};
use super::{View, gallery, keyboard, legend, notes, sliders};
use crate::kernel::Backend;
use crate::render;
use crate::scene::SCENES;
use crate::settings::{Kind, Value, plain};

/// The width of the panel \[points\].
const PANEL: f32 = 320.0;
/// Columns of a picture are a multiple of so many.
const COLUMNS: u32 = 64;
/// Pixels of a picture from side to side, at most.
const SIDE: u32 = 4096;
/// The camera turns so far when one drags across the height of the picture \[radians\].
const TURN: f64 = 3.0;
/// The radius of the ring around a chosen particle \[points\].
const RING: f32 = 9.0;
/// The wheel brings the camera so much closer for each point.
const WHEEL: f64 = 0.003;

/// Shows both.
pub fn show<B: Backend>(view: &mut View<B>, ui: &mut Ui) {
    if view.panel {
        Panel::right("panel").default_size(PANEL).show(ui, |ui| {
            ScrollArea::vertical().show(ui, |ui| panel(view, ui));
        });
    } else {
        view.plots.close();
    }
    CentralPanel::default().frame(Frame::NONE).show(ui, |ui| picture(view, ui));
    if view.help {
        let mut open = true;
        egui::Window::new("Keys").open(&mut open).resizable(false).show(ui.ctx(), keys);
        view.help = open;
    }
    if let (Some(contact), true) = (view.contact, view.scenes) {
        gallery::show(contact, &view.stage.name, ui, &mut view.scenes, &mut view.actions);
    }
}

fn keys(ui: &mut Ui) {
    egui::Grid::new("keys").striped(true).show(ui, |ui| {
        for (key, about) in keyboard::keys() {
            ui.monospace(*key);
            ui.label(*about);
            ui.end_row();
        }
    });
}

fn panel<B: Backend>(view: &mut View<B>, ui: &mut Ui) {
    let open = view.stage.name.clone();
    ui.horizontal(|ui| {
        let name = egui::RichText::new(&open).heading();
        if view.contact.is_some() {
            if ui.button(name).on_hover_text("the scenes: L").clicked() {
                view.actions.push(Action::Scenes);
            }
        } else {
            let list = ComboBox::from_id_salt("scene").selected_text(name).show_ui(ui, |ui| {
                for scene in SCENES {
                    if ui.selectable_label(scene.name == open, scene.name).on_hover_text(scene.about()).clicked() {
                        view.actions.push(Action::Open(scene.name.to_owned()));
                    }
                }
            });
            let info = || egui::WidgetInfo::labeled(egui::Role::ComboBox, true, "scene");
            list.response.widget_info(info);
        }
        if ui.button("?").on_hover_text("the keys").clicked() {
            view.actions.push(Action::Help);
        }
    });
    for part in view.stage.about.split("\n\n") {
        ui.small(part.split_whitespace().collect::<Vec<_>>().join(" "));
    }
    ui.separator();
    run(view, ui);
    tool::show(&mut view.hand, view.stage.obstacles(), ui, &mut view.actions);
    ui.separator();
    if let Some(chosen) = &view.chosen {
        let title = format!("Particle {}", chosen.id);
        CollapsingHeader::new(title).id_salt("particle").default_open(true).show(ui, |ui| {
            chosen.show(ui, &mut view.actions);
        });
    }
    CollapsingHeader::new("Picture").default_open(true).show(ui, |ui| looks(view, ui));
    forces(view, ui);
    if view.plots.show(ui) {
        // What was not looked at was not measured.
        view.measured = None;
    }
}

/// What is said, over the lower left corner of the picture: in the panel it would move the controls below.
fn said<B: Backend>(view: &View<B>, ui: &Ui, place: Rect) {
    let fault = view.fault.as_deref().unwrap_or_default();
    if fault.is_empty() && view.message.is_empty() {
        return;
    }
    let area = egui::Area::new(egui::Id::unique("said")).order(egui::Order::Middle).constrain_to(place);
    let area = area.pivot(egui::Align2::LEFT_BOTTOM).fixed_pos(place.left_bottom() + Vec2::new(8.0, -8.0));
    area.show(ui.ctx(), |ui| {
        Frame::popup(ui.style()).show(ui, |ui| {
            ui.set_max_width((0.8 * place.width()).max(120.0));
            let (bad, warn) = (ui.visuals().error_fg_color, ui.visuals().warn_fg_color);
            say(fault, bad, ui);
            say(&view.message, warn, ui);
        });
    });
}

/// Says something; lines that point at places of a text stand below each other.
fn say(text: &str, color: Color32, ui: &mut Ui) {
    if text.contains('\n') {
        ScrollArea::horizontal().id_salt(("said", color)).show(ui, |ui| {
            ui.add(Label::new(egui::RichText::new(text).monospace().color(color)).extend());
        });
    } else if !text.is_empty() {
        ui.colored_label(color, text);
    }
}

fn run<B: Backend>(view: &mut View<B>, ui: &mut Ui) {
    ui.horizontal(|ui| {
        let name = if view.paused { "Run" } else { "Pause" };
        if ui.button(name).on_hover_text("Space").clicked() {
            view.actions.push(Action::Pause);
        }
        if ui.button("Step").on_hover_text("one step: .").clicked() {
            view.actions.push(Action::Step);
        }
        if ui.button("Reset").on_hover_text("back to the start, with these settings: R").clicked() {
            view.actions.push(Action::Reset);
        }
        if ui.button("Scene").on_hover_text("back to the start, with the settings of the scene").clicked() {
            view.actions.push(Action::Restore);
        }
        // A page has a link for it.
        if !cfg!(target_arch = "wasm32")
            && ui
                .button("Copy")
                .on_hover_text("what was changed, for the command `motes`, to the clipboard: C")
                .clicked()
        {
            view.actions.push(Action::Copy);
        }
    });
    let mut wanted = view.pace.wanted;
    let slider = sliders::slider(&mut wanted, (1.0, 10_000.0), 1.0).logarithmic(true).text("steps / s");
    let response = ui.add(slider);
    if response.changed() {
        // What is dragged is a whole number.
        let wanted = if response.dragged() { wanted.round() } else { wanted };
        view.actions.push(Action::Faster(wanted / view.pace.wanted));
    }
    let [asked, now] = view.pace.speeds();
    let short = !view.paused && now < 0.8 * asked && view.pace.step.is_some();
    let simulation = &view.stage.simulation;
    egui::Grid::new("numbers").num_columns(2).show(ui, |ui| {
        let mut row = |name: &str, value: String| {
            ui.label(name);
            ui.monospace(value);
            ui.end_row();
        };
        row("time", digits(view.stage.time()));
        row("step", simulation.steps().to_string());
        row("particles", simulation.count().to_string());
        row("time per second", format!("{} of {}", digits(now), digits(asked)));
        // The row stays, so that nothing below moves.
        row("", if short { "as fast as it goes" } else { "" }.to_owned());
        let millis = |seconds: Option<f64>| seconds.map_or("…".to_owned(), |s| format!("{:.1} ms", 1e3 * s));
        row("a step takes", millis(view.pace.step));
        row("a picture takes", millis(view.pace.picture));
    });
}

/// With four digits.
pub fn digits(x: f64) -> String {
    plain(format!("{x:.3e}").parse().unwrap_or(x))
}

/// By what particles are coloured: a word of the key, or a column.
fn colors<B: Backend>(view: &mut View<B>, ui: &mut Ui) {
    let Some(key) = render::KEYS.iter().find(|key| key.name == "color") else { return };
    let Kind::Choice(known) = key.kind else { return };
    let (word, column) = (view.stage.text("color"), view.stage.text("column"));
    let by_column = word == "column";
    let now = if by_column { column.clone() } else { word.clone() };
    let columns: Vec<(String, String)> = view.stage.shown_columns();
    ui.horizontal(|ui| {
        let label = ui.label("color").on_hover_text(key.about);
        let list = ComboBox::from_id_salt("color").selected_text(&now).show_ui(ui, |ui| {
            let set = |key, to: &str| Action::Picture { key, value: Value::Text(to.to_owned().into()) };
            for one in known.iter().filter(|one| **one != "column") {
                if ui.selectable_label(*one == word, *one).clicked() && *one != word {
                    view.actions.push(set("color", one));
                }
            }
            ui.separator();
            for (name, about) in &columns {
                let is_it = by_column && *name == column;
                if ui.selectable_label(is_it, name).on_hover_text(about).clicked() && !is_it {
                    view.actions.extend([set("column", name), set("color", "column")]);
                }
            }
        });
        list.response.labelled_by(label.id);
    });
}

/// A slider of a number of the picture.
fn number<B: Backend>(
    view: &mut View<B>,
    ui: &mut Ui,
    key: &'static str,
    about: &str,
    range: (f64, f64),
    logarithmic: bool,
) {
    let unit = sliders::unit(range.1);
    let mut value = view.stage.number(key) / unit;
    let slider = sliders::slider(&mut value, range, unit).logarithmic(logarithmic).text(key);
    let response = ui.add(slider).on_hover_text(about);
    if response.changed() {
        let value = sliders::whole(value, unit);
        let value = if response.dragged() { value.clamp(range.0, range.1) } else { value };
        view.actions.push(Action::Picture { key, value: value.into() });
    }
}

fn looks<B: Backend>(view: &mut View<B>, ui: &mut Ui) {
    colors(view, ui);
    for name in ["style", "background", "draw"] {
        let Some(key) = render::KEYS.iter().find(|key| key.name == name) else { continue };
        let Kind::Choice(known) = key.kind else { continue };
        let now = view.stage.text(name);
        ui.horizontal(|ui| {
            let label = ui.label(name).on_hover_text(key.about);
            let list = ComboBox::from_id_salt(name).selected_text(&now).show_ui(ui, |ui| {
                for one in known {
                    if ui.selectable_label(*one == now, *one).clicked() && *one != now {
                        view.actions.push(Action::Picture { key: key.name, value: Value::Text((*one).into()) });
                    }
                }
            });
            list.response.labelled_by(label.id);
        });
    }
    let tail = 200.0 * view.stage.dt();
    number(view, ui, "size", "how large particles are drawn, as a multiple of what they are", (0.1, 20.0), true);
    number(view, ui, "tail", "a streak from where each particle was so long ago", (0.0, tail), false);
    number(view, ui, "exposure", "brightness of lights, as a multiple of the automatic one", (0.05, 20.0), true);
    number(view, ui, "bloom", "how bright the bloom around lights is, as a multiple of the usual", (0.0, 5.0), false);
    let mut notes = view.stage.picture().annotated();
    let about = "box, axes and a bar of length over the picture, and in those that are saved";
    if ui.checkbox(&mut notes, "annotate").on_hover_text(about).changed() {
        view.actions.push(Action::Picture { key: "annotate", value: Value::Flag(notes) });
    }
    ui.horizontal(|ui| {
        if ui.button("Frame all").on_hover_text("F").clicked() {
            view.actions.push(Action::Frame);
        }
        if ui.button("Save picture").on_hover_text("P").clicked() {
            view.actions.push(Action::Take);
        }
        let film = if view.recording.is_some() { "End film" } else { "Film" };
        if ui.button(film).on_hover_text("V: each picture of a step becomes one of a film").clicked() {
            view.actions.push(Action::Record);
        }
    });
}

fn forces<B: Backend>(view: &mut View<B>, ui: &mut Ui) {
    let start = view.stage.original();
    for ((name, settings), scene) in view.stage.simulation.settings().into_iter().zip(start) {
        let Some(scene) = scene.map(crate::component::Component::settings) else { continue };
        if settings.is_empty() {
            continue;
        }
        let title = egui::RichText::new(name.replace('_', " "));
        // What particles have from a force is hardly changed by hand.
        let few = settings.iter().filter(|setting| !setting.shared).count() <= 12;
        CollapsingHeader::new(title).id_salt(&name).default_open(few).show(ui, |ui| {
            sliders::show(ui, &name, &settings, &scene, &mut view.actions);
        });
    }
}

/// The columns and rows of a picture for a place of so many pixels, or of as many of this shape as a picture can have.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of pixels, which is bounded")]
fn size(pixels: Vec2) -> [u32; 2] {
    let fits = |part: f32| {
        let whole = |x: f32| ((part * x).round().max(64.0) as u32).min(SIDE);
        [whole(pixels.x).next_multiple_of(COLUMNS), whole(pixels.y)]
    };
    let parts = (0..).map(|n| 0.97_f32.powi(n));
    parts.map(fits).find(|[width, height]| width * height <= render::AREA).unwrap_or([COLUMNS; 2])
}

fn picture<B: Backend>(view: &mut View<B>, ui: &mut Ui) {
    let (place, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    let pixels = place.size() * ui.ctx().pixels_per_point();
    view.size = size(pixels);
    if let Some(id) = view.texture {
        // Columns beyond the place are cut off, as many at both sides.
        let [width, height] = view.size();
        let part = (place.aspect_ratio() * height as f32 / width as f32).min(1.0);
        let seen = Rect::from_min_max(pos2(0.5 - 0.5 * part, 0.0), pos2(0.5 + 0.5 * part, 1.0));
        Image::from_texture(SizedTexture::new(id, Vec2::new(width as f32, height as f32))).uv(seen).paint_at(ui, place);
    }
    if let Some(text) = view.copied.take() {
        ui.ctx().copy_text(text);
    }
    said(view, ui, place);
    legend::show(&view.stage.picture().color, ui, place);
    if view.stage.picture().annotated() {
        notes::show(view.stage.picture(), ui, place);
    }
    mark(view, ui, place);
    drag(view, ui, &response, place);
    if response.double_clicked() {
        view.actions.push(Action::Frame);
    } else if response.clicked()
        && let Some(pointer) = response.interact_pointer_pos()
    {
        let [across, up] = spot(pointer - place.center(), place);
        view.actions.push(match view.hand.tool {
            tool if tool.places() => Action::Place { from: [across, up], to: [across, up] },
            _ => Action::Choose { across, up },
        });
    }
    if let Some(pointer) = response.hover_pos() {
        let (wheel, pinch) = ui.input(|input| (input.smooth_scroll_delta.y, input.zoom_delta()));
        let factor = (-WHEEL * f64::from(wheel)).exp() / f64::from(pinch);
        if (factor - 1.0).abs() > 1e-6 {
            let [across, up] = spot(pointer - place.center(), place);
            view.actions.push(Action::Zoom { factor, across, up });
        }
    }
}

/// A way on the screen, to the right and up in halves of the height of the picture.
fn spot(way: Vec2, place: Rect) -> [f64; 2] {
    let half = f64::from(0.5 * place.height()).max(1.0);
    [f64::from(way.x) / half, -f64::from(way.y) / half]
}

/// Where a spot of the picture is on the screen.
#[expect(clippy::cast_possible_truncation, reason = "a place on the screen")]
fn point([across, up]: [f64; 2], place: Rect) -> Pos2 {
    let half = 0.5 * place.height();
    place.center() + Vec2::new(across as f32 * half, -up as f32 * half)
}

/// A drag across the picture: of the camera, or with a tool.
fn drag<B: Backend>(view: &mut View<B>, ui: &Ui, response: &Response, place: Rect) {
    let by = response.drag_delta();
    let [across, up] = spot(by, place);
    let shift = ui.input(|input| input.modifiers.shift);
    let primary = response.dragged_by(PointerButton::Primary) && !shift;
    if !primary && response.dragged() && view.hand.tool != Tool::Look {
        // With Shift, or another button, the camera moves, and what was begun ends.
        view.hand.begun = None;
        view.actions.push(Action::Release);
    }
    let at = response.interact_pointer_pos().map(|pointer| spot(pointer - place.center(), place));
    if let (Some([across, up]), true) = (at, primary && view.hand.tool != Tool::Look) {
        if view.hand.tool.places() {
            // It is a drag when the pointer has moved a little from where it was pressed.
            let pressed = ui.input(|input| input.pointer.press_origin());
            let pressed = pressed.map_or([across, up], |pressed| spot(pressed - place.center(), place));
            view.hand.begun.get_or_insert(pressed);
        } else {
            view.actions.push(Action::Pull { across, up });
            // What is pulled goes on moving while the pointer rests.
            ui.ctx().request_repaint();
        }
    } else if by != Vec2::ZERO {
        let flies = keyboard::flight(ui.ctx()).is_some();
        let (turn_across, turn_up) = (0.5 * TURN * across, -0.5 * TURN * up);
        view.actions.push(if !primary || view.is_flat() {
            Action::Pan { across, up }
        } else if flies {
            Action::Turn { across: 0.5 * turn_across, up: 0.5 * turn_up }
        } else {
            Action::Orbit { across: turn_across, up: turn_up }
        });
    }
    if response.drag_stopped() {
        if let (Some(from), Some(to)) = (view.hand.begun.take(), at) {
            view.actions.push(Action::Place { from, to });
        }
        view.actions.push(Action::Release);
    }
    outline(view, ui, response, place);
}

/// A circle about the pointer, as far as a tool reaches, or the line of a bar.
#[expect(clippy::cast_possible_truncation, reason = "a place on the screen")]
fn outline<B: Backend>(view: &View<B>, ui: &Ui, response: &Response, place: Rect) {
    let Some(pointer) = response.interact_pointer_pos().or(response.hover_pos()) else { return };
    let (half, painter) = (0.5 * place.height(), ui.painter_at(place));
    let (middle, radius) = match (view.hand.tool, view.hand.begun) {
        (Tool::Pull | Tool::Push, _) => (pointer, view.hand.reach as f32 * half),
        (Tool::Ball, Some([across, up])) => {
            let middle = point([across, up], place);
            (middle, (pointer - middle).length())
        }
        (Tool::Bar, Some(begun)) => {
            let ends = [point(begun, place), pointer];
            painter.line_segment(ends, Stroke::new(4.5, Color32::from_black_alpha(140)));
            painter.line_segment(ends, Stroke::new(1.5, Color32::from_white_alpha(160)));
            return;
        }
        _ => return,
    };
    painter.circle_stroke(middle, radius + 1.5, Stroke::new(1.5, Color32::from_black_alpha(140)));
    painter.circle_stroke(middle, radius, Stroke::new(1.5, Color32::from_white_alpha(160)));
}

/// A ring around the chosen particle.
fn mark<B: Backend>(view: &View<B>, ui: &Ui, place: Rect) {
    let position = view.chosen.as_ref().and_then(|chosen| chosen.position);
    let seen = position.and_then(|x| view.stage.picture().frame.camera.sees(x));
    let Some(seen) = seen else { return };
    let at = point(seen, place);
    let painter = ui.painter_at(place);
    // Light on dark, and dark on light.
    painter.circle_stroke(at, RING + 1.5, Stroke::new(1.5, Color32::from_black_alpha(180)));
    painter.circle_stroke(at, RING, Stroke::new(1.5, Color32::from_rgb(255, 214, 90)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_of_any_size_has_a_picture() {
        for (width, height) in [(4096.0, 4096.0), (7680.0, 4320.0), (0.0, 0.0), (1e9, 3.0), (50.0, 9000.0)] {
            let [columns, rows] = size(Vec2::new(width, height));
            assert!(
                columns * rows <= render::AREA && columns % COLUMNS == 0 && rows >= 64,
                "{width} × {height}: {columns} × {rows}"
            );
            assert!(columns <= SIDE && rows <= SIDE, "{width} × {height}: {columns} × {rows}");
        }
        for whole in [[3840, 2160], [640, 384]] {
            assert_eq!(size(Vec2::from(whole.map(|side| side as f32))), whole);
        }
        let [columns, rows] = size(Vec2::splat(4096.0)).map(f64::from);
        assert!((columns / rows - 1.0).abs() < 0.03, "{columns} × {rows}");
    }
}
