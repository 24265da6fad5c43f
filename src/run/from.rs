//! `--from`: a run that continues from a state of an earlier one.

use std::path::Path;

use crate::diagnose;
use crate::error::Error;
use crate::formats;
use crate::scene::Scene;
use crate::settings::plain;
use crate::simulation::Setup;

/// Replaces the state of a scene by that of a file which an earlier run of the scene has written.
///
/// # Errors
/// [`Error::Input`] when the file has other particles, lacks a required time, or is at the end of the run.
pub fn go_on(setup: &mut Setup, scene: &Scene, path: &Path) -> Result<(), Error> {
    let columns = setup.columns()?;
    let mut state = formats::read(path, &columns)?;
    let refuse = |message: String| Err(Error::Input { file: path.to_owned(), message });
    let corner = crate::component::barostat::CORNER.name;
    if columns.get(corner).is_some() && state.get(corner).is_none() {
        return refuse(
            "does not hold the box, which a barostat has changed since the start: give the NPZ archive of a run, or a file with a box in its header"
                .to_owned(),
        );
    }
    if (state.step, state.time) == (0, 0.0)
        && let Some(step) = numbered(path)
    {
        if scene.adaptive_step.is_some() {
            return refuse("is a table without the clock of adaptive steps: give the NPZ file".to_owned());
        }
        if let Some(given) = scene.given_dt {
            return refuse(format!(
                "is a table, which holds no clock, and dt = {given} does not divide the length of this run, so that its steps may have been \
                 others: give the NPZ file, or the length of its steps with --set simulation.dt=… and an `until` that is a whole number \
                 of these"
            ));
        }
        (state.step, state.time) = (step, step as f64 * scene.dt);
    }
    if state.step == 0 && state.time > 0.0 && scene.adaptive_step.is_none() {
        // For formats that hold a time, and no step.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "above 0, or saturated")]
        let steps = (state.time / scene.dt).round() as u64;
        state.step = steps;
    }
    if let (Some(given), true) = (scene.given_dt, state.step > 0) {
        let made = state.time / state.step as f64;
        if (made - scene.dt).abs() > 1e-9 * scene.dt {
            let whole = (scene.until / made).round() * made;
            return refuse(format!(
                "was made by steps of {made}, and here steps are {}, so that a whole number of them ends at {} (the scene has dt = {given}): \
                 go on with --set simulation.dt={made:?} and --until {whole:?}, a whole number of these",
                scene.dt, scene.until
            ));
        }
    }
    if setup.breaks() && !state.keeps() {
        return refuse(
            "does not say which springs have broken, and in this scene they may: give the NPZ archive of a run"
                .to_owned(),
        );
    }
    // With adaptive steps only the time gives the progress.
    let over = if scene.adaptive_step.is_some() { state.time >= scene.until } else { state.step >= scene.steps };
    if over {
        return refuse(format!(
            "is at step {} and time {}, where the run ends: `steps` and `until` count from the start of the first run; give later \
             ones with --steps or --until",
            state.step,
            plain(state.time)
        ));
    }
    let goes_on =
        setup.state.go_on_from(&state).and_then(|()| setup.on_the_floor()).and_then(|()| diagnose::have_ways(setup));
    match goes_on {
        Err(Error::Scene(message)) => refuse(format!("cannot go on: {message}")),
        other => {
            setup.bounds = setup.in_its_box()?.bounds;
            other
        }
    }
}

/// The step in the name of a table that a run has written, `snapshot_0100.csv`: a table holds neither time nor step.
fn numbered(path: &Path) -> Option<u64> {
    let table = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"));
    let name = path.file_stem()?.to_str()?;
    name.strip_prefix("snapshot_").filter(|_| table)?.parse().ok()
}

/// The remark where a simulation begins at this step.
pub(super) fn remark(goes_on: bool, step: u64, time: f64) -> String {
    let way = if goes_on {
        "with the restart data of its last step"
    } else {
        "with accelerations that are evaluated again: its last bits may differ from those of a run that was never stopped"
    };
    format!("continues at step {step}, time {}, {way}", plain(time))
}
