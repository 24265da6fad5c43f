//! Springs that are not stretched farther than so much.

use std::borrow::Cow;
use std::sync::Arc;

use glam::{DVec3, Vec4};

use super::{Component, Over, Problem, Properties, Stage};
use crate::error::Error;
use crate::kernel::{Field, Host, Kernel, POSITION, Pass, Plan, Shader, VELOCITY};
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit;

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("strain", Kind::Positive, Value::Number(0.1), "the largest strain of a spring: its extension over its rest length"),
    Key::new("sweeps", Kind::Count, Value::Number(8.0), "iterations over all springs after a drift: more bring long chains closer to the limit"),
    Key::new("over", Kind::Choice(&["links"]), Value::Text(Cow::Borrowed("links")), "what is limited: springs and ropes"),
];

/// The target positions of a sweep.
const LIMITED: Field<Vec4> = Field::new("limited");

/// `strain_limit`: after each drift, ends of springs longer than (1 + strain) L are brought nearer (Provot 1995), all at once
/// and in several sweeps, with the velocity that this takes. The centre of mass and its momentum stay, fixed particles too;
/// energy is taken. What the sweeps do not reach stays longer: the limit is approached, and not promised.
#[derive(Clone)]
pub struct StrainLimit {
    strain: f64,
    sweeps: u64,
}

impl StrainLimit {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self { strain: settings.number("strain"), sweeps: settings.whole("sweeps") }
    }
    fn sweep(&self, problem: &Problem) -> Result<Kernel, Error> {
        let (holding, held) = problem.holding();
        let tables = visit::Tables::of(problem);
        let shader = Shader::join(&[
            crate::shader!("world.wgsl"),
            crate::shader!("fields.wgsl"),
            crate::shader!("particle.wgsl"),
            holding,
            tables.file(),
            crate::shader!("constraints/strain_limit.wgsl"),
        ])?;
        let constants = [problem.constants(&shader), vec![("STRAIN", self.strain)]].concat();
        let work = u64::from(problem.capacity) + u64::from(problem.network.ends());
        let pass = Pass { constants, work, ..Pass::new(shader, problem.capacity) };
        let (strain, whole) = (self.strain, problem.clone());
        let reference = move |host: &Host| {
            let view = visit::View::of(host)?;
            let (bodies, bounds) = (view.particles(), host.world().bounds);
            let tied = visit::Tied::of(host, tables)?;
            let lightness = |id: usize| if whole.is_held(id) { 0.0 } else { 1.0 / bodies[id].mass };
            let halves: Vec<_> = (0..bodies.len()).map(|id| tied.halves(id)).collect();
            let mut limited = host.write(LIMITED)?;
            for (me, place) in bodies.iter().zip(limited.iter_mut()) {
                let mut change = DVec3::ZERO;
                for half in halves[me.index].iter().filter(|half| half.rest > 0.0 && !half.is_broken()) {
                    let r = bounds.shortest(bodies[half.partner].position - me.position);
                    let excess = r.length() - (1.0 + strain) * half.rest;
                    let (mine, yours) = (lightness(me.index), lightness(half.partner));
                    if excess > 0.0 && mine > 0.0 {
                        let springs = halves[me.index].len().max(halves[half.partner].len()) as f64;
                        change += mine / (mine + yours) * excess / springs * r.normalize();
                    }
                }
                *place = (me.position + change).extend(me.mass);
            }
            Ok(())
        };
        let (name, sizes, scratch) = ("strain_limit".to_owned(), Vec::new(), Vec::new());
        let kernel = Kernel { name, passes: vec![pass], reference: Some(Arc::new(reference)), sizes, scratch, tables: held };
        Ok(visit::bind(kernel, Over::Links, problem))
    }
}

fn apply(problem: &Problem, factor: f64) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("constraints/strain_limit_apply.wgsl")])?;
    let reference = move |host: &Host| {
        let time = factor * host.world().dt;
        let (mut position, mut velocity) = (host.write(POSITION)?, host.write(VELOCITY)?);
        for ((x, v), to) in position.iter_mut().zip(velocity.iter_mut()).zip(host.read(LIMITED)?.iter()) {
            *v += ((to.truncate() - x.truncate()) / time).extend(0.0);
            *x = *to;
        }
        Ok(())
    };
    Ok(Kernel::new("limited", shader, vec![("FACTOR", factor)], problem.capacity, Arc::new(reference)))
}

impl Component for StrainLimit {
    fn properties(&self) -> Properties {
        let why = "strain_limit corrects velocities for a fixed time step";
        Properties { fixed_step: Some(why), limits_links: true, constrains: true, ..Properties::default() }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        let (Stage::AfterDrift { factor } | Stage::AfterAdvance { factor }) = stage else { return Ok(()) };
        let (sweep, apply) = (self.sweep(problem)?, apply(problem, factor)?);
        for _ in 0..self.sweeps {
            plan.add(sweep.clone());
            plan.add(apply.clone());
        }
        Ok(())
    }
}
