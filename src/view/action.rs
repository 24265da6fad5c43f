//! What a user asks for.

use glam::DVec3;

use super::tool::Tool;
use crate::settings::Value;

/// A request. Lengths on the picture are in halves of its height, from its middle, to the right and up.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Stand still, or go on.
    Pause,
    /// One step.
    Step,
    /// Back to the start, with the present settings.
    Reset,
    /// Back to the start, with the settings of the scene.
    Restore,
    /// So many times as fast.
    Faster(f64),
    /// Another value of a setting of a force.
    Set { force: String, setting: String, value: Value },
    /// Another value of a key of the picture.
    Picture { key: &'static str, value: Value },
    /// Turn the camera about its centre \[radians\].
    Orbit { across: f64, up: f64 },
    /// Shift the camera.
    Pan { across: f64, up: f64 },
    /// Look closer, or from farther away, at a place on the picture.
    Zoom { factor: f64, across: f64, up: f64 },
    /// Look from a direction.
    From { back: DVec3, up: DVec3 },
    /// Perspective or parallel rays.
    Projection,
    /// All particles in the picture.
    Frame,
    /// Fly: to the right, up and forwards \[halves of the picture's height\].
    Fly { right: f64, up: f64, forward: f64 },
    /// Turn the camera about the eye \[radians\].
    Turn { across: f64, up: f64 },
    /// Another use of the pointer.
    Use(Tool),
    /// Pull particles to a place on the picture, or push them away; until it is let go.
    Pull { across: f64, up: f64 },
    /// Pull no more.
    Release,
    /// Place a ball or a bar from a place on the picture to another.
    Place { from: [f64; 2], to: [f64; 2] },
    /// Remove the last of them.
    Remove,
    /// Choose the particle that is drawn at a place on the picture, or none.
    Choose { across: f64, up: f64 },
    /// The camera goes with the chosen particle, or no longer.
    Follow,
    /// Choose none.
    LetGo,
    /// Plot a column of the chosen particle, or no longer.
    Plot(String),
    /// Show the panel, or hide it.
    Panel,
    /// Show the list of keys, or hide it.
    Help,
    /// Show the scenes, or hide them.
    Scenes,
    /// Copy what was changed, for the command.
    Copy,
    /// Save a picture.
    Take,
    /// Begin a film, or end and save it.
    Record,
    /// Open another scene.
    Open(String),
}
