//! The virial of a law of pairs, by the same functions as its accelerations.

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec4};
use rayon::prelude::*;

use super::{Law, Over, Particle, View};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Field, Kernel, Name, Pass, Problem, Reference, Shader, Source, World};

/// −½ Σ r ⊗ F of each particle \[energy\], two elements of it: xx, yy, zz, and by how much forces of pairs do not add up to the force; yz,
/// xz, xy, and the sum of their sizes \[force\].
pub const VIRIAL: Field<Vec4> = Field::new("virial");

/// Sums over parts of all pairs, by their name in WGSL, and those of the virial.
const PARTS: (&str, &str) = ("parts", "virial parts");

/// Names of a law's functions and of its sum, and those that they have beside the functions of the virial.
const RENAMED: [(&str, &str); 4] =
    [("gather", "pair_gather"), ("merge", "pair_merge"), ("finish", "pair_finish"), ("Sum", "PairSum")];

impl Law {
    /// A kernel that adds the virial of its forces; `None` for a law that exerts none between particles.
    ///
    /// # Errors
    /// [`Error::Scene`] where they are not those of pairs in range.
    pub fn virial(&self, problem: &Problem) -> Result<Option<Kernel>, Error> {
        if !self.accelerates() || self.over == Over::Each {
            return Ok(None);
        }
        let law = self.settled(problem);
        let refuse = |why: &str| Err(no_virial(&self.name, why));
        match law.over {
            Over::Pairs | Over::Within { .. } | Over::Near { .. } | Over::List { slots: 0, .. } => {}
            Over::List { .. } => return refuse("keeps history of pairs"),
            over => return refuse(&format!("is evaluated over \"{}\"", over.name())),
        }
        if law.wgsl.ours && !law.reciprocal {
            return refuse("exerts forces that are not equal and opposite");
        }
        if law.search.is_some() || law.distant.images {
            return refuse("has more than the forces of single pairs");
        }
        if law.into.iter().any(|name| name != ACCELERATION.name) {
            return refuse("writes columns beside accelerations");
        }
        let name = format!("virial of {}", law.name);
        let [wgsl, beside @ ..] = &law.files_of_virial()[..] else { return Ok(None) };
        let (wgsl, beside, reference) = (wgsl.clone(), beside.to_vec(), law.virial.clone());
        let law = Self { name, wgsl, beside, into: Vec::new(), reference, ..law };
        let mut kernel = law.clone().visiting(problem)?;
        law.bind_tables(&mut kernel, problem)?;
        // Its sums are longer than those of the law.
        let parts = |name: &mut Name| {
            if name == PARTS.0 {
                *name = PARTS.1.into();
            }
        };
        kernel.sizes.iter_mut().for_each(|(name, _)| parts(name));
        kernel.scratch.iter_mut().for_each(parts);
        let binds = |pass: &&mut Pass| pass.shader.reflection().binding(PARTS.0).is_some();
        kernel.passes.iter_mut().filter(binds).for_each(|pass| pass.fields.push((PARTS.0.into(), PARTS.1.into())));
        kernel.sizes.push((VIRIAL.name.into(), 2 * u64::from(problem.capacity)));
        Ok(Some(kernel))
    }
    /// Its file with its functions renamed, and those of the virial.
    fn files_of_virial(&self) -> Vec<Source> {
        let renamed = |file: &Source| {
            let file = RENAMED.iter().fold(file.clone(), |file, (from, to)| file.renamed(from, to));
            Source { file: format!("{} (renamed)", file.file).into(), ..file }
        };
        let mut files = vec![renamed(&self.wgsl)];
        files.extend(self.sums().iter().map(renamed));
        let merges = files.iter().any(|file| file.says(&["fn", "pair_merge", "("]));
        files.push(crate::shader!("visit/virial.wgsl"));
        files.extend(merges.then_some(crate::shader!("visit/virial_merge.wgsl")));
        files
    }
}

/// The error of a force without a virial.
#[must_use]
pub fn no_virial(name: &str, why: &str) -> Error {
    Error::Scene(format!(
        "`{name}` {why}, and the virial is that of forces of pairs in range: leave out what measures the pressure"
    ))
}

/// Sets the virial of all particles to zero.
///
/// # Errors
/// When the shader does not compile.
pub fn clear(problem: &Problem) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("visit/virial_clear.wgsl")])?;
    let reference: Reference = Arc::new(|host| {
        host.write(VIRIAL)?.fill(DVec4::ZERO);
        Ok(())
    });
    let kernel = Kernel::new("virial clear", shader, Vec::new(), problem.capacity, reference);
    Ok(Kernel { sizes: vec![(VIRIAL.name.into(), 2 * u64::from(problem.capacity))], ..kernel })
}

/// The reference: all pairs in range.
pub fn reference<S: Default>(
    over: Over,
    gather: impl Fn(&Particle, &Particle, DVec3, &World, &mut S) + Send + Sync + 'static,
    finish: impl Fn(&Particle, &S, &World) -> DVec4 + Send + Sync + 'static,
) -> Reference {
    Arc::new(move |host| {
        let view = View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        let mut virial = host.write(VIRIAL)?;
        virial.par_chunks_mut(2).zip(&bodies).for_each(|(result, me)| {
            let mut whole = S::default();
            let (mut normal, mut shear, mut sum, mut size) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO, 0.0);
            let force = |sum: &S| me.mass * (finish(me, sum, &world) - finish(me, &S::default(), &world)).truncate();
            for you in bodies.iter().filter(|you| you.index != me.index && me.is_active() && you.is_active()) {
                let way = you.position - me.position;
                if over.range().is_some_and(|range| !world.bounds.within(way, range)) {
                    continue;
                }
                let (mut pair, r) = (S::default(), world.bounds.shortest(way));
                gather(me, you, r, &world, &mut pair);
                gather(me, you, r, &world, &mut whole);
                let f = force(&pair);
                normal -= 0.5 * r * f;
                shear -= 0.25 * DVec3::new(r.y * f.z + r.z * f.y, r.x * f.z + r.z * f.x, r.x * f.y + r.y * f.x);
                sum += f;
                size += f.length();
            }
            result[0] += normal.extend((force(&whole) - sum).length());
            result[1] += shear.extend(size);
        });
        Ok(())
    })
}
