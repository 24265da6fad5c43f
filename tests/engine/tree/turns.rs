//! Where a driver ends loops after so many iterations, walks continue in other dispatches: nothing is lost, and no particle is evaluated twice.

use motes::Error;
use motes::kernel::Machine;

use crate::support::{self, machines::walkers};
use crate::tree::accuracy::apart;
use crate::tree::complete::{complete, counted, weighed};
use crate::tree::sets::cloud;
use crate::tree::walks::{Alone, Settings, USUAL, Walk, gravity, over};

/// The machines that end loops, with so few turns that walks continue many times.
fn walkers_of(shared: &support::Shared, turns: u32) -> Vec<(&'static str, Machine)> {
    let mut all = walkers(shared);
    all.retain(|(_, machine)| machine.software);
    all.iter_mut().for_each(|(_, machine)| machine.turns = turns);
    all
}

#[test]
fn a_walk_that_stops_goes_on() {
    let shared = support::device();
    let bodies = cloud(3205, 23);
    for (name, machine) in walkers_of(&shared, 150) {
        for settings in [USUAL, Settings { alpha: 0.005, kernel: "spline", ..USUAL }] {
            let whole =
                Walk::new(&shared, Machine { turns: 60_000, ..machine }, &bodies, gravity("tree", settings)).run();
            let mut walk = Walk::new(&shared, machine, &bodies, gravity("tree", settings));
            assert!(walk.rounds() > 3, "{name}: goes on {} times", walk.rounds());
            let parts = walk.run();
            assert!(walk.verdict().good(), "{name}, {settings:?}: {:?}", walk.verdict());
            pollster::block_on(walk.simulation.check()).expect("all walks are done");
            // Sums are kept between dispatches and added in parts: √1500 roundings by half an epsilon.
            let off = apart(&whole, &parts);
            assert!(off > 0.0 && off < 2.3e-6, "{name}, {settings:?}: {off:e} away from one dispatch");
        }
    }
}

#[test]
fn all_mass_is_met_once_wherever_walks_stop() {
    let shared = support::device();
    for turns in [70, 150, 1000] {
        for (name, machine) in walkers_of(&shared, turns) {
            let bodies = weighed(cloud(1111, 24), true);
            let mut walk = Walk::new(&shared, machine, &bodies, Box::new(Alone(counted(over(0.4)))));
            assert!(walk.rounds() > 0, "{name}");
            complete(&format!("{name}, {turns} turns"), &mut walk, &bodies);
        }
    }
}

/// With fewer dispatches than it takes, the run ends with the number of a particle.
#[test]
fn a_walk_that_is_not_done_is_an_alarm() {
    let shared = support::device();
    let bodies = cloud(3200, 21);
    for (name, machine) in walkers_of(&shared, 150) {
        for (rounds, crowded) in [(1, true), (usize::MAX, false)] {
            let mut walk = Walk::new(&shared, machine, &bodies, gravity("tree", USUAL));
            let mut left = rounds;
            walk.passes().retain(|pass| {
                let kept = pass.indirect.is_none() || left > 0;
                left -= usize::from(pass.indirect.is_some() && left > 0);
                kept
            });
            walk.run();
            match (pollster::block_on(walk.simulation.check()), crowded) {
                (Ok(()), false) => (),
                (Err(Error::TooManyNeighbors { particle }), true) => assert!(particle < 3200, "{name}: {particle}"),
                (said, _) => panic!("{name}, {rounds} rounds: {said:?}"),
            }
        }
    }
}

/// A GPU ends no loops: there is nothing to continue with.
#[test]
fn a_gpu_walks_at_once() {
    let shared = support::device();
    let (name, machine) = walkers(&shared).into_iter().find(|(_, machine)| !machine.software).expect("a GPU");
    assert_eq!(Walk::new(&shared, machine, &cloud(3200, 21), gravity("tree", USUAL)).rounds(), 0, "{name}");
}
