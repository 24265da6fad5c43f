//! Sizes that no test can run: what is planned for them is arithmetic.

use glam::DVec3;
use motes::forces::{Component, Over, Problem};
use motes::kernel::Machine;
use motes::neighbors::{Cells, Grid};
use motes::{Bounds, Error, Gpu, Side};

use crate::neighbors::exact::{Whole, by_force};
use crate::support::{self, Random};

const SIDES: [Side; 3] = [Side::Open, Side::Periodic, Side::Reflecting];
const COUNTS: [u32; 9] = [1, 2, 31, 33, 1000, 1 << 20, (1 << 23) + 1, u32::MAX / 2, u32::MAX];
const LENGTHS: [f64; 7] = [0.0, 1e-30, 1e-10, 1.0, 1e10, 1e30, 3e38];

fn problems() -> impl Iterator<Item = Problem> {
    let machine = Machine { software: false, subgroup: 0, invocations: 1 << 18, ..Machine::HOST };
    let shapes = LENGTHS.into_iter().flat_map(|a| LENGTHS.map(|b| DVec3::new(a, b, 1.0)));
    shapes.flat_map(move |size| {
        SIDES.into_iter().flat_map(move |side| {
            [DVec3::ZERO, -size, DVec3::splat(-1e9)].into_iter().flat_map(move |low| {
                let bounds = Bounds { low, high: low + size, sides: [side, Side::Open, side], dimensions: 3 };
                let positions = [low, low + size];
                COUNTS.into_iter().map(move |count| Problem::new(count, machine).at(&positions, bounds))
            })
        })
    })
}

/// What a device can index, bind and count.
fn sound(grid: &Grid, problem: &Problem) {
    let [x, y, z] = grid.cells.map(u64::from);
    let fits = |(n, fine): (u64, u32)| (1..=8192 * u64::from(fine)).contains(&n);
    assert!([x, y, z].into_iter().zip(grid.fine).all(fits), "{grid:?} for {problem:?}");
    assert!(x * y * z <= 1 << 24, "{grid:?} for {problem:?}");
    assert_eq!(u64::from(grid.count()), x * y * z);
    assert!((grid.count() + 1) * 4 <= 128 << 20);
    let ends = grid.per_cell.as_vec3().to_array().into_iter().chain(grid.low.as_vec3().to_array());
    assert!(ends.clone().all(f32::is_finite), "{grid:?} for {problem:?}");
    assert!(grid.per_cell.as_vec3().min_element() >= f32::MIN_POSITIVE, "{grid:?} for {problem:?}");
    let candidates = grid.candidates(problem);
    assert!(candidates >= 1.0 && candidates <= f64::from(problem.capacity), "{candidates} for {problem:?}");
}

#[test]
fn every_grid_can_be_indexed_and_bound() {
    let mut grids = 0;
    for problem in problems() {
        for range in [1.2e-19, 1e-10, 1.0, 1e10, 1.7e19] {
            sound(&Grid::new(range, None, &problem).expect("a grid"), &problem);
        }
        for occupancy in [1.0 / 3.0, 16.0 / 3.0] {
            sound(&Grid::sparse(occupancy, &problem), &problem);
        }
        grids += 7;
    }
    assert!(grids > 20_000);
}

#[test]
fn every_target_is_in_one_dispatch() {
    let machine = Machine { software: false, subgroup: 0, invocations: 1 << 18, ..Machine::HOST };
    for count in [1, 1 << 20, (1 << 20) + 1, (1 << 23) + 77, u32::MAX / 2, u32::MAX] {
        let law = Whole(Over::Near { range: 0.1, of: None }).laws().remove(0);
        let kernel = law.kernel(&Problem::new(count, machine)).expect("a kernel");
        let mut next = 0_u64;
        for pass in &kernel.passes {
            let (_, block) = pass.uniforms.iter().find(|(name, _)| *name == "grid").expect("a grid");
            let grid = pass.shader.reflection().binding("grid").expect("a grid");
            let word = |name: &str| u64::from(grid.packed.uint(block, name));
            let (first, end) = (word("first"), word("end"));
            assert_eq!((first, u64::from(pass.threads.count)), (next, end - first));
            assert!(end > first && end - first <= 1 << 20);
            next = end;
        }
        assert_eq!(next, u64::from(count));
    }
}

#[test]
fn what_does_not_fit_is_said_with_the_most_that_does() {
    use motes::kernel::{Backend, Plan};
    let shared = support::device();
    let few = |limits: &mut motes::wgpu::Limits| limits.max_storage_buffer_binding_size = 1 << 20;
    let (device, queue) = pollster::block_on(support::limited(&shared, few));
    let count = (1 << 16) + 1;
    let mut gpu = Gpu::new(&device, &queue, count).expect("a GPU");
    let grid = Grid::new(0.1, None, &Problem::new(count, gpu.machine())).expect("a grid");
    let kernel = grid.kernel(&Problem::new(count, gpu.machine()), false).expect("a kernel");
    let result = gpu.compile(&Plan::of([kernel]));
    let Err(Error::Limit(text)) = result.map(|_| ()) else { panic!("more than fits fits") };
    assert!(text.contains("65537 particles need") && text.contains("at most 65536 particles fit"), "{text}");
}

#[test]
fn the_hosts_cells_take_anything() {
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300];
    for x in bad {
        let positions = [DVec3::ZERO, DVec3::splat(x), DVec3::new(0.1, x, 0.0), DVec3::X * 0.2];
        for bounds in [Bounds::default(), Bounds::new(DVec3::ZERO, DVec3::ONE, Side::Periodic)] {
            let cells = Cells::new(&positions, bounds, 0.3).expect("cells");
            let mut met = Vec::new();
            cells.around(0, |j| met.push(j));
            assert_eq!(met, [3], "{x}, {bounds}");
            assert!(cells.candidates() <= 4.0);
        }
    }
    assert!(Cells::new(&[], Bounds::default(), 0.3).is_ok_and(|cells| cells.candidates() <= 0.0));
    assert!(Cells::new(&[DVec3::ZERO], Bounds::default(), f64::NAN).is_err());
}

#[test]
fn the_hosts_cells_find_all_however_far() {
    for far in [0.0, 9000.0, 3e6, 1e7] {
        let mut random = Random::new(3);
        let place = |x: DVec3| (far + 2.0 * x).as_vec3().as_dvec3();
        let mut positions: Vec<_> = (0..300).map(|_| place(random.vector())).collect();
        positions.push(DVec3::ZERO);
        let want = by_force(&positions, &Bounds::default(), 1.0);
        let cells = Cells::new(&positions, Bounds::default(), 1.0).expect("cells");
        for (i, want) in want.iter().enumerate() {
            let mut met = 0.0;
            cells.around(i, |_| met += 1.0);
            assert!((met - want.x).abs() < 0.5, "{far}: {i} meets {met} for {}", want.x);
        }
    }
}
