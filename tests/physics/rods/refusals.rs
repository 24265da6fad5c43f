//! What rods may not be.

use glam::DVec3;
use motes::links::{MOST_RODS, Rod};
use motes::motion::{Held, Hold};
use motes::{Setup, State};

use crate::rods::{chain, forces, pendulum, setup};

fn said(particles: &State) -> String {
    setup(particles, forces(), "leapfrog", 0.01).check().err().map_or_else(String::new, |error| error.to_string())
}

fn square() -> State {
    let mut particles = State::default();
    chain(&mut particles, &[DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y], [false, false]);
    particles
}

#[test]
fn rods_make_open_chains() {
    let mut closed = square();
    assert_eq!(said(&closed), "");
    closed.links.rods.push(Rod { ends: [0, 3], length: 1.0 });
    assert!(said(&closed).contains("through particle 0 make a closed loop"), "{}", said(&closed));
    closed.held.push(Held { id: 2, by: Hold::Fixed });
    assert_eq!(said(&closed), "");

    let mut branch = square();
    branch.push(DVec3::X * 2.0, DVec3::ZERO, 1.0, 0.0);
    branch.links.rods.push(Rod { ends: [4, 1], length: 1.0 });
    assert!(said(&branch).contains("particle 1 has 3 rods"), "{}", said(&branch));
    branch.held.push(Held { id: 1, by: Hold::Fixed });
    assert_eq!(said(&branch), "");
    branch.held.push(Held { id: 4, by: Hold::Fixed });
    assert!(said(&branch).contains("rod 3 connects two fixed particles"), "{}", said(&branch));

    let mut long = State::default();
    let line = |rods: u32| (0..=rods).map(|n| DVec3::X * (f64::from(n) - 1350.0)).collect::<Vec<_>>();
    chain(&mut long, &line(MOST_RODS + 1), [false, false]);
    assert!(said(&long).contains("from particle 0 to particle 2701 has 2701 rods: 2700 are"), "{}", said(&long));
    long.held.push(Held { id: 1000, by: Hold::Fixed });
    assert_eq!(said(&long), "");
}

#[test]
fn rods_have_their_lengths_at_the_start() {
    let mut wrong = pendulum(&[0.4, 0.9]);
    wrong.links.rods[1].length = 1.000_02;
    assert!(
        said(&wrong).starts_with("rod 1 has the length 1.00002, and its particles 1 and 2 are "),
        "{}",
        said(&wrong)
    );
    wrong.links.rods[1].length = 0.999_99;
    assert_eq!(said(&wrong), "");

    let mut far = pendulum(&[0.4]);
    far.position_mut().iter_mut().for_each(|x| x.y += 3000.0);
    assert!(said(&far).contains("an origin that is nearer"), "{}", said(&far));
    far.position_mut().iter_mut().for_each(|x| x.y -= 2900.0);
    assert_eq!(said(&far), "");
}

#[test]
fn rods_do_not_grow_at_the_start() {
    let mut grows = pendulum(&[0.0, 0.0]);
    grows.velocity_mut()[2] = DVec3::new(3.0, 0.0, -0.5);
    assert!(said(&grows).contains("rod 1 between particles 1 and 2 would grow by 5e-1"), "{}", said(&grows));
    grows.velocity_mut()[2].z = 0.0;
    assert_eq!(said(&grows), "");
    // A fixed particle has no velocity, whatever is written of it; one with a prescribed motion has one that is not known yet.
    grows.velocity_mut()[0] = DVec3::Z;
    assert_eq!(said(&grows), "");
    grows.velocity_mut()[1] = DVec3::Z;
    grows.velocity_mut()[2] += DVec3::Z;
    assert!(said(&grows).contains("rod 0"), "{}", said(&grows));
    grows.held[0].by = Hold::Target;
    assert_eq!(said(&grows), "");
}

#[test]
fn rods_want_the_force() {
    let setup = Setup { forces: Vec::new(), ..setup(&pendulum(&[0.4]), forces(), "leapfrog", 0.01) };
    let text = setup.check().err().map_or_else(String::new, |error| error.to_string());
    assert!(text.contains("nothing keeps the lengths of the rods (of which there are 1)"), "{text}");
}
