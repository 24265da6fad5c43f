//! The report after NaN or a runaway: links of the limiting particle, advice, and the last good state.

use std::fmt::Write as _;
use std::path::Path;

use motes::formats::{Format, Options, Precision};
use motes::{Bounds, Error, Setup, State};

use super::failure::Failure;
use motes::run::written;

/// The maximum number of linked particles that are named.
const NAMED: usize = 8;

/// Writes the last valid state in the numerical formats of the run, or as NPZ if it has none, and reports its files
/// and the links of the failing particle. `advice` is the known reason, such as a time step that is too long.
pub fn explain(
    error: Error,
    setup: &Setup,
    advice: Option<&str>,
    last: Option<&State>,
    (folder, formats, precision): (&Path, &[&Format], Precision),
) -> Failure {
    let (Error::NotFinite { particle, .. } | Error::Runaway { particle, .. } | Error::Overlong { particle, .. }) =
        error
    else {
        return Failure::Error(error);
    };
    let mut words = neighbors(setup, particle);
    if let Some(advice) = advice.or_else(|| of_a_fluid(setup)) {
        let _ = write!(words, "\n{advice}");
    }
    if let Some(last) = last {
        let bounds = Some(last.boxed(&setup.bounds)).filter(|bounds| *bounds != Bounds::default());
        match keep(last, folder, formats, (precision, bounds)) {
            Ok(files) => {
                let _ = write!(words, "\nthe last good state, after step {}, is in {files}", last.step);
            }
            Err(why) => {
                let _ = write!(words, "\nthe last good state is lost: {why}");
            }
        }
    }
    Failure::Explained(error, words.trim_start().to_owned())
}

/// Usual reasons for NaN in a fluid.
fn of_a_fluid(setup: &Setup) -> Option<&'static str> {
    motes::diagnose::flows(&setup.forces).then_some(
        "in a fluid the cause is a time step too long for its speed of sound or viscosity (`motes check` reports the limit), a flow \
         faster than sound, surface tension that is too strong, or particles squeezed between walls, obstacles and spawned particles",
    )
}

/// The particles that are linked to a particle.
fn neighbors(setup: &Setup, particle: u32) -> String {
    let links = &setup.state.links;
    // Links hold rows, not ids.
    let ids = setup.state.ids();
    let Some(place) = setup.state.place_of(particle).and_then(|place| u32::try_from(place).ok()) else {
        return String::new();
    };
    let mut others: Vec<u32> = Vec::new();
    let pairs = links.springs.iter().map(|s| s.ends).chain(links.rods.iter().map(|r| r.ends));
    others.extend(pairs.filter(|ends| ends.contains(&place)).flatten());
    others.extend(links.corners().filter(|corners| corners.contains(&place)).flatten());
    others.retain(|other| *other != place);
    others.sort_unstable();
    others.dedup();
    if others.is_empty() {
        return String::new();
    }
    let named: Vec<_> =
        others.iter().take(NAMED).filter_map(|other| ids.get(*other as usize)).map(u32::to_string).collect();
    let more = if others.len() > NAMED { format!(" and {} more", others.len() - NAMED) } else { String::new() };
    format!("it is linked to {}{more}", named.join(", "))
}

fn keep(
    last: &State,
    folder: &Path,
    formats: &[&Format],
    (precision, bounds): (Precision, Option<Bounds>),
) -> Result<String, Error> {
    let arrays = motes::formats::format("npz");
    let chosen: Vec<&Format> = if formats.is_empty() { arrays.into_iter().collect() } else { formats.to_vec() };
    let mut files = Vec::new();
    for format in chosen {
        let path = folder.join(format!("last_good.{}", format.name));
        written(&path, format, last, &Options { precision, bounds, ..Options::default() })?;
        files.push(path.display().to_string());
    }
    Ok(files.join(" and "))
}
