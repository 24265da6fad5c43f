//! The build, kernel by kernel and as a whole.

use glam::{DMat3, DVec3, DVec4, Vec4};
use motes::kernel::{Problem, Threads};
use motes::lockstep::compare;
use motes::primitives::MOST;
use motes::tree::{GROUP, LEAF, Nodes, Opening, Tree};

use crate::support;
use crate::tree::sets::{Built, GEOMETRIC, MACHINES, RELATIVE, awkward, cloud};

const SIZES: [usize; 18] = [1, 2, 3, 4, 5, 8, 9, 16, 17, 31, 32, 33, 63, 64, 65, 127, 1000, 1025];

#[test]
fn each_kernel_agrees_with_its_reference_at_every_size() {
    let shared = support::device();
    for count in SIZES {
        for (machine, opening, core) in [(MACHINES[0], RELATIVE, 0.0), (MACHINES[1], GEOMETRIC, 0.05)] {
            agree(&mut Built::new(&shared, &cloud(count, 2), &cloud(count, 3), opening, core, machine), count);
        }
    }
}

#[test]
fn many_agree_with_the_references() {
    let shared = support::device();
    let count = 65_537;
    agree(&mut Built::new(&shared, &cloud(count, 2), &cloud(count, 3), RELATIVE, 0.01, MACHINES[0]), count);
}

fn agree(built: &mut Built, count: usize) {
    let plan = built.plan.clone();
    let verdicts = pollster::block_on(compare(&mut built.gpu, &plan, count as u32)).expect("a comparison");
    for verdict in &verdicts {
        assert!(verdict.good(), "{count}, {}: {verdict:?}", built.tree.opening);
    }
    for kernel in plan.steps().filter(|_| count > 2) {
        let changed = verdicts.iter().any(|verdict| verdict.kernel == kernel.name && verdict.changed);
        assert!(changed, "{count}: {} changes nothing", kernel.name);
    }
}

/// What a node's bodies are together, summed one by one.
struct Sums {
    mass: f64,
    center: DVec3,
    moments: DMat3,
    low: DVec3,
    high: DVec3,
}

impl Sums {
    fn of(bodies: &[DVec4]) -> Self {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (mut mass, mut first) = (0.0, DVec3::ZERO);
        for b in bodies {
            let x = b.truncate();
            // From the first one on, so that those at one place are there bit for bit.
            let way = b.w * (x - bodies[0].truncate());
            (low, high, mass, first) = (low.min(x), high.max(x), mass + b.w, first + way);
        }
        let center = if mass > 0.0 { bodies[0].truncate() + first / mass } else { low.midpoint(high) };
        let mut moments = DMat3::ZERO;
        for b in bodies {
            let y = b.truncate() - center;
            moments += DMat3::from_cols(b.w * y.x * y, b.w * y.y * y, b.w * y.z * y);
        }
        Self { mass, center, moments, low, high }
    }
}

fn checked(name: &str, built: &mut Built) {
    let (tree, host) = (built.tree.clone(), built.host());
    let nodes = Nodes::of(&tree, &host).expect("a tree");
    let corner = |of: &'static str| host.reading::<Vec4>(&tree.field(of).1).expect("corners");
    let (low, high) = (corner("tree_low"), corner("tree_high"));
    let epsilon = f64::from(f32::EPSILON);
    let mut seen = 0;
    for n in (1..u32::try_from(tree.nodes()).expect("few")).filter(|n| nodes.exists(*n)) {
        let want = Sums::of(&nodes.bodies()[nodes.range(n)]);
        let side = (want.high - want.low).max_element();
        // Bodies are put together one by one in a leaf, then level by level. Each time the mass rounds by half an epsilon
        // of itself, the centre by one and a half of the side it moves along and half a one of itself, and moments by four
        // of M l² and by what d, of which there are two, is wrong by times M l.
        let times = f64::from(LEAF + tree.height() - n.ilog2());
        let place = times * epsilon * (2.0 * side + want.low.abs().max(want.high.abs()).max_element());
        let moment = want.mass * side * (4.0 * times * epsilon * side + 4.0 * times * place);
        let of = format!("{name}: node {n} of {:?}", nodes.range(n));
        assert!((nodes.mass(n) - want.mass).abs() <= times * epsilon * want.mass, "{of}: mass {}", nodes.mass(n));
        assert!(
            (nodes.center(n) - want.center).abs().max_element() <= place,
            "{of}: {} {}",
            nodes.center(n),
            want.center
        );
        let error = (nodes.moments(n) - want.moments).abs().to_cols_array().into_iter().fold(0.0, f64::max);
        assert!(error <= moment, "{of}: moments {} for {}", nodes.moments(n), want.moments);
        let (lowest, highest) = (low[n as usize].truncate(), high[n as usize].truncate());
        assert_eq!((lowest, highest), (want.low, want.high), "{of}");
        assert!((nodes.length(n) - side).abs() <= epsilon * side, "{of}: {} for {side}", nodes.length(n));
        // One side is enough for every place in the box.
        let opened = match tree.opening {
            Opening::Geometric { theta } => side / theta,
            Opening::Relative { .. } => side,
        };
        let offset = want.center.distance(want.low.midpoint(want.high));
        let reach = opened.max(tree.core + side * 0.75_f64.sqrt()) + offset;
        let allowed = 2.0 * place + 4.0 * epsilon * reach;
        assert!((f64::from(nodes.reach(n)) - reach).abs() <= allowed, "{of}: reach {} for {reach}", nodes.reach(n));
        let parent = n as usize / 2;
        let inside = lowest.cmpge(low[parent].truncate()).all() && highest.cmple(high[parent].truncate()).all();
        assert!(n == 1 || inside, "{of}: outside of its parent");
        seen += 1;
    }
    let levels = (0..=tree.height()).map(|above| tree.level(above).1);
    assert_eq!(seen, levels.sum::<u32>(), "{name}");
}

#[test]
fn nodes_are_what_their_bodies_are() {
    let shared = support::device();
    for (machine, count) in [(MACHINES[0], 777), (MACHINES[1], 130)] {
        for (name, bodies) in awkward(count).into_iter().chain([("a cloud", cloud(count, 1))]) {
            let (opening, core) = if machine.software { (GEOMETRIC, 0.0) } else { (RELATIVE, 0.3) };
            checked(name, &mut Built::new(&shared, &bodies, &[], opening, core, machine).run());
        }
    }
    for count in SIZES {
        checked("few", &mut Built::new(&shared, &cloud(count, 8), &[], GEOMETRIC, 0.2, MACHINES[0]).run());
    }
}

#[test]
fn leaves_and_levels_part_the_bodies() {
    for count in SIZES.into_iter().chain([0, 65_537, 1 << 27]) {
        let count = u32::try_from(count).expect("few");
        let tree = Tree { opening: GEOMETRIC, core: 0.0, count, used: count, two_words: false };
        for above in (0..=tree.height()).rev().take(12) {
            let (first, nodes) = tree.level(above);
            let mut next = 0;
            for n in first..first + nodes {
                let range = tree.range(n);
                assert!(
                    range.start == next && range.len() <= (LEAF << above) as usize && tree.exists(n),
                    "{count}: {n}"
                );
                assert_eq!(tree.is_leaf(n), above == 0, "{count}: {n}");
                next = range.end;
            }
            assert_eq!(next, count as usize, "level {above} over the leaves");
            assert!(nodes == first || !tree.exists(first + nodes), "{count}: {nodes} on level {above}");
            assert!(u64::from(first + nodes) <= tree.nodes());
        }
        assert!(!tree.exists(0) && !tree.exists(u32::try_from(tree.nodes()).expect("below 2³²")), "{count}");
    }
}

/// The weakest of a group decides, and a particle without acceleration leaves it to the other criterion. Where pulls cancel, a part of
/// their sizes is what counts: 64 roundings of half an epsilon. A length of three roots is wrong by four or less, a quotient by
/// two and a half.
#[test]
fn groups_demand_by_their_smallest_acceleration() {
    let shared = support::device();
    let count = 999;
    for (scale, left) in [(1.0, 1.0), (1e-25, 1.0), (1e18, 1.0), (1.0, 0.05), (1e-20, 1e-5)] {
        let scaled = |a: Vec4| (scale * a.as_dvec4()).as_vec4();
        let mut last: Vec<Vec4> = cloud(count, 12).into_iter().map(|a| left as f32 * scaled(a)).collect();
        last[500] = Vec4::ZERO.with_w(1.0);
        last[600].x = 0.0;
        let bodies: Vec<Vec4> = cloud(count, 2).into_iter().map(|b| b.truncate().extend(scaled(b).w)).collect();
        let mut built = Built::new(&shared, &bodies, &last, RELATIVE, 0.0, MACHINES[0]).run();
        let host = built.host();
        let nodes = Nodes::of(&built.tree, &host).expect("a tree");
        let (mut quiet, mut cancelled) = (0, 0);
        for (g, ids) in nodes.ids().chunks(GROUP as usize).enumerate() {
            let sizes = ids.iter().map(|id| last[*id as usize].as_dvec4().truncate().length());
            let least = sizes.fold(f64::INFINITY, f64::min);
            let place = nodes.bodies()[g * GROUP as usize].truncate();
            let pull = |n| nodes.mass(n) / (nodes.center(n).distance_squared(place) + nodes.length(n).powi(2));
            let pulls = 1.3 / 32.0 * (64..128).filter(|n| nodes.exists(*n)).map(pull).sum::<f64>();
            let want = if least > 0.0 { 1.3 / 0.005 / least.max(pulls) } else { 0.0 };
            let error = (nodes.demand(g) - want).abs();
            assert!(error <= 40.0 * f64::from(f32::EPSILON) * want, "{g}: {} for {want}", nodes.demand(g));
            quiet += u32::from(want == 0.0);
            cancelled += u32::from(pulls > least);
        }
        assert_eq!(quiet, 1);
        assert!(if left < 1.0 { cancelled > 3 } else { cancelled < 3 }, "{cancelled} groups whose pulls cancel");
    }
}

const FIELDS: [&str; 7] = ["tree_id", "tree_body", "tree_center", "tree_mass", "tree_shape", "tree_low", "tree_high"];

#[test]
fn runs_give_the_same_bits_and_ids_do_not_matter() {
    let shared = support::device();
    for machine in MACHINES {
        // Of a cusp's middle many are in one cell, each elsewhere: there ids decide the order.
        for (name, bodies) in awkward(777).into_iter().filter(|(name, _)| *name != "in a cusp") {
            let run = |bodies: &[Vec4]| {
                let mut built = Built::new(&shared, bodies, &[], GEOMETRIC, 0.1, machine).run();
                FIELDS.map(|field| built.bytes(field))
            };
            let first = run(&bodies);
            assert!(first == run(&bodies), "{name}: a rerun differs");
            // Particles at one place, of one mass: in any order the sums are the same.
            let turned: Vec<_> = (0..777).map(|i| bodies[i * 100 % 777]).collect();
            let second = run(&turned);
            assert!(first[1..] == second[1..], "{name}: another order differs");
            let ids = bytemuck::pod_collect_to_vec::<u8, u32>(&second[0]);
            let bodies_of = bytemuck::pod_collect_to_vec::<u8, Vec4>(&second[1]);
            assert!(ids.iter().zip(&bodies_of).all(|(id, b)| turned[*id as usize] == *b), "{name}");
            assert!(name == "at one place" || first[0] != second[0], "{name}: the order is no other one");
        }
    }
}

/// What no device here holds can still be planned.
#[test]
fn plans_for_none_and_for_the_most() {
    for machine in MACHINES {
        for count in [0, 1, MOST] {
            let problem = Problem::new(count, machine);
            let kernels = Tree::new(RELATIVE, 0.0, &problem).kernels(&problem).expect("kernels");
            let passes = kernels.iter().flat_map(|kernel| &kernel.passes);
            assert!(passes.clone().all(|pass| u64::from(pass.threads.count) < 1 << 28), "{count}");
            let levels = kernels.iter().find(|kernel| kernel.name.starts_with("nodes")).expect("nodes");
            let threads: Vec<_> = levels.passes.iter().map(|pass| pass.threads).collect();
            match count {
                0 => assert_eq!(threads, [Threads::new(0)]),
                1 => assert_eq!(threads, [Threads::new(1)]),
                _ => assert!(threads.iter().rev().map(|t| t.count).eq((0..26).map(|level| 1 << level)), "{threads:?}"),
            }
        }
        let problem = Problem::new(MOST + 1, machine);
        assert!(Tree::new(RELATIVE, 0.0, &problem).kernels(&problem).is_err());
    }
}

#[test]
fn trees_side_by_side_do_not_meet() {
    let shared = support::device();
    let count = 300;
    let mut built = Built::new(&shared, &cloud(count, 2), &cloud(count, 3), GEOMETRIC, 0.0, MACHINES[0]);
    let problem = Problem::new(count as u32, MACHINES[0]);
    let other = Tree::new(RELATIVE, 0.2, &problem);
    other.kernels(&problem).expect("kernels").into_iter().for_each(|kernel| built.plan.add(kernel));
    let mut built = built.run();
    checked("first", &mut built);
    built.tree = other;
    checked("second", &mut built);
}
