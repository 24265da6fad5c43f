//! The virial of a law of pairs, links, joints or dihedrals, by the same functions as its accelerations.

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec4};
use rayon::prelude::*;

use super::reference::{ByTables, PIECE, left_out, piece, shared_tables};
use super::tied::row;
use super::{Law, Over, Particle, Tables, Tied, View};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Field, Kernel, Name, Pass, Problem, Reference, Shader, Source, World};
use crate::links::{Half, Shared};

/// −½ Σ r ⊗ F of each particle, and of a joint or a dihedral (x − x₂) ⊗ F at each of its ends \[energy\], two elements of it: xx, yy, zz, and by how much
/// these forces do not add up to the force; yz, xz, xy, and the sum of their sizes \[force\].
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
    /// [`Error::Scene`] where they are not those of pairs in range, of links, joints or dihedrals.
    pub fn virial(&self, problem: &Problem) -> Result<Option<Kernel>, Error> {
        if !self.accelerates() || self.over == Over::Each {
            return Ok(None);
        }
        let law = self.settled(problem);
        let refuse = |why: &str| Err(no_virial(&self.name, why));
        match law.over {
            Over::Links
            | Over::Joints
            | Over::Dihedrals
            | Over::Pairs
            | Over::Within { .. }
            | Over::Near { .. }
            | Over::List { slots: 0, .. } => {}
            Over::List { .. } => return refuse("keeps history of pairs"),
            over => return refuse(&format!("is evaluated over \"{}\"", over.name())),
        }
        if law.wgsl.ours && !law.reciprocal {
            return refuse("exerts forces that are not equal and opposite");
        }
        if law.search.is_some() || law.outlined.is_some() || law.distant.images {
            return refuse("has more than the forces of single pairs");
        }
        if law.into.iter().any(|name| name != ACCELERATION.name) {
            return refuse("writes columns beside accelerations");
        }
        let name = format!("virial of {}", law.name);
        let [wgsl, beside @ ..] = &law.files_of_virial()[..] else { return Ok(None) };
        let (wgsl, beside) = (wgsl.clone(), beside.to_vec());
        let reference = law.virial.as_ref().map(|by| by(Tables::of(problem)));
        let law = Self { name, wgsl, beside, into: Vec::new(), reference, tied: None, ..law };
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
        let merges = files.iter().any(|file| file.defines("pair_merge"));
        files.extend(self.beside.iter().map(renamed));
        files.push(crate::shader!("visit/virial.wgsl"));
        files.push(match self.over {
            Over::Links => crate::shader!("visit/virial_links.wgsl"),
            Over::Joints | Over::Dihedrals => crate::shader!("visit/virial_corners.wgsl"),
            _ => crate::shader!("visit/virial_pairs.wgsl"),
        });
        files.extend(merges.then_some(crate::shader!("visit/virial_merge.wgsl")));
        files
    }
}

/// The error of a force without a virial.
#[must_use]
pub fn no_virial(name: &str, why: &str) -> Error {
    Error::Scene(format!(
        "`{name}` {why}, and the virial is that of forces of pairs in range, of links, joints and dihedrals: leave out what measures the pressure"
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

/// The virial of a particle, as it is summed.
#[derive(Default)]
struct Parts {
    normal: DVec3,
    shear: DVec3,
    sum: DVec3,
    size: f64,
}

impl Parts {
    /// Adds a force, with the way to its source, and its part in their virial.
    fn add(&mut self, r: DVec3, f: DVec3, part: f64) {
        self.normal -= part * r * f;
        self.shear -= 0.5 * part * DVec3::new(r.y * f.z + r.z * f.y, r.x * f.z + r.z * f.x, r.x * f.y + r.y * f.x);
        self.sum += f;
        self.size += f.length();
    }
    /// Adds it to the two elements of a particle that has this force in all.
    fn store(&self, result: &mut [DVec4], whole: DVec3) {
        result[0] += self.normal.extend((whole - self.sum).length());
        result[1] += self.shear.extend(self.size);
    }
}

/// The reference: all pairs in range.
pub fn reference<S: Default>(
    over: Over,
    gather: impl Fn(&Particle, &Particle, DVec3, &World, &mut S) + Send + Sync + 'static,
    finish: impl Fn(&Particle, &S, &World) -> DVec4 + Send + Sync + 'static,
) -> ByTables {
    let reference: Reference = Arc::new(move |host| {
        let view = View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        let left_out = left_out(host, over)?;
        let mut virial = host.write(VIRIAL)?;
        virial.par_chunks_mut(2).zip(&bodies).with_min_len(piece(bodies.len())).for_each(|(result, me)| {
            let (mut whole, mut parts) = (S::default(), Parts::default());
            let force = |sum: &S| me.mass * (finish(me, sum, &world) - finish(me, &S::default(), &world)).truncate();
            for you in bodies.iter().filter(|you| you.index != me.index && me.is_active() && you.is_active()) {
                let way = you.position - me.position;
                let is_far = over.range().is_some_and(|range| !world.bounds.within(way, range));
                if is_far || left_out.has(me.index, you.index) {
                    continue;
                }
                let (mut pair, r) = (S::default(), world.bounds.shortest(way));
                gather(me, you, r, &world, &mut pair);
                gather(me, you, r, &world, &mut whole);
                parts.add(r, force(&pair), 0.5);
            }
            parts.store(result, force(&whole));
        });
        Ok(())
    });
    Arc::new(move |_| reference.clone())
}

/// The reference of links.
pub fn links<S: Default>(
    gather: impl Fn(&Particle, &Particle, DVec3, &Half, &mut S) + Send + Sync + 'static,
    finish: impl Fn(&Particle, &S) -> DVec4 + Send + Sync + 'static,
) -> ByTables {
    let rule = Arc::new((gather, finish));
    Arc::new(move |tables| -> Reference {
        let rule = rule.clone();
        Arc::new(move |host| {
            let (view, bounds, tied) = (View::of(host)?, host.world().bounds, Tied::of(host, tables)?);
            let (bodies, (gather, finish)) = (view.particles(), &*rule);
            let mut virial = host.write(VIRIAL)?;
            virial.par_chunks_mut(2).zip(&bodies).with_min_len(PIECE).for_each(|(result, me)| {
                let (mut whole, mut parts) = (S::default(), Parts::default());
                let force = |sum: &S| me.mass * (finish(me, sum) - finish(me, &S::default())).truncate();
                for half in tied.halves(me.index) {
                    let you = &bodies[half.partner];
                    let (mut pair, r) = (S::default(), bounds.shortest(you.position - me.position));
                    gather(me, you, r, &half, &mut pair);
                    gather(me, you, r, &half, &mut whole);
                    parts.add(r, force(&pair), 0.5);
                }
                parts.store(result, force(&whole));
            });
            Ok(())
        })
    })
}

/// The reference of joints and of dihedrals.
pub fn corners<const N: usize, C: Shared<N>>(
    over: Over,
    rule: Arc<impl Fn([&Particle; N], &C, &World) -> DVec4 + Send + Sync + 'static>,
) -> ByTables {
    let names = shared_tables(over);
    let reference: Reference = Arc::new(move |host| {
        let (view, world) = (View::of(host)?, host.world());
        if !host.contains(names[1]) {
            return Ok(());
        }
        let (bodies, start, corner) =
            (view.particles(), host.reading::<u32>(names[0])?, host.reading::<u32>(names[1])?);
        let mut virial = host.write(VIRIAL)?;
        virial.par_chunks_mut(2).zip(&bodies).with_min_len(PIECE).for_each(|(result, me)| {
            let mut parts = Parts::default();
            for corner in row(&start, &corner, me.index, C::WORDS).map(C::new) {
                let (ids, at) = (corner.ids(), corner.ids().map(|id| &bodies[id]));
                // Along the bonds from the second one.
                let bond = |from: usize, to: usize| world.bounds.shortest(at[to].position - at[from].position);
                let r = match ids.iter().position(|id| *id == me.index) {
                    Some(0) => bond(0, 1),
                    Some(place) => (1..place).map(|n| bond(n + 1, n)).sum(),
                    None => DVec3::ZERO,
                };
                parts.add(r, rule(at, &corner, &world).truncate(), 1.0);
            }
            let whole = parts.sum;
            parts.store(result, whole);
        });
        Ok(())
    });
    Arc::new(move |_| reference.clone())
}
