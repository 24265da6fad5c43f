//! A speed within limits.

use std::sync::Arc;

use glam::DVec4;

use super::{Component, Kind as Only, Problem, Properties, SPECIES, Stage, species};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Pass, Plan, Scalar, Shader, VELOCITY};
use crate::visit::Particle;
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("min", Kind::NotNegative, Value::Number(0.0), "the minimum speed; a particle at rest sets off along x [length / time]"),
    Key::required("max", Kind::Positive, "the maximum speed [length / time]"),
    SPECIES,
];

/// `speed_limit`: after every kick, v ← v clamp(|v|, least, most) / |v|. It accelerates no particle by itself.
#[derive(Clone)]
pub struct SpeedLimit(Settings);

impl SpeedLimit {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for SpeedLimit {
    fn properties(&self) -> Properties {
        Properties { constrains: true, ..Properties::default() }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if stage != Stage::AfterKick {
            return Ok(());
        }
        let limits = [self.0.number("min"), self.0.number("max")];
        kernel(problem, limits, species(&self.0, "species").0).map(|kernel| plan.add(kernel))
    }
}

/// The kernel that keeps the speeds of a species between the minimum and the maximum.
///
/// # Errors
/// [`Error::Scene`] when the minimum is above the maximum.
pub fn kernel(problem: &Problem, [least, most]: [f64; 2], species: Only) -> Result<Kernel, Error> {
    if least > most {
        let text = format!("the minimum speed, {least}, is above the maximum, {most}: lower one or raise the other");
        return Err(Error::Scene(text));
    }
    let (holding, tables) = problem.holding();
    let shader = Shader::join(&[
        holding,
        problem.active(),
        crate::shader!("world.wgsl"),
        crate::shader!("law/species.wgsl"),
        crate::shader!("constraints/speed_limit.wgsl"),
    ])?;
    let values = [("least", Scalar::Float(least)), ("most", Scalar::Float(most)), ("species", species.scalar())];
    let params = shader.reflection().binding("params");
    let params = params.map_or(Ok(Vec::new()), |binding| binding.packed.pack("speed_limit", &values))?;
    let pass = Pass { uniforms: vec![("params", params)], alone: true, ..Pass::new(shader, problem.capacity) };
    let problem = problem.clone();
    let reference = move |host: &Host| {
        let view = crate::visit::View::of(host)?;
        let bodies = view.particles();
        let mut velocity = host.write(VELOCITY)?;
        let has = |body: &Particle| species.has(body) && body.is_active() && !problem.is_held(body.index);
        for (v, _) in velocity.iter_mut().zip(&bodies).filter(|(_, body)| has(body)) {
            let speed = v.truncate().length();
            if speed > most {
                *v *= DVec4::splat(most / speed).with_w(1.0);
            } else if speed == 0.0 && least > 0.0 {
                v.x = least;
            } else if speed < least {
                *v *= DVec4::splat(least / speed).with_w(1.0);
            }
        }
        Ok(())
    };
    let name = "speed_limit".to_owned();
    Ok(Kernel { name, passes: vec![pass], reference: Some(Arc::new(reference)), sizes: Vec::new(), scratch: Vec::new(), tables })
}
