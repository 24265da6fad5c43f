//! The scene of an evacuation: pedestrians at random on the floor of a plan.

use std::collections::HashMap;
use std::fmt::Write as _;

use glam::DVec2;

use crate::crowds::{DECAY, FRICTION, Press, REPULSION, STIFFNESS};
use crate::error::Error;
use crate::floor_plan::FloorPlan;
use crate::formats::floor_plan::Landing;
use crate::settings::Settings;
use crate::shapes::random::Random;

/// Places tried for one pedestrian, as of the shape `crowd`.
const TRIES: u32 = 20_000;
/// The side of a square is at least the largest diameter of any model \[m\].
const SQUARE: f64 = 0.7;
/// Deviation, minimum and maximum of desired speeds as parts of their mean (Weidmann 1993: 0.26, 0.5 and 2.2 of 1.34 m/s).
const SPREAD: [f64; 3] = [0.26 / 1.34, 0.5 / 1.34, 2.2 / 1.34];
/// The mass of each pedestrian \[kg\].
const MASS: f64 = 80.0;
/// The fluctuations of velocities, σ √(τ / 2) = 0.2 m/s in the mean square \[m/s^(3/2)\]: without them two may block each other before a door for ever.
const WANDER: f64 = 0.4;
/// The interval between samples \[s\].
const SAMPLE: f64 = 0.25;
/// The most others that one may touch: π / asin(0.25 / 0.6) = 7.3 of the smallest radius around one of the largest.
const CONTACTS: f64 = 7.0;
/// The most steps between two samples: those of a mean speed of some 60 m/s.
const MOST_STEPS: f64 = 10_000.0;
/// The largest step that friction between the fastest allows is divided by this.
const SAFE: f64 = 0.97;
/// The distance in which walls turn pedestrians of the collision-free speed model away, which the fastest do not go in a step \[m\].
const TURNED: f64 = 0.02;

/// How pedestrians move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Model {
    /// By forces: Helbing, Farkas & Vicsek (2000).
    #[default]
    SocialForce,
    /// By velocities: Tordeux, Chraibi & Seyfried (2015).
    CollisionFreeSpeed,
}

impl Model {
    /// Every model.
    pub const ALL: [Self; 2] = [Self::SocialForce, Self::CollisionFreeSpeed];
    /// Its name, which is that of the component.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::SocialForce => "social_force",
            Self::CollisionFreeSpeed => "collision_free_speed",
        }
    }
    /// In a sentence: pedestrians follow …
    #[must_use]
    pub fn about(self) -> &'static str {
        match self {
            Self::SocialForce => "the social force model of Helbing, Farkas & Vicsek (2000)",
            Self::CollisionFreeSpeed => "the collision-free speed model of Tordeux, Chraibi & Seyfried (2015)",
        }
    }
    /// Radii are uniform between these \[m\]: as of the shape `crowd`, where shoulders press; about that of JuPedSim, 0.2 m, where they do not.
    #[must_use]
    pub fn radii(self) -> [f64; 2] {
        match self {
            Self::SocialForce => [0.25, 0.35],
            Self::CollisionFreeSpeed => [0.18, 0.22],
        }
    }
    /// The longest step for pedestrians whose fastest has this speed \[s\].
    fn longest_step(self, fastest: f64) -> f64 {
        match self {
            // The overlap g of two that meet head on at the largest speed: 2 κ g / m times dt is 4 / CONTACTS at most, as `check` asks.
            Self::SocialForce => {
                let press = Press::of(&Settings::defaults(&[REPULSION, DECAY, STIFFNESS, FRICTION]));
                let overlap = fastest * (2.0 * MASS / press.stiffness).sqrt();
                SAFE * 2.0 / CONTACTS * MASS / (press.friction * overlap)
            }
            Self::CollisionFreeSpeed => TURNED / fastest,
        }
    }
    /// The integrator of its scene.
    fn integrator(self) -> &'static str {
        match self {
            Self::SocialForce => "leapfrog",
            Self::CollisionFreeSpeed => "symplectic_euler",
        }
    }
    /// Its forces beside `navigate`.
    fn forces(self, seed: u64, fastest: f64) -> String {
        match self {
            Self::SocialForce => format!(
                "[[force]]\nkind = \"social_force\"\n\n[[force]]\nkind = \"social_wall\"\n\n[[force]]\nkind = \"wander\"\nstrength = {WANDER:?}\nseed = {seed}\n"
            ),
            Self::CollisionFreeSpeed => {
                let own = Settings::defaults(crate::interactions::collision_free_speed::KEYS);
                let needed = 2.0 * self.radii()[1] + fastest * own.number("time_gap");
                let range = own.number("range").max((10.0 * needed).ceil() / 10.0);
                format!("[[force]]\nkind = \"collision_free_speed\"\nrange = {range:?}\n")
            }
        }
    }
}

/// The pedestrians of an evacuation.
#[derive(Debug, Clone, PartialEq)]
pub struct Crowd {
    /// The number.
    pub people: u32,
    /// How they move.
    pub model: Model,
    /// The seed of places, radii and speeds.
    pub seed: u64,
    /// The mean of desired speeds \[m/s\].
    pub speed: f64,
    /// The rectangles that they start in, each by two corners; none: the whole floor \[m\].
    pub within: Vec<[DVec2; 2]>,
    /// Where the floor is outside of the building, and none starts.
    pub outside: Vec<Landing>,
}

/// A scene of a crowd.
#[derive(Debug, Clone, PartialEq)]
pub struct Start {
    /// The text of the scene.
    pub text: String,
    /// The steps between two samples.
    pub every: u32,
    /// The time at which it ends \[s\].
    pub limit: f64,
}

impl Start {
    /// The same scene with another end \[s\].
    #[must_use]
    pub fn until(&self, time: f64) -> String {
        self.text.replacen(&format!("\nuntil = {:?}\n", self.limit), &format!("\nuntil = {time:?}\n"), 1)
    }
}

/// The scene of a crowd on a plan, whose text as WKT and whose names of exits are given, for `limit` seconds at most.
///
/// # Errors
/// [`Error::Scene`] where there is no room for so many.
pub fn scene(plan: &FloorPlan, (wkt, about): (&str, &str), crowd: &Crowd, limit: f64) -> Result<Start, Error> {
    let longest = crowd.model.longest_step(SPREAD[2] * crowd.speed);
    let parts = (SAMPLE / longest).ceil().max(1.0);
    if parts > MOST_STEPS {
        return Err(Error::Scene(format!(
            "pedestrians with a mean speed of {} m/s need steps of {longest:.1e} s, of which {SAMPLE} s has more than {MOST_STEPS}: choose a lower --speed (walking is 1.34)",
            crowd.speed
        )));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked to be few")]
    let every = parts as u32;
    let bodies = bodies(plan, crowd)?;
    let (low, high) = plan.extent();
    let (size, low) = (high - low + 2.0, low - 1.0);
    let names: Vec<String> = plan.exits().iter().map(|exit| format!("{:?}", exit.name)).collect();
    let (reach, cell) = (plan.exits().first().map_or(0.25, |exit| exit.reach), plan.cell());
    let (dt, extent, middle) = (SAMPLE / parts, 0.5 * size.y, low + 0.5 * size);
    let height = (960.0 * size.y / size.x).clamp(240.0, 1920.0).round();
    let comment = format!("# {}\n", about.replace('\n', "\n# "));
    let text = format!(
        "{comment}\n[simulation]\ndt = {dt:?}\nuntil = {limit:?}\nintegrator = {:?}\n\n[box]\nsize = [{:?}, {:?}, 0]\nlow = [{:?}, {:?}, 0]\nboundary = \"open\"\n\n\
         [plan]\ncell = {cell:?}\nreach = {reach:?}\nexits = [{}]\nwkt = \"\"\"\n{wkt}\n\"\"\"\n\n[[particles]]\nbodies = [\n{bodies}]\n\n[[force]]\nkind = \"navigate\"\n\n{}\n\
         [output]\nevery = {every}\nformats = []\n\n[picture]\nwidth = 960\nheight = {height:?}\neye = [0, 0, 1]\nup = [0, 1, 0]\n\
         projection = \"orthographic\"\nauto_frame = false\ncenter = [{:?}, {:?}, 0]\nextent = {extent:?}\ncolor = \"speed\"\n",
        crowd.model.integrator(),
        size.x,
        size.y,
        low.x,
        low.y,
        names.join(", "),
        crowd.model.forces(crowd.seed, SPREAD[2] * crowd.speed),
        middle.x,
        middle.y
    );
    Ok(Start { text, every, limit })
}

/// Discs, by squares whose side is the largest diameter.
#[derive(Default)]
struct Placed(HashMap<(i64, i64), Vec<(DVec2, f64)>>);

impl Placed {
    #[expect(clippy::cast_possible_truncation, reason = "plans are small against the numbers of squares")]
    fn square(x: DVec2) -> (i64, i64) {
        let place = (x / SQUARE).floor();
        (place.x as i64, place.y as i64)
    }
    fn leave_free(&self, x: DVec2, radius: f64) -> bool {
        let (column, row) = Self::square(x);
        let near = (-1..=1).flat_map(|i| (-1..=1).map(move |j| (column + i, row + j)));
        let mut discs = near.filter_map(|square| self.0.get(&square)).flatten();
        discs.all(|(y, other)| x.distance(*y) >= radius + other)
    }
    fn push(&mut self, x: DVec2, radius: f64) {
        self.0.entry(Self::square(x)).or_default().push((x, radius));
    }
}

/// The pedestrians, a line each.
fn bodies(plan: &FloorPlan, crowd: &Crowd) -> Result<String, Error> {
    let (low, high) = plan.extent();
    let areas = if crowd.within.is_empty() { vec![[low, high]] } else { crowd.within.clone() };
    let areas: Vec<[DVec2; 2]> = areas.iter().map(|[a, b]| [a.min(*b).max(low), a.max(*b).min(high)]).collect();
    let sizes: Vec<f64> = areas.iter().map(|[a, b]| (*b - *a).max(DVec2::ZERO).element_product()).collect();
    let whole: f64 = sizes.iter().sum();
    let (cells, mut random) = (plan.cells(), Random::new(crowd.seed));
    let steps = cells.steps();
    let [least, most] = crowd.model.radii();
    let mut placed = Placed::default();
    let mut text = String::new();
    for i in 0..crowd.people {
        let radius = random.between(least, most);
        let free = |x: DVec2| {
            let apart = |exit: &crate::floor_plan::Exit| exit.distance(x) > exit.reach + radius;
            placed.leave_free(x, radius)
                && plan.holds(x)
                && !crowd.outside.iter().any(|landing| landing.holds(x))
                && plan.exits().iter().all(apart)
                && cells.around(x).into_iter().any(|k| steps[k].is_some())
                && plan.distance(x) >= radius
        };
        let tried = (0..TRIES).find_map(|_| {
            let mut at = whole * random.uniform();
            let area = areas.iter().zip(&sizes).find(|(_, size)| {
                at -= **size;
                at <= 0.0
            });
            let [a, b] = area.map_or([low, high], |(area, _)| *area);
            let x = a + (b - a) * DVec2::new(random.uniform(), random.uniform());
            free(x).then_some(x)
        });
        let Some(x) = tried else {
            let what = if crowd.within.is_empty() { "of the floor" } else { "of the rectangles of --start" };
            return Err(Error::Scene(format!(
                "{} pedestrians have no room: after {i} no free place {what} with a way to an exit was found in {TRIES} tries; ask for fewer with --people{}",
                crowd.people,
                if crowd.within.is_empty() { ", or check the scale of the plan" } else { ", or a larger --start" }
            )));
        };
        let [deviation, least, most] = SPREAD.map(|part| part * crowd.speed);
        let mut speed = crowd.speed + deviation * random.normal();
        while !(least..=most).contains(&speed) {
            speed = crowd.speed + deviation * random.normal();
        }
        placed.push(x, radius);
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "  {{ position = [{:?}, {:?}, 0.0], mass = {MASS:?}, size = {radius:?}, radius = {radius:?}, desired_speed = {speed:?} }},",
            x.x, x.y
        );
    }
    Ok(text)
}
