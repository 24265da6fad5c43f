//! `picture_*.png`, and the last of them under the name of the scene.

use std::sync::Arc;

use super::Folder;
use super::images;
use super::stream::Stream;
use super::table::Lengths;
use super::writer::Writer;
use crate::error::Error;
use crate::kernel::Bounds;
use crate::measure::Moment;
use crate::render::{Color, Image, Picture, Scenery, Trail, framed, group_color, pack};
use crate::scene::{Group, Scene};
use crate::settings::Settings;
use crate::simulation::Setup;
use crate::state::State;
#[cfg(feature = "panel")]
use crate::{render::Camera, settings::Value};

/// The approximate number of points of a trail.
const TRAIL: u64 = 1000;

/// The pictures of a run, and the last of them.
#[derive(Debug)]
pub struct Pictures {
    name: String,
    wanted: bool,
    picture: Settings,
    /// The same before a closed box was framed, with the width of the scene's picture for its height; until all particles are framed.
    #[cfg(feature = "panel")]
    unframed: Option<(Settings, f64)>,
    groups: Vec<Group>,
    digits: usize,
    /// The number of steps between two points of a trail.
    stride: u64,
    folder: Option<Arc<Folder>>,
    stream: Stream,
    /// The trails, for runs with few particles.
    pub(super) trail: Trail,
    /// The objects that pictures show in addition to particles, and the box at the start.
    scenery: Scenery,
    bounds: Bounds,
    last: Option<Arc<Image>>,
}

impl Pictures {
    /// The pictures of a scene with `count` particles.
    pub(super) fn new(scene: &Scene, count: usize, (scenery, bounds): (Scenery, Bounds), stream: Stream) -> Self {
        // A trail is needed only for pictures.
        let drawn = scene.output.pictures || scene.output.frames > 0;
        Self {
            name: scene.name.clone(),
            wanted: scene.output.pictures,
            picture: framed(&scene.picture, &bounds),
            #[cfg(feature = "panel")]
            unframed: Some((scene.picture.clone(), aspect(&scene.picture))),
            groups: scene.groups.clone(),
            digits: scene.steps.to_string().len(),
            stride: (scene.steps / TRAIL).max(1),
            folder: None,
            stream,
            trail: Trail::new(if drawn { count } else { 0 }),
            scenery,
            bounds,
            last: None,
        }
    }
    /// The pictures of a scene with this setup, of which no file is written.
    #[cfg(feature = "panel")]
    #[must_use]
    pub fn beside(scene: &Scene, setup: &Setup) -> Self {
        let of = Self::new(scene, setup.state.len(), (scenery(setup), setup.bounds), Stream::default());
        Self { trail: Trail::new(setup.state.len()), ..of }
    }
    /// Whether each output is drawn.
    #[must_use]
    pub fn wanted(&self) -> bool {
        self.wanted
    }
    /// Whether colours show a column.
    pub(super) fn shows_column(&self) -> bool {
        self.picture.text("color") == "column"
    }
    /// The last picture.
    #[must_use]
    pub fn last(&self) -> Option<&Image> {
        self.last.as_deref()
    }
    /// The number of steps until the next point of the trail; `None` where there is no trail.
    pub(super) fn until_point(&self, steps: u64) -> Option<u64> {
        self.trail.wanted().then(|| self.stride - steps % self.stride)
    }
    /// Whether the trail gets a point after `steps` steps.
    pub(super) fn points_at(&self, steps: u64) -> bool {
        self.trail.wanted() && steps.is_multiple_of(self.stride)
    }
    /// The objects beside the particles at a time, in a box that may have changed since the start.
    #[must_use]
    pub fn scenery(&self, bounds: &Bounds, time: f64) -> Scenery {
        if *bounds == self.bounds { self.scenery.at(time) } else { self.scenery.clone().within(bounds).at(time) }
    }
    /// The picture of a state, to be drawn, with this trail.
    ///
    /// # Errors
    /// As for [`Picture::with`].
    pub fn of(&self, snapshot: &State, trail: Trail) -> Result<Picture, Error> {
        let of = |id: usize| {
            let found = self.groups.iter().position(|g| g.ids.start as usize <= id && id < g.ids.end as usize);
            u32::try_from(found.unwrap_or(0)).unwrap_or(0)
        };
        let groups: Vec<u32> = (0..snapshot.len()).map(of).collect();
        let scenery = self.scenery(&snapshot.boxed(&self.bounds), snapshot.time);
        let mut picture = Picture::with(&self.picture, snapshot, &groups, trail, &scenery)?;
        // Colours of the scene take precedence over the palette, unless another colouring was chosen.
        if !["speed", "heading", "column"].contains(&self.picture.text("color"))
            && self.groups.iter().any(|g| g.color.is_some())
        {
            let color = |group: &u32| {
                let own = self.groups.get(*group as usize).and_then(|g| g.color);
                pack(own.unwrap_or_else(|| group_color(*group)))
            };
            picture.color = Color::Given(groups.iter().map(color).collect());
        }
        Ok(picture)
    }
}

/// The width of a picture for its height.
#[cfg(feature = "panel")]
fn aspect(picture: &Settings) -> f64 {
    picture.number("width") / picture.number("height")
}

/// The objects that pictures of a setup show beside particles.
pub(super) fn scenery(setup: &Setup) -> Scenery {
    let properties = || setup.forces.iter().map(|force| force.properties());
    let walls = setup.state.floor_plan.iter().flat_map(|plan| plan.standing());
    let standing = properties().filter_map(|of| of.pictured).chain(walls).collect();
    let expansion = properties().find_map(|of| of.expands).map(|expands| expands.expansion);
    let scenery = Scenery { expansion, ..Scenery::of(&setup.state).within(&setup.bounds) };
    scenery.beside(standing, &setup.state)
}

/// What a viewer changes.
#[cfg(feature = "panel")]
impl Pictures {
    /// The settings of its pictures.
    #[must_use]
    pub fn looks(&self) -> &Settings {
        &self.picture
    }
    /// Shows the obstacles of a setup beside its particles from now on.
    pub fn surround(&mut self, setup: &Setup) {
        self.scenery = scenery(setup);
    }
    /// Changes one of them; returns the old value.
    pub fn set(&mut self, key: &'static str, value: Value) -> Option<Value> {
        if let Some((unframed, _)) = &mut self.unframed {
            unframed.0.insert(key, value.clone());
        }
        self.picture.0.insert(key, value)
    }
    /// Takes another size \[pixels\], in which all that the scene's picture shows has its place.
    pub fn size(&mut self, width: u32, height: u32) {
        self.set("width", width.into());
        self.set("height", height.into());
        if let Some((unframed, wide)) = &self.unframed {
            let mut given = unframed.clone();
            if !given.flag("auto_frame") {
                let extent = given.number("extent") * (wide / aspect(&given)).max(1.0);
                given = given.with("extent", extent.into());
            }
            self.picture = framed(&given, &self.bounds);
        }
    }
    /// Frames all particles from the direction of a camera.
    pub fn aim(&mut self, camera: &Camera) {
        self.unframed = None;
        self.set("eye", camera.back.into());
        self.set("up", camera.up.into());
        self.set("projection", camera.projection().into());
        self.set("auto_frame", true.into());
    }
    /// The trails.
    pub fn trail(&mut self) -> &mut Trail {
        &mut self.trail
    }
}

impl Writer for Pictures {
    fn open(&mut self, folder: &Arc<Folder>, _: &Lengths) -> Result<(), Error> {
        self.folder = Some(folder.clone());
        Ok(())
    }
    fn take(&mut self, _: &Moment<'_>) -> Result<(), Error> {
        Ok(())
    }
    fn picture(&mut self, moment: &Moment<'_>) -> Result<Option<Picture>, Error> {
        self.wanted.then(|| self.of(moment.state, self.trail.clone())).transpose()
    }
    fn drawn(&mut self, step: u64, image: Image) -> Result<(), Error> {
        let image = Arc::new(image);
        if let Some(folder) = &self.folder {
            let path = folder.file(&format!("picture_{step:0width$}.png", width = self.digits))?;
            images::save_later(&image, path, folder, &self.stream)?;
        }
        self.last = Some(image);
        Ok(())
    }
    fn finish(&mut self) -> Result<(), Error> {
        match (&self.last, &self.folder) {
            (Some(image), Some(folder)) => images::save(image, &folder.file(&format!("{}.png", self.name))?),
            _ => Ok(()),
        }
    }
}
