//! A control for each setting of each force, made of its key.

use egui::{ComboBox, DragValue, Slider, SliderClamping, Ui};
use glam::DVec3;

use super::action::Action;
use crate::component::Setting;
use crate::settings::{Kind, Pair, Value, plain};

/// So many times the value of the scene a slider reaches, up and down.
const REACH: f64 = 100.0;
/// The change of a number that is dragged by a point, as a part of its size.
const SPEED: f64 = 0.005;

/// The controls of one force. `scene` has the values with which the run began, in the same order.
pub fn show(ui: &mut Ui, force: &str, settings: &[Setting<'_>], scene: &[Setting<'_>], actions: &mut Vec<Action>) {
    for (now, start) in settings.iter().zip(scene) {
        let changed = now.value != start.value;
        let mut set = |value: Value| {
            if value != *now.value {
                actions.push(Action::Set { force: force.to_owned(), setting: now.name.to_owned(), value });
            }
        };
        ui.horizontal(|ui| {
            let name = egui::RichText::new(now.name);
            let label = ui.label(if changed { name.strong() } else { name }).on_hover_text(about(now, start));
            if changed && ui.small_button("reset").on_hover_text("the value of the scene").clicked() {
                set(start.value.clone());
            }
            if let Some(value) = control(ui, now, start.value, &label) {
                set(value);
            }
        });
    }
}

fn about(now: &Setting<'_>, start: &Setting<'_>) -> String {
    let default = now.default.map_or(String::new(), |value| format!("\nby default {}", words(value)));
    format!("{}\nit must be {}\nin the scene {}{default}", now.about, now.kind.wanted(), words(start.value))
}

/// A value in words.
fn words(value: &Value) -> String {
    match value {
        Value::Number(x) => plain(*x),
        Value::Vector(v) => v.to_array().map(plain).join(", "),
        Value::Text(text) if text.is_empty() => "nothing".to_owned(),
        Value::Text(text) => text.to_string(),
        Value::Flag(on) => if *on { "yes" } else { "no" }.to_owned(),
        Value::Pairs(rows) => format!("{} pairs of species", rows.len()),
    }
}

/// The size of a number for its control: 1 where it is 0.
fn size(of: f64) -> f64 {
    if of == 0.0 { 1.0 } else { of.abs() }
}

/// A power of ten of the size of a number. Controls work in it: they round to decimals, of which the numbers of atoms have none.
pub fn unit(of: f64) -> f64 {
    10_f64.powf(size(of).log10().floor()).max(f64::MIN_POSITIVE)
}

/// A number in units, as it is set and shown: with twelve digits.
pub fn whole(x: f64, unit: f64) -> f64 {
    format!("{:.11e}", x * unit).parse().unwrap_or(x * unit)
}

/// What was typed, in units.
fn typed(text: &str, unit: f64) -> Option<f64> {
    text.trim().parse::<f64>().ok().filter(|x| x.is_finite()).map(|x| x / unit)
}

/// A number in units, in words: with six digits.
fn shown(x: f64, unit: f64) -> String {
    let x = format!("{:.5e}", x * unit).parse().unwrap_or(x * unit);
    if x == 0.0 || (1e-4..1e7).contains(&x.abs()) { plain(x) } else { format!("{x:e}") }
}

/// A slider of a number in units, that leaves alone what is not moved.
pub fn slider(value: &mut f64, (low, high): (f64, f64), unit: f64) -> Slider<'_> {
    let slider = Slider::new(value, low / unit..=high / unit).clamping(SliderClamping::Never).max_decimals(6);
    slider.custom_formatter(move |x, _| shown(x, unit)).custom_parser(move |text| typed(text, unit))
}

/// A field for a number among others as large as `most`, that is dragged or typed; the new one, where it was changed.
fn field(ui: &mut Ui, x: f64, most: f64, label: &egui::Response) -> Option<f64> {
    let unit = unit(if x == 0.0 { most } else { x });
    let mut value = x / unit;
    let field = DragValue::new(&mut value).speed(SPEED * (size(most) / unit).max(1.0)).max_decimals(6);
    let field = field.custom_formatter(move |x, _| shown(x, unit)).custom_parser(move |text| typed(text, unit));
    ui.add(field).labelled_by(label.id).changed().then(|| whole(value, unit))
}

/// The ends of a slider, and whether it is logarithmic.
pub fn range(kind: Kind, scene: f64) -> (f64, f64, bool) {
    let size = size(scene);
    match kind {
        Kind::Fraction => (0.001, 1.0, false),
        Kind::Positive => (size / REACH, size * REACH, true),
        Kind::NotNegative => (0.0, size * if scene == 0.0 { 1.0 } else { REACH }, scene != 0.0),
        Kind::Count => (1.0, (size * 4.0).max(10.0).min(kind.largest()), false),
        Kind::Whole | Kind::Species => (0.0, (size * 4.0).max(10.0).min(kind.largest()), false),
        _ => (-4.0 * size, 4.0 * size, false),
    }
}

/// A control for a value; the new value, where it was changed.
fn control(ui: &mut Ui, now: &Setting<'_>, scene: &Value, label: &egui::Response) -> Option<Value> {
    match (now.kind, now.value, scene) {
        (kind, Value::Number(x), Value::Number(start)) => {
            let (low, high, logarithmic) = range(kind, *start);
            let unit = if kind.is_whole() { 1.0 } else { unit(*start) };
            let mut value = *x / unit;
            // A whole number, such as a seed, has all of its digits.
            let mut slider = if kind.is_whole() {
                Slider::new(&mut value, low..=high).clamping(SliderClamping::Never).step_by(1.0)
            } else {
                slider(&mut value, (low, high), unit).drag_value_speed(SPEED * size(*start) / unit)
            };
            if logarithmic {
                slider = slider.logarithmic(true).smallest_positive(high / REACH.powi(3) / unit);
            }
            let response = ui.add(slider).labelled_by(label.id);
            let value = if kind.is_whole() { value } else { whole(value, unit) };
            // What is dragged beyond what is accepted stays there; what is typed is refused in words.
            let beyond = response.dragged() && kind.outside(value).is_some();
            let value = if beyond { value.clamp(low, high) } else { value };
            response.changed().then_some(Value::Number(value))
        }
        (Kind::Choice(known), Value::Text(word), _) => {
            let mut chosen = word.to_string();
            let list = ComboBox::from_id_salt((label.id, "choice")).selected_text(&chosen);
            let list = list.show_ui(ui, |ui| {
                for one in known {
                    ui.selectable_value(&mut chosen, (*one).to_owned(), *one);
                }
            });
            list.response.labelled_by(label.id);
            (chosen != *word).then(|| Value::Text(chosen.into()))
        }
        (_, Value::Flag(on), _) => {
            let mut value = *on;
            ui.checkbox(&mut value, "").labelled_by(label.id).changed().then_some(Value::Flag(value))
        }
        (_, Value::Vector(v), _) => {
            let mut parts = v.to_array();
            let most = v.abs().max_element();
            let mut changed = false;
            for part in &mut parts {
                if let Some(x) = field(ui, *part, most, label) {
                    (*part, changed) = (x, true);
                }
            }
            changed.then_some(Value::Vector(DVec3::from_array(parts)))
        }
        (Kind::Species, Value::Text(_), _) => {
            // All of them, or one.
            ui.label("all");
            ui.small_button("one").labelled_by(label.id).clicked().then_some(Value::Number(0.0))
        }
        (Kind::Pairs(_), Value::Pairs(rows), _) => pairs(ui, rows, label),
        (_, Value::Text(text), _) => line(ui, text, label),
        (_, value, _) => {
            ui.weak(words(value));
            None
        }
    }
}

/// A text, which is set when it is finished.
fn line(ui: &mut Ui, now: &str, label: &egui::Response) -> Option<Value> {
    let id = label.id.with("text");
    let mut text = ui.data_mut(|data| data.get_temp::<String>(id)).unwrap_or_else(|| now.to_owned());
    let response = ui.add(egui::TextEdit::singleline(&mut text).desired_width(140.0)).labelled_by(label.id);
    if response.lost_focus() {
        ui.data_mut(|data| data.remove::<String>(id));
        let entered = ui.input(|input| input.key_pressed(egui::Key::Enter));
        return (entered && text != now).then(|| Value::Text(text.into()));
    }
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text));
    }
    None
}

/// The coefficients of each pair of species.
fn pairs(ui: &mut Ui, rows: &[Pair], label: &egui::Response) -> Option<Value> {
    let mut rows = rows.to_vec();
    let mut changed = false;
    egui::Grid::new((label.id, "pairs")).show(ui, |ui| {
        ui.label("");
        for (name, _) in rows.first().map_or(&[][..], |row| &row.values) {
            ui.small(name);
        }
        ui.end_row();
        for row in &mut rows {
            let [a, b] = row.species;
            ui.label(format!("{a}, {b}"));
            for (_, x) in &mut row.values {
                if let Some(to) = field(ui, *x, *x, label) {
                    (*x, changed) = (to, true);
                }
            }
            ui.end_row();
        }
    });
    changed.then_some(Value::Pairs(rows))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sliders_hold_the_value_of_the_scene_and_what_its_kind_takes() {
        let kinds = [Kind::Number, Kind::Positive, Kind::NotNegative, Kind::Count, Kind::Whole];
        for kind in kinds {
            for scene in [1e-20, 0.3, 1.0, 7.0, 1e12, 0.0, -2.5] {
                if kind.outside(scene).is_some() {
                    continue;
                }
                let (low, high, _) = range(kind, scene);
                assert!((low..=high).contains(&scene) && low < high, "{kind:?} {scene}: {low} to {high}");
                assert_eq!((kind.outside(low), kind.outside(high)), (None, None), "{kind:?} {scene}: {low} to {high}");
            }
        }
        assert!(range(Kind::Fraction, 0.2).1 <= 1.0);
    }
}
