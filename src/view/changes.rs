//! What was changed by hand, in the form of `--set`.

use super::stage::Stage;
use crate::component::Component;
use crate::kernel::Backend;
use crate::render::KEYS;
use crate::scene::written;
use crate::settings::Value;

/// The keys of a picture that the place of a view gives, or its camera.
const PLACE: [&str; 8] = ["width", "height", "eye", "up", "projection", "auto_frame", "center", "extent"];

impl<B: Backend> Stage<B> {
    /// The values of forces, of the picture and of its camera that differ from those of the scene. What was added to the forces is not among them.
    pub fn changes(&self) -> Vec<String> {
        let mut changes = Vec::new();
        let start = self.start.forces.iter().map(|force| Component::settings(&**force));
        for (place, ((_, now), before)) in self.simulation.settings().iter().zip(start).enumerate() {
            let others = now.iter().zip(&before).filter(|(now, before)| now.value != before.value);
            changes.extend(others.map(|(now, _)| {
                let table = now.table.map_or(String::new(), |table| format!("{table}."));
                format!("force.{place}.{table}{}={}", now.name, written(now.kind, now.value))
            }));
        }
        let mut picture = |name: &str, value: &Value| {
            let kind = KEYS.iter().find(|key| key.name == name).map(|key| key.kind);
            changes.extend(kind.map(|kind| format!("picture.{name}={}", written(kind, value))));
        };
        let looks = self.pictures.looks();
        for (name, value) in looks.0.iter().filter(|(name, _)| !PLACE.contains(name)) {
            if self.looks.0.get(name) != Some(value) {
                picture(name, value);
            }
        }
        if self.moved() {
            let frame = &self.picture().frame;
            let camera = &frame.camera;
            let projection = if camera.distance > 0.0 { "perspective" } else { "orthographic" };
            picture("width", &frame.width.into());
            picture("height", &frame.height.into());
            picture("eye", &camera.back.into());
            picture("up", &camera.up.into());
            picture("projection", &projection.into());
            picture("auto_frame", &false.into());
            picture("center", &camera.center.into());
            picture("extent", &camera.extent.into());
        }
        changes
    }
}
