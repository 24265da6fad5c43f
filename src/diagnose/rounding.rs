//! Rounding in single precision: motions and softenings below its last place.

use super::Remark;
use super::softenings::reads;
use crate::integrators::Precise;
use crate::interactions::gravity::SOFTENING_LENGTH;
use crate::kernel::{Machine, Precision, Scalar};
use crate::simulation::Setup;

/// Slower particles count as being at rest \[parts of the mean speed\].
const SLOW: f64 = 0.1;
/// The rounding error of positions above which forces within a softening are inaccurate \[parts of the softening\].
const COARSE: f64 = 0.01;

/// The distance from one number of single precision to the next, at this one.
fn last_place(x: f64) -> f64 {
    #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
    let single = (x as f32).abs();
    f64::from(f32::from_bits(single.to_bits() + 1)) - f64::from(single)
}

/// Remarks on a setup for a device that computes in single precision. Two words hold 24 bits more of a position.
pub fn remarks(setup: &Setup) -> Vec<Remark> {
    let precision = setup.integrator.precision();
    let motions = if precision.is_double() { None } else { motions(setup) };
    let softenings = if precision == Precision::DoubleSingle { Vec::new() } else { softenings(setup) };
    motions.into_iter().chain(softenings).collect()
}

/// The way out by another precision, where the setup can run in it.
fn in_two_words(setup: &Setup, precision: Precision) -> String {
    let integrator = Precise { integrator: setup.integrator.clone(), precision };
    let two = Setup { integrator: Box::new(integrator), ..setup.clone() };
    let serves = two.plans(Machine::HOST).is_ok();
    if serves { format!("set precision = \"{}\" in [simulation], ", precision.name()) } else { String::new() }
}

/// Particles that move by less than the last place of their coordinates in a step.
fn motions(setup: &Setup) -> Option<Remark> {
    let particles = &setup.state;
    let fixed = particles.fixed();
    let speed = |id: usize| particles.velocity()[id].length();
    let moving = || (0..particles.len()).filter(|id| !fixed[*id] && speed(*id) > 0.0);
    let count = moving().count();
    let mean = moving().map(speed).sum::<f64>() / count.max(1) as f64;
    // A particle lingers at a turning point; all of a scene do not.
    let lost = |id: &usize| {
        let (x, v) = (particles.position()[*id], particles.velocity()[*id]);
        let axis = (0..3).max_by(|a, b| v[*a].abs().total_cmp(&v[*b].abs())).unwrap_or(0);
        speed(*id) > SLOW * mean && v[axis].abs() * setup.dt < last_place(x[axis])
    };
    let mut all = moving().filter(lost);
    let first = all.next()?;
    let others = all.count();
    let (x, v) = (particles.position()[first], speed(first));
    let place = last_place(x.abs().max_element());
    let text = format!(
        "{} of {count} moving particles move less in a step than the last place of single precision, the first is particle {first}: \
         |v| dt = {:.1e}, and numbers at {:.4e} are {place:.1e} apart: such motion is rounded or lost",
        1 + others,
        v * setup.dt,
        x.abs().max_element(),
    );
    let better = 10.0 * place / v;
    Some(
        Remark::note("rounded-motion", text)
            .with("particles", (1 + others) as f64)
            .with("particle", first as f64)
            .with("moved", v * setup.dt)
            .with("last_place", place)
            .with("better_dt", better)
            .advice(format!(
                "{}move the origin closer, choose a larger dt (above {better:.1e}), or use --backend cpu",
                in_two_words(setup, Precision::Compensated)
            )),
    )
}

/// Softenings that coordinates do not resolve.
fn softenings(setup: &Setup) -> Vec<Remark> {
    let far = setup.state.position().iter().map(|x| x.abs().max_element()).fold(0.0, f64::max);
    let place = last_place(far);
    // The smallest of particles, where they have softenings of their own.
    let own = setup.state.scalar(SOFTENING_LENGTH).unwrap_or_default().iter().copied();
    let own = own.filter(|softening| *softening > 0.0).min_by(f64::total_cmp);
    let remark = |(law, own): (crate::forces::Law, Option<f64>)| {
        let given = law.params.iter().find_map(|(name, value)| match value {
            Scalar::Float(x) if name == "softening" && *x > 0.0 => Some(*x),
            _ => None,
        });
        let softening = given.or(own)?;
        (place > COARSE * softening).then(|| {
            let text = format!(
                "the softening {softening} of `{}` is {:.1e} times the last place of single precision at the largest coordinate, {far:.4e}: \
                 forces of close pairs are off by up to {:.0} %",
                law.name,
                softening / place,
                100.0 * (place / softening).min(1.0)
            );
            Remark::note("rounded-softening", text)
                .with("softening", softening)
                .with("last_place", place)
                .with("coordinate", far)
                .advice(format!(
                    "{}move the origin closer, or use --backend cpu",
                    in_two_words(setup, Precision::DoubleSingle)
                ))
        })
    };
    let laws = setup.forces.iter().flat_map(|force| {
        let has_own = reads(force.as_ref());
        force.laws().into_iter().map(move |law| (law, own.filter(|_| has_own)))
    });
    laws.filter_map(remark).collect()
}

/// Particles that cross a periodic box more than once in a step: their positions are meaningless.
pub fn crossings(setup: &Setup) -> Option<Remark> {
    let period = setup.bounds.period();
    let crossed = |id: usize| {
        let way = (setup.state.velocity()[id] * setup.dt).abs();
        (0..3).filter(|axis| period[*axis] > 0.0).map(|axis| way[axis] / period[axis]).fold(0.0, f64::max)
    };
    let all = || (0..setup.state.len()).map(|id| (id, crossed(id))).filter(|(_, times)| *times > 1.0);
    let (first, times) = all().next()?;
    let count = all().count();
    let text = format!(
        "{count} of {} particles cross the periodic box in a step, the first is particle {first}, {times:.1} times: they do not interact \
         with particles on their way, and beyond some 10^7 times their positions are rounding errors only",
        setup.state.len()
    );
    Some(
        Remark::note("crossed-box", text)
            .with("particles", count as f64)
            .with("particle", first as f64)
            .with("times", times)
            .advice("choose a smaller dt"),
    )
}
