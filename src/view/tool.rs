//! What a drag across the picture does.

use egui::{Slider, Ui};

use super::action::Action;
use crate::render::Camera;
use crate::state::State;

/// A use of the pointer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tool {
    /// The camera turns.
    Look,
    /// Particles are pulled to the pointer.
    Pull,
    /// Particles are pushed away from it.
    Push,
    /// A ball is placed, as large as the drag is long.
    Ball,
    /// A bar is placed along the drag.
    Bar,
}

impl Tool {
    /// All of them, with their names and what they do.
    pub const ALL: [(Self, &str, &str); 5] = [
        (Self::Look, "Look", "a drag turns the camera"),
        (Self::Pull, "Pull", "a drag pulls the particles near the pointer along"),
        (Self::Push, "Push", "a drag pushes the particles near the pointer away"),
        (Self::Ball, "Ball", "a drag places a ball that lets no particle in, from its middle to its edge"),
        (Self::Bar, "Bar", "a drag draws a bar that lets no particle through, from end to end"),
    ];
    /// The one after it.
    pub fn next(self) -> Self {
        let place = Self::ALL.iter().position(|(tool, ..)| *tool == self).unwrap_or(0);
        Self::ALL[(place + 1) % Self::ALL.len()].0
    }
    /// Whether it moves particles: 1 to the pointer, −1 away from it.
    pub fn sign(self) -> Option<f64> {
        match self {
            Self::Pull => Some(1.0),
            Self::Push => Some(-1.0),
            Self::Look | Self::Ball | Self::Bar => None,
        }
    }
    /// Whether it places obstacles.
    pub fn places(self) -> bool {
        matches!(self, Self::Ball | Self::Bar)
    }
}

/// A tool, how far it reaches and how strong it is.
pub struct Hand {
    pub tool: Tool,
    /// The distance from the pointer at which the pull is greatest \[halves of the picture's height\].
    pub reach: f64,
    /// The greatest pull, in multiples of what is usual in the run.
    pub strength: f64,
    /// Where the drag of an obstacle began: across and up.
    pub begun: Option<[f64; 2]>,
}

impl Default for Hand {
    fn default() -> Self {
        // Newton, the simulator of robots, limits a pull to five times the weight.
        Self { tool: Tool::Look, reach: 0.12, strength: 5.0, begun: None }
    }
}

/// A pull in a run of which this is usual: the median of accelerations, or what turns the motion within the picture, or brings
/// particles across it in a hundred steps.
pub fn usual(state: &State, accelerations: &[f64], weight: f64, camera: &Camera, dt: f64) -> f64 {
    let median = |values: Vec<f64>| {
        let mut values: Vec<f64> = values.into_iter().filter(|x| x.is_finite()).collect();
        let middle = values.len() / 2;
        if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(middle, f64::total_cmp).1 }
    };
    let speed = median(state.velocity().iter().map(|v| v.length()).collect());
    let usual = median(accelerations.to_vec()).max(weight);
    let turns = speed * speed / camera.extent;
    let crosses = camera.extent / (100.0 * dt).powi(2);
    [usual, turns, crosses].into_iter().find(|a| a.is_normal() && *a > 0.0).unwrap_or(0.0)
}

/// The tools, and what the present one may be set to.
pub fn show(hand: &mut Hand, obstacles: usize, ui: &mut Ui, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.label("drag").on_hover_text("what a drag with the left button does: G");
        for (tool, name, about) in Tool::ALL {
            ui.selectable_value(&mut hand.tool, tool, name).on_hover_text(about);
        }
    });
    if hand.tool.sign().is_some() {
        ui.add(Slider::new(&mut hand.reach, 0.01..=1.0).logarithmic(true).max_decimals(3).text("reach"))
            .on_hover_text("in halves of the height of the picture");
        ui.add(Slider::new(&mut hand.strength, 0.05..=500.0).logarithmic(true).max_decimals(2).text("strength"))
            .on_hover_text("in multiples of the acceleration that is usual in this run");
    }
    if obstacles > 0 && ui.button("Remove the last obstacle").clicked() {
        actions.push(Action::Remove);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn tools_come_one_after_the_other() {
        let mut seen = vec![Tool::Look];
        while seen.last().map(|tool| tool.next()) != Some(Tool::Look) {
            seen.push(seen[seen.len() - 1].next());
        }
        assert_eq!(seen, Tool::ALL.map(|(tool, ..)| tool));
    }
    #[test]
    fn a_pull_is_as_strong_as_what_moves_the_run() {
        let camera =
            Camera { center: DVec3::ZERO, back: DVec3::Z, right: DVec3::X, up: DVec3::Y, extent: 2.0, distance: 0.0 };
        let mut state = State::default();
        for n in 0..9 {
            state.push(DVec3::ZERO, DVec3::X * f64::from(n), 1.0, 0.0);
        }
        let usual =
            |state: &State, accelerations: &[f64], weight: f64| usual(state, accelerations, weight, &camera, 0.01);
        assert!((usual(&state, &[1.0, 7.0, 2.0, 1e9, f64::NAN], 3.0) - 7.0).abs() < 1e-12);
        assert!((usual(&state, &[1.0, 2.0, 0.5], 9.8) - 9.8).abs() < 1e-12, "at rest under weight");
        assert!((usual(&state, &[], 0.0) - 8.0).abs() < 1e-12, "v² / L of the median speed 4");
        assert!((usual(&State::default(), &[], 0.0) - 2.0).abs() < 1e-12, "L / (100 dt)²");
    }
}
