//! The f64 reference of laws with history of pairs: brute force finds the pairs in range, and the list locates their history.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use crate::error::Error;
use crate::kernel::{Host, Reference, World};
use crate::neighbors::{HISTORY, LIST, List, NONE, exclusions};
use crate::visit::particle::{Particle, View};
use crate::visit::reference::piece;
use crate::visit::{Outcome, result};

/// The history of a pair, word by word.
pub struct Memory<'a> {
    last: &'a [f64],
    next: &'a mut [f64],
}

impl Memory<'_> {
    /// The value stored by the last step; 0 where the pair was not in range then, or nothing was stored.
    #[must_use]
    pub fn recall(&self, word: usize) -> f64 {
        self.last.get(word).copied().unwrap_or(0.0)
    }
    /// Stores a value for the next step.
    pub fn remember(&mut self, word: usize, value: f64) {
        if let Some(place) = self.next.get_mut(word) {
            *place = value;
        }
    }
}

/// The result of one particle, and the new history of its pairs: indices and values.
struct Made {
    outcome: (usize, Outcome),
    words: Vec<(usize, f64)>,
}

/// All pairs in range, in the order of ids, with `words` words of history.
pub fn remembering<S: Default>(
    range: f64,
    slots: usize,
    gather: impl Fn(&Particle, &Particle, DVec3, &World, &mut Memory<'_>, &mut S) + Send + Sync + 'static,
    finish: impl Fn(&Particle, &S, &World, &mut Outcome) + Send + Sync + 'static,
) -> Reference {
    Arc::new(move |host: &Host| {
        let view = View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        let (count, stride) = (bodies.len(), world.capacity() as usize);
        let list = host.reading::<u32>(LIST)?;
        let mut history = host.writing::<f32>(HISTORY)?;
        let was = history.to_vec();
        let half = (world.step & 1) as usize;
        let left_out = exclusions(host)?;
        let row = |k: usize| -> Result<Option<Made>, Error> {
            let Some(&[end, id]) = list.get(4 * k..4 * k + 2) else { return Ok(None) };
            let Some(me) = bodies.get(id as usize).filter(|_| id != NONE) else { return Ok(None) };
            let mut sum = S::default();
            let mut words = Vec::new();
            let ids: Vec<u32> = (0..end as usize).map_while(|n| list.get(List::place(k, n, stride)).copied()).collect();
            let mut next = vec![vec![0.0; slots]; ids.len()];
            for you in bodies.iter().filter(|you| you.is_active() && you.index != me.index) {
                let way = you.position - me.position;
                if !world.bounds.within(way, range) || left_out.has(me.index, you.index) {
                    continue;
                }
                let missing = || Error::Device(format!("the list of particle {id} lacks particle {}", you.index));
                let n = ids.binary_search(&u32::try_from(you.index).unwrap_or(NONE)).map_err(|_| missing())?;
                let last: Vec<f64> =
                    (0..slots).filter_map(|w| was.get(List::word([k, n, half, w], slots, stride)).copied()).collect();
                gather(
                    me,
                    you,
                    world.bounds.shortest(way),
                    &world,
                    &mut Memory { last: &last, next: &mut next[n] },
                    &mut sum,
                );
            }
            for (n, pair) in next.iter().enumerate() {
                let place = |w: usize| List::word([k, n, 1 - half, w], slots, stride);
                words.extend(pair.iter().enumerate().map(|(w, value)| (place(w), *value)));
            }
            let mut outcome = Outcome::default();
            finish(me, &sum, &world, &mut outcome);
            Ok(Some(Made { outcome: (me.index, outcome), words }))
        };
        let made = (0..count).into_par_iter().with_min_len(piece(count)).map(row).collect::<Result<Vec<_>, _>>()?;
        let mut outcomes = Vec::new();
        for made in made.into_iter().flatten() {
            for (place, value) in made.words {
                history.get_mut(place).into_iter().for_each(|word| *word = value);
            }
            outcomes.push(made.outcome);
        }
        drop((list, history));
        // Each of a pair holds half of its potential energy.
        result::write(host, 0.5, None, outcomes)
    })
}
