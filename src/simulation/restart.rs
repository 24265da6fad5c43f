//! Continuation of a run from a state of another simulation, as if it had never stopped.
//!
//! Columns hold the state of particles. In addition, a step saves for the next one: the accelerations of its first kick, which are those of
//! half-kicked velocities and cannot be evaluated again; rates of other columns; an adaptive clock, and the dt criteria of forces; the
//! initial positions of fixed particles; broken springs; the low words of positions and velocities, of which a sum in f64 may lack the last digits; the maximum speeds of the last steps, by which an alarm detects a runaway. A state
//! carries these. They are valid for the step that wrote them: under other forces, with steps of another length or another integrator, or
//! on another kind of device, accelerations are evaluated again.

use glam::{DVec3, DVec4};

use super::{Plans, Setup, Simulation, pair_history};
use crate::boundary;
use crate::component::pressure;
use crate::error::Error;
use crate::ewald;
use crate::integrators::{SOLVE_REPORT, kept_rates};
use crate::kernel::{
    ALARM, Array, BLOCK_CLOCK, Backend, Column, Columns, HOME, ID, LARGEST_CRITERION, LIFE, LOW_WORDS, Pass, Plan,
    Problem, QUIET, Role, STEP_CLOCK, STEP_CLOCK_WORDS, STEP_CRITERIA, TICKS, World, extent, split,
};
use crate::life::Life;
use crate::links::Links;
use crate::motion;
use crate::sph::{DFSPH_ERRORS, DFSPH_REPORT};
use crate::state::{
    KEPT, KEPT_BROKEN, KEPT_EXTENT, KEPT_HOME, KEPT_NEIGHBORS, KEPT_PAIR_WORDS, KEPT_PAIRS, KEPT_ROWS, KEPT_SIDES,
    KEPT_STEP, State,
};
use crate::visit;

/// The tolerated difference of time and step × dt, as a part of a step: 2³² steps of a time in double precision.
const AGREEMENT: f64 = 1e-6;

/// A field of the device that continues from one step to the next.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Carried {
    field: String,
    /// An empty array of its kind.
    like: Array,
    len: usize,
    /// Whether it holds only for the positions and velocities of the state.
    rate: bool,
    /// Elements per row; 0 where they do not belong to rows.
    each: usize,
}

/// The fields of some plans.
pub(super) fn carried(plans: &Plans, columns: &Columns, count: u32) -> Vec<Carried> {
    let fields: std::collections::BTreeMap<String, u64> =
        plans.all().flat_map(|plan| plan.fields(count).into_iter()).collect();
    let particles = count as usize;
    let (four, real, whole) = (Array::Vec4(Vec::new()), Array::Float(Vec::new()), Array::Uint(Vec::new()));
    let one = |field: &str, like: &Array, rate| Carried {
        field: field.to_owned(),
        like: like.clone(),
        len: 0,
        rate,
        each: 0,
    };
    let mut all = vec![Carried { each: 1, ..one("kept_acceleration", &four, true) }];
    for buffer in kept_rates(columns) {
        if let (Some(like), Some(len)) = (columns.element(&buffer), columns.len_of(&buffer, particles)) {
            let each = columns.len_of(&buffer, 2).unwrap_or(0) - columns.len_of(&buffer, 1).unwrap_or(0);
            all.push(Carried { len, each, ..one(&format!("{KEPT}{buffer}"), &like, true) });
        }
    }
    let words = [ALARM.name, STEP_CLOCK.name, BLOCK_CLOCK.name, SOLVE_REPORT, DFSPH_REPORT];
    all.extend(words.map(|name| one(name, &whole, false)));
    all.push(one(DFSPH_ERRORS, &real, false));
    all.extend(LOW_WORDS.iter().map(|(_, low)| Carried { each: 1, ..one(low.name, &four, false) }));
    all.push(Carried { each: 1, ..one(STEP_CRITERIA.name, &four, true) });
    all.push(one(LARGEST_CRITERION.name, &four, true));
    all.retain(|one| fields.contains_key(&one.field));
    for one in all.iter_mut().filter(|one| one.len == 0) {
        let bytes = one.like.zeros(1).to_bytes().len() as u64;
        one.len = usize::try_from(fields.get(&one.field).copied().unwrap_or(0) / bytes).unwrap_or(0);
    }
    all
}

impl Carried {
    /// The numbers of these rows.
    fn picked(&self, list: &[f64], order: &[usize]) -> Vec<f64> {
        self.array(list).map_or_else(Vec::new, |array| numbers(&array.picked(order, self.each)))
    }
    /// The name of its numbers in a state.
    fn name(&self) -> String {
        if self.field.starts_with(KEPT) { self.field.clone() } else { format!("{KEPT}{}", self.field) }
    }
    /// Its elements, converted from the numbers of a state.
    fn array(&self, numbers: &[f64]) -> Option<Array> {
        let mut array = match &self.like {
            Array::Vec4(_) => Array::Vec4(numbers.chunks_exact(4).map(DVec4::from_slice).collect()),
            Array::Vec3(_) => Array::Vec3(numbers.chunks_exact(3).map(DVec3::from_slice).collect()),
            Array::Float(_) => Array::Float(numbers.to_vec()),
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "words, or saturated")]
            Array::Uint(_) => Array::Uint(numbers.iter().map(|x| *x as u32).collect()),
        };
        // Free rows have nothing.
        if self.each > 0 && array.len() < self.len {
            array.resize(self.len, [0.0; 4]);
        }
        (array.len() == self.len).then_some(array)
    }
}

/// Groups of `width` numbers, of which the first `rows` are rows, renumbered by `place`; groups with a row that has no new number are left out.
fn renumbered(numbers: &[f64], width: usize, rows: usize, place: impl Fn(f64) -> Option<f64>) -> Vec<f64> {
    let group = |group: &[f64]| {
        let places: Option<Vec<f64>> = group[..rows].iter().map(|row| place(*row)).collect();
        Some([&places?[..], &group[rows..]].concat())
    };
    numbers.chunks_exact(width).filter_map(group).flatten().collect()
}

/// The numbers of an array, one element after another.
fn numbers(array: &Array) -> Vec<f64> {
    match array {
        Array::Vec4(list) => list.iter().flat_map(DVec4::to_array).collect(),
        Array::Vec3(list) => list.iter().flat_map(DVec3::to_array).collect(),
        Array::Float(list) => list.clone(),
        Array::Uint(list) => list.iter().copied().map(f64::from).collect(),
    }
}

/// FNV-1a of 64 bits.
struct Print(u64);

impl Print {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
    fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3);
        }
    }
}

/// A hash that two steps share only if they perform the same operations: names are ignored, and so is the neighbour list, of which capacity,
/// cells and skin depend on when it was checked: pairs in range are the same by any. Nor does it matter how many waves there are in a box that
/// changes: what the sums are is in the law between two.
pub(super) fn print(step: &Plan, problem: &Problem) -> u64 {
    let mut print = Print::new();
    let (elastic, bounds) = (problem.elastic.is_some(), &problem.bounds);
    // The highest corner of a box that changes is a column.
    let corners = [bounds.low, if elastic { DVec3::ZERO } else { bounds.high }];
    corners.iter().flat_map(DVec3::to_array).for_each(|x| print.add(&x.to_bits().to_le_bytes()));
    bounds.sides.iter().for_each(|side| print.add(&[*side as u8]));
    let is_sum = |pass: &Pass| elastic && pass.constants.iter().any(|(name, _)| *name == ewald::NUMBER);
    let is_of_box = |name: &str| elastic && (name.starts_with(ewald::CHARGE_WAVE) || name == pressure::ALL);
    for kernel in step.steps().filter(|kernel| !visit::is_list(kernel)) {
        for pass in kernel.passes.iter().filter(|pass| !is_sum(pass)) {
            print.add(pass.shader.text().as_bytes());
            pass.constants.iter().for_each(|(name, value)| {
                print.add(name.as_bytes());
                print.add(&value.to_bits().to_le_bytes());
            });
            pass.uniforms.iter().for_each(|(_, bytes)| print.add(bytes));
            pass.fields.iter().for_each(|(_, field)| print.add(field.as_bytes()));
        }
        // Springs break: a state holds the remaining ones.
        for (_, words) in kernel.tables.iter().filter(|(name, _)| name != visit::LINK && !is_of_box(name)) {
            words.iter().for_each(|word| print.add(&word.to_le_bytes()));
        }
    }
    print.0
}

/// The hash of a step and of the state that it made.
fn mark(step: u64, state: &State) -> Vec<f64> {
    let mut print = Print(step);
    print.add(&state.step.to_le_bytes());
    print.add(&state.time.to_bits().to_le_bytes());
    print.add(&of_columns(state).to_le_bytes());
    for link in &state.links.springs {
        print.add(&[link.ends[0].to_le_bytes(), link.ends[1].to_le_bytes()].concat());
        [link.rest, link.stiffness, link.damping].iter().for_each(|x| print.add(&x.to_bits().to_le_bytes()));
        print.add(&[u8::from(link.rope)]);
    }
    for name in [KEPT_PAIRS, KEPT_PAIR_WORDS] {
        state.kept.get(name).unwrap_or_default().iter().for_each(|x| print.add(&x.to_bits().to_le_bytes()));
    }
    [print.0 >> 32, print.0 & 0xffff_ffff].map(|word| word as f64).to_vec()
}

/// A hash of the columns of a state, in any order, by their values as a device holds them. Columns that files leave out do not count: sizes
/// and species that are all 0, and life where all are active.
fn of_columns(state: &State) -> u64 {
    // Where positions and velocities have two words, all digits count.
    let exact = |name: &str| {
        let low = LOW_WORDS.iter().find(|(high, _)| high.name == name).map(|(_, low)| format!("{KEPT}{}", low.name));
        low.is_some_and(|low| state.kept.get(&low).is_some())
    };
    let counts = |column: &Column| match column.name.as_ref() {
        "size" => state.size().iter().any(|size| *size != 0.0),
        "species" => state.species().iter().any(|species| *species != 0),
        name if name == LIFE.name => (0..state.len()).any(|id| !state.is_active(id)),
        name if name == ID.name => !state.ids_are_places(),
        _ => column.role == Role::State,
    };
    let one = |(column, values): (&Column, &Array)| {
        let mut print = Print::new();
        print.add(column.name.as_bytes());
        let exact = exact(&column.name);
        #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
        let add = |x: &f64| {
            if exact { print.add(&x.to_bits().to_le_bytes()) } else { print.add(&(*x as f32).to_bits().to_le_bytes()) }
        };
        numbers(values).iter().for_each(add);
        print.0
    };
    state.columns().filter(|(column, _)| counts(column)).map(one).fold(0, u64::wrapping_add)
}

/// Whether a state was made by this step and is unchanged since.
pub(super) fn is_whole(step: u64, state: &State) -> bool {
    state.kept.get(KEPT_STEP) == Some(&mark(step, state)[..])
}

impl Setup {
    /// The extent of the particles at the start of the run, or at present, if the state does not hold it.
    pub(super) fn extent(&self) -> (DVec3, DVec3) {
        let kept = || {
            let numbers = self.state.kept.get(KEPT_EXTENT).filter(|list| list.len() == 6)?;
            let (low, high) = (DVec3::from_slice(numbers), DVec3::from_slice(&numbers[3..]));
            let fits = |v: DVec3| v.abs().max_element() <= f64::from(f32::MAX);
            (fits(low) && fits(high) && low.cmple(high).all()).then_some((low, high))
        };
        kept().unwrap_or_else(|| extent(self.state.position()))
    }
    /// The number of steps done at the state.
    ///
    /// # Errors
    /// [`Error::Scene`] when its time is not step × dt, or there are more than a device counts.
    pub(super) fn done(&self) -> Result<u32, Error> {
        let State { time, step, .. } = self.state;
        let refuse = |text: String| Err(Error::Scene(text));
        if !time.is_finite() || time < 0.0 {
            return refuse(format!("the state is at time {time:e}: a simulation begins at a time from 0 on"));
        }
        let Ok(done) = u32::try_from(step) else {
            return refuse(format!("the state is at step {step}, and a device counts to {}: begin anew", u32::MAX));
        };
        let apart = (time - f64::from(done) * self.dt).abs() > AGREEMENT * self.dt;
        if self.integrator.adaptive_step().is_none() && apart {
            return refuse(format!(
                "the state is at step {step} and time {time:e}, which is not {step} steps of dt = {:e}: choose a dt of which time is a \
                 whole number of steps and set `state.step` to that, or take `state.begin_anew()`",
                self.dt
            ));
        }
        if self.integrator.adaptive_step().is_some() && split(time, self.dt)[0] == u32::MAX {
            return refuse(format!("the state is at time {time:e}, more than {} steps of {:e}", u32::MAX, self.dt));
        }
        Ok(done)
    }
    /// The words of the adaptive clock of a state: those that the last step kept, if they give the same time, else a new clock set to that time.
    fn wound(&self, dt: f64) -> Option<Vec<u32>> {
        let adaptive_step = self.integrator.adaptive_step()?;
        let at = split(self.state.time, dt);
        let kept = self.state.kept.get("kept_step_clock").filter(|list| list.len() == STEP_CLOCK_WORDS);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "words, or saturated")]
        let kept = kept.map(|list| list.iter().map(|x| *x as u32).collect::<Vec<_>>());
        Some(kept.filter(|words| words[..2] == at).unwrap_or_else(|| {
            let mut words = adaptive_step.start(dt);
            words[..2].copy_from_slice(&at);
            // The reasons of these lengths are unknown.
            words[12] = u32::try_from(self.state.step).unwrap_or(u32::MAX);
            words
        }))
    }
    /// The positions of fixed particles at time 0, in their order.
    pub(super) fn homes(&self) -> Vec<DVec3> {
        let places = self.state.position();
        let kept = self.state.kept.get(KEPT_HOME).unwrap_or_default().chunks_exact(7);
        let kept: std::collections::BTreeMap<u64, &[f64]> = kept.map(|seven| (seven[0].to_bits(), seven)).collect();
        let home = |id: u32| {
            let here = places[id as usize];
            // A particle that a caller has moved begins at its new position.
            let there = kept.get(&f64::from(id).to_bits()).filter(|seven| DVec3::from_slice(&seven[4..]) == here);
            let home = there.map(|seven| DVec3::from_slice(&seven[1..4])).filter(|home| home.is_finite());
            boundary::wrapped(&self.bounds, home.unwrap_or(here))
        };
        motion::sorted(&self.state.held).iter().map(|one| home(one.id)).collect()
    }
}

impl<B: Backend> Simulation<B> {
    /// Whether the state that it was made of continued with all restart data of its last step, so that results are bit-identical to those
    /// of a run that was never stopped. Otherwise accelerations were evaluated again: the state is of step 0, or of a run with other
    /// forces, integrator, step length or device, or its positions, velocities or other columns were changed.
    #[must_use]
    pub fn goes_on(&self) -> bool {
        self.goes_on
    }
    /// Fills the restart data of a step.
    pub(super) fn resume(&mut self, setup: &Setup, whole: bool) -> Result<(), Error> {
        let state = &setup.state;
        let mut arrays = Vec::new();
        for one in &self.carried {
            let numbers = state.kept.get(&one.name()).filter(|_| whole);
            arrays.push((one.field.clone(), one.rate, numbers.and_then(|numbers| one.array(numbers))));
        }
        self.goes_on = whole && arrays.iter().all(|(_, rate, array)| !rate || array.is_some());
        self.begun = self.goes_on;
        self.backend.write(ALARM.name, &Array::Uint(QUIET.to_vec()))?;
        for (field, _, array) in arrays {
            if let Some(array) = array {
                self.backend.write(&field, &array)?;
            }
        }
        let mut dt = setup.dt;
        if let Some(words) = setup.wound(setup.dt) {
            if words[2] > 0 {
                dt = f64::from(words[2]) / f64::from(TICKS) * setup.dt;
            }
            self.backend.write(STEP_CLOCK.name, &Array::Uint(words))?;
        }
        let (step, count, bounds) = (setup.done()?, self.rows.used(), setup.bounds);
        let free = self.rows.capacity() - count;
        self.backend.set_world(World { time: state.time, dt, step, count, free, bounds })?;
        if step > 0 || state.time > 0.0 || self.goes_on {
            let wake = self.backend.compile(&self.plans.wake(self.goes_on))?;
            self.backend.run(&wake, 1)?;
        }
        Ok(())
    }
    /// Adds the restart data of the last step to a state.
    pub(super) async fn keep(&mut self, state: &mut State, all: &Links) -> Result<(), Error> {
        for one in self.carried.clone().into_iter().filter(|one| self.begun || !one.rate) {
            let array = self.backend.read(&one.field, &one.like, one.len).await?;
            state.kept.put(one.name(), numbers(&array));
        }
        if self.anchored > 0 {
            let homes = self.backend.read(HOME.name, &Array::Vec4(Vec::new()), self.anchored).await?;
            let Array::Vec4(homes) = homes else { return Ok(()) };
            let held = motion::sorted(&state.held);
            let seven = |(one, home): (&motion::Held, &DVec4)| {
                let here = state.position().get(one.id as usize).copied().unwrap_or_default();
                let mut numbers = vec![f64::from(one.id)];
                numbers.extend(home.truncate().to_array().into_iter().chain(here.to_array()));
                numbers
            };
            let homes = held.iter().zip(&homes).flat_map(seven).collect();
            state.kept.put(KEPT_HOME, homes);
        }
        state.keep_broken(all);
        let (low, high) = self.extent;
        state.kept.put(KEPT_EXTENT, low.to_array().into_iter().chain(high.to_array()).collect());
        if self.rows.are_open() {
            state.kept.put(KEPT_ROWS, vec![f64::from(self.first_rows)]);
        }
        if let Some(elastic) = self.problem.elastic {
            state.kept.put(KEPT_SIDES, elastic.start.to_array().to_vec());
        }
        let neighbors = self.problem.neighbors.iter().flat_map(|one| [one.range, one.mean]);
        state.kept.put(KEPT_NEIGHBORS, neighbors.collect());
        Ok(())
    }
    /// Marks a state as made by this step.
    pub(super) fn mark(&self, state: &mut State) {
        let mark = mark(self.print, state);
        state.kept.put(KEPT_STEP, mark);
    }
    /// The same state without free rows and rows of removed particles, where ids are separate from rows.
    pub(super) fn compacted(&self, state: State) -> State {
        if !self.rows.are_open() {
            return state;
        }
        let life = state.life();
        let is_there = |row: &usize| {
            let free = self.rows.is_free(u32::try_from(*row).unwrap_or(u32::MAX));
            !free && life.get(*row).copied().unwrap_or_default() != Life::Removed
        };
        let order: Vec<usize> = (0..state.len()).filter(is_there).collect();
        let mut picked = state.picked(&order);
        let mut places = vec![None; state.len()];
        order.iter().zip(0..).for_each(|(row, place)| places[*row] = Some(f64::from(place)));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is a row")]
        let place = |row: f64| places.get(row as usize).copied().flatten();
        for (name, numbers) in state.kept.iter() {
            let carried = self.carried.iter().find(|one| one.each > 0 && one.name() == name);
            let numbers = match (name, carried) {
                (_, Some(one)) => one.picked(numbers, &order),
                (KEPT_HOME, _) => renumbered(numbers, 7, 1, place),
                (KEPT_BROKEN, _) => renumbered(numbers, 3, 2, place),
                (KEPT_PAIRS, _) => renumbered(numbers, 2 + pair_history::width(&state).unwrap_or(0), 2, place),
                _ => numbers.to_vec(),
            };
            picked.kept.put(name, numbers);
        }
        (picked.capacity, picked.next) = (Some(self.capacity()), self.rows.next());
        picked
    }
}
