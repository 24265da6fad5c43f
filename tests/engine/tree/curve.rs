//! Keys: the curve, and the order that it brings bodies into.

use glam::{IVec3, Vec4};
use motes::kernel::Backend;
use motes::tree::hilbert;

use crate::support;
use crate::tree::sets::{Built, GEOMETRIC, MACHINES, awkward, cloud};

/// Cells along each axis of the small cube.
const SIDE: i32 = 8;
/// Cells along each axis of the whole.
const LAST: u32 = (1 << 21) - 1;

fn cells() -> impl Iterator<Item = IVec3> {
    (0..SIDE.pow(3)).map(|k| IVec3::new(k % SIDE, k / SIDE % SIDE, k / SIDE / SIDE))
}

/// Whether each lies beside the one before it.
fn touches(path: &[IVec3]) -> bool {
    path.windows(2).all(|pair| (pair[0] - pair[1]).abs().element_sum() == 1)
}

#[test]
fn the_curve_visits_every_cell_once_and_goes_to_a_neighbour() {
    // A corner of the whole, where the curve begins, and one where it ends.
    for (corner, first) in [([0, 0, 0], 0), ([LAST - 7, 0, 0], (1 << 63) - 512)] {
        let place = |c: IVec3| hilbert([0, 1, 2].map(|axis| corner[axis] + c[axis].unsigned_abs()));
        let mut path: Vec<_> = cells().map(|c| (place(c), c)).collect();
        path.sort_unstable_by_key(|(key, _)| *key);
        let keys = path.iter().map(|(key, _)| *key);
        assert!(keys.eq(first..first + 512), "the small cube is no piece of the curve");
        assert!(touches(&path.iter().map(|(_, c)| *c).collect::<Vec<_>>()));
    }
    // Scattered over the whole, the same path, wider.
    let wide = |c: IVec3| hilbert(c.to_array().map(|x| x.unsigned_abs() << 18));
    let mut path: Vec<_> = cells().collect();
    path.sort_unstable_by_key(|c| wide(*c));
    assert!(touches(&path));
}

#[test]
fn the_device_goes_the_same_way() {
    let shared = support::device();
    let bodies: Vec<Vec4> = cells().map(|c| c.as_vec3().extend(1.0)).collect();
    for machine in MACHINES {
        let mut built = Built::new(&shared, &bodies, &[], GEOMETRIC, 0.0, machine).run();
        let path: Vec<_> = built.read::<Vec4>("tree_body").iter().map(|b| b.truncate().as_ivec3()).collect();
        assert_eq!(path.len(), 512);
        assert!(touches(&path), "{path:?}");
    }
}

/// The keys of bodies in a cube, by the device's arithmetic.
fn keys(bodies: &[Vec4], cube: Vec4) -> Vec<u64> {
    let key = |b: &Vec4| {
        let away = (b.truncate() - cube.truncate()) * cube.w;
        #[expect(clippy::cast_sign_loss, reason = "no body stands below the corner")]
        hilbert(away.to_array().map(|x| (x as u32).min(LAST)))
    };
    bodies.iter().map(key).collect()
}

#[test]
fn bodies_stand_in_the_order_of_their_keys_and_ids() {
    let shared = support::device();
    for machine in MACHINES {
        for (name, bodies) in awkward(777).into_iter().chain([("a cloud", cloud(3000, 1))]) {
            let mut built = Built::new(&shared, &bodies, &[], GEOMETRIC, 0.0, machine).run();
            let cube = built.read::<Vec4>("tree_cube")[0];
            let keys = keys(&bodies, cube);
            let mut want: Vec<u32> = (0..bodies.len() as u32).collect();
            want.sort_by_key(|id| keys[*id as usize]);
            assert_eq!(built.read::<u32>("tree_id"), want, "{name}");
            let carried: Vec<_> = want.iter().map(|id| bodies[*id as usize]).collect();
            assert_eq!(built.read::<Vec4>("tree_body"), carried, "{name}");
            // The greatest key is as far along as there are cells: the cube is no wider than the box.
            let spread = bodies.iter().any(|b| b.truncate() != bodies[0].truncate());
            let low = bodies.iter().map(|b| b.truncate()).reduce(glam::Vec3::min).expect("some");
            let high = bodies.iter().map(|b| b.truncate()).reduce(glam::Vec3::max).expect("some");
            let cells = (high - low).max_element() * cube.w;
            assert!(!spread || (cells - 2_097_152.0).abs() <= 1.0, "{name}: {cells} cells");
        }
    }
}

/// Numbers for which there is no cube give some order, and the same one each time.
#[test]
fn any_number_has_a_place() {
    let shared = support::device();
    let wild = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN, 1e-40, 1e-33, 0.0];
    for x in wild {
        for among in [0.0, 1.0] {
            let mut bodies: Vec<Vec4> =
                cloud(97, 3).into_iter().map(|b| b * Vec4::new(among, among, among, 1.0)).collect();
            bodies[41].y = x;
            let mut built = Built::new(&shared, &bodies, &[], GEOMETRIC, 0.0, MACHINES[0]).run();
            let ids = built.read::<u32>("tree_id");
            let mut all = ids.clone();
            all.sort_unstable();
            assert!(all.iter().copied().eq(0..97), "{x} among {among}: a body is lost");
            let program = built.gpu.compile(&built.plan).expect("a program");
            built.gpu.run(&program, 1).expect("a run");
            assert_eq!(built.read::<u32>("tree_id"), ids, "{x} among {among}");
            let narrow = x.is_finite() && x.abs() < 1e-30 && among == 0.0;
            assert!(!narrow || ids.iter().copied().eq(0..97), "{x}: all are in one cell, and not by their ids");
        }
    }
}
