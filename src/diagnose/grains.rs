//! Remarks on grains: steps that contacts do not allow, spheres that overlap at the start, spheres without a radius.

use std::f64::consts::PI;

use super::Remark;
use super::steps::digits;
use crate::grains::{Material, Model, Pair, touching};
use crate::simulation::Setup;

/// The largest step, as a part of the Rayleigh time: the common rule of granular codes (Li, Xu & Thornton, Powder Technol. 154, 45, 2005).
const RAYLEIGH: f64 = 0.2;
/// The largest step, as a part of the time of contact.
const CONTACT: f64 = 0.05;
/// How many times heavier than the heaviest free grain a fixed one has to be, to be as good as a wall: the reduced mass is then right to 1e-3.
const HEAVY: f64 = 1000.0;
/// The largest overlap at the start, as a part of the smaller radius.
const OVERLAP: f64 = 0.1;

/// A limit of the step, by a grain.
struct Limit {
    dt: f64,
    time: f64,
    grain: usize,
    what: &'static str,
    part: f64,
}

/// The remarks; none where particles do not touch.
pub fn remarks(setup: &Setup) -> Vec<Remark> {
    let materials: Vec<Material> = setup.forces.iter().flat_map(|force| force.properties().touches).collect();
    let (Some(radii), false) = (setup.state.scalar("radius"), materials.is_empty()) else { return Vec::new() };
    let mut remarks = Vec::new();
    if let Some(grain) = radii.iter().position(|radius| *radius <= 0.0) {
        let none = radii.iter().filter(|radius| **radius <= 0.0).count();
        let text =
            format!("{none} grains have a radius of 0 or less, the first of them particle {grain}: they touch nothing");
        remarks.push(
            Remark::warning("no-radius", text)
                .with("particles", none as f64)
                .with("particle", grain as f64)
                .advice("give them a radius"),
        );
    }
    remarks.extend(light_walls(setup));
    remarks.extend(long_step(setup, radii, &materials));
    remarks.extend(overlaps(setup, radii));
    remarks.extend(pressed(setup, radii, &materials));
    remarks
}

/// The largest overlap at which bridges of liquid may hold two grains, as a part of the radius.
const PRESSED: f64 = 0.05;

/// Grains that bridges of liquid press into each other: the overlap of two of the smallest size at which the contact balances the bridge.
fn pressed(setup: &Setup, radii: &[f64], materials: &[Material]) -> Option<Remark> {
    let grains = (0..radii.len()).filter(|i| radii[*i] > 0.0 && setup.state.is_active(*i));
    let grain = grains.min_by(|a, b| radii[*a].total_cmp(&radii[*b]))?;
    let radius = radii[grain];
    let overlap = |material: &Material| {
        let pull = material.pull * radius;
        match material.model {
            Model::Linear => pull / material.stiffness,
            Model::Hertz => (pull / (2.0 / 3.0 * material.stiffness * (0.5 * radius).sqrt())).powf(2.0 / 3.0),
        }
    };
    let part = materials.iter().map(overlap).fold(0.0, f64::max) / radius;
    (part > PRESSED).then(|| {
        let text = format!(
            "bridges of liquid press grains into each other by {} of the radius of particle {grain}: they are too soft for such a surface tension",
            digits(part)
        );
        let remark = Remark::warning("soft-for-bridges", text).with("overlap", part).with("particle", grain as f64);
        remark.advice("make them stiffer, or lower `surface_tension`")
    })
}

/// Fixed grains that impacts take for light ones.
fn light_walls(setup: &Setup) -> Option<Remark> {
    let mass = setup.state.mass();
    let fixed = setup.state.fixed();
    let free = (0..mass.len()).filter(|i| !fixed[*i]).map(|i| mass[i]).fold(0.0, f64::max);
    let light = (0..mass.len()).find(|i| fixed[*i] && mass[*i] > 0.0 && mass[*i] < HEAVY * free)?;
    let text = format!(
        "particle {light} is fixed and has a mass of {}, which impacts count: they lose less than `restitution` says",
        digits(mass[light])
    );
    let way =
        format!("give fixed grains a mass of 0, which counts as infinite, or of {} at least", digits(HEAVY * free));
    Some(Remark::warning("light-walls", text).with("particle", light as f64).advice(way))
}

fn long_step(setup: &Setup, radii: &[f64], materials: &[Material]) -> Option<Remark> {
    let mass = setup.state.mass();
    let grains = (0..radii.len()).filter(|i| radii[*i] > 0.0 && mass[*i] > 0.0);
    let limits = grains
        .flat_map(|grain| materials.iter().map(move |material| limit(material, grain, radii[grain], mass[grain])));
    let least = limits.min_by(|a, b| a.dt.total_cmp(&b.dt))?;
    (setup.dt > least.dt).then(|| {
        let Limit { dt, time, grain, what, part } = least;
        let text = format!(
            "dt = {} is too long for contacts: the {what} of particle {grain} is {}, and a step may be {part} of it: grains gain energy in \
             contacts, or pass through each other",
            setup.dt,
            digits(time)
        );
        let way = format!("the largest dt that is safe is {}: set it, or make grains softer or larger", digits(dt));
        Remark::warning("long-step", text).with("dt", setup.dt).with("largest_dt", dt).with("particle", grain as f64).advice(way)
    })
}

fn limit(material: &Material, grain: usize, radius: f64, mass: f64) -> Limit {
    let (what, time, part) = match material.model {
        // Half a period of two like grains.
        Model::Linear => ("time of contact", PI * (0.5 * mass / material.stiffness).sqrt(), CONTACT),
        Model::Hertz => {
            let density = mass / (4.0 / 3.0 * PI * radius.powi(3));
            let nu = (2.0 - 2.0 * material.shear) / (2.0 - material.shear);
            let shear = material.stiffness * (1.0 - nu * nu) / (2.0 * (1.0 + nu));
            ("Rayleigh time", PI * radius * (density / shear).sqrt() / (0.1631 * nu + 0.8766), RAYLEIGH)
        }
    };
    Limit { dt: part * time, time, grain, what, part }
}

/// Pairs that overlap by more than a tenth of the smaller radius.
fn overlaps(setup: &Setup, radii: &[f64]) -> Option<Remark> {
    let state = &setup.state;
    let part = |pair: &Pair| pair.overlap / pair.grains.map(|grain| radii[grain]).into_iter().fold(f64::MAX, f64::min);
    let pairs = touching(state.position(), radii, &setup.bounds, |i| state.is_active(i) && radii[i] > 0.0);
    let deep: Vec<&Pair> = pairs.iter().filter(|pair| part(pair) > OVERLAP).collect();
    let worst = deep.iter().max_by(|a, b| part(a).total_cmp(&part(b)))?;
    let (many, [i, j], part) = (deep.len(), worst.grains, part(worst));
    let text = format!(
        "{many} pairs of grains overlap by more than {OVERLAP} of a radius at the start, most of all particles {i} and {j}, by {part:.2}: \
         they fly apart"
    );
    let remark = Remark::warning("overlap", text).with("pairs", many as f64).with("overlap", part);
    let way = "start with grains that do not touch, and let them settle";
    Some(remark.with("particle", i as f64).with("other", j as f64).advice(way))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::kernel::{Array, Bounds, Solver};
    use crate::settings::{Settings, Value};
    use crate::state::State;

    fn setup(dt: f64, radii: [f64; 2], distance: f64, more: &[(&'static str, Value)]) -> Setup {
        let entry = crate::forces::entry("contact").expect("it");
        let settings = Settings::defaults(entry.keys).with("range", 4.0.into());
        let settings = more.iter().fold(settings, |all, (key, value)| all.with(key, value.clone()));
        let mut state = State::default();
        for x in [0.0, distance] {
            state.push(DVec3::X * x, DVec3::ZERO, 2.0, 0.0);
        }
        for column in crate::grains::columns() {
            state.declare(&column).expect("a column");
        }
        state.set("radius", Array::Float(radii.to_vec())).expect("radii");
        let integrator = crate::integrators::entry("leapfrog").expect("it").by_default();
        let (bounds, solver) = (Bounds::default(), Solver::default());
        Setup { state, forces: vec![(entry.build)(&settings)], integrator, dt, bounds, solver }
    }

    /// Of the remarks the identifiers.
    fn ids(setup: &Setup) -> Vec<&'static str> {
        remarks(setup).iter().map(|remark| remark.id).collect()
    }

    /// Two grains of mass 2 and stiffness 1000 touch for π √(1 / 1000) = 0.0993: steps up to 0.00497. By Hertz the Rayleigh time of
    /// R = 1, ρ = 0.4775, E = 1000, ν = 0.25 is π √(ρ / 400) / 0.917375 = 0.1183.
    #[test]
    fn steps_that_are_too_long_are_named_with_the_longest() {
        let limit = |more: &[(&'static str, Value)]| {
            let all = remarks(&setup(1.0, [1.0, 1.0], 2.1, more));
            assert_eq!(all.len(), 1, "{all:?}");
            (all[0].id, all[0].number("largest_dt").expect("a limit"))
        };
        let (id, dt) = limit(&[]);
        assert!(id == "long-step" && (dt - 0.05 * 0.099_346).abs() < 1e-6, "{dt}");
        let (_, dt) = limit(&[("model", "hertz".into()), ("young_modulus", 1000.0.into())]);
        assert!((dt - 0.2 * 0.118_32).abs() < 1e-5, "{dt}");
        assert!(ids(&setup(0.0049, [1.0, 1.0], 2.1, &[])).is_empty());
    }

    /// Two spheres of radius 1 with γ = 4 pull with 8 π = 25.1, which a stiffness of 1000 holds at 0.0251, and one of 200 at 0.126. By Hertz 4/3 E* √(1/2)
    /// δ^(3/2) holds it.
    #[test]
    fn bridges_that_press_grains_together_are_found() {
        let of = |more: &[(&'static str, Value)]| {
            let more = [&[("surface_tension", 4.0.into())], more].concat();
            remarks(&setup(1e-4, [1.0, 1.0], 2.1, &more))
        };
        assert!(of(&[]).is_empty());
        let soft = of(&[("stiffness", 200.0.into())]);
        assert!(soft.len() == 1 && soft[0].id == "soft-for-bridges", "{soft:?}");
        assert!((soft[0].number("overlap").expect("a part") - 8.0 * PI / 200.0).abs() < 1e-12, "{soft:?}");
        let hertz = of(&[("model", "hertz".into()), ("young_modulus", 500.0.into()), ("poisson_ratio", 0.0.into())]);
        let want = (8.0 * PI / (4.0 / 3.0 * 250.0 * 0.5_f64.sqrt())).powf(2.0 / 3.0);
        assert!((hertz[0].number("overlap").expect("a part") - want).abs() < 1e-12, "{hertz:?} {want}");
    }

    #[test]
    fn deep_overlaps_and_grains_without_radius_are_found() {
        assert!(ids(&setup(0.001, [1.0, 1.0], 1.92, &[])).is_empty());
        let deep = remarks(&setup(0.001, [1.0, 0.5], 1.4, &[]));
        assert!(deep.len() == 1 && deep[0].id == "overlap", "{deep:?}");
        assert!((deep[0].number("overlap").expect("a part") - 0.2).abs() < 1e-12, "{deep:?}");
        assert_eq!(ids(&setup(0.001, [1.0, 0.0], 0.5, &[])), ["no-radius"]);
    }
}
