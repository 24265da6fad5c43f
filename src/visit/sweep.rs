//! A search for neighbours that is no law of its own: it reads and writes the fields of a method that takes several.

use glam::DVec3;
use rayon::prelude::*;

use super::near::{self, Candidate};
use super::particle::{Particle, View};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Pass, Problem, Scalar, Shader, Source, Twin};
use crate::neighbors::Grid;

/// A search of everybody for those in range. Its files say, between them: `struct Sum`, `fn acts_on(me: Particle) -> bool`, `fn gather(me, you, r, sum)` and `fn deliver(k: u32, me, sum)`, which is
/// for who stands in slot k.
pub struct Sweep {
    /// What it is called in a plan.
    pub name: String,
    /// What it searches; it holds everybody.
    pub grid: Grid,
    /// What it loads of a neighbour.
    pub candidate: Candidate,
    /// Its own files.
    pub files: Vec<Source>,
    /// The members of its `Params`, by name; none where it has none.
    pub params: Vec<(&'static str, Scalar)>,
    /// Values for its `override`s, of which it may leave some out.
    pub constants: Vec<(&'static str, f64)>,
    /// The same in f64.
    pub twin: Twin,
}

impl Sweep {
    /// The kernel for such a problem. Where the grid keeps those apart who are held, they do not look around.
    ///
    /// # Errors
    /// [`Error::Shader`] when a file does not compile, [`Error::Scene`] when a block has other members.
    pub fn kernel(self, problem: &Problem) -> Result<Kernel, Error> {
        let (ahead, cells) = (self.grid.ahead(problem), f64::from(self.grid.count()));
        let mut kernel = self.from(ahead, problem)?;
        // Of those who stand in slots, searches end at the last who is not held.
        let ends = kernel.passes.iter_mut().flat_map(|pass| &mut pass.constants).filter(|(name, _)| *name == "CELLS");
        ends.for_each(|(_, end)| *end = cells);
        Ok(kernel)
    }
    /// The same where everybody looks around, whoever is held too.
    ///
    /// # Errors
    /// As [`Sweep::kernel`].
    pub fn kernel_of_all(self, problem: &Problem) -> Result<Kernel, Error> {
        self.from(problem.count, problem)
    }
    fn from(self, targets: u32, problem: &Problem) -> Result<Kernel, Error> {
        let mut sources = near::ground();
        sources.push(self.grid.present(problem));
        sources.extend(near::search(&self.grid, &problem.machine, self.candidate));
        sources.push(crate::shader!("own/no_turns.wgsl"));
        sources.extend(self.files);
        let shader = Shader::join(&sources)?;
        let uniforms = block(&self.name, &shader, "params", &self.params)?;
        let mut constants = problem.constants(&shader);
        constants.extend(shader.reflection().known(&self.constants));
        let pass = Pass { constants, uniforms, ..Pass::new(shader, 0) };
        Ok(Kernel {
            name: self.name,
            passes: near::passes(&self.grid, &pass, targets, problem)?,
            twin: Some(self.twin),
            sizes: near::sizes(&self.grid),
            scratch: Vec::new(),
            tables: Vec::new(),
        })
    }
}

/// The contents of a uniform block, where the shader has it.
///
/// # Errors
/// [`Error::Scene`] when the block has other members.
pub fn block(
    whose: &str,
    shader: &Shader,
    name: &'static str,
    values: &[(&'static str, Scalar)],
) -> Result<Vec<(&'static str, Vec<u8>)>, Error> {
    match shader.reflection().binding(name) {
        Some(binding) => Ok(vec![(name, binding.packed.pack(whose, values)?)]),
        None => Ok(Vec::new()),
    }
}

/// What everybody gathers who lives and is chosen, of all others in range, in the order of their ids: the twin of a [`Sweep`].
///
/// # Errors
/// When the host lacks positions or velocities.
pub fn gathered<S: Default + Send>(
    host: &Host,
    range: f64,
    chosen: impl Fn(&Particle) -> bool + Sync,
    gather: impl Fn(&Particle, &Particle, DVec3, &mut S) + Sync,
) -> Result<Vec<Option<S>>, Error> {
    let view = View::of(host)?;
    let (bodies, bounds) = (view.particles(), host.world().bounds);
    let gathered = |me: &Particle| {
        let mut sum = S::default();
        for you in bodies.iter().filter(|you| you.lives() && you.index != me.index) {
            let way = you.position - me.position;
            if bounds.within(way, range) {
                gather(me, you, bounds.shortest(way), &mut sum);
            }
        }
        sum
    };
    Ok(bodies.par_iter().map(|me| (me.lives() && chosen(me)).then(|| gathered(me))).collect())
}
