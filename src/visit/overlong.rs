//! Bonds that are longer than their law admits: they raise the alarm.

use std::sync::Arc;

use super::particle::View;
use super::reference::ByTables;
use super::tied::Tied;
use super::{Law, Tables};
use crate::kernel::{ALARM, Host, Reference};

/// The first words of the alarm: the steps that are done, and the lowest particle.
const WORDS: usize = 12;

impl Law {
    /// The same law, of links of which the stiff ones are shorter than `longest`. Its WGSL calls `fn overlong(me, you)` for others, which exert no
    /// force.
    #[must_use]
    pub fn shorter_than(mut self, longest: f64) -> Self {
        self.beside = vec![crate::shader!("own/alarm.wgsl"), crate::shader!("visit/overlong.wgsl")];
        self.tied = self.tied.map(|tied| raising(tied, longest));
        Self { longest: Some(longest), ..self }
    }
}

/// References that raise the alarm beside.
fn raising(tied: ByTables, longest: f64) -> ByTables {
    Arc::new(move |tables| -> Reference {
        let forces = tied(tables);
        Arc::new(move |host: &Host| {
            forces(host)?;
            // A few particles outside any problem have no alarm.
            if tables == Tables::None || !host.contains(ALARM.name) {
                return Ok(());
            }
            let (view, world, tied) = (View::of(host)?, host.world(), Tied::of(host, tables)?);
            let bodies = view.particles();
            let mut alarm = host.write(ALARM)?;
            for me in &bodies {
                let long = |partner: usize| {
                    let r = world.bounds.shortest(bodies[partner].position - me.position);
                    1.0 - r.length_squared() / (longest * longest) <= 0.0
                };
                let beyond = tied.halves(me.index).into_iter().any(|half| half.stiffness > 0.0 && long(half.partner));
                if beyond && alarm[WORDS] >= world.step {
                    alarm[WORDS] = world.step;
                    alarm[WORDS + 1] = alarm[WORDS + 1].min(u32::try_from(me.index).unwrap_or(u32::MAX));
                }
            }
            Ok(())
        })
    })
}
