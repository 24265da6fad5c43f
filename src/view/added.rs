//! What a hand adds to the forces of a scene: obstacles, and a trap that follows the pointer.

use glam::DVec3;

use super::stage::Stage;
use super::tool::{self, Tool};
use crate::component::{Change, Component};
use crate::error::Error;
use crate::forces;
use crate::kernel::{ACCELERATION, Array, Backend};
use crate::settings::{Settings, Value};

/// A ball that was placed without a drag is so large \[halves of the picture's height\].
const BALL: f64 = 0.1;
/// The shortest drag.
const LEAST: f64 = 0.01;
/// The radius of a bar \[halves of the picture's height\].
const BAR: f64 = 0.03;

/// The forces after those of the scene.
#[derive(Default)]
pub struct Added {
    /// As they were added; nothing is the trap.
    forces: Vec<Option<Box<dyn Component>>>,
    /// The acceleration that was usual when the present pull began.
    usual: Option<f64>,
}

impl Added {
    /// The place of the trap among them.
    fn trap(&self) -> Option<usize> {
        self.forces.iter().position(Option::is_none)
    }
}

/// A component by its name, with settings that its keys take.
fn made(name: &str, settings: Vec<(&'static str, Value)>) -> Result<Box<dyn Component>, Error> {
    let entry = forces::entry(name).ok_or_else(|| Error::Scene(format!("there is no force `{name}`")))?;
    Ok((entry.build)(
        &settings.into_iter().fold(Settings::defaults(entry.keys), |all, (key, value)| all.with(key, value)),
    ))
}

impl<B: Backend> Stage<B> {
    /// The forces as they were at the start, or when they were added; nothing for the trap, which is not set by hand.
    pub fn original(&self) -> Vec<Option<&dyn Component>> {
        let added = self.added.forces.iter().map(Option::as_deref);
        self.start.forces.iter().map(|force| Some(&**force)).chain(added).collect()
    }
    /// The number of obstacles.
    pub fn obstacles(&self) -> usize {
        self.added.forces.iter().flatten().count()
    }
    /// Where a place on the picture \[halves of its height\] is, and the direction away from the eye there; in two dimensions in their plane, and across it.
    fn ray(&self, across: f64, up: f64) -> Result<(DVec3, DVec3), Error> {
        let (point, direction) = self.picture().frame.camera.ray(across, up);
        if self.start.bounds.dimensions != 2 {
            return Ok((point, direction));
        }
        if direction.z.abs() < 1e-3 {
            return Err(Error::Scene(
                "the plane of the particles is seen edge-on: turn the camera, or press 5".to_owned(),
            ));
        }
        Ok(((point - point.z / direction.z * direction).with_z(0.0), DVec3::Z))
    }
    /// Pulls particles to a place on the picture, within a reach \[halves of its height\] and by a multiple of what is usual; below 0 it pushes.
    pub async fn pull(&mut self, across: f64, up: f64, reach: f64, strength: f64) -> Result<(), Error> {
        let (position, axis) = self.ray(across, up)?;
        let usual = match self.added.usual {
            Some(usual) => usual,
            None => self.usual().await?,
        };
        self.added.usual = Some(usual);
        // The pull is greatest at half the waist, and 2 U / √e w there.
        let waist = 2.0 * reach * self.picture().frame.camera.extent;
        let depth = strength * usual * waist * 0.5 * std::f64::consts::E.sqrt();
        let mut settings = vec![("position", position.into()), ("axis", axis.into()), ("waist", waist.into())];
        settings.push(("depth", depth.into()));
        let Some(place) = self.added.trap() else {
            return self.add(None, made("tweezers", settings)?).await;
        };
        let settings: Vec<_> = settings.into_iter().map(|(key, value)| (key, value.into())).collect();
        self.trap(place, &settings)
    }
    /// Ends the pull.
    pub fn release(&mut self) -> Result<(), Error> {
        let pulls = self.added.usual.take().is_some();
        match self.added.trap() {
            Some(place) if pulls => self.trap(place, &[("depth", 0.0.into())]),
            _ => Ok(()),
        }
    }
    fn trap(&mut self, place: usize, settings: &[(&str, Change)]) -> Result<(), Error> {
        let names = self.simulation.settings();
        let Some((name, _)) = names.get(self.start.forces.len() + place) else { return Ok(()) };
        let name = name.clone();
        self.simulation.set_all(&name, settings)
    }
    async fn usual(&mut self) -> Result<f64, Error> {
        let accelerations = match self.simulation.read_column(ACCELERATION.name).await {
            Ok(Array::Vec4(values)) => values.iter().map(|a| a.truncate().length()).collect(),
            Ok(Array::Vec3(values)) => values.iter().map(|a| a.length()).collect(),
            // A device that is lost says so at the next step.
            _ => Vec::new(),
        };
        let settings = self.simulation.settings();
        let weights =
            settings.iter().filter(|(name, _)| name.starts_with("uniform")).flat_map(|(_, settings)| settings);
        let weights =
            weights.filter(|setting| setting.name == "acceleration").filter_map(|setting| match setting.value {
                Value::Vector(a) => Some(a.length()),
                _ => None,
            });
        let weight = weights.fold(0.0, f64::max);
        let state = self.simulation.snapshot().await?;
        Ok(tool::usual(&state, &accelerations, weight, &self.picture().frame.camera, self.dt()))
    }
    /// Places a ball about a place on the picture \[halves of its height\], or a bar from there, as far away as the centre.
    pub async fn place(&mut self, tool: Tool, from: [f64; 2], to: [f64; 2]) -> Result<(), Error> {
        let [begin, end] = [self.ray(from[0], from[1])?.0, self.ray(to[0], to[1])?.0];
        let long = (to[0] - from[0]).hypot(to[1] - from[1]);
        let (radius, position) = match tool {
            Tool::Bar if long < LEAST => {
                return Err(Error::Scene("a bar is as long as the drag that draws it".to_owned()));
            }
            Tool::Bar => (BAR, begin.midpoint(end)),
            _ => (if long < LEAST { BALL } else { long }, begin),
        };
        let radius = self.picture().frame.camera.extent * radius;
        let snapshot = self.simulation.snapshot().await?;
        let reach = snapshot.scalar("radius").unwrap_or_default().iter().copied().fold(0.0, f64::max);
        let mut settings = vec![("position", position.into()), ("radius", radius.into()), ("thickness", reach.into())];
        if tool == Tool::Bar {
            settings.extend([("shape", "capsule".into()), ("axis", (end - begin).into())]);
        }
        let obstacle = made("solid", settings)?;
        self.add(Some(obstacle.clone()), obstacle).await
    }
    async fn add(&mut self, shown: Option<Box<dyn Component>>, force: Box<dyn Component>) -> Result<(), Error> {
        let mut forces = self.simulation.setup().forces.clone();
        forces.push(force);
        self.go_on(forces).await?;
        self.added.forces.push(shown);
        self.surround();
        Ok(())
    }
    /// Removes the last obstacle.
    pub async fn remove(&mut self) -> Result<(), Error> {
        let Some(place) = self.added.forces.iter().rposition(Option::is_some) else { return Ok(()) };
        let mut forces = self.simulation.setup().forces.clone();
        forces.remove(self.start.forces.len() + place);
        self.go_on(forces).await?;
        self.added.forces.remove(place);
        self.surround();
        Ok(())
    }
    /// Shows the obstacles that there are now.
    pub fn surround(&mut self) {
        let present = self.present();
        self.pictures.surround(&present);
    }
}
