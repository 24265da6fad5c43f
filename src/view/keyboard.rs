//! Keys, each alone.

use egui::{Context, Key, Modifiers};
use glam::DVec3;

use super::action::Action;

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
    ("P", "save a picture"),
    ("V", "record a film, and save it"),
    ("H", "hide the panel"),
    ("?", "this list"),
    ("click", "choose a particle"),
    ("T", "the camera goes with it, or no longer"),
    ("Esc", "choose none"),
    ("drag", "turn; with the right button or Shift: shift"),
    ("wheel", "closer, farther, at the pointer"),
];

/// So far an arrow turns the camera \[radians\], and so much closer a key goes.
const TURN: f64 = 0.1;
const CLOSER: f64 = 0.8;

/// Reads the keys of a frame. While a text is edited, they belong to it.
pub fn read(context: &Context, actions: &mut Vec<Action>) {
    if context.text_edit_focused() {
        return;
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
        for key in [Key::Plus, Key::Equals] {
            on(key, Action::Zoom { factor: CLOSER, across: 0.0, up: 0.0 });
        }
        on(Key::Minus, Action::Zoom { factor: 1.0 / CLOSER, across: 0.0, up: 0.0 });
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
