//! The simulation that is watched, and its picture.

use glam::{DVec2, DVec3, DVec4};

use super::Make;
use super::added::Added;
use crate::component::Component;
use crate::error::Error;
use crate::kernel::{Array, Backend, Column, Kind, POSITION, Shape};
use crate::render::{Camera, Color, Image, KEYS, Live, PROJECTED, Picture, Trail};
use crate::run::Pictures;
use crate::scene::{Scene, Shared};
use crate::settings::{Settings, Value};
use crate::simulation::{Setup, Simulation};
use crate::state::State;

/// How far from a small particle one may point at it, as a part of the height of the picture.
const NEAR: f64 = 0.012;

/// What a picture has of the one before it.
#[derive(Clone, Copy, Default)]
struct Kept {
    /// The scale of colours, if it shows the same. Otherwise it is that of present values.
    scale: bool,
    /// The camera, also where it was not moved by hand.
    camera: bool,
}

/// A simulation with its picture.
pub struct Stage<B: Backend> {
    /// The name of the scene, and what it says of itself.
    pub name: String,
    pub about: String,
    pub simulation: Simulation<B>,
    /// What it began with.
    pub start: Setup,
    make: Make<B>,
    pub(super) pictures: Pictures,
    /// The picture of the scene.
    pub(super) looks: Settings,
    live: Live,
    /// The keys of particles and emitters that had their values from forces.
    pub(super) shared: Vec<Shared>,
    /// The state by which the picture was framed.
    framed: State,
    /// Whether the camera was moved by hand.
    moved: bool,
    /// Whether all particles were framed from where the camera was.
    aimed: bool,
    /// Whether the forces have changed since the last picture.
    stale: bool,
    time: f64,
    /// Samples of a pixel each way where edges are smooth.
    fine: u32,
    /// What was added to the forces of the scene: obstacles, and the trap of the hand.
    pub(super) added: Added,
}

impl<B: Backend> Stage<B> {
    /// A scene with its setup.
    pub async fn new(scene: &Scene, start: Setup, make: Make<B>) -> Result<Self, Error> {
        let mut pictures = Pictures::beside(scene, &start);
        let mut simulation = make(&start)?;
        let framed = simulation.snapshot().await?;
        let trail = pictures.trail().clone();
        let live = Live::new(pictures.of(&framed, trail)?);
        let (time, fine) = (framed.time, live.picture.frame.fine);
        let (name, about) = (scene.name.clone(), scene.about.clone());
        Ok(Self {
            name,
            about,
            simulation,
            start,
            make,
            pictures,
            looks: scene.picture.clone(),
            shared: scene.shared.clone(),
            live,
            framed,
            moved: false,
            aimed: false,
            stale: false,
            time,
            fine,
            added: Added::default(),
        })
    }
    pub fn dt(&self) -> f64 {
        self.start.dt
    }
    pub fn time(&self) -> f64 {
        self.time
    }
    /// Whether the camera was moved by hand.
    pub fn moved(&self) -> bool {
        self.moved
    }
    /// Whether all particles were framed from where the camera was.
    pub fn aimed(&self) -> bool {
        self.aimed
    }
    pub fn picture(&self) -> &Picture {
        &self.live.picture
    }
    /// A key of the picture.
    pub fn text(&self, key: &str) -> String {
        self.pictures.looks().text(key).to_owned()
    }
    /// The columns that colours can show, and what they are.
    pub fn shown_columns(&self) -> Vec<(String, String)> {
        // Of a rotation no number shows anything.
        let shown = |column: &&Column| column.shape == Shape::Particle && column.kind != Kind::Quaternion;
        let columns = self.simulation.columns().iter().filter(shown);
        columns.map(|column| (column.name.to_string(), column.with_unit(&column.about))).collect()
    }
    pub fn number(&self, key: &str) -> f64 {
        self.pictures.looks().number(key)
    }
    /// Advances, and looks for faults.
    pub async fn advance(&mut self, steps: u32) -> Result<(), Error> {
        if steps == 0 {
            return Ok(());
        }
        self.simulation.step(steps)?;
        self.simulation.check().await?;
        let clock = self.simulation.clock().await?;
        self.time = clock.map_or(self.simulation.steps() as f64 * self.start.dt, |clock| clock.time);
        if self.pictures.trail().wanted() {
            let positions = self.simulation.read(POSITION).await?;
            let positions: Vec<DVec3> = positions.iter().map(|x| x.as_dvec4().truncate()).collect();
            self.pictures.trail().push(&positions);
        }
        Ok(())
    }
    /// Whether the last picture was of this size, and as smooth, and another one of the same state would be the same.
    pub fn shows(&self, [width, height]: [u32; 2], smooth: bool) -> bool {
        let frame = &self.live.picture.frame;
        let fine = if smooth { self.fine } else { 1 };
        self.live.is_settled() && (frame.width, frame.height, frame.fine) == (width, height, fine)
    }
    /// Draws a picture of this size on the device \[pixels\]: with smooth edges where there is time for them.
    pub async fn draw(&mut self, [width, height]: [u32; 2], smooth: bool) -> Result<(), Error> {
        let frame = &self.live.picture.frame;
        if [frame.width, frame.height] != [width, height] {
            self.pictures.size(width, height);
            self.compose(Kept { scale: true, camera: false })?;
        }
        if std::mem::take(&mut self.stale) {
            self.compose_anew(Kept { scale: false, camera: true }).await?;
        } else if self.live.picture.frame.count != self.simulation.capacity() {
            self.compose_anew(Kept { scale: true, camera: false }).await?;
        }
        self.live.picture.frame.fine = if smooth { self.fine } else { 1 };
        let bounds = self.simulation.bounds().await?;
        let scenery = self.pictures.scenery(&bounds, self.time);
        self.live.picture.place(scenery.solids);
        self.live.picture.contain(scenery.tanks);
        let trail = self.pictures.trail().clone();
        self.live.picture.retrace(trail);
        self.simulation.show(&mut self.live).await
    }
    /// A picture of the known state; a camera that was moved by hand stays.
    fn compose(&mut self, kept: Kept) -> Result<(), Error> {
        let camera = self.live.picture.frame.camera;
        let trail = self.pictures.trail().clone();
        let mut picture = self.pictures.of(&self.framed, trail)?;
        if self.moved || kept.camera {
            picture.frame.camera = camera;
        }
        let known = &self.live.picture.color;
        if kept.scale && known.shows_as(&picture.color) {
            picture.paint(known.clone());
        }
        self.fine = picture.frame.fine;
        self.live.change(picture);
        Ok(())
    }
    /// A picture of the present state.
    async fn compose_anew(&mut self, kept: Kept) -> Result<(), Error> {
        self.framed = self.simulation.snapshot().await?;
        self.compose(kept)
    }
    /// Where in the columns the values of the particle lie that the last picture shows at a place \[halves of its height, to the right and up from
    /// its middle\]: of those whose ball covers it the foremost, otherwise the nearest of the small ones that are a few pixels away.
    pub async fn found(&mut self, across: f64, up: f64) -> Result<Option<usize>, Error> {
        let frame = &self.live.picture.frame;
        let (width, height) = (f64::from(frame.width), f64::from(frame.height));
        let at = 0.5 * DVec2::new(width + across * height, height - up * height);
        let (near, count) = (NEAR * height, frame.count as usize);
        let Array::Vec4(drawn) =
            self.simulation.backend().read(PROJECTED.name, &Array::Vec4(Vec::new()), count).await?
        else {
            return Ok(None);
        };
        let drawn = drawn.iter().enumerate().filter(|(_, x)| x.w >= 0.0);
        let away = |x: &DVec4| at.distance(x.truncate().truncate());
        let ball = drawn.clone().filter(|(_, x)| away(x) <= x.w).min_by(|a, b| a.1.z.total_cmp(&b.1.z));
        let small =
            || drawn.clone().filter(|(_, x)| away(x) <= x.w + near).min_by(|a, b| away(a.1).total_cmp(&away(b.1)));
        Ok(ball.or_else(small).map(|(place, _)| place))
    }
    /// Changes a key of the picture.
    pub async fn look(&mut self, key: &'static str, value: Value) -> Result<(), Error> {
        // A word may change the defaults of other keys.
        let looks = self.pictures.looks();
        let mut all = vec![(key, value)];
        if let (Some(of), Value::Text(word)) = (KEYS.iter().find(|of| of.name == key), &all[0].1) {
            let by_default = |name: &str| KEYS.iter().find(|of| of.name == name).and_then(|of| of.default.clone());
            let before = of.preset(looks.text(key)).iter().filter(|(name, value)| looks.0.get(name) == Some(value));
            let again = before.filter_map(|(name, _)| Some((*name, by_default(name)?)));
            let under = of.preset(word).iter().map(|(name, value)| (*name, value.clone()));
            let others: Vec<_> = again.chain(under).collect();
            all.extend(others);
        }
        let old: Vec<_> = all.into_iter().map(|(key, value)| (key, self.pictures.set(key, value))).collect();
        let kept = Kept { scale: true, camera: true };
        let composed = self.compose_anew(kept).await;
        if composed.is_err() {
            for (key, value) in old.into_iter().rev() {
                value.and_then(|value| self.pictures.set(key, value));
            }
            self.compose(kept)?;
        }
        composed
    }
    /// Takes another scale of colours where values of the run have outgrown the present one, or fill less than half of it;
    /// whether it does.
    pub async fn follow(&mut self, state: &State) -> Result<bool, Error> {
        let known = &self.live.picture.color;
        let Some(mut own) = known.anew(state) else { return Ok(false) };
        if matches!(own, Color::Column(_)) {
            let mut picture = self.live.picture.clone();
            picture.paint(own);
            self.simulation.scale(&mut picture).await?;
            own = picture.color;
        }
        let other = !known.fits(&own);
        if other {
            self.live.picture.paint(own);
        }
        Ok(other)
    }
    /// Moves the camera.
    pub fn camera(&mut self, moved: impl FnOnce(Camera) -> Camera) {
        let camera = &mut self.live.picture.frame.camera;
        let next = moved(*camera);
        if next.center.is_finite() && (1e-30..1e30).contains(&next.extent) {
            (*camera, self.moved) = (next, true);
        }
    }
    /// All particles in the picture, from where the camera is.
    pub async fn frame(&mut self) -> Result<(), Error> {
        let camera = self.live.picture.frame.camera;
        self.pictures.aim(&camera);
        (self.moved, self.aimed) = (false, true);
        self.compose_anew(Kept::default()).await
    }
    /// Changes a setting of a force. Where kernels depend on it, they are compiled anew for the present state, and this is said.
    pub async fn set(&mut self, force: &str, setting: &str, value: Value) -> Result<Option<String>, Error> {
        let Err(refused) = self.simulation.set(force, setting, value.clone()) else { return Ok(None) };
        let place = self.simulation.settings().iter().position(|(name, _)| name == force);
        let Some(place) = place else { return Err(refused) };
        let mut forces = self.simulation.setup().forces.clone();
        // What is invalid stays refused.
        forces[place] = forces[place].changed(setting, &value.into())?;
        self.go_on(forces).await?;
        Ok(Some(format!("`{setting}` of `{force}` changes what kernels do: they were compiled anew")))
    }
    /// Goes on with other forces at the present state.
    pub(super) async fn go_on(&mut self, forces: Vec<Box<dyn Component>>) -> Result<(), Error> {
        let state = self.simulation.snapshot().await?;
        let setup = Setup { state, forces, ..self.simulation.setup().clone() };
        let mut simulation = (self.make)(setup.in_its_box()?.as_ref())?;
        simulation.check().await?;
        (self.simulation, self.stale) = (simulation, true);
        Ok(())
    }
    /// What it began with, and the present forces.
    pub fn present(&self) -> Setup {
        Setup { forces: self.simulation.setup().forces.clone(), ..self.start.clone() }
    }
    /// Back to the start, with the present settings.
    pub async fn reset(&mut self) -> Result<(), Error> {
        self.begin((self.make)(&self.present())?).await
    }
    /// Back to the start, with the settings of the scene.
    pub async fn restore(&mut self) -> Result<(), Error> {
        let simulation = (self.make)(&self.start)?;
        self.added = Added::default();
        self.begin(simulation).await
    }
    async fn begin(&mut self, simulation: Simulation<B>) -> Result<(), Error> {
        self.simulation = simulation;
        self.surround();
        *self.pictures.trail() = Trail::new(self.start.state.len());
        self.time = self.start.state.time;
        self.compose_anew(Kept::default()).await
    }
    /// Adds notes to a picture that is saved, where they are wanted.
    pub fn annotate(&self, image: &mut Image) {
        if self.live.picture.annotated() {
            image.annotate(&self.live.picture, self.time);
        }
    }
    /// A picture of the present state, and a name for its file.
    pub async fn take(&mut self) -> Result<(Image, String), Error> {
        self.live.picture.frame.fine = self.fine;
        let mut image = self.simulation.draw(&self.live.picture).await?;
        self.annotate(&mut image);
        // Drawing it has taken the fields away.
        self.live.change(self.live.picture.clone());
        Ok((image, format!("{}_{:06}.png", self.name, self.simulation.steps())))
    }
}
