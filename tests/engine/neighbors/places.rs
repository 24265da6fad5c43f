//! Places where a search for neighbours may go wrong.

use glam::DVec3;
use motes::{Bounds, Side, State};

use crate::support::{self, Random};

/// Particles in a box, and how far they look.
pub struct Place {
    pub name: &'static str,
    pub particles: State,
    pub bounds: Bounds,
    pub range: f64,
}

/// Particles at these places, with velocities and masses of a cloud.
fn particles(positions: &[DVec3]) -> State {
    let mut cloud = support::cloud(positions.len(), 17);
    cloud.position_mut().copy_from_slice(&positions.iter().map(|x| x.as_vec3().as_dvec3()).collect::<Vec<_>>());
    cloud
}

fn uniform(random: &mut Random, low: DVec3, high: DVec3) -> DVec3 {
    let mut number = || f64::from(random.narrow()) * 0.5 + 0.5;
    low + (high - low) * DVec3::new(number(), number(), number()).clamp(DVec3::ZERO, DVec3::splat(0.999_999))
}

fn random(count: usize, low: DVec3, high: DVec3) -> State {
    let mut random = Random::new(3);
    particles(&(0..count).map(|_| uniform(&mut random, low, high)).collect::<Vec<_>>())
}

pub fn all() -> Vec<Place> {
    let cube = |side: f64| Bounds::new(DVec3::splat(-side), DVec3::splat(side), Side::Periodic);
    let in_cube = |count, side: f64| random(count, DVec3::splat(-side), DVec3::splat(side));
    let flat = DVec3::new(1.0, 1.0, 0.0);
    let place = |name, particles, bounds, range| Place { name, particles, bounds, range };
    let mut list = vec![
        place("one", in_cube(1, 1.0), cube(1.0), 0.3),
        place("two", particles(&[DVec3::ZERO, DVec3::X * 0.25]), Bounds::default(), 0.3),
        place("periodic", in_cube(2000, 3.0), cube(3.0), 0.71),
        place("periodic, six cells", in_cube(700, 3.0), cube(3.0), 0.98),
        place("periodic, five cells", in_cube(700, 3.0), cube(3.0), 1.1),
        place("periodic, four cells", in_cube(500, 3.0), cube(3.0), 1.4),
        place("periodic, three cells", in_cube(300, 3.0), cube(3.0), 1.9),
        place("periodic, two cells", in_cube(300, 3.0), cube(3.0), 2.9),
        place("periodic, one cell", in_cube(300, 3.0), cube(3.0), 5.0),
        place("periodic, more than the box", in_cube(200, 3.0), cube(3.0), 50.0),
        place("open", in_cube(2000, 3.0), Bounds::default(), 0.71),
        place("open, all in one cell", in_cube(500, 0.1), Bounds::default(), 3.0),
        place("open, all at one place", particles(&[DVec3::new(0.3, -2.0, 7.0); 100]), Bounds::default(), 0.5),
        place("open, cells all but empty", in_cube(900, 500.0), Bounds::default(), 40.0),
        place("open, folded", in_cube(2000, 1e4), Bounds::default(), 900.0),
        place(
            "reflecting",
            in_cube(1500, 3.0),
            Bounds::new(DVec3::splat(-3.0), DVec3::splat(3.0), Side::Reflecting),
            0.7,
        ),
    ];
    let plane = Bounds::new(-4.0 * flat, 4.0 * flat, Side::Periodic);
    let mut planar = random(2000, -4.0 * flat, 4.0 * flat);
    planar.velocity_mut().iter_mut().for_each(|v| v.z = 0.0);
    list.push(place("a periodic plane", planar, plane, 0.5));
    let strip = Bounds { sides: [Side::Periodic, Side::Open, Side::Open], ..cube(3.0) };
    list.push(place("periodic along one axis", in_cube(1000, 3.0), strip, 0.9));
    // A lattice of distances that f32 holds, some of them just the range, and cells whose sides it touches.
    let lattice: Vec<_> =
        (0..1000).map(|i| DVec3::new(f64::from(i % 10), f64::from(i / 10 % 10), f64::from(i / 100))).collect();
    list.push(place("a lattice, neighbours just out of range", particles(&lattice), Bounds::default(), 1.0));
    list.push(place(
        "a lattice in a box",
        particles(&lattice),
        Bounds::new(DVec3::ZERO, DVec3::splat(10.0), Side::Periodic),
        1.5,
    ));
    // Far away f32 is coarse: cells and places are of one size there, and places are further apart than cells.
    for far in [1e4, 3e5, 4e6, 2e7, 1e9, 1e30] {
        let mut positions: Vec<_> = in_cube(400, 2.0).position().to_vec();
        positions.extend(in_cube(400, 2.0).position().iter().map(|x| *x + DVec3::new(far, -far, 0.5 * far)));
        list.push(place("some far away", particles(&positions), Bounds::default(), 1.0));
    }
    // A clump in thin air, and strays.
    let mut clumped = in_cube(600, 0.4).position().to_vec();
    clumped.extend(in_cube(200, 30.0).position());
    list.push(place("clumped", particles(&clumped), Bounds::default(), 0.5));
    list.push(place("clumped, periodic", particles(&clumped), cube(30.0), 0.5));
    list
}
