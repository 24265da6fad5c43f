//! Births come when and where they should.

use glam::DVec3;
use motes::life::Life;
use motes::settings::Value;
use motes::{Bounds, Cpu, Simulation};

use crate::births::{DT, emitted, fluid, jet, setup, spray, state};
use crate::support::{self, machines};

/// So many intervals are over, of which none ends within a part of a step of a step's end.
fn due(time: f64, start: f64, interval: f64) -> u64 {
    let mut number = 0;
    while start + number as f64 * interval <= time + DT / 64.0 {
        number += 1;
    }
    number
}

#[test]
fn as_many_are_born_as_are_due() {
    let end = 60.0 * DT;
    let mut particles = jet(end);
    let rows = particles.len() as u64;
    particles.append(&spray(end)).expect("one kind");
    // As many as leave before the end: rows of six, and one by one.
    assert!((rows as f64 - 6.0 * (end * 1.3 / 0.1).ceil()).abs() < 0.5, "{rows}");
    let single = particles.len() as u64 - rows;
    assert!((single as f64 - ((end - 0.1) * 71.0).ceil()).abs() < 0.5, "{single}");
    let shared = support::device();
    let gpu = machines::gpu(&shared, particles.len());
    let mut simulation = Simulation::on(gpu, &setup(particles.clone(), Vec::new(), Bounds::default())).expect("a run");
    let all = particles.len() as u64;
    let before = pollster::block_on(simulation.population()).expect("a count");
    assert_eq!((before.pending, before.active, before.removed), (all, 0, 0));
    for steps in [1, 7, 9, 20, 20] {
        simulation.step(steps).expect("steps");
        let time = simulation.steps() as f64 * DT;
        let want = (6 * due(time, 0.0, 0.1 / 1.3)).min(rows) + due(time, 0.1, 1.0 / 71.0).min(all - rows);
        let have = pollster::block_on(simulation.population()).expect("a count");
        assert_eq!((have.active, have.pending, have.removed), (want, all - want, 0), "at {time}");
        // Active particles are the first of each emitter, and each is where it flew to by itself.
        let now = state(&mut simulation);
        for birth in &particles.births {
            let id = birth.id as usize;
            let is_active = birth.time <= time + DT / 64.0;
            assert_eq!(now.life()[id], if is_active { Life::Active } else { Life::Pending }, "{id} at {time}");
            let way = if is_active { birth.velocity * (time - birth.time) } else { DVec3::ZERO };
            // 60 additions near 1, each rounded by 6e-8.
            assert!((now.position()[id] - particles.position()[id] - way).length() < 60.0 * 2e-7, "{id}");
            let (mass, v) = if is_active { (birth.mass, birth.velocity) } else { (0.0, DVec3::ZERO) };
            assert!(
                (now.mass()[id] - mass).abs() < 1e-7 * birth.mass && (now.velocity()[id] - v).length() < 1e-6,
                "{id}"
            );
        }
    }
}

/// What does not depend on how steps are cut: the rows are a cubic lattice.
#[test]
fn rows_follow_each_other_at_the_spacing() {
    let particles = jet(1.0);
    let shared = support::device();
    let gpu = machines::gpu(&shared, particles.len());
    let mut simulation = Simulation::on(gpu, &setup(particles.clone(), Vec::new(), Bounds::default())).expect("a run");
    simulation.step(73).expect("steps");
    let now = state(&mut simulation);
    assert!(now.life().iter().all(|life| *life == Life::Active));
    // In the middle of the jet the nearest others of each are a spacing away, and six of them.
    let gap = |a: usize, b: usize| (now.position()[a] - now.position()[b]).length();
    for id in 0..particles.len() {
        let near = (0..particles.len()).filter(|other| *other != id && gap(id, *other) < 0.12).collect::<Vec<_>>();
        assert!(near.iter().all(|other| (gap(id, *other) - 0.1).abs() < 2e-5), "{id}");
        // Three by two of them: two or three beside, and two along but at the ends.
        let ends = usize::from(id < 6) + usize::from(id >= particles.len() - 6);
        assert_eq!(near.len(), 4 - ends + usize::from(id % 3 == 1), "{id}");
    }
    assert!((particles.births[0].mass - 1.0).abs() < 1e-12, "1000 in a tenth of a tenth of a tenth");
}

/// A mouth is round, and the ways of a spray fill a cone.
#[test]
fn mouths_have_their_shapes() {
    let disk = [("speed", Value::Number(1.0)), ("spacing", Value::Number(0.1)), ("radius", Value::Number(0.5))];
    let row = emitted(&disk, 3, 0.05);
    // The area of the disk over that of a share, 78.5, within the shares of its edge.
    assert!((70..=88).contains(&row.len()), "{}", row.len());
    assert!(row.position().iter().all(|x| x.length() <= 0.5 + 1e-12 && x.x.abs() < 1e-12));
    let line = emitted(&disk, 2, 0.05);
    assert_eq!(line.len(), 10);
    assert!(line.position().iter().all(|x| x.z == 0.0 && x.x.abs() < 1e-12 && x.y.abs() <= 0.45 + 1e-12));
    let spray = spray(20.0);
    let n = spray.len() as f64;
    let cosines: Vec<f64> = spray.births.iter().map(|birth| birth.velocity.y / birth.velocity.length()).collect();
    let edge = 20_f64.to_radians().cos();
    assert!(cosines.iter().all(|c| *c >= edge - 1e-12));
    // Uniform in height: the mean is half way; the deviation of one is a twelfth of the width, squared; five of the mean.
    let mean = cosines.iter().sum::<f64>() / n;
    assert!((mean - 0.5 * (1.0 + edge)).abs() < 5.0 * (1.0 - edge) / (12.0 * n).sqrt(), "{mean}");
    // The mean square of a disk's radius is half the square of its edge.
    let square = spray.position().iter().map(|x| x.length_squared()).sum::<f64>() / n;
    assert!((square - 0.02).abs() < 5.0 * 0.04 / (12.0 * n).sqrt(), "{square}");
    assert!(spray.births.iter().all(|birth| (birth.velocity.length() - 0.9).abs() < 1e-12));
}

/// A jet of fluid in free flight is as dense as the fluid at rest.
#[test]
fn a_jet_is_at_rest_density() {
    let settings = [
        ("shape", crate::births::word("rectangle")),
        ("size", Value::Vector(DVec3::new(1.0, 1.0, 0.0))),
        ("direction", Value::Vector(DVec3::X)),
        ("speed", Value::Number(1.3)),
        ("spacing", Value::Number(0.1)),
    ];
    let particles = emitted(&settings, 2, 1.2);
    let bounds = Bounds { dimensions: 2, ..Bounds::default() };
    let count = u32::try_from(particles.len()).expect("few");
    let mut simulation =
        Simulation::on(Cpu::new(count).expect("some"), &setup(particles, vec![fluid()], bounds)).expect("a run");
    simulation.step(88).expect("steps");
    let density = pollster::block_on(simulation.read(motes::sph::DENSITY)).expect("densities");
    let now = state(&mut simulation);
    // Ten abreast: the fourth to seventh of a row see no edge, nor do rows that are two behind an end.
    let rows = now.len() / 10;
    assert!(rows >= 12 && now.life().iter().all(|life| *life == Life::Active));
    for id in (2..rows - 2).flat_map(|row| (3..7).map(move |k| 10 * row + k)) {
        assert!((f64::from(density[id]) / 1000.0 - 1.0).abs() < 0.02, "{id}: {}", density[id]);
    }
}

/// A particle just spawned goes straight on, whatever forces say; then it falls.
#[test]
fn the_newest_go_straight_on() {
    let particles = jet(0.8);
    let weight = || support::states::force("uniform", &[("acceleration", Value::Vector(DVec3::NEG_Z))]);
    let count = u32::try_from(particles.len()).expect("few");
    let run = setup(particles.clone(), vec![weight()], Bounds::default());
    let mut simulation = Simulation::on(Cpu::new(count).expect("some"), &run).expect("a run");
    simulation.step(50).expect("steps");
    let (now, time) = (state(&mut simulation), 50.0 * DT);
    for birth in particles.births.iter().filter(|birth| birth.time < time) {
        // Three rows, at 1.3 and a tenth apart, and then the steps that begin and end in free fall.
        let fall = (time - birth.time - 0.3 / 1.3).max(0.0);
        let change = (now.velocity()[birth.id as usize] - birth.velocity) * DVec3::NEG_Z;
        assert!(change.z >= 0.0 && (change.z - fall).abs() <= DT, "{}: {} after {fall}", birth.id, change.z);
        assert!(fall > 0.0 || change.z == 0.0);
    }
}
