//! Copies of particles: turned by every rotation alike, apart over the seams of the box, with velocities of a temperature.

use glam::DVec3;
use motes::shapes::copies::Copies;
use motes::{Bounds, Side, State};

/// Three particles of different masses, in no line, the second with a velocity.
fn molecule() -> State {
    let mut state = State::default();
    state.push(DVec3::new(0.3, 0.0, 0.0), DVec3::ZERO, 1.0, 0.1);
    state.push(DVec3::new(0.0, 0.4, 0.1), DVec3::new(0.0, 0.0, 2.0), 2.0, 0.2);
    state.push(DVec3::new(-0.3, -0.1, 0.2), DVec3::ZERO, 3.0, 0.3);
    state.species_mut().copy_from_slice(&[4, 5, 4]);
    state
}

fn bounds(dimensions: u32) -> Bounds {
    let flat = DVec3::new(1.0, 1.0, if dimensions == 2 { 0.0 } else { 1.0 });
    Bounds { dimensions, ..Bounds::new(DVec3::splat(-4.0) * flat, DVec3::splat(4.0) * flat, Side::Periodic) }
}

fn copies(count: u32, seed: u64) -> Copies {
    let room = [DVec3::splat(-4.0), DVec3::splat(4.0)];
    Copies { count, room, lattice: false, separation: 0.0, temperature: 0.0, seed }
}

fn center(state: &State, copy: usize) -> DVec3 {
    let (x, m) = (&state.position()[3 * copy..3 * copy + 3], &state.mass()[3 * copy..3 * copy + 3]);
    x.iter().zip(m).map(|(x, m)| *x * *m).sum::<DVec3>() / m.iter().sum::<f64>()
}

/// Distances within a copy are those of the first, and so is what else particles have; velocities turn with it. Directions are uniform: the mean
/// of a unit vector is 0 and that of its squares a third, with standard errors 0.577 / √n and 0.298 / √n; 5 of them.
#[test]
fn copies_are_rigid_and_turned_anyhow() {
    const NUMBER: u32 = 3000;
    const COUNT: usize = NUMBER as usize;
    let one = molecule();
    for seed in [1, 2] {
        let all = copies(NUMBER, seed).of(&one, &bounds(3)).expect("copies");
        assert_eq!(all.len(), 3 * COUNT);
        let (mut mean, mut squares, mut handed) = (DVec3::ZERO, DVec3::ZERO, 0);
        for copy in 0..COUNT {
            let (x, v) = (&all.position()[3 * copy..3 * copy + 3], &all.velocity()[3 * copy..3 * copy + 3]);
            let at = one.position();
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                assert!(((x[a] - x[b]).length() - (at[a] - at[b]).length()).abs() < 1e-12);
            }
            // Turned, not mirrored: the velocity stands to both ways as it did.
            let volume = |x: &[DVec3], v: DVec3| (x[1] - x[0]).cross(x[2] - x[0]).dot(v);
            assert!((volume(x, v[1] - v[0]) - volume(at, one.velocity()[1])).abs() < 1e-12);
            assert_eq!(&all.species()[3 * copy..3 * copy + 3], &[4, 5, 4]);
            assert_eq!(&all.mass()[3 * copy..3 * copy + 3], one.mass());
            let way = (x[1] - x[0]).normalize();
            mean += way / COUNT as f64;
            squares += way * way / COUNT as f64;
            handed += usize::from(way.x * way.y > 0.0);
            assert!(center(&all, copy).abs().max_element() <= 4.0);
        }
        let root = (COUNT as f64).sqrt();
        assert!(mean.abs().max_element() < 5.0 * 0.577 / root, "{seed}: {mean}");
        assert!((squares - 1.0 / 3.0).abs().max_element() < 5.0 * 0.298 / root, "{seed}: {squares}");
        assert!((handed as f64 - 0.5 * COUNT as f64).abs() < 2.5 * root, "{seed}: {handed}");
        // Centres are anywhere: a sixteenth of 8² / 12 is their variance, with a standard error of 0.9 of it by √n.
        let variance = (0..COUNT).map(|copy| center(&all, copy)).map(|x| x * x).sum::<DVec3>() / COUNT as f64;
        assert!((variance / (64.0 / 12.0) - 1.0).abs().max_element() < 5.0 * 0.9 / root, "{seed}: {variance}");
        assert_eq!(all, copies(NUMBER, seed).of(&one, &bounds(3)).expect("the same"));
        assert_ne!(all, copies(NUMBER, seed + 1).of(&one, &bounds(3)).expect("others"));
    }
}

/// In the plane copies turn about its normal, and stay in it.
#[test]
fn copies_in_the_plane_stay_there() {
    let mut one = State::default();
    one.push(DVec3::ZERO, DVec3::ZERO, 1.0, 0.0);
    one.push(DVec3::X, DVec3::Y, 1.0, 0.0);
    let copies = Copies { room: [DVec3::new(-4.0, -4.0, 0.0), DVec3::new(4.0, 4.0, 0.0)], ..copies(500, 1) };
    for lattice in [true, false] {
        let all =
            Copies { lattice, temperature: if lattice { 0.7 } else { 0.0 }, ..copies.clone() }.of(&one, &bounds(2));
        let all = all.expect("copies");
        assert!(all.position().iter().chain(all.velocity()).all(|x| x.z == 0.0));
        let mean = all.position().chunks(2).map(|x| x[1] - x[0]).sum::<DVec3>() / 500.0;
        assert!(mean.length() < 5.0 / 500f64.sqrt() && (all.position()[1] - all.position()[0]).length() > 0.999);
    }
}

/// The least distance of particles of two copies.
fn nearest(state: &State, bounds: &Bounds) -> f64 {
    let x = state.position();
    let pairs = (0..x.len()).flat_map(|i| (0..i).map(move |j| (i, j))).filter(|(i, j)| i / 3 != j / 3);
    pairs.map(|(i, j)| bounds.shortest(x[i] - x[j]).length()).fold(f64::INFINITY, f64::min)
}

/// Over seams, too, with cells of any number along a side; and the number of those that find a place is what there is room for.
#[test]
fn copies_keep_their_distance() {
    for (seed, separation, count) in [(1, 0.9, 100), (2, 0.5, 250), (3, 3.0, 6), (4, 4.1, 2)] {
        // The centres of two cells are 4 apart.
        for lattice in [false, true].into_iter().filter(|lattice| !(*lattice && separation > 4.0)) {
            let all = Copies { separation, lattice, ..copies(count, seed) }.of(&molecule(), &bounds(3));
            let all = all.unwrap_or_else(|why| panic!("{seed}, {lattice}: {why}"));
            let least = nearest(&all, &bounds(3));
            assert!(least >= separation && least < 1.6 * separation, "{seed}, {lattice}: {least}");
        }
    }
    // Without it they overlap.
    assert!(nearest(&copies(250, 2).of(&molecule(), &bounds(3)).expect("copies"), &bounds(3)) < 0.3);
    // In open space, and where sides are walls, there are no seams.
    let open = Bounds::default();
    let all = Copies { separation: 0.9, ..copies(100, 1) }.of(&molecule(), &open).expect("copies");
    assert!(nearest(&all, &open) >= 0.9);
}

/// Through a mirror no particle reaches, though centres are near it.
#[test]
fn copies_stay_inside_of_mirrors() {
    let inside = DVec3::splat(1.2);
    let room = Bounds::new(-inside, inside, Side::Reflecting);
    let all = Copies { room: [-inside, inside], ..copies(500, 1) }.of(&molecule(), &room).expect("copies");
    assert!(all.position().iter().all(|x| x.abs().max_element() <= 1.2));
    assert!((0..500).any(|copy| center(&all, copy).abs().max_element() > 1.0));
    let open =
        Copies { room: [-inside, inside], ..copies(500, 1) }.of(&molecule(), &Bounds::default()).expect("copies");
    assert!(open.position().iter().any(|x| x.abs().max_element() > 1.3));
}

#[test]
fn lattices_have_a_place_for_each() {
    let room = [DVec3::ZERO, DVec3::new(8.0, 4.0, 2.0)];
    let all = Copies { room, lattice: true, ..copies(64, 1) }.of(&molecule(), &bounds(3)).expect("copies");
    let centers: Vec<_> = (0..64).map(|copy| center(&all, copy)).collect();
    // Cubes of edge 1, x fastest.
    for (n, place) in centers.iter().enumerate() {
        let want = DVec3::new((n % 8) as f64, (n / 8 % 4) as f64, (n / 32) as f64) + 0.5;
        assert!((*place - want).length() < 1e-12, "{n}: {place} is not {want}");
    }
}

/// 2 K = (3 N − 3) k T to rounding, no momentum, and light particles as warm as heavy ones: of 3 n squares of normal numbers the standard error is
/// √(2 / 3 n); 5 of them.
#[test]
fn copies_have_a_temperature() {
    let mut still = molecule();
    still.velocity_mut()[1] = DVec3::ZERO;
    for seed in [1, 2] {
        let all = Copies { temperature: 1.7, ..copies(2000, seed) }.of(&still, &bounds(3)).expect("copies");
        let twice = |id: usize| all.mass()[id] * all.velocity()[id].length_squared();
        let total: f64 = (0..all.len()).map(twice).sum();
        assert!((total / (3.0 * all.len() as f64 - 3.0) - 1.7).abs() < 1e-12);
        let momentum: DVec3 = all.velocity().iter().zip(all.mass()).map(|(v, m)| *v * *m).sum();
        assert!((momentum / all.mass().iter().sum::<f64>()).length() < 1e-12, "{momentum}");
        for place in 0..3 {
            let mean = (place..all.len()).step_by(3).map(twice).sum::<f64>() / 2000.0 / 3.0;
            assert!((mean / 1.7 - 1.0).abs() < 5.0 * (2.0f64 / 6000.0).sqrt(), "{seed}, {place}: {mean}");
        }
    }
}

#[test]
fn copies_that_cannot_be() {
    let error = |copies: Copies, one: &State| copies.of(one, &bounds(3)).expect_err("refused").to_string();
    let crowded = error(Copies { separation: 2.0, ..copies(400, 1) }, &molecule());
    assert!(crowded.contains("of 400 found no place with 2 to the particles of others"), "{crowded}");
    assert!(crowded.contains("arrangement = \"lattice\""), "{crowded}");
    let mut light = molecule();
    light.mass_mut()[1] = 0.0;
    let massless = error(Copies { temperature: 1.0, ..copies(3, 1) }, &light);
    assert!(massless.contains("particle 1 has no mass, so it has no temperature"), "{massless}");
    for room in [[DVec3::ONE, DVec3::ZERO], [DVec3::ZERO, DVec3::splat(f64::INFINITY)]] {
        assert!(error(Copies { room, ..copies(3, 1) }, &molecule()).contains("give one or more, and finite corners"));
    }
    assert!(error(copies(0, 1), &molecule()).contains("0 copies"));
}
