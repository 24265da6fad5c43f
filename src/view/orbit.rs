//! Movements of a camera.

use glam::{DQuat, DVec3};

use crate::render::Camera;

/// How near to the poles a camera may come \[radians\].
const POLE: f64 = 0.02;
/// From the eye to the centre, in half heights of the picture: as automatic cameras have it.
const DISTANCE: f64 = 1.0 / 0.268;

/// Turned about its centre: about the z axis, and up or down, but never over a pole.
#[must_use]
pub fn turned(camera: Camera, across: f64, up: f64) -> Camera {
    let height = camera.back.z.clamp(-1.0, 1.0).asin();
    let upright = camera.up.z.abs() > 1e-6 || camera.back.z.abs() > 1.0 - 1e-9;
    // A camera that lies on its side turns about its own axes.
    let axis = if upright { DVec3::Z } else { camera.up };
    let limit = std::f64::consts::FRAC_PI_2 - POLE;
    let up = if upright { (height + up).clamp(-limit, limit) - height } else { up };
    let turn = DQuat::from_axis_angle(axis, -across) * DQuat::from_axis_angle(camera.right, -up);
    let back = (turn * camera.back).normalize();
    let right = (turn * camera.right).normalize();
    Camera { back, right, up: back.cross(right), ..camera }
}

/// Shifted across and up, in half heights of the picture: what is seen moves with the pointer.
#[must_use]
pub fn shifted(camera: Camera, across: f64, up: f64) -> Camera {
    Camera { center: camera.center - camera.extent * (across * camera.right + up * camera.up), ..camera }
}

/// Closer by a factor below 1, so that what is seen at a place stays there.
#[must_use]
pub fn zoomed(camera: Camera, factor: f64, across: f64, up: f64) -> Camera {
    let at = camera.extent * (across * camera.right + up * camera.up);
    let closer = camera.wider(factor);
    Camera { center: camera.center + (1.0 - factor) * at, ..closer }
}

/// Turned about the eye, which stays where it is.
#[must_use]
pub fn looked(camera: Camera, across: f64, up: f64) -> Camera {
    let eye = camera.center + camera.distance * camera.back;
    let turned = turned(camera, across, up);
    Camera { center: eye - turned.distance * turned.back, ..turned }
}

/// Moved with its eye to the right, up and forwards, in half heights of the picture. With parallel rays, which show the same from wherever along
/// them, it comes closer instead.
#[must_use]
pub fn flown(camera: Camera, right: f64, up: f64, forward: f64) -> Camera {
    let ahead = if camera.distance > 0.0 { forward } else { 0.0 };
    let way = right * camera.right + up * camera.up - ahead * camera.back;
    let moved = Camera { center: camera.center + camera.extent * way, ..camera };
    if camera.distance > 0.0 { moved } else { moved.wider((-forward).exp()) }
}

/// From a direction.
#[must_use]
pub fn from(camera: Camera, back: DVec3, up: DVec3) -> Camera {
    let right = up.cross(back).normalize();
    Camera { back, right, up: back.cross(right), ..camera }
}

/// Perspective for parallel rays, and back.
#[must_use]
pub fn other_projection(camera: Camera) -> Camera {
    let distance = if camera.distance > 0.0 { 0.0 } else { camera.extent * DISTANCE };
    Camera { distance, ..camera }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        let back = DVec3::new(0.35, -1.0, 0.7).normalize();
        let right = DVec3::Z.cross(back).normalize();
        let center = DVec3::new(3.0, -2.0, 1.0);
        Camera { center, back, right, up: back.cross(right), extent: 2.0, distance: 2.0 * DISTANCE }
    }
    fn upright(camera: &Camera) {
        for (a, b) in [(camera.back, camera.right), (camera.back, camera.up), (camera.right, camera.up)] {
            assert!(a.dot(b).abs() < 1e-9, "{camera:?}");
        }
        assert!((camera.up - camera.back.cross(camera.right)).length() < 1e-9);
    }

    #[test]
    fn a_camera_turns_about_its_centre_and_stays_upright() {
        let mut camera = camera();
        for step in 0..400 {
            camera = turned(camera, 0.1, if step < 200 { 0.05 } else { -0.05 });
            upright(&camera);
            assert!(camera.up.z > 0.0 && camera.right.z.abs() < 1e-6, "upside down: {camera:?}");
        }
        assert_eq!(camera.center, DVec3::new(3.0, -2.0, 1.0));
        assert!((turned(camera, 0.3, 0.0).back.z - camera.back.z).abs() < 1e-12, "across is not up");
    }
    #[test]
    fn the_place_under_the_pointer_stays_when_one_zooms() {
        let from = camera();
        let parallel = other_projection(from);
        let place = |camera: &Camera, x: DVec3| {
            let r = x - camera.center;
            (r.dot(camera.right) / camera.extent, r.dot(camera.up) / camera.extent)
        };
        let x = parallel.center + parallel.extent * (0.5 * parallel.right - 0.25 * parallel.up);
        let closer = zoomed(parallel, 0.5, 0.5, -0.25);
        let (across, up) = place(&closer, x);
        assert!((across - 0.5).abs() < 1e-12 && (up + 0.25).abs() < 1e-12, "{across} {up}");
        assert!((closer.extent - 1.0).abs() < 1e-12);
        assert!((other_projection(parallel).distance - from.distance).abs() < 1e-12);
        let (across, up) = place(&shifted(parallel, 0.2, 0.1), x);
        assert!((across - 0.7).abs() < 1e-12 && (up + 0.15).abs() < 1e-12);
    }
    #[test]
    fn a_camera_flies_where_it_looks_and_turns_about_its_eye() {
        let from = camera();
        let eye = |camera: &Camera| camera.center + camera.distance * camera.back;
        let flown = super::flown(from, 0.0, 0.0, 1.5);
        assert!((eye(&flown) - eye(&from) + 3.0 * from.back).length() < 1e-9, "{flown:?}");
        assert_eq!((flown.back, flown.extent), (from.back, from.extent));
        let looked = looked(flown, 0.4, -0.2);
        upright(&looked);
        assert!((eye(&looked) - eye(&flown)).length() < 1e-9 && looked.back.dot(flown.back) < 0.95);
        let parallel = other_projection(from);
        let closer = super::flown(parallel, 0.5, 0.0, 1.0);
        assert!((closer.extent - parallel.extent * (-1.0f64).exp()).abs() < 1e-12);
        assert!((closer.center - parallel.center - parallel.right).length() < 1e-9);
    }
    #[test]
    fn six_views_are_along_axes() {
        for (back, up) in [(DVec3::X, DVec3::Z), (DVec3::NEG_Y, DVec3::Z), (DVec3::Z, DVec3::Y)] {
            let camera = from(camera(), back, up);
            upright(&camera);
            assert_eq!((camera.back, camera.up), (back, up));
        }
    }
}
