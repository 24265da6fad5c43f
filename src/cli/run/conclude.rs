//! The end of a run: what is plotted, and what it says of itself.

use std::time::Duration;

use motes::formats::Precision;
use motes::render::Image;
use motes::stability::Verdict;
use motes::{Error, Setup};
use serde_json::json;

use super::super::aftermath;
use super::super::course::Course;
use super::super::engine::Engine;
use super::super::failure::Failure;
use super::super::ledger::Book;
use super::super::output::Output;
use super::super::substeps;
use super::super::summary;
use super::Run;

impl Run {
    pub(super) fn conclude(
        &mut self,
        (steps, course): (u64, &Course),
        output: &Output,
        stepping: Duration,
        image: Option<&Image>,
    ) -> Result<(), Failure> {
        let took = self.progress.finish();
        output.plot()?;
        if let Some(image) = image {
            image.save(&output.portrait()?)?;
            if image.outside > 0 {
                let (few, all) = (image.outside, self.count);
                self.progress.say(&format!("note: {few} of {all} particles are outside of the last picture"));
            }
        }
        let film = self.film.as_ref().map_or_else(|| Ok(Vec::new()), |film| film.join(&self.progress))?;
        let stopped = course.done() < self.scene.steps;
        let done = steps - output.first().step;
        let rate = done as f64 / stepping.as_secs_f64().max(1e-9);
        let (first, last) = (output.first(), output.rows().last().copied().unwrap_or_default());
        let worst = output.rows().iter().map(|row| row.drift_from(&first).abs()).fold(0.0, f64::max);
        self.progress.event(
            "finish",
            json!({ "steps": steps, "stopped": stopped, "seconds": took.as_secs_f64(), "stepping_seconds": stepping.as_secs_f64(), "steps_per_second": rate,
                "energy": last.total(), "energy_error": last.drift_from(&first), "worst_energy_error": worst,
                "adaptive": course.event(), "order": output.flock_statistics().map(|(_, last)| last.order), "output": output.folder().path() }),
        );
        let say = |text: String| self.progress.conclude(&text);
        if stopped {
            say(format!(
                "stopped at step {} of {}; everything up to there is written",
                course.done(),
                self.scene.steps
            ));
        }
        say(summary::speed(done, self.count, stepping, took));
        course.summary().into_iter().for_each(&say);
        // Birds are driven: their energy has no meaning.
        if self.conserved.energy || output.flock_statistics().is_none() {
            say(summary::energy(output.rows(), &self.looks, &self.conserved));
        }
        summary::momentum(output.rows(), &self.conserved).into_iter().for_each(&say);
        output
            .flock_statistics()
            .map(|(first, last)| summary::flock_statistics(first, last))
            .into_iter()
            .for_each(&say);
        self.book.as_ref().and_then(Book::summary).into_iter().for_each(&say);
        self.torn.iter().cloned().chain(output.population().map(summary::population)).for_each(&say);
        let flow = output.population().is_some();
        let more = [
            (output.flock_statistics().is_some(), ", flock.csv"),
            (self.book.is_some(), ", fluid.csv"),
            (flow, ", flow.csv"),
        ];
        let tables: String =
            more.iter().filter(|(is, _)| *is).fold("energy.csv".to_owned(), |all, (_, name)| all + name);
        let picture = if output.pictures() { format!("{}.png, ", self.scene.name) } else { String::new() };
        say(format!(
            "results in {}: {picture}{tables}, energy.svg, scene.toml, {} states",
            output.folder().path().display(),
            output.rows().len()
        ));
        film.into_iter().for_each(&say);
        if stopped { Err(Failure::Stopped) } else { Ok(()) }
    }

    /// What is to be said, and kept, when numbers are lost.
    pub(super) fn explain(&self, error: Error, setup: &Setup, verdict: Option<&Verdict>, engine: &Engine) -> Failure {
        let precision = match engine {
            Engine::Gpu(_) => Precision::Single,
            Engine::Cpu(_) => Precision::Double,
        };
        let way = verdict.and_then(|verdict| substeps::way_out(verdict, &self.scene, setup));
        let to = (&*self.folder, &*self.scene.output.formats, precision);
        aftermath::explain(error, setup, way.as_deref(), self.last.as_ref(), to)
    }
}
