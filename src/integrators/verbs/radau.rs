//! The parts of a step along the nodes of Radau's quadrature.

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec4};

use crate::error::Error;
use crate::kernel::{
    ACCELERATION, Field, Host, Kernel, LARGEST_CRITERION, Machine, POSITION, POSITION_LOW, Problem, Reason, STEP_CLOCK,
    STEP_CLOCK_WORDS, Shader, Source, TICKS, VELOCITY, VELOCITY_LOW, World,
};
use crate::primitives::{Items, Operation, rows};

/// Nodes after the start of a step, and divided differences.
pub const NODES: u32 = 7;
/// The start and the nodes: zeros of P₇ + P₈ of 2 h − 1 (Radau 1880), as in the shader.
pub const NODE: [f64; 8] = [
    0.0,
    0.056_262_560_536_922_15,
    0.180_240_691_736_892_36,
    0.352_624_717_113_169_64,
    0.547_153_626_330_555_4,
    0.734_210_177_215_410_5,
    0.885_320_946_839_095_8,
    0.977_520_613_561_287_5,
];
/// The divided differences of a particle's accelerations.
pub const DIFFERENCES: Field<Vec4> = Field::new("acceleration_differences");
/// The length of the last step, 1 if it was accepted, and the number of steps in a longest one.
pub const STEP: Field<f32> = Field::new("radau_step");
/// The state of iterations: whether they have ended, how many there were, and the change by the last one.
pub const ITERATION: Field<f32> = Field::new("radau_iteration");
/// The number of fixed steps whose iterations did not settle, and the first of them.
pub const UNSETTLED_STEPS: Field<u32> = Field::new("radau_unsettled");
/// The start of a step: six vectors for each particle.
const START: Field<Vec4> = Field::new("step_start");
const SIZES: Field<Vec4> = Field::new("radau_sizes");
const LARGEST: Field<Vec4> = Field::new("radau_largest");

const SLOTS: usize = 6;
const START_VELOCITY: usize = 1;
const START_ACCELERATION: usize = 2;
const LOW_POSITION: usize = 3;
const LOW_VELOCITY: usize = 4;
const BEFORE: usize = 5;
/// Beyond so many lengths of the last step its polynomial says nothing.
const FAR: f64 = 4.0;
/// A step that is so many times too long is tried again.
const TOO_LONG: f64 = 4.0;
/// The most by which an error lets steps grow.
const LONGER: f64 = 16.0;
/// How long a step is tried next whose iterations have not settled.
const UNSETTLED: f64 = 0.2;
/// The rounding error of accelerations, in the last places of a number, and what the last of seven divided differences makes of it:
/// Σₙ 1 / Πₖ |hₙ − hₖ|.
const PLACES: f64 = 3.0;
const AMPLIFIED: f64 = 11_525.0;

/// Half of the distance between 1 and the next number, in the arithmetic of a machine.
fn place(machine: &Machine) -> f64 {
    if *machine == Machine::HOST { 0.5 * f64::EPSILON } else { f64::from(0.5 * f32::EPSILON) }
}

/// What rounding of accelerations makes of the last difference, relative to the largest acceleration.
fn noise(machine: &Machine) -> f64 {
    PLACES * AMPLIFIED * place(machine)
}

/// The integrals of the terms h (h − h₁) … (h − hₖ), and the integrals of these, from 0 to h.
fn integrals(h: f64) -> [[f64; NODES as usize]; 2] {
    let mut all = [[0.0; NODES as usize]; 2];
    let mut term = vec![1.0];
    for k in 0..NODES as usize {
        // The coefficients of the term, times another factor.
        let mut next = vec![0.0; term.len() + 1];
        for (power, coefficient) in term.iter().enumerate() {
            next[power + 1] += coefficient;
            next[power] -= NODE[k] * coefficient;
        }
        term = next;
        for (power, coefficient) in term.iter().enumerate() {
            let n = power as f64;
            let once = coefficient * h.powf(n + 1.0) / (n + 1.0);
            all[0][k] += once;
            all[1][k] += once * h / (n + 2.0);
        }
    }
    all
}

/// A part of a step, to which particles go.
#[derive(Clone)]
struct Part {
    h: f64,
    once: [f64; NODES as usize],
    twice: [f64; NODES as usize],
    /// Whether positions and velocities have two words.
    is_double: bool,
    /// The step, or the longest one.
    dt: f64,
    is_adaptive: bool,
    /// What the part of the step in single precision lacks; `None`: the device computes it.
    lacks: Option<f64>,
}

impl Part {
    fn new(h: f64, problem: &Problem) -> Self {
        let [once, twice] = integrals(h);
        #[expect(clippy::cast_possible_truncation, reason = "as the device multiplies")]
        let product = f64::from(h as f32 * problem.dt as f32);
        // At a node of an adaptive step it does not matter: what is computed there are accelerations, which are single.
        let is_adaptive = problem.adaptive_step.is_some();
        let lacks = if is_adaptive { (h < 1.0).then_some(0.0) } else { Some(h * problem.dt - product) };
        Self { h, once, twice, is_double: problem.precision.is_double(), dt: problem.dt, is_adaptive, lacks }
    }
    fn files(&self) -> Vec<Source> {
        let mut files =
            vec![crate::shader!("integrators/radau/differences.wgsl"), crate::shader!("integrators/radau/move.wgsl")];
        if self.is_double {
            files.extend([
                super::compensated::sums(),
                crate::shader!("integrators/radau/two_product.wgsl"),
                crate::shader!("integrators/radau/go_compensated.wgsl"),
                if self.lacks.is_some() {
                    crate::shader!("integrators/radau/rest_even.wgsl")
                } else {
                    crate::shader!("integrators/radau/rest_adaptive.wgsl")
                },
            ]);
        } else {
            files.push(crate::shader!("integrators/radau/go.wgsl"));
        }
        files
    }
    fn constants(&self) -> Vec<(&'static str, f64)> {
        const TWICE: [&str; 7] = ["X0", "X1", "X2", "X3", "X4", "X5", "X6"];
        const ONCE: [&str; 7] = ["V0", "V1", "V2", "V3", "V4", "V5", "V6"];
        let mut all = vec![("H", self.h)];
        all.extend(TWICE.into_iter().zip(self.twice));
        all.extend(ONCE.into_iter().zip(self.once));
        if self.is_double {
            #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
            let rest = self.dt - f64::from(self.dt as f32);
            match self.lacks {
                Some(lacks) => all.push(("REST", lacks)),
                None => all.extend([("UNIT", self.dt), ("UNIT_REST", rest)]),
            }
        }
        all
    }
    /// Saves positions and velocities at the start of a step.
    fn save(&self, host: &Host) -> Result<(), Error> {
        let (x, v) = (host.read(POSITION)?, host.read(VELOCITY)?);
        let mut start = host.write(START)?;
        for (i, its) in start.chunks_exact_mut(SLOTS).enumerate() {
            (its[0], its[START_VELOCITY]) = (x[i], v[i]);
        }
        if self.is_double {
            let (x, v) = (host.read(POSITION_LOW)?, host.read(VELOCITY_LOW)?);
            for (i, its) in start.chunks_exact_mut(SLOTS).enumerate() {
                (its[LOW_POSITION], its[LOW_VELOCITY]) = (x[i], v[i]);
            }
        }
        Ok(())
    }
    /// The length of the step, with what single precision lacks: the way by the velocity at its start is the largest by far.
    fn length(&self, host: &Host) -> Result<f64, Error> {
        Ok(match self.lacks {
            Some(_) if self.is_double && !self.is_adaptive => self.dt,
            None if self.is_double => f64::from(host.read(STEP_CLOCK)?[2]) / f64::from(TICKS) * self.dt,
            _ => host.world().dt,
        })
    }
    /// To the part of the step, or back to its start.
    fn go(&self, host: &Host, back: bool) -> Result<(), Error> {
        let (whole, dt) = (self.length(host)?, host.world().dt);
        let (start, differences) = (host.read(START)?, host.read(DIFFERENCES)?);
        let (mut x, mut v) = (host.write(POSITION)?, host.write(VELOCITY)?);
        let mut low = if self.is_double { Some((host.write(POSITION_LOW)?, host.write(VELOCITY_LOW)?)) } else { None };
        for (i, its) in start.chunks_exact(SLOTS).enumerate() {
            let a = its[START_ACCELERATION].truncate();
            let (mut drift, mut kick) = (0.5 * self.h * self.h * a, self.h * a);
            for (k, g) in differences[i * NODES as usize..][..NODES as usize].iter().enumerate() {
                drift += self.twice[k] * g.truncate();
                kick += self.once[k] * g.truncate();
            }
            let v0 = its[START_VELOCITY];
            if back {
                (x[i], v[i]) = (its[0], v0);
                if let Some((x_low, v_low)) = &mut low {
                    (x_low[i], v_low[i]) = (its[LOW_POSITION], its[LOW_VELOCITY]);
                }
                continue;
            }
            let lows = if low.is_some() { [its[LOW_POSITION], its[LOW_VELOCITY]] } else { [DVec4::ZERO; 2] };
            let moved = lows[0].truncate() + self.h * whole * (v0 + lows[1]).truncate() + dt * dt * drift;
            let faster = lows[1].truncate() + dt * kick;
            let (position, rest) = two_sum(its[0].truncate(), moved);
            let (velocity, slower) = two_sum(v0.truncate(), faster);
            x[i] = position.extend(its[0].w);
            v[i] = velocity.extend(v0.w);
            if let Some((x_low, v_low)) = &mut low {
                (x_low[i], v_low[i]) = (rest.extend(0.0), slower.extend(0.0));
            }
        }
        Ok(())
    }
    /// A kernel that ends by going there.
    fn kernel(
        &self,
        name: &str,
        file: Source,
        constants: &[(&'static str, f64)],
        problem: &Problem,
        reference: impl Fn(&Host) -> Result<(), Error> + Send + Sync + 'static,
    ) -> Result<Kernel, Error> {
        let mut files = vec![crate::shader!("world.wgsl")];
        files.extend(self.files());
        files.push(file);
        let all = [self.constants(), constants.to_vec()].concat();
        let kernel = Kernel::new(name, Shader::join(&files)?, all, problem.capacity, Arc::new(reference));
        Ok(Kernel { name: name.to_owned(), sizes: sizes(problem), ..kernel }.alone())
    }
}

/// A sum and its rounding error.
fn two_sum(a: DVec3, b: DVec3) -> (DVec3, DVec3) {
    let s = a + b;
    let t = s - a;
    (s, (a - (s - t)) + (b - t))
}

fn sizes(problem: &Problem) -> Vec<(crate::kernel::Name, u64)> {
    let rows = u64::from(problem.capacity);
    vec![
        (DIFFERENCES.name.into(), rows * u64::from(NODES)),
        (START.name.into(), rows * SLOTS as u64),
        (STEP.name.into(), 3),
        (ITERATION.name.into(), 1),
        (LARGEST.name.into(), 1),
        (STEP_CLOCK.name.into(), STEP_CLOCK_WORDS as u64),
    ]
}

/// A kernel of one invocation.
fn single(
    name: &str,
    files: &[Source],
    constants: Vec<(&'static str, f64)>,
    problem: &Problem,
    reference: impl Fn(&Host) -> Result<(), Error> + Send + Sync + 'static,
) -> Result<Kernel, Error> {
    let shader = Shader::join(&[&[crate::shader!("world.wgsl")], files].concat())?;
    let kernel = Kernel::new(name, shader, constants, 1, Arc::new(reference));
    Ok(Kernel { name: name.to_owned(), sizes: sizes(problem), ..kernel })
}

/// The polynomial from another start, with its length in the new step's: by its powers.
fn predicted(differences: &[DVec3; NODES as usize], start: f64, ratio: f64) -> [DVec3; NODES as usize] {
    let last = NODES as usize;
    let mut power = [DVec3::ZERO; NODES as usize + 1];
    power[1..].copy_from_slice(differences);
    for k in (1..last).rev() {
        for j in k..last {
            power[j] -= NODE[k] * power[j + 1];
        }
    }
    for k in 0..last {
        for j in (k..last).rev() {
            power[j] += start * power[j + 1];
        }
    }
    let mut scale = 1.0;
    for power in &mut power[1..] {
        scale *= ratio;
        *power *= scale;
    }
    for k in 1..last {
        for j in (k..last).rev() {
            power[j] += NODE[k] * power[j + 1];
        }
    }
    let mut all = [DVec3::ZERO; NODES as usize];
    all.copy_from_slice(&power[1..]);
    all
}

/// Before the first iteration.
pub fn restart(problem: &Problem) -> Result<Kernel, Error> {
    let files = [crate::shader!("integrators/radau/iteration.wgsl"), crate::shader!("integrators/radau/restart.wgsl")];
    single("restart iterations", &files, Vec::new(), problem, |host| {
        host.write(ITERATION)?.fill(0.0);
        Ok(())
    })
}

/// The start of a step, with the first guess; then to the first node.
pub fn begin(problem: &Problem) -> Result<Kernel, Error> {
    let part = Part::new(NODE[1], problem);
    let own = part.clone();
    let reference = move |host: &Host| {
        own.save(host)?;
        {
            let (acceleration, step, dt) = (host.read(ACCELERATION)?, host.read(STEP)?, host.world().dt);
            let (mut start, mut differences) = (host.write(START)?, host.write(DIFFERENCES)?);
            let known = step[0] > 0.0 && dt <= FAR * step[0];
            for (i, its) in start.chunks_exact_mut(SLOTS).enumerate() {
                its[START_ACCELERATION] = acceleration[i];
                if dt > 0.0 {
                    let own = &mut differences[i * NODES as usize..][..NODES as usize];
                    let mut before = [DVec3::ZERO; NODES as usize];
                    before.iter_mut().zip(own.iter()).for_each(|(before, own)| *before = own.truncate());
                    let next = if known { predicted(&before, step[1], dt / step[0]) } else { [DVec3::ZERO; 7] };
                    own.iter_mut().zip(next).for_each(|(own, next)| *own = next.extend(0.0));
                }
            }
        }
        own.go(host, false)
    };
    part.kernel("begin along nodes", crate::shader!("integrators/radau/begin.wgsl"), &[], problem, reference)
}

/// The divided difference of an acceleration at a node, less that at the start.
fn difference(acceleration: DVec3, differences: &[DVec4], node: usize) -> DVec3 {
    let first = acceleration / NODE[node];
    (1..node).fold(first, |sum, k| (sum - differences[k - 1].truncate()) / (NODE[node] - NODE[k]))
}

/// What the acceleration at a node says; then to the next.
pub fn node(at: usize, problem: &Problem) -> Result<Kernel, Error> {
    let part = Part::new(NODE[at % NODES as usize + 1], problem);
    let own = part.clone();
    let reference = move |host: &Host| {
        if host.world().dt > 0.0 {
            let (acceleration, mut start) = (host.read(ACCELERATION)?, host.write(START)?);
            let mut differences = host.write(DIFFERENCES)?;
            for (i, its) in start.chunks_exact_mut(SLOTS).enumerate() {
                let own = &mut differences[i * NODES as usize..][..NODES as usize];
                let found = difference((acceleration[i] - its[START_ACCELERATION]).truncate(), own, at);
                if at == NODES as usize {
                    its[BEFORE] = own[at - 1];
                }
                own[at - 1] = found.extend(0.0);
            }
        }
        own.go(host, false)
    };
    let name = format!("node {at}");
    part.kernel(&name, crate::shader!("integrators/radau/node.wgsl"), &[("AT", at as f64)], problem, reference)
}

/// What changed in the last iteration, and whether it was the last one.
pub fn settle(problem: &Problem) -> Result<[Kernel; 3], Error> {
    let largest = |v: DVec4| v.truncate().abs().max_element();
    let reference = move |host: &Host| {
        let (acceleration, start) = (host.read(ACCELERATION)?, host.read(START)?);
        let (differences, mut sizes) = (host.read(DIFFERENCES)?, host.write(SIZES)?);
        for (i, size) in sizes.iter_mut().enumerate() {
            let g = differences[(i + 1) * NODES as usize - 1];
            *size = DVec4::new(largest(g - start[i * SLOTS + BEFORE]), largest(acceleration[i]), largest(g), 0.0);
        }
        Ok(())
    };
    let files = [
        crate::shader!("world.wgsl"),
        crate::shader!("integrators/radau/differences.wgsl"),
        crate::shader!("integrators/radau/measure.wgsl"),
    ];
    let measure =
        Kernel::new("measure", Shader::join(&files)?, Vec::new(), problem.capacity, Arc::new(reference)).alone();
    let measure = Kernel { name: "measure differences".to_owned(), sizes: sizes(problem), ..measure };
    let (of, into) = (SIZES.name.into(), LARGEST.name.into());
    let reduced = rows(Operation::Max, Items::Vec4, &of, &into, problem.capacity, &problem.machine)?;
    let (rounding, noise) = (place(&problem.machine), noise(&problem.machine));
    let files = [crate::shader!("integrators/radau/iteration.wgsl"), crate::shader!("integrators/radau/settle.wgsl")];
    let constants = vec![("ROUNDING", rounding), ("NOISE", noise)];
    let settle = single("settle", &files, constants, problem, move |host| {
        let (all, mut iteration) = (host.read(LARGEST)?[0], host.write(ITERATION)?);
        let (change, count) = (all.x / all.y, iteration[1] + 1.0);
        let idle = count > 1.0 && change >= iteration[2] && change <= noise;
        let done = all.x <= rounding * all.y || idle || host.world().dt == 0.0;
        iteration.copy_from_slice(&[f64::from(u8::from(done)), count, change]);
        Ok(())
    })?;
    Ok([measure, Kernel { name: "largest difference".to_owned(), ..reduced }, settle])
}

/// The verdict on a step, by its error where steps are adaptive.
pub fn decide(tolerance: f64, problem: &Problem) -> Result<Kernel, Error> {
    if problem.adaptive_step.is_none() {
        let files =
            [crate::shader!("integrators/radau/iteration.wgsl"), crate::shader!("integrators/radau/accept.wgsl")];
        let kernel = single("accept", &files, Vec::new(), problem, |host| {
            let (iteration, world, mut step) = (host.read(ITERATION)?, host.world(), host.write(STEP)?);
            (step[0], step[1]) = (world.dt, 1.0);
            let mut report = host.write(UNSETTLED_STEPS)?;
            if iteration[0] == 0.0 {
                if report[0] == 0 {
                    report[1] = world.step;
                }
                report[0] += 1;
            }
            Ok(())
        })?;
        let sizes = [kernel.sizes, vec![(UNSETTLED_STEPS.name.into(), 2)]].concat();
        return Ok(Kernel { sizes, ..kernel });
    }
    let (unit, noise) = (problem.dt, noise(&problem.machine));
    let files = [crate::shader!("integrators/radau/iteration.wgsl"), crate::shader!("integrators/radau/decide.wgsl")];
    let constants = vec![("UNIT", unit), ("TOLERANCE", tolerance), ("NOISE", noise)];
    single("decide", &files, constants, problem, move |host| {
        let world = host.world();
        if world.dt == 0.0 {
            return Ok(());
        }
        let (all, mut step, mut clock) = (host.read(LARGEST)?[0], host.write(STEP)?, host.write(STEP_CLOCK)?);
        let error = (all.z - noise * all.y).max(0.0);
        let mut longer =
            if error > 0.0 { (tolerance * all.y / error).powf(1.0 / f64::from(NODES)).min(LONGER) } else { LONGER };
        if host.read(ITERATION)?[0] == 0.0 {
            longer = longer.min(UNSETTLED);
        }
        let accepted = longer * TOO_LONG >= 1.0;
        let reason = clock[4];
        if !(accepted && reason == Reason::Stop as u32 && longer >= 1.0) {
            step[2] = unit / (longer * world.dt);
        }
        (step[0], step[1]) = (world.dt, f64::from(u8::from(accepted)));
        if !accepted {
            clock[12 + reason as usize] -= 1;
            clock[2] = 0;
            host.set_world(World { dt: 0.0, ..world });
        }
        Ok(())
    })
}

/// The end of the step, or its start again.
pub fn finish(problem: &Problem) -> Result<Kernel, Error> {
    let part = Part::new(1.0, problem);
    let own = part.clone();
    let reference = move |host: &Host| {
        let accepted = host.read(STEP)?[1] > 0.0;
        own.go(host, !accepted)
    };
    part.kernel("end along nodes", crate::shader!("integrators/radau/finish.wgsl"), &[], problem, reference)
}

/// The limit of the next step.
pub fn criterion(problem: &Problem) -> Result<Kernel, Error> {
    let files = [crate::shader!("integrators/radau/criterion.wgsl")];
    let kernel = single("error criterion", &files, Vec::new(), problem, |host| {
        let rate = host.read(STEP)?[2];
        host.write(LARGEST_CRITERION)?[0] = DVec4::new(0.0, 0.0, 0.0, rate);
        Ok(())
    })?;
    Ok(Kernel { sizes: [kernel.sizes, vec![(LARGEST_CRITERION.name.into(), 1)]].concat(), ..kernel })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// P₇ + P₈ by Bonnet's recursion.
    fn radau(x: f64) -> f64 {
        let (mut before, mut now) = (1.0, x);
        for n in 1..7 {
            let n = f64::from(n);
            (before, now) = (now, ((2.0 * n + 1.0) * x * now - n * before) / (n + 1.0));
        }
        now + (15.0 * x * now - 7.0 * before) / 8.0
    }

    #[test]
    fn nodes_are_zeros() {
        for node in NODE {
            let x = 2.0 * node - 1.0;
            let slope = (radau(x + 1e-6) - radau(x - 1e-6)) / 2e-6;
            assert!((radau(x) / slope).abs() < 1e-15 * 3.0, "{node}");
        }
    }

    /// A polynomial of degree 7 is its divided differences, and its integrals are exact.
    #[test]
    fn integrals_of_powers() {
        for power in 1..=7 {
            let mut g = [DVec4::ZERO; NODES as usize];
            for n in 1..NODE.len() {
                g[n - 1] = difference(DVec3::splat(NODE[n].powi(power)), &g, n).extend(0.0);
            }
            let terms = g.map(DVec4::truncate);
            // From t = a on in parts of s: the differences of ((a + s h)ⁿ − aⁿ).
            for (a, s) in [(1.0, 0.7), (0.0, 0.3), (1.0, 2.5)] {
                let mut want = [DVec4::ZERO; NODES as usize];
                for n in 1..NODE.len() {
                    let value = f64::from(a + s * NODE[n]).powi(power) - f64::from(a).powi(power);
                    want[n - 1] = difference(DVec3::splat(value), &want, n).extend(0.0);
                }
                for (found, want) in predicted(&terms, a, s).iter().zip(want) {
                    assert!(
                        (found.x - want.x).abs() < 1e-10 * s.powi(power).max(1.0),
                        "{power}, {a}, {s}: {found}, {want}"
                    );
                }
            }
            for h in [0.3, 1.0, 1.7] {
                let n = f64::from(power);
                let [once, twice] = integrals(h).map(|all| all.iter().zip(&terms).map(|(w, g)| w * g.x).sum::<f64>());
                assert!((once - h.powi(power + 1) / (n + 1.0)).abs() < 1e-12, "{power}, {h}: {once}");
                assert!((twice - h.powi(power + 2) / ((n + 1.0) * (n + 2.0))).abs() < 1e-12, "{power}, {h}: {twice}");
            }
        }
    }

    #[test]
    fn rounding_is_amplified_by_what_is_said() {
        let one = |n: usize| (0..NODE.len()).filter(|k| *k != n).map(|k| NODE[n] - NODE[k]).product::<f64>();
        let sum: f64 = (0..NODE.len()).map(|n| 1.0 / one(n).abs()).sum();
        assert!((sum / AMPLIFIED - 1.0).abs() < 1e-3, "{sum}");
    }

    /// A first number and its rest are the exact sum.
    #[test]
    fn sums_keep_their_rest() {
        let (sum, rest) = two_sum(DVec3::splat(1.0), DVec3::splat(1e-20));
        assert_eq!((sum.x, rest.x), (1.0, 1e-20));
        let (sum, rest) = two_sum(DVec3::splat(1e-20), DVec3::splat(1.0));
        assert_eq!((sum.x, rest.x), (1.0, 1e-20));
    }
}
