//! Springs that break.

use std::borrow::Cow;
use std::sync::Arc;

use super::{Component, Over, Problem, Properties, Stage};
use crate::error::Error;
use crate::kernel::{Kernel, Pass, Plan, Shader, Reference};
use crate::links::{Half, WORDS};
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::{self, LINK, LINK_START};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("strain", Kind::Positive, Value::Number(0.5), "the strain at which a spring breaks: its extension over its rest length"),
    Key::new("over", Kind::Choice(&["links"]), Value::Text(Cow::Borrowed("links")), "what breaks: springs and ropes"),
];

/// `tear`: at the end of a step, springs and ropes that are longer than (1 + strain) L break, forever. Their energy is gone.
#[derive(Clone)]
pub struct Tear(f64);

impl Tear {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.number("strain"))
    }
    fn reference(&self) -> Reference {
        #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
        let strain = self.0 as f32;
        Arc::new(move |host| {
            let view = visit::View::of(host)?;
        let (bodies, bounds) = (view.particles(), host.world().bounds);
            let (start, mut link) = (host.reading::<u32>(LINK_START)?, host.writing::<u32>(LINK)?);
            for (me, row) in bodies.iter().zip(start.windows(2)) {
                for words in link[row[0] as usize * WORDS..row[1] as usize * WORDS].chunks_exact_mut(WORDS) {
                    let half = Half::new(words);
                    // In the device's own arithmetic: a link at the very limit breaks on both.
                    let r = bounds.shortest_single(bodies[half.partner].position - me.position);
                    #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
                    let longest = (1.0 + strain) * half.rest as f32;
                    if longest > 0.0 && r.length_squared() > longest * longest {
                        (words[2], words[3]) = (0, 0);
                    }
                }
            }
            Ok(())
        })
    }
}

impl Component for Tear {
    fn properties(&self) -> Properties {
        Properties { breaks_bonds: true, ..Properties::default() }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if stage != Stage::EndOfStep {
            return Ok(());
        }
        let shader = Shader::join(&[
            crate::shader!("world.wgsl"),
            crate::shader!("fields.wgsl"),
            crate::shader!("particle.wgsl"),
            crate::shader!("updaters/tear.wgsl"),
        ])?;
        let constants = [problem.constants(&shader), vec![("STRAIN", self.0)]].concat();
        let work = u64::from(problem.capacity) + u64::from(problem.network.ends());
        let pass = Pass { constants, work, ..Pass::new(shader, problem.capacity) };
        let (name, reference, passes) = (format!("tear STRAIN={}", self.0), Some(self.reference()), vec![pass]);
        let (sizes, scratch, tables) = (Vec::new(), Vec::new(), Vec::new());
        plan.add(visit::bind(Kernel { name, passes, reference, sizes, scratch, tables }, Over::Links, problem));
        Ok(())
    }
}
