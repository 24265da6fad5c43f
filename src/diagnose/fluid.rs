//! The report of `check` on a fluid.

use crate::error::Error;
use crate::forces::Over;
use crate::kernel::Machine;
use crate::kernel::Side;
use crate::simulation::Setup;
use crate::sph::{COURANT, Start};
use glam::DVec3;

use super::advice::acceleration_at;
use super::{Remark, contradictions};

/// The Mach number of the fastest flow, where the density varies by 1 % (Monaghan 1994).
const MACH: f64 = 0.1;
/// By how much the density may vary before it is remarked on.
const VARIES: f64 = 0.02;

/// The lines about a start, and the remarks on it.
pub fn remarks(setup: &Setup, start: &Start) -> Result<(Vec<String>, Vec<Remark>), Error> {
    let (medium, mut notes) = (&start.medium, Vec::new());
    let size = if medium.dimensions == 2 { "square" } else { "cubic" };
    let mut lines = vec![
        format!(
            "  at rest      density {}, on a {size} lattice of {}; a particle has mass {:.4e} and support {:.4e}",
            medium.density,
            medium.spacing,
            medium.mass(),
            medium.range()
        ),
        format!("  particles    {} of the fluid, {} of walls", start.fluid, start.walls),
    ];
    // Along a periodic axis nothing falls: a push there is a wind.
    let weight = weight(setup)?;
    notes.extend(contradictions::all(setup, start, weight)?);
    let weight = weight.pull * (DVec3::ONE - setup.bounds.axes(Side::Periodic));
    let (g, extent) = (weight.length(), start.extent.1 - start.extent.0);
    // Half a spacing of fluid is beyond the first and the last.
    let height = extent.dot(weight.normalize_or_zero().abs()) + medium.spacing;
    let fall = (2.0 * g * height).sqrt();
    let fastest = fall.max(start.speed);
    let how = if fall >= start.speed {
        format!("√(2 g H) = {fall:.4} with g = {g:.4}, H = {height:.4}")
    } else {
        "as it starts".to_owned()
    };
    let solved = medium.sound == 0.0;
    if solved {
        let bears = COURANT * medium.spacing / setup.dt;
        lines.push(format!(
            "  solved       for pressure; the fastest flow expected {fastest:.4}, and dt is stable up to {bears:.4}: {how}"
        ));
        if fastest > bears {
            let text = format!(
                "the fastest flow expected is {fastest:.4} ({how}), and dt = {} is stable for speeds up to {bears:.4}",
                setup.dt
            );
            let largest = COURANT * medium.spacing / fastest;
            notes.push(
                Remark::note("fast-flow", text)
                    .with("speed", fastest)
                    .with("largest_speed", bears)
                    .with("largest_dt", largest)
                    .advice(format!("choose {largest:.3e}")),
            );
        }
    } else if fastest > 0.0 {
        let ratio = medium.sound / fastest;
        lines.push(format!("  sound        {}, {ratio:.1} times the fastest flow expected: {how}", medium.sound));
        if ratio * ratio * VARIES < 1.0 {
            let text = format!(
                "the speed of sound is {ratio:.1} times the fastest flow expected ({how}): the density will vary by {:.0} %",
                100.0 / (ratio * ratio)
            );
            notes.push(
                Remark::note("slow-sound", text)
                    .with("sound_speed", medium.sound)
                    .with("speed", fastest)
                    .with("better_sound_speed", fastest / MACH)
                    .advice(format!("sound_speed = {:.4} makes that 1 %", fastest / MACH)),
            );
        }
    } else {
        lines.push(format!("  sound        {}; the speed of the flow is not known in advance", medium.sound));
    }
    let (light, heavy) = start.mass;
    if light < 0.99 * medium.mass() || heavy > 1.01 * medium.mass() {
        let text = format!(
            "particles of the fluid have masses from {light:.4e} to {heavy:.4e}, and density × spacing^{} of the force is {:.4e}: do their spacing \
             and density agree with the force?",
            medium.dimensions,
            medium.mass()
        );
        let masses = Remark::note("fluid-mass", text).with("least_mass", light).with("largest_mass", heavy);
        notes.push(masses.with("fluid_mass", medium.mass()));
    }
    if !start.summed {
        lines.push(format!(
            "  at the start every density is the rest density, as density_by = \"continuity\" sets it; by summation it is at most {:.4} of \
             that (particle {}), at least {:.4} (particle {})",
            start.densest.1, start.densest.0, start.thinnest.1, start.thinnest.0
        ));
        return Ok((lines, notes));
    }
    let ((dense, densest), (thin, thinnest)) = (start.densest, start.thinnest);
    let pressure = match medium.density * g * height {
        column if column > 0.0 => format!("{:.3} ρ g H", start.pressure() / column),
        _ => format!("{:.3e}", start.pressure()),
    };
    let asks = if solved {
        format!("and the fastest moves {:.3} spacings in the first step, at least", start.thrust)
    } else {
        format!("a pressure of {pressure}")
    };
    lines.push(format!("  at the start the maximum density is {densest:.4} of rest (particle {dense}), {asks}"));
    lines.push(format!("               the minimum density is {thinnest:.4} of rest (particle {thin})"));
    let burst = start.burst();
    if !solved && burst > MACH * medium.sound {
        let text = format!(
            "the maximum density of the fluid, at particle {dense}, is {densest:.3} times that at rest: it expands at the speed {burst:.3}, \
             faster than the flow for which the speed of sound is chosen"
        );
        let start = Remark::note("dense-start", text).with("particle", f64::from(dense));
        let start = start.with("relative_density", densest).with("speed", burst);
        notes.push(start.advice(format!(
            "give particles the mass density × spacing^{} = {:.4e}, move them apart, or choose a larger sound_speed",
            medium.dimensions,
            medium.mass()
        )));
    }
    if densest < 0.97 {
        let text = format!(
            "the maximum density of the fluid, at particle {dense}, is {densest:.3} times that at rest: under gravity it will collapse \
             by as much"
        );
        let start =
            Remark::note("thin-start", text).with("particle", f64::from(dense)).with("relative_density", densest);
        notes.push(start.advice(format!(
            "are masses density × spacing^{} = {:.4e}?",
            medium.dimensions,
            medium.mass()
        )));
    }
    Ok((lines, notes))
}

/// The effect of forces on each particle alone on the fluid as a whole.
#[derive(Debug, Clone, Copy, Default)]
pub struct Weight {
    /// The acceleration at the middle of the start.
    pub pull: DVec3,
    /// The largest that a single force has there or at the first particle: what is far smaller is rounding.
    pub largest: f64,
}

/// The acceleration that all particles have in common.
fn weight(setup: &Setup) -> Result<Weight, Error> {
    let problem = setup.problem(Machine::HOST)?;
    let mut weight = Weight::default();
    for law in
        setup.forces.iter().flat_map(|force| force.laws()).filter(|law| law.over == Over::Each && law.accelerates())
    {
        if let (Some(reference), false) = (&law.reference, law.depends_on_velocity(&problem)?) {
            let places = setup.state.position();
            let middle = places.iter().sum::<DVec3>() / places.len() as f64;
            let pull = |x: DVec3| Ok::<_, Error>(acceleration_at(reference, (0.0, 0), x, setup.bounds)?.truncate());
            let (here, aside) = (pull(middle)?, pull(places.first().copied().unwrap_or(middle))?);
            weight.pull += here;
            weight.largest = weight.largest.max(here.length()).max(aside.length());
        }
    }
    Ok(weight)
}
