//! Validation of births and drains.

use super::{Birth, Drain, Life};
use crate::error::Error;
use crate::motion::Held;
use crate::solids::Solid;

/// Checks births and drains for `count` particles in `dimensions` dimensions, some of which are fixed.
///
/// # Errors
/// [`Error::Scene`] that names the first invalid particle or drain.
pub fn check(
    (life, births, drains): (&[Life], &[Birth], &[Drain]),
    held: &[Held],
    count: usize,
    dimensions: u32,
) -> Result<(), Error> {
    let refuse = |text: String| Err(Error::Scene(text));
    let fits = |x: f64| x.abs() <= f64::from(f32::MAX);
    if life.len() > count {
        return refuse(format!("the life of {} particles is given, but there are {count}", life.len()));
    }
    let mut born = vec![false; count];
    for birth in births {
        let id = birth.id;
        let Some(known) = born.get_mut(id as usize) else {
            return refuse(format!("particle {id} is to be spawned, but there are {count} particles: ids start at 0"));
        };
        if std::mem::replace(known, true) {
            return refuse(format!("particle {id} is to be spawned twice: give each birth its own id"));
        }
        let numbers = birth.velocity.to_array().into_iter().chain([birth.time, birth.mass, birth.guided]);
        if !numbers.into_iter().all(fits) || birth.mass < 0.0 || birth.guided < 0.0 {
            return refuse(format!(
                "the birth of particle {id} has a number that is NaN, infinite or beyond single precision, or a negative mass"
            ));
        }
        if dimensions == 2 && birth.velocity.z != 0.0 {
            return refuse(format!(
                "particle {id} is spawned with a velocity out of the plane: in 2 dimensions give it no z"
            ));
        }
    }
    let led = |one: &&Held| born.get(one.id as usize).is_some_and(|born| *born) || idle(life, one.id);
    if let Some(one) = held.iter().find(led) {
        return refuse(format!("particle {} is fixed, and is not active from the start: fix other particles", one.id));
    }
    for (number, drain) in drains.iter().enumerate() {
        let (numbers, good) = match drain.solid {
            Solid::Sphere(radius) => (vec![radius], radius > 0.0),
            Solid::Box(size) => (size.to_array().to_vec(), size.min_element() >= 0.0 && size.max_element() > 0.0),
            Solid::Plane(normal) => (normal.to_array().to_vec(), (normal.length() - 1.0).abs() < 1e-6),
            Solid::Capsule(axis, radius) => ([axis.to_array().to_vec(), vec![radius]].concat(), radius > 0.0),
            // A surface has no inside in which particles could be removed.
            Solid::Cone { .. } => (Vec::new(), false),
        };
        let mut numbers = numbers.into_iter().chain(drain.position.to_array());
        if !good || !numbers.all(fits) {
            return refuse(format!("drain {number} is no solid: {:?} at {}", drain.solid, drain.position));
        }
    }
    Ok(())
}

fn idle(life: &[Life], id: u32) -> bool {
    life.get(id as usize).is_some_and(|life| *life != Life::Active)
}
