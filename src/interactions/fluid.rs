//! A fluid, weakly compressible.

use std::borrow::Cow;
use std::sync::Arc;

use glam::DVec3;

use super::{Component, Law, Over, Problem, Properties, Resolved, SKIN, Stage, over_within};
use crate::error::Error;
use crate::sph::{
    self, Asked, Boxed, COURANT, Continuity, Continuum, Dfsph, Form, Friction, Limits, Medium, Rates, Smoothing, Tension, WallMass, Walls,
};
use crate::kernel::{Bounds, Column, Plan};
use crate::settings::{Key, Kind, Preset, Settings, Value};
use crate::visit::Loads;

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("regime", Kind::Choice(&["general", "viscous"]), Value::Text(Cow::Borrowed("general")), "\"viscous\", for flows between walls without a surface, at Reynolds numbers up to some 100: other defaults of kernel, support, density_by, diffusion, negative_pressure, viscosity_form, walls and wall_mass; keys that are given win").with_presets(REGIMES),
    Key::new("density", Kind::Positive, Value::Number(1000.0), "the density at rest [mass / length³, or mass / length² in two dimensions]").shared(),
    Key::required("spacing", Kind::Positive, "the spacing of particles at rest, on a cubic lattice [length]").shared(),
    Key::new("support", Kind::Positive, Value::Number(2.0), "the support radius of the kernel [spacings]").shared(),
    Key::new("kernel", Kind::Choice(Smoothing::NAMES), Value::Text(Cow::Borrowed("cubic")), "the smoothing kernel: the cubic spline, or Wendland's C2").shared(),
    Key::new("solver", Kind::Choice(&["wcsph", "dfsph"]), Value::Text(Cow::Borrowed("wcsph")), "pressure by an equation of state, or solved for (Bender & Koschier 2015)"),
    Key::new("sound_speed", Kind::NotNegative, Value::Number(0.0), "wcsph: the speed of sound: ten times the fastest flow makes the density vary by 1 % [length / time]"),
    Key::new("gamma", Kind::Count, Value::Number(7.0), "the exponent of Tait's equation p = (ρ₀ c² / γ) ((ρ/ρ₀)^γ − 1), 2 to 15"),
    Key::new("negative_pressure", Kind::Flag, Value::Flag(false), "whether pressure may be below 0: where there is no free surface"),
    Key::new("alpha", Kind::NotNegative, Value::Number(0.0), "the artificial viscosity α (Monaghan 1992)"),
    Key::new("viscosity", Kind::NotNegative, Value::Number(0.0), "the kinematic viscosity ν, of the form viscosity_form [length² / time]"),
    Key::new("viscosity_form", Kind::Choice(FORMS), Value::Text(Cow::Borrowed("central")), "the form of the viscosity: along the line between two particles, which preserves angular momentum (Monaghan & Gingold 1983; Cleary 1998; Monaghan 2005), or along the difference of their velocities, which is more accurate in channels on a lattice and takes the angular momentum of a fluid with a free surface (Morris, Fox & Zhu 1997)"),
    Key::new("xsph", Kind::NotNegative, Value::Number(0.0), "ε of XSPH: the fraction by which velocities move towards the mean of the neighbours in each step (Schechter & Bridson 2012), which takes energy and angular momentum, whatever the resolution"),
    Key::new("wall_friction", Kind::NotNegative, Value::Number(1.0), "the part of both viscosities that acts at walls; 0: free slip"),
    Key::new("walls", Kind::Choice(WALLS), Value::Text(Cow::Borrowed("mirror")), "the pressure of walls: that of the particle at the wall (Akinci et al. 2012), or that of the fluid around them (Adami, Hu & Adams 2012, as if they were not accelerated)"),
    Key::new("wall_mass", Kind::Choice(WALL_MASS), Value::Text(Cow::Borrowed("sampled")), "the mass of wall particles: from their spacing, for one layer (Akinci et al. 2012), or that of a lattice particle, for several layers").shared(),
    Key::new("density_by", Kind::Choice(DENSITY_BY), Value::Text(Cow::Borrowed("summation")), "how density is computed: by summation over neighbours, or by the continuity equation (Monaghan 1994), which has no deficit at free surfaces"),
    Key::new("diffusion", Kind::NotNegative, Value::Number(0.0), "density_by = \"continuity\": the density diffusion δ, for instance 0.1 (Molteni & Colagrossi 2009)"),
    Key::new("weight", Kind::Vector, Value::Vector(DVec3::ZERO), "the gravitational acceleration that another force applies, so that density diffusion (Fourtakas et al. 2019) and walls preserve hydrostatic equilibrium [length / time²]"),
    Key::new("tension", Kind::NotNegative, Value::Number(0.0), "the surface tension coefficient γ (Akinci, Akinci & Teschner 2013), which is not the physical σ: with density 1000, in three dimensions, σ is about 25 000, 55 000 or 75 000 γ spacing² where support is 2, 2.5 or 3"),
    Key::new("adhesion", Kind::NotNegative, Value::Number(0.0), "the adhesion coefficient β of walls (Akinci, Akinci & Teschner 2013)"),
    Key::new("over", Kind::Choice(&["near", "list", "auto"]), Value::Text(Cow::Borrowed("near")), "wcsph: how neighbours are found: by a cell list, by a neighbour list that is reused over steps, or by the faster of both"),
    SKIN,
    Key::new("tolerance", Kind::Positive, Value::Number(1e-4), "dfsph: the tolerance of the mean density error [relative to the density]"),
    Key::new("divergence_tolerance", Kind::Positive, Value::Number(1e-3), "dfsph: the tolerance of the mean density change by divergence in a step [relative to the density]"),
    Key::new("min_iterations", Kind::Count, Value::Number(2.0), "dfsph: the minimum number of iterations of a solve"),
    Key::new("max_iterations", Kind::Count, Value::Number(50.0), "dfsph: the maximum number of iterations of a solve"),
];

/// Rows of particles that slide past each other keep their order where walls have the pressure of the fluid around them, and the kernel
/// is smooth and wide: see the guide.
const REGIMES: &[Preset] = &[Preset {
    word: "viscous",
    defaults: &[
        ("kernel", Value::Text(Cow::Borrowed("wendland"))),
        ("support", Value::Number(3.0)),
        ("density_by", Value::Text(Cow::Borrowed("continuity"))),
        ("diffusion", Value::Number(0.1)),
        ("negative_pressure", Value::Flag(true)),
        ("viscosity_form", Value::Text(Cow::Borrowed("morris"))),
        ("walls", Value::Text(Cow::Borrowed("extrapolate"))),
        ("wall_mass", Value::Text(Cow::Borrowed("lattice"))),
    ],
}];
const FORMS: &[&str] = &["central", "morris"];
const WALLS: &[&str] = &["mirror", "extrapolate"];
const WALL_MASS: &[&str] = &["sampled", "lattice"];
const DENSITY_BY: &[&str] = &["summation", "continuity"];

/// `fluid`: smoothed particle hydrodynamics with density by summation or continuity and Tait's equation of state (Monaghan 1994; Becker &
/// Teschner 2007). Particles that are not fixed are of the fluid; fixed ones are its boundary particles (Akinci et al. 2012).
#[derive(Clone)]
pub struct Fluid(Settings);

impl Fluid {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
    /// The fluid in the box of a problem.
    ///
    /// # Errors
    /// [`Error::Setting`] when there is no such fluid.
    pub fn medium(&self, bounds: &Bounds) -> Result<Medium, Error> {
        let number = |name| self.0.number(name);
        let exponent = u32::try_from(self.0.whole("gamma")).unwrap_or(u32::MAX);
        if !(2..=15).contains(&exponent) {
            return Err(Error::Setting { key: "gamma", why: format!("a fluid has gamma = {exponent}: Tait's exponent is a whole number from 2 to 15; water has 7") });
        }
        let support = number("support");
        if !(1.5..=6.0).contains(&support) {
            return Err(Error::Setting { key: "support", why: format!(
                "a fluid has support = {support} spacings: below 1.5 particles have no neighbours, and above 6 they have \
                 hundreds; choose 2 to 3"
            ) });
        }
        let solves = self.solves();
        if !solves && number("sound_speed") == 0.0 {
            return Err(Error::Setting { key: "solver", why: 
                "a fluid has no sound_speed: give ten times the speed of the fastest flow, or solver = \"dfsph\", which needs none"
                    .to_owned() });
        }
        let medium = Medium {
            density: number("density"),
            spacing: number("spacing"),
            support,
            smoothing: Smoothing::named(self.0.text("kernel")),
            sound: if solves { 0.0 } else { number("sound_speed") },
            exponent,
            negative: self.0.flag("negative_pressure"),
            dimensions: bounds.dimensions,
        };
        medium.check()?;
        Ok(medium)
    }
    /// Whether its pressure is solved for.
    fn solves(&self) -> bool {
        self.0.text("solver") == "dfsph"
    }
    fn dfsph<'a>(&self, medium: Medium, problem: &'a Problem) -> Result<Dfsph<'a>, Error> {
        let number = |name| self.0.number(name);
        let count = |name| u32::try_from(self.0.whole(name)).unwrap_or(u32::MAX);
        let asked = Asked {
            density: number("tolerance"),
            divergence: number("divergence_tolerance"),
            least: count("min_iterations"),
            most: count("max_iterations"),
        };
        Dfsph::new(medium, asked, problem)
    }
    fn friction(&self) -> Friction {
        let number = |name| self.0.number(name);
        let form = if self.0.text("viscosity_form") == "morris" { Form::Morris } else { Form::Central };
        Friction { alpha: number("alpha"), viscosity: number("viscosity"), form, wall: number("wall_friction") }
    }
    fn tension(&self) -> Option<Tension> {
        let tension = Tension { tension: self.0.number("tension"), adhesion: self.0.number("adhesion") };
        (tension.tension > 0.0 || tension.adhesion > 0.0).then_some(tension)
    }
    fn walls(&self) -> Walls {
        if self.0.text("walls") == "extrapolate" {
            return Walls::Extrapolate { weight: self.0.vector("weight") };
        }
        Walls::Mirror
    }
    fn wall_mass(&self) -> WallMass {
        if self.0.text("wall_mass") == "lattice" { WallMass::Lattice } else { WallMass::Sampled }
    }
    /// The options of the density, where it is a state.
    fn continuity(&self) -> Result<Option<Continuity>, Error> {
        let diffusion = self.0.number("diffusion");
        let carried = self.0.text("density_by") == "continuity" || self.0.text("walls") == "extrapolate";
        if self.solves() && carried && self.0.text("regime") == "viscous" {
            return Err(Error::Setting { key: "regime", why: 
                "a fluid with regime = \"viscous\" has density_by = \"continuity\" and walls = \"extrapolate\" unless they are given, and a \
                 pressure that is solved for has neither: leave out regime, or solver = \"dfsph\""
                    .to_owned() });
        }
        if self.solves() && carried {
            return Err(Error::Setting { key: "solver", why: 
                "a fluid with solver = \"dfsph\" has its density by summation, and its walls have the pressure of the particles that press on \
                 them: leave out density_by = \"continuity\" and walls = \"extrapolate\", or say solver = \"wcsph\""
                    .to_owned() });
        }
        if self.0.text("density_by") == "continuity" {
            return Ok(Some(Continuity { diffusion, weight: self.0.vector("weight") }));
        }
        if diffusion > 0.0 {
            return Err(Error::Setting { key: "diffusion", why: format!(
                "a fluid has diffusion = {diffusion} of a density by summation, which has no state to diffuse: say \
                 density_by = \"continuity\", or diffusion = 0"
            ) });
        }
        Ok(None)
    }
}

impl Component for Fluid {
    fn columns(&self) -> Vec<Column> {
        // Settings that contradict each other are refused where the fluid is resolved.
        if matches!(self.continuity(), Ok(Some(_))) {
            return sph::continuity_columns(self.0.number("density"));
        }
        let mut all = sph::summed();
        if self.solves() {
            all.extend(sph::dfsph_columns());
        }
        all
    }
    fn properties(&self) -> Properties {
        let on = |name| self.0.number(name) > 0.0;
        let (solves, friction) = (self.solves(), self.friction());
        // Pressure by summation is the slope of the internal energy, and the equation of continuity goes along with it; nothing
        // else is. Friction along the difference of two velocities, and the curvature of a surface, turn a fluid.
        let all = [
            (on("viscosity") || on("alpha") && !solves, "viscosity"),
            (on("xsph"), "XSPH"),
            (self.tension().is_some(), "surface tension, which is not counted"),
            (on("diffusion"), "diffusion"),
            (solves, "pressure that is solved for"),
        ];
        let turning = [
            (on("viscosity") && friction.form == Form::Morris, "viscosity_form = \"morris\""),
            (on("xsph"), "XSPH"),
            (self.tension().is_some(), "surface tension"),
        ];
        let caution = "alpha is proportional to the speed of sound, which a pressure solve does not have: give viscosity instead";
        Properties {
            evaluated_last: solves,
            dissipates: all.into_iter().filter(|(is, _)| *is).map(|(_, what)| what).collect(),
            dissipates_at_walls: vec!["walls"],
            makes_fluid: true,
            limits_steps: true,
            turns: turning.into_iter().filter(|(is, _)| *is).map(|(_, what)| what).collect(),
            integrators: if solves { &["symplectic_euler"] } else { &[] },
            largest_move: solves.then(|| COURANT * self.0.number("spacing")),
            caution: (solves && on("alpha")).then_some(caution),
            ..Properties::default()
        }
    }
    fn check(&self, bounds: &Bounds) -> Result<(), Error> {
        let medium = self.medium(bounds)?;
        self.continuity()?;
        if self.solves() && self.0.text("over") == "list" {
            return Err(Error::Setting { key: "over", why:
                "a fluid with solver = \"dfsph\" stores its neighbours in each step, and has no list that is kept over several: leave out over = \"list\", or \
                 say solver = \"wcsph\"".to_owned() });
        }
        medium.fits(bounds)
    }
    fn resolved(&self, problem: &Problem) -> Result<Resolved, Error> {
        self.check(&problem.bounds)?;
        let (medium, continuity) = (self.medium(&problem.bounds)?, self.continuity()?);
        let weighs = self.walls() != Walls::Mirror || continuity.is_some_and(|its| its.diffusion > 0.0);
        let weight = weighs.then(|| self.0.vector("weight"));
        let fluid = Continuum { medium, walls: self.wall_mass(), summed: continuity.is_none(), weight };
        Ok(Resolved {
            cell_lists: medium.grid_over(self.over().faster(Loads::Fields, problem), problem)?.into_iter().map(|grid| (grid, true)).collect(),
            fluid: Some(fluid),
            rates: Some(Rates::of(&medium, self.friction(), self.0.number("xsph"))),
            viscous_steps: sph::viscous_steps(&medium, self.friction(), problem),
            ..Resolved::default()
        })
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        match stage {
            Stage::Start => self.begin(plan, problem),
            Stage::Evaluate { .. } => self.evaluate(plan, problem),
            Stage::Carry { .. } => self.rate().map_or(Ok(()), |law| law.kernel(problem).map(|kernel| plan.add(kernel))),
            Stage::StepLimit => {
                let sound = (!self.solves()).then(|| self.0.number("sound_speed"));
                sph::limits(&self.boxed(), self.over(), Limits { sound, alpha: self.friction().alpha }, plan, problem)
            }
            Stage::EndOfStep if self.solves() => self.dfsph(self.medium(&problem.bounds)?, problem)?.conclude(plan),
            Stage::AfterKick | Stage::AfterDrift { .. } | Stage::AfterAdvance { .. } | Stage::StartOfStep | Stage::Pressure | Stage::EndOfStep | Stage::Virial { .. } => Ok(()),
        }
    }
    fn laws(&self) -> Vec<Law> {
        [self.density(), self.rate(), self.wall_pressure()].into_iter().flatten().chain(self.pushes()).collect()
    }
}

impl Fluid {
    /// The fluid in a box that is not known yet.
    fn boxed(&self) -> Boxed {
        let own = self.clone();
        Arc::new(move |bounds| own.medium(bounds))
    }
    /// How its neighbours are found.
    fn over(&self) -> Over {
        let range = self.0.number("support") * self.0.number("spacing");
        // A pressure solve stores the pairs of each step.
        if self.solves() { Over::Near { range, of: None } } else { over_within(&self.0, range, None) }
    }
    /// Whether its laws need states: where pressure is solved for, there is neither sound nor a pressure by an equation of state, but
    /// friction and tension remain.
    fn has_states(&self) -> bool {
        !self.solves() || self.friction().viscosity > 0.0 || self.0.number("xsph") > 0.0 || self.tension().is_some()
    }
    fn density(&self) -> Option<Law> {
        let summed = matches!(self.continuity(), Ok(None));
        (summed && self.has_states()).then(|| sph::density(&self.boxed(), self.over()))
    }
    /// The rate of a density that is carried along with positions.
    fn rate(&self) -> Option<Law> {
        let continuity = self.continuity().ok().flatten()?;
        Some(sph::rate(&self.boxed(), self.over(), continuity))
    }
    fn wall_pressure(&self) -> Option<Law> {
        let Walls::Extrapolate { weight } = self.walls() else { return None };
        Some(sph::wall_pressure(&self.boxed(), self.over(), weight))
    }
    /// The laws that accelerate it, and what they need of its surface.
    fn pushes(&self) -> Vec<Law> {
        let (of, over, friction, xsph) = (self.boxed(), self.over(), self.friction(), self.0.number("xsph"));
        let pushed = !self.solves() || friction.viscosity > 0.0;
        let mut laws = Vec::new();
        laws.extend(pushed.then(|| sph::pressure(&of, over, friction, self.walls())));
        laws.extend((xsph > 0.0).then(|| sph::xsph(&of, over, xsph)));
        laws.extend(self.tension().into_iter().flat_map(|tension| sph::tension(&of, over, tension)));
        laws
    }
    fn begin(&self, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        let medium = self.medium(&problem.bounds)?;
        if !problem.held.is_empty() {
            plan.add(medium.grid(problem)?.kernel(problem, true)?);
            plan.add(sph::walls(&self.boxed(), self.wall_mass(), problem)?);
        }
        Ok(())
    }
    fn evaluate(&self, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        let (medium, over) = (self.medium(&problem.bounds)?, self.over().faster(Loads::Fields, problem));
        self.continuity()?;
        if let Some(law) = self.density() {
            plan.add(law.kernel(problem)?);
        }
        if self.has_states() {
            plan.add(sph::state(&medium, over, problem)?);
        }
        if let Some(law) = self.wall_pressure().filter(|_| !problem.held.is_empty()) {
            plan.add(law.kernel(problem)?);
            plan.add(sph::wall_state(&medium, over, problem)?);
        }
        for law in self.pushes() {
            plan.add(law.kernel(problem)?);
        }
        if self.solves() {
            self.dfsph(medium, problem)?.evaluate(plan)?;
        }
        Ok(())
    }
}
