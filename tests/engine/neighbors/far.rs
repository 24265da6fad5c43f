//! Where a grid is folded, and where its own arithmetic is coarse.

use glam::{DVec3, Vec4};
use motes::forces::Over;
use motes::kernel::Machine;
use motes::{ACCELERATION, Bounds, POSITION, SPECIES};

use crate::neighbors::exact::{by_force, by_sort, found, same, simulation};
use crate::neighbors::variants;
use crate::support::{self, Random, Shared, machines};

fn cloud(count: usize, low: DVec3, high: DVec3, seed: u64) -> Vec<DVec3> {
    let mut random = Random::new(seed);
    let place = |x: DVec3| (low + (high - low) * (0.5 + 0.5 * x)).as_vec3().as_dvec3();
    (0..count).map(|_| place(random.vector())).collect()
}

/// What is found after particles moved from where the grid was made for.
fn moved(
    shared: &Shared,
    machine: Option<Machine>,
    from: &[DVec3],
    to: &[DVec3],
    over: Over,
    species: Option<&[u32]>,
) -> Vec<Vec4> {
    let mut gpu = machines::gpu(shared, from.len());
    if let Some(machine) = machine {
        gpu.pretend(machine);
    }
    let mut simulation = simulation(gpu, from, Bounds::default(), over);
    let places: Vec<Vec4> = to.iter().map(|x| x.extend(1.0).as_vec4()).collect();
    simulation.write(POSITION, &places).expect("places");
    if let Some(species) = species {
        simulation.write(SPECIES, species).expect("species");
    }
    simulation.step(0).expect("a start");
    pollster::block_on(simulation.check()).expect("no alarm");
    pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations")
}

#[test]
fn a_stray_far_below_hides_no_neighbours() {
    let shared = support::device();
    for far in [1e4, 1e6, 1e7, 1e8, 1e9, 1e12, 1e30] {
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            // Close to where a distance from the stray is rounded up rather than down.
            let center = axis * if far > 5e8 { 32.0 } else { 4.0 };
            let mut positions = cloud(300, center - 1.5, center + 1.5, 7);
            positions.push(-far * axis);
            let want = by_force(&positions, &Bounds::default(), 1.0);
            assert!(want.iter().filter(|met| met.x > 0.0).count() > 250);
            for (name, machine) in variants(&shared) {
                let over = Over::Near { range: 1.0, of: None };
                let near = found(&shared, Some(machine), &positions, Bounds::default(), over);
                same(&near, &want, &format!("{far}, {axis}, {name}"));
            }
        }
    }
}

#[test]
fn a_stray_from_a_thin_sheet_meets_each_once() {
    let shared = support::device();
    for thin in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(1.0, 1.0, 0.0)] {
        let sheet = cloud(300, DVec3::ZERO, DVec3::ONE - thin + DVec3::splat(6.0) * (DVec3::ONE - thin), 7);
        for far in [9000.0, 3e6] {
            let away: Vec<DVec3> = cloud(300, DVec3::splat(far), DVec3::splat(far + 3.0), 9);
            let want = by_force(&away, &Bounds::default(), 1.0);
            for (name, machine) in variants(&shared) {
                let over = Over::Near { range: 1.0, of: None };
                let near = moved(&shared, Some(machine), &sheet, &away, over, None);
                same(&near, &want, &format!("{thin}, {far}, {name}"));
            }
        }
    }
}

#[test]
fn lanes_that_walk_together_go_no_further_than_once_round() {
    let shared = support::device();
    // As many cells along x as particles that walk together may look at, and some less and more. Those of eight ids stand in
    // one row, the first of them in the middle.
    for cells in [6, 7, 8, 9, 10_u32] {
        let row = [3, 0, 6, 1, 5, 2, 4, cells - 1];
        let mut random = Random::new(8);
        let mut place = |i: u32| {
            let cell = DVec3::new(f64::from(row[i as usize % 8]), f64::from(i / 8 % 5), f64::from(i / 40));
            ((cell + 0.5 + 0.4 * random.vector()) * (1.0 + 1.0 / 512.0)).as_vec3().as_dvec3()
        };
        let mut positions: Vec<_> = (0..200).map(&mut place).collect();
        positions[0] = DVec3::ZERO;
        let want = by_force(&positions, &Bounds::default(), 1.0);
        let species = vec![3; positions.len()];
        for (name, machine) in variants(&shared) {
            let over = Over::Near { range: 1.0, of: Some(3) };
            let near = moved(&shared, Some(machine), &positions, &positions, over, Some(&species));
            same(&near, &want, &format!("{cells} cells, {name}"));
        }
    }
}

#[test]
fn the_nearest_in_long_and_flat_boxes_and_of_strays() {
    let shared = support::device();
    for size in [DVec3::new(300.0, 2.0, 1.0), DVec3::new(1.0, 300.0, 2.0), DVec3::new(40.0, 3.0, 40.0)] {
        let mut positions = cloud(150, DVec3::ZERO, size * 0.02, 3);
        positions.extend(cloud(150, DVec3::ZERO, size, 4));
        positions.extend([size * 3.0, -size]);
        for count in [3, 7, 16] {
            let want = by_sort(&positions, &Bounds::default(), count);
            let over = Over::Nearest { count: u32::try_from(count).expect("few") };
            same(&found(&shared, None, &positions, Bounds::default(), over), &want, &format!("{size}, {count}"));
        }
    }
}

#[test]
fn fewer_than_asked_for_are_all_met() {
    let shared = support::device();
    for count in [1, 2, 3, 8, 16, 17] {
        let positions = cloud(count, DVec3::ZERO, DVec3::ONE, 6);
        for bounds in [Bounds::default(), Bounds::new(DVec3::ZERO, DVec3::ONE, motes::Side::Periodic)] {
            let want = by_sort(&positions, &bounds, 16);
            assert!(want.iter().all(|met| (f64::from(met.x) - (count.min(17) - 1) as f64).abs() < 0.5));
            same(&found(&shared, None, &positions, bounds, Over::Nearest { count: 16 }), &want, "few");
        }
    }
}
