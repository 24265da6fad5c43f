//! Keys, each alone.

use egui::{Context, Key, Modifiers};
use glam::DVec3;

use super::action::Action;
use super::tool::Tool;

/// The keys, and what they do.
pub const KEYS: &[(&str, &str)] = &[
    ("Space", "pause, or go on"),
    (".", "one step"),
    ("R", "back to the start"),
    ("[  ]", "half as fast, twice as fast"),
    ("F", "all particles in the picture"),
    ("1 … 6", "look along −x, +x, −y, +y, −z, +z"),
    ("O", "perspective, or parallel rays"),
    ("← → ↑ ↓", "turn the camera"),
    ("+ −", "closer, farther"),
    ("W A S D", "fly ahead, to the left, back, to the right; a drag then turns about the eye"),
    ("E Q", "fly up, down"),
    ("G", "the next use of a drag: look, pull, push, place a ball, draw a bar"),
    ("L", "the scenes"),
    ("C", "copy the command with what was changed"),
    ("P", "save a picture"),
    ("V", "record a film, and save it"),
    ("H", "hide the panel"),
    ("?", "this list"),
    ("click", "choose a particle"),
    ("T", "the camera goes with it, or no longer"),
    ("Esc", "choose none, and look"),
    ("drag", "turn, or what G chose; with the right button or Shift: shift"),
    ("wheel", "closer, farther, at the pointer"),
];

/// Those that this shell has: a page has buttons for some.
pub fn keys() -> impl Iterator<Item = &'static (&'static str, &'static str)> {
    KEYS.iter().filter(|(key, _)| !(cfg!(target_arch = "wasm32") && ["L", "C"].contains(key)))
}

/// So far an arrow turns the camera \[radians\], and so much closer a key goes.
const TURN: f64 = 0.1;
const CLOSER: f64 = 0.8;
/// So many half heights of the picture the camera flies in a second.
const FLIGHT: f64 = 1.2;
/// The keys that fly: to the right, up and forwards.
const WINGS: [(Key, [f64; 3]); 6] = [
    (Key::D, [1.0, 0.0, 0.0]),
    (Key::A, [-1.0, 0.0, 0.0]),
    (Key::E, [0.0, 1.0, 0.0]),
    (Key::Q, [0.0, -1.0, 0.0]),
    (Key::W, [0.0, 0.0, 1.0]),
    (Key::S, [0.0, 0.0, -1.0]),
];

/// The direction of flight, as far as keys are held down for it.
pub fn flight(context: &Context) -> Option<[f64; 3]> {
    if context.text_edit_focused() {
        return None;
    }
    let held = context.input(|input| {
        let bare = !input.modifiers.any() || input.modifiers == Modifiers::SHIFT;
        WINGS.iter().filter(|(key, _)| bare && input.key_down(*key)).map(|(_, way)| *way).collect::<Vec<_>>()
    });
    (!held.is_empty()).then(|| held.iter().fold([0.0; 3], |sum, way| [0, 1, 2].map(|k| sum[k] + way[k])))
}

/// Reads the keys of a frame. While a text is edited, they belong to it.
pub fn read(context: &Context, tool: Tool, actions: &mut Vec<Action>) {
    if context.text_edit_focused() {
        return;
    }
    if let Some([right, up, forward]) = flight(context) {
        let way = FLIGHT * f64::from(context.input(|input| input.stable_dt).min(0.1));
        actions.push(Action::Fly { right: way * right, up: way * up, forward: way * forward });
        // As long as they are held nothing else need happen.
        context.request_repaint();
    }
    // A focused slider takes the arrows.
    let focused = context.memory(|memory| memory.focused().is_some());
    context.input(|input| {
        if input.modifiers.any() && input.modifiers != Modifiers::SHIFT {
            return;
        }
        let mut on = |key: Key, action: Action| {
            if input.key_pressed(key) {
                actions.push(action);
            }
        };
        if !focused {
            on(Key::Space, Action::Pause);
            on(Key::ArrowLeft, Action::Orbit { across: -TURN, up: 0.0 });
            on(Key::ArrowRight, Action::Orbit { across: TURN, up: 0.0 });
            on(Key::ArrowUp, Action::Orbit { across: 0.0, up: TURN });
            on(Key::ArrowDown, Action::Orbit { across: 0.0, up: -TURN });
        }
        on(Key::Period, Action::Step);
        on(Key::R, Action::Reset);
        on(Key::OpenBracket, Action::Faster(0.5));
        on(Key::CloseBracket, Action::Faster(2.0));
        on(Key::F, Action::Frame);
        on(Key::O, Action::Projection);
        on(Key::T, Action::Follow);
        on(Key::Escape, Action::LetGo);
        on(Key::Escape, Action::Use(Tool::Look));
        on(Key::G, Action::Use(tool.next()));
        for key in [Key::Plus, Key::Equals] {
            on(key, Action::Zoom { factor: CLOSER, across: 0.0, up: 0.0 });
        }
        on(Key::Minus, Action::Zoom { factor: 1.0 / CLOSER, across: 0.0, up: 0.0 });
        if !cfg!(target_arch = "wasm32") {
            on(Key::C, Action::Copy);
            on(Key::L, Action::Scenes);
        }
        on(Key::P, Action::Take);
        on(Key::V, Action::Record);
        on(Key::H, Action::Panel);
        on(Key::Questionmark, Action::Help);
        let views = [
            (Key::Num1, DVec3::X, DVec3::Z),
            (Key::Num2, DVec3::NEG_X, DVec3::Z),
            (Key::Num3, DVec3::Y, DVec3::Z),
            (Key::Num4, DVec3::NEG_Y, DVec3::Z),
            (Key::Num5, DVec3::Z, DVec3::Y),
            (Key::Num6, DVec3::NEG_Z, DVec3::Y),
        ];
        for (key, back, up) in views {
            on(key, Action::From { back, up });
        }
    });
}
