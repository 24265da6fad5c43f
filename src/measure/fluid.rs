//! The ledger of a fluid: conserved quantities and failures, summed in f64.

use glam::DVec3;

use super::series::{number, whole};
use super::{Cell, Measure, Moment, Needs, Row, Series, Times};
use crate::error::Error;
use crate::kernel::{Bounds, Machine, Reason};
use crate::settings::{Settings, plain};
use crate::simulation::Setup;
use crate::sph::Medium;
use crate::state::State;

/// `fluid.csv`.
pub const MEASURE: Measure = Measure {
    name: "fluid",
    about: "mass, momentum, energies and density errors of a fluid, without its walls",
    keys: &[],
    cells: &[
        ("dt", "the time step [time]"),
        ("dt_free", "the time step without the limits of this output [time]"),
        ("limit", "what limits it"),
        ("limited_by", "the particle by which it is limited"),
        ("mass", "Σ m [mass]"),
        ("momentum_x", "Σ m v [mass length / time]"),
        ("momentum_y", "along y"),
        ("momentum_z", "along z"),
        ("kinetic", "½ Σ m v² [mass length² / time²]"),
        ("potential", "that of weight and other forces [mass length² / time²]"),
        ("internal", "Σ m ∫ p / ρ² dρ by the equation of state [mass length² / time²]"),
        ("total", "the three together [mass length² / time²]"),
        ("largest_density_error", "the largest ρ/ρ₀ − 1 above 0"),
        ("densest_particle", "its particle"),
        ("mean_density_error", "the mean of max(ρ/ρ₀ − 1, 0)"),
        ("outside", "particles outside of the box; must be 0"),
        ("broken", "particles with NaN or infinity; must be 0"),
    ],
    times: Times::Ledger,
    usual: |setup| {
        let flows = setup.forces.iter().any(|force| force.properties().makes_fluid);
        Ok(flows.then(Settings::default))
    },
    begin: |setup, _| match Book::of(setup)? {
        Some(book) => Ok(Box::new(book)),
        None => Err(Error::Scene("the measure `fluid` is for a scene with a fluid, and this one has none: leave it out".to_owned())),
    },
};

/// The quantities of a fluid at a time, without fixed particles, which are its walls. A row of `fluid.csv`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ledger {
    /// Steps done.
    pub step: u64,
    /// The time.
    pub time: f64,
    /// Particles of the fluid.
    pub count: u64,
    /// Σ m \[mass\]
    pub mass: f64,
    /// Σ m v \[mass length / time\]
    pub momentum: DVec3,
    /// ½ Σ m v² \[mass length² / time²\]
    pub kinetic: f64,
    /// The potential energy without the internal one: that of gravity and other forces \[mass length² / time²\]
    pub potential: f64,
    /// Σ m ∫ p / ρ² dρ, by the equation of state; 0 where there is no speed of sound \[mass length² / time²\]
    pub internal: f64,
    /// The largest of ρ/ρ₀ − 1, where it is above 0.
    pub worst_density: f64,
    /// The particle with that density.
    pub worst_particle: u32,
    /// The mean of max(ρ/ρ₀ − 1, 0).
    pub mean_density: f64,
    /// Particles outside the box, along axes where it has an extent, including open ones. It must stay 0.
    pub outside: u64,
    /// Particles with a number that is not finite. It must stay 0.
    pub broken: u64,
}

impl Ledger {
    /// Measures a state, with the densities of all particles \[mass / length³, or mass / length² in two dimensions\].
    ///
    /// # Errors
    /// [`Error::Scene`] where the state does not have the potential energies.
    pub fn of(
        snapshot: &State,
        density: &[f32],
        medium: &Medium,
        bounds: &Bounds,
        held: impl Fn(usize) -> bool,
    ) -> Result<Self, Error> {
        let particles = snapshot;
        let energies = snapshot.energies()?;
        let mut ledger = Self { step: snapshot.step, time: snapshot.time, ..Self::default() };
        let extent: Vec<usize> = (0..3).filter(|axis| bounds.high[*axis] > bounds.low[*axis]).collect();
        // Single precision may put a particle just beyond a side.
        let slack = f64::from(f32::EPSILON) * bounds.low.abs().max(bounds.high.abs());
        let sounds = medium.sound > 0.0;
        let ids = particles.ids();
        for i in (0..particles.len()).filter(|i| !held(*i) && particles.is_active(*i)) {
            let (x, v, m) = (particles.position()[i], particles.velocity()[i], particles.mass()[i]);
            let rho = density.get(i).copied().map_or(medium.density, f64::from);
            ledger.count += 1;
            if !(x.is_finite() && v.is_finite() && rho.is_finite()) {
                ledger.broken += 1;
                continue;
            }
            let internal = if sounds { m * medium.state(rho).1 } else { 0.0 };
            ledger.mass += m;
            ledger.momentum += m * v;
            ledger.kinetic += 0.5 * m * v.length_squared();
            ledger.potential += energies[i] - internal;
            ledger.internal += internal;
            let error = (rho / medium.density - 1.0).max(0.0);
            ledger.mean_density += error;
            if error > ledger.worst_density {
                (ledger.worst_density, ledger.worst_particle) = (error, ids[i]);
            }
            let out = |axis: &usize| {
                let (low, high) = (bounds.low - slack, bounds.high + slack);
                x[*axis] < low[*axis] || x[*axis] > high[*axis]
            };
            ledger.outside += u64::from(extent.iter().any(out));
        }
        ledger.mean_density /= (ledger.count - ledger.broken).max(1) as f64;
        Ok(ledger)
    }
    /// All energies together.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential + self.internal
    }
}

/// The ledger of a run that has a fluid.
#[derive(Debug)]
pub struct Book {
    medium: Medium,
    bounds: Bounds,
    held: Vec<bool>,
    dt: f64,
    first: Option<Ledger>,
    last: Ledger,
    worst: Ledger,
    /// The largest of the mean density errors.
    mean: f64,
    /// The next warning, if it was not given yet.
    warning: Option<String>,
}

impl Book {
    /// The ledger of a setup; `None` without a fluid.
    fn of(setup: &Setup) -> Result<Option<Self>, Error> {
        let problem = setup.problem(Machine::HOST)?;
        for force in &setup.forces {
            if let Some(fluid) = force.resolved(&problem)?.fluid {
                let held = (0..setup.state.len()).map(|id| problem.is_held(id)).collect();
                let (first, warning, last, worst) = (None, None, Ledger::default(), Ledger::default());
                let (bounds, dt, mean) = (setup.bounds, setup.dt, 0.0);
                return Ok(Some(Self {
                    medium: fluid.medium,
                    bounds,
                    held,
                    dt,
                    first,
                    last,
                    worst,
                    mean,
                    warning,
                }));
            }
        }
        Ok(None)
    }
    fn add(&mut self, row: Ledger) {
        self.warning = (row.outside > self.worst.outside || row.broken > self.worst.broken).then(|| {
            format!(
                "{} particles of the fluid are outside of the box and {} are not finite at {}: both must stay 0",
                row.outside,
                row.broken,
                plain(row.time)
            )
        });
        if row.worst_density > self.worst.worst_density {
            (self.worst.worst_density, self.worst.worst_particle) = (row.worst_density, row.worst_particle);
            self.worst.time = row.time;
        }
        self.mean = self.mean.max(row.mean_density);
        self.worst.outside = self.worst.outside.max(row.outside);
        self.worst.broken = self.worst.broken.max(row.broken);
        self.first.get_or_insert(row);
        self.last = row;
    }
}

impl Series for Book {
    fn needs(&self) -> Needs {
        Needs { density: true, ..Needs::default() }
    }
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let held = |id: usize| self.held.get(id).copied().unwrap_or(false);
        let row = Ledger::of(moment.state, moment.density, &self.medium, &self.bounds, held)?;
        let (dt, free, reason) =
            moment.clock.map_or((self.dt, self.dt, Reason::Longest), |clock| (clock.dt, clock.free, clock.reason));
        let limiting = moment.clock.and_then(|clock| clock.particle).map_or(Cell::Empty, Into::into);
        let p = row.momentum;
        let numbers = [row.mass, p.x, p.y, p.z, row.kinetic, row.potential, row.internal, row.total(), row.worst_density];
        let mut cells: Row = vec![dt.into(), free.into(), reason.name().into(), limiting];
        cells.extend(numbers.map(Cell::from));
        cells.extend([row.worst_particle.into(), row.mean_density.into(), row.outside.into(), row.broken.into()]);
        self.add(row);
        Ok(vec![cells])
    }
    fn recall(&mut self, step: u64, cells: &[&str]) {
        let (number, whole) = (|k| number(cells, k), |k| whole(cells, k));
        self.add(Ledger {
            step,
            time: number(0),
            mass: number(5),
            momentum: DVec3::new(number(6), number(7), number(8)),
            kinetic: number(9),
            potential: number(10),
            internal: number(11),
            worst_density: number(13),
            worst_particle: u32::try_from(whole(14)).unwrap_or(u32::MAX),
            mean_density: number(15),
            outside: whole(16),
            broken: whole(17),
            ..Ledger::default()
        });
        // The warning was given before.
        self.warning = None;
    }
    fn summary(&self) -> Option<String> {
        let (first, last, worst) = (self.first?, self.last, self.worst);
        let lost = last.mass - first.mass;
        let counts = if worst.outside + worst.broken == 0 {
            "all particles finite and inside of the box".to_owned()
        } else {
            format!("UP TO {} OUTSIDE OF THE BOX AND {} NOT FINITE", worst.outside, worst.broken)
        };
        // Walls have mass too, and the energy of a run includes it.
        let which = if self.held.contains(&true) { " without walls" } else { "" };
        Some(format!(
            "fluid: mass {:.6e} ({lost:+.1e}), energy{which} {:.4e} → {:.4e}, too dense by {:.2} % at most (particle {} at {:.4}), {:.3} % in \
             the mean; {counts}",
            last.mass,
            first.total(),
            last.total(),
            100.0 * worst.worst_density,
            worst.worst_particle,
            worst.time,
            100.0 * self.mean
        ))
    }
    fn warning(&mut self) -> Option<String> {
        self.warning.take()
    }
}
