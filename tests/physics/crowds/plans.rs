//! Floor plans: outlines, walls, cells and ways against distances that are known.

use glam::DVec2;
use motes::crowds::EXIT_DISTANCE;
use motes::floor_plan::{Exit, FloorPlan, Polygon};
use motes::{Cpu, Gpu, Setup, Simulation};

use super::{PERSON, Person, setup, state};
use crate::matter::on_cpu;
use crate::support::states::force;

pub fn outline(points: &[[f64; 2]]) -> Vec<DVec2> {
    points.iter().copied().map(DVec2::from_array).collect()
}

pub fn exit(path: &[[f64; 2]], reach: f64) -> Exit {
    Exit { name: "door".to_owned(), path: outline(path), reach }
}

/// A plan of one polygon.
pub fn plan(points: &[[f64; 2]], exits: Vec<Exit>, cell: f64) -> Result<FloorPlan, String> {
    FloorPlan::new(&[Polygon { outline: outline(points), holes: Vec::new() }], exits, cell)
}

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];

/// A pedestrian on a plan that walks to its exits.
fn walker(plan: FloorPlan, at: DVec2) -> Setup {
    let people = state(&[Person { position: at.extend(0.0), ..PERSON }]).on_floor(plan);
    setup(people, vec![force("navigate", &[])], 1e-3)
}

/// The distances of all cells to exits.
fn distances(plan: &FloorPlan, at: DVec2) -> Vec<f64> {
    let mut simulation: Simulation<Cpu> = on_cpu(&walker(plan.clone(), at));
    simulation.step(1).expect("a step");
    let state = pollster::block_on(simulation.snapshot()).expect("a state");
    let distances = state.scalar(EXIT_DISTANCE.name).expect("distances").to_vec();
    assert_eq!(distances.len(), plan.cells().open.len());
    distances
}

/// The largest error of the distance to an exit, over cells that `known` gives a distance for.
fn worst(plan: &FloorPlan, at: DVec2, known: impl Fn(DVec2) -> Option<f64>) -> f64 {
    let (cells, found) = (plan.cells(), distances(plan, at));
    let nx = cells.count[0];
    let error = |(k, found): (usize, &f64)| {
        let centre = cells.centre(k % nx, k / nx);
        let want = known(centre).filter(|_| plan.holds(centre))?;
        Some((found - want).abs())
    };
    found.iter().enumerate().filter_map(error).fold(0.0, f64::max)
}

/// From a point-like exit in a square: the upwind scheme errs by h log(1 / h), so that half of h has 0.62 and then 0.6 of the error for distances of 8.
#[test]
fn distances_from_a_point_converge() {
    let end = DVec2::new(4.003, 5.511);
    let error = |cell: f64| {
        let plan = plan(&SQUARE, vec![exit(&[[4.0, 5.511], [4.006, 5.511]], 0.001)], cell).expect("a plan");
        worst(&plan, DVec2::new(1.0, 1.0), |x| Some(((x - end).length() - 0.001).max(0.0)))
    };
    let errors = [0.4, 0.2, 0.1].map(error);
    assert!(errors[0] < 0.4 && errors[1] < 0.72 * errors[0] && errors[2] < 0.66 * errors[1], "{errors:?}");
}

/// Round the end of a wall of no more than a thousandth: the way bends at the corner, |x − c| + |c − exit|, and no distance leaks through it.
#[test]
fn ways_go_round_corners_and_never_through_walls() {
    let thin =
        [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [5.001, 10.0], [5.001, 3.0], [5.0, 3.0], [5.0, 10.0], [0.0, 10.0]];
    let (corner, end) = (DVec2::new(5.0005, 3.0), DVec2::new(8.0, 8.0));
    let known = |x: DVec2| {
        let straight = x.x > 5.001 || (end - x).perp_dot(corner - x) > 0.0;
        let bent = (x - corner).length() + (corner - end).length();
        Some((if straight { (x - end).length() } else { bent } - 0.05).max(0.0))
    };
    let error = |cell: f64| {
        let plan = plan(&thin, vec![exit(&[[7.999, 8.0], [8.001, 8.0]], 0.05)], cell).expect("a plan");
        worst(&plan, DVec2::new(1.0, 1.0), known)
    };
    let errors = [0.2, 0.1, 0.05].map(error);
    // Behind the wall at the height of the exit a leak would shorten the way by 8 m.
    assert!(errors[0] < 0.75 && errors[1] < 0.7 * errors[0] && errors[2] < 0.7 * errors[1], "{errors:?}");
    // With the wall closed there is no way at all.
    let closed = FloorPlan::new(
        &[
            Polygon { outline: outline(&[[0.0, 0.0], [5.0, 0.0], [5.0, 10.0], [0.0, 10.0]]), holes: Vec::new() },
            Polygon { outline: outline(&[[5.001, 0.0], [10.0, 0.0], [10.0, 10.0], [5.001, 10.0]]), holes: Vec::new() },
        ],
        vec![exit(&[[8.0, 8.0], [8.0, 9.0]], 0.05)],
        0.1,
    );
    let closed = closed.expect("two rooms");
    let (cells, found) = (closed.cells(), distances(&closed, DVec2::new(9.0, 1.0)));
    let nx = cells.count[0];
    let left: Vec<f64> = (0..found.len())
        .filter(|k| cells.is_floor(*k) && cells.centre(k % nx, k / nx).x < 5.0)
        .map(|k| found[k])
        .collect();
    assert!(left.len() > 4000 && left.iter().all(|far| *far >= 1e9));
    let lost = walker(closed, DVec2::new(1.0, 1.0));
    let why = pollster::block_on(motes::diagnose::diagnose(&lost)).expect_err("no way").to_string();
    assert!(why.contains("1 particles have no way to an exit") && why.contains("at 1 1"), "{why}");
}

/// Between two exits distances are equal on the bisector, and either way is the shorter one on its side; pedestrians are led to the nearer one.
#[test]
fn two_exits_divide_a_room_evenly() {
    let exits = || vec![exit(&[[1.0, 4.0], [1.0, 6.0]], 0.2), exit(&[[9.0, 4.0], [9.0, 6.0]], 0.2)];
    let plan = plan(&SQUARE, exits(), 0.1).expect("a plan");
    let nearest = |x: DVec2| exits().iter().map(|exit| exit.distance(x) - 0.2).fold(f64::INFINITY, f64::min).max(0.0);
    let error = worst(&plan, DVec2::new(5.0, 1.0), |x| Some(nearest(x)));
    assert!(error < 0.15, "{error}");
    for (x, sign) in [(4.7, -1.0), (5.3, 1.0), (3.0, -1.0), (7.0, 1.0)] {
        for y in [2.0, 5.0, 8.0] {
            let mut simulation = on_cpu(&walker(plan.clone(), DVec2::new(x, y)));
            simulation.step(300).expect("steps");
            let end = pollster::block_on(simulation.snapshot()).expect("a state");
            assert!((end.position()[0].x - x) * sign > 0.05, "from {x} {y}: {}", end.position()[0]);
        }
    }
}

/// The device finds the same distances: to 1e-5 of the largest.
#[test]
fn the_device_finds_the_same_distances() {
    let bend = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [7.0, 10.0], [7.0, 3.0], [5.0, 3.0], [5.0, 10.0], [0.0, 10.0]];
    let plan = plan(&bend, vec![exit(&[[8.0, 9.0], [9.0, 9.0]], 0.2)], 0.13).expect("a plan");
    let at = DVec2::new(1.0, 9.0);
    let want = distances(&plan, at);
    let shared = crate::support::device();
    let gpu = Gpu::new(&shared.found.device, &shared.found.queue, 1).expect("a GPU");
    let mut simulation = Simulation::on(gpu, &walker(plan.clone(), at)).expect("a simulation");
    simulation.step(1).expect("a step");
    let state = pollster::block_on(simulation.snapshot()).expect("a state");
    let found = state.scalar(EXIT_DISTANCE.name).expect("distances");
    let cells = plan.cells();
    let largest = want.iter().copied().filter(|far| *far < 1e9).fold(0.0, f64::max);
    assert!(largest > 15.0 && found.len() == cells.open.len(), "{largest}");
    for (found, want) in found.iter().zip(&want) {
        let apart = (found - want).abs();
        assert!(apart < 1e-5 * largest || *found >= 1e9 && *want >= 1e9, "{found} is not {want}");
    }
    // Settled: another sweep would change none, neither of the device nor of the reference.
    for k in (0..want.len()).filter(|k| cells.is_floor(*k) && want[*k] < 1e9 && cells.known(*k).is_none()) {
        let far = cells.next(k).map(|next| next.map_or(1e9, |next| want[next]));
        let (a, b) = (far[0].min(far[1]), far[2].min(far[3]));
        let apart = (a - b).abs();
        let h = cells.side;
        let again = if apart < h { 0.5 * (a + b + (2.0 * h * h - apart * apart).sqrt()) } else { a.min(b) + h };
        assert!((again - want[k]).abs() < 1e-12, "cell {k}: {again} {}", want[k]);
    }
}

#[test]
fn plans_that_make_no_sense_are_refused_with_the_place() {
    let why = |points: &[[f64; 2]], exits: Vec<Exit>, cell: f64| plan(points, exits, cell).expect_err("no plan");
    assert!(why(&SQUARE[..2], vec![], 0.1).contains("2 different points"));
    assert!(why(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]], vec![], 0.1).contains("no area"));
    assert!(
        why(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.5]], vec![], 0.1).contains("crosses or touches itself at")
    );
    assert!(why(&[[0.0, 0.0], [f64::NAN, 2.0], [2.0, 0.0]], vec![], 0.1).contains("not finite"));
    assert!(why(&SQUARE, vec![exit(&[[11.0, 4.0], [11.0, 6.0]], 0.2)], 0.1).contains("not on the floor at 11 5"));
    assert!(why(&SQUARE, vec![exit(&[[4.0, 4.0], [4.0, 4.0]], 0.2)], 0.1).contains("has no length"));
    assert!(why(&SQUARE, vec![], 1e-4).contains("choose larger cells"));
    let hole = Polygon { outline: outline(&SQUARE), holes: vec![outline(&[[9.0, 1.0], [11.0, 1.0], [10.0, 2.0]])] };
    assert!(FloorPlan::new(&[hole], vec![], 0.1).expect_err("outside").contains("outside of the outline"));
    let on = |at: [f64; 2]| walker(plan(&SQUARE, vec![], 0.5).expect("a plan"), DVec2::from_array(at));
    let why = on([12.0, 3.0]).check().expect_err("off the floor").to_string();
    assert!(
        why.contains("1 particles are on or in a wall, or off the floor") && why.contains("particle 0 at 12 3"),
        "{why}"
    );
    let why = on([10.0, 3.0]).check().expect_err("on a wall").to_string();
    assert!(why.contains("particle 0 at 10 3"), "{why}");
    let none = pollster::block_on(motes::diagnose::diagnose(&on([2.0, 3.0]))).expect_err("no exit").to_string();
    assert!(none.contains("has no exit"), "{none}");
}
