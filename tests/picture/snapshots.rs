//! Small pictures that are kept as files: a device draws them, and so does the plain renderer. `UPDATE=1` writes them anew.

use glam::DVec3;

use super::draw::{Difference, device, file, plain, rgb, snapshot};
use super::{scenes, support};

#[test]
fn a_device_draws_the_snapshots() {
    let shared = support::device();
    let mut wrong = Vec::new();
    for scene in scenes::all() {
        let image = device(&shared, &scene.state, &scene.picture);
        if std::env::var_os("UPDATE").is_some() {
            image.save(&file(scene.name)).expect("a file");
        }
        let off = Difference::between(&rgb(&image), &snapshot(scene.name));
        println!("{}: {off:?}, {} outside, {} not finite", scene.name, image.outside, image.broken);
        if !off.is_within(1.0) {
            wrong.push(format!("{}: {off:?}", scene.name));
        }
    }
    assert!(wrong.is_empty(), "look at the pictures; if they are right, UPDATE=1 keeps them:\n{}", wrong.join("\n"));
}

#[test]
fn the_plain_renderer_draws_the_snapshots() {
    let shared = support::device();
    for scene in scenes::all() {
        let (image, on_device) = (plain(&scene.state, &scene.picture), device(&shared, &scene.state, &scene.picture));
        let off = Difference::between(&rgb(&image), &snapshot(scene.name));
        println!("{}: {off:?}", scene.name);
        assert!(off.is_within(1.0), "{}: {off:?}", scene.name);
        assert_eq!((image.outside, image.broken), (on_device.outside, on_device.broken), "{}", scene.name);
    }
}

/// A camera that is moved by 1e-4 pixels, some roundings of a place in f32, gives what another driver may give: a quarter of the tolerance is enough for it.
/// One that is moved by a pixel gives another picture.
#[test]
fn rounding_is_within_the_tolerance() {
    let shared = support::device();
    for mut scene in scenes::all() {
        let camera = scene.picture.frame.camera;
        let way = DVec3::new(0.7, -0.5, 0.6);
        let mut moved = |pixels: f64| {
            let length = 2.0 * camera.extent / f64::from(scene.picture.frame.height);
            scene.picture.frame.camera.center = camera.center + pixels * length * way;
            Difference::between(&rgb(&device(&shared, &scene.state, &scene.picture)), &snapshot(scene.name))
        };
        let (little, pixel) = (moved(1e-4), moved(1.0));
        println!("{}: {little:?}, and by a pixel {pixel:?}", scene.name);
        assert!(little.is_within(0.25), "{}: {little:?}", scene.name);
        assert!(!pixel.is_within(2.0), "{}: {pixel:?}", scene.name);
    }
}
