//! What was changed by hand, in the form of `--set`.

use super::stage::Stage;
use crate::component::Component;
use crate::kernel::Backend;
use crate::render::KEYS;
use crate::scene::{Shared, written};
use crate::settings::{Key, Value};

/// The keys of a picture that the place of a view gives, or its camera.
const PLACE: [&str; 8] = ["width", "height", "eye", "up", "projection", "auto_frame", "center", "extent"];

impl<B: Backend> Stage<B> {
    /// The values of forces, of the picture and of its camera that differ from those of the scene. What was added to the forces is not among them.
    pub fn changes(&self) -> Vec<String> {
        let mut changes = Vec::new();
        let start = self.start.forces.iter().map(|force| Component::settings(&**force));
        for (place, ((_, now), before)) in self.simulation.settings().iter().zip(start).enumerate() {
            for (now, before) in now.iter().zip(&before).filter(|(now, before)| now.value != before.value) {
                let table = now.table.map_or(String::new(), |table| format!("{table}."));
                changes.push(format!("force.{place}.{table}{}={}", now.name, written(now.kind, now.value)));
                // Particles that took it from the force are as they were.
                let of_it = |key: &&Shared| key.force == place && key.path.rsplit('.').next() == Some(now.name);
                let same = |key: &Shared| format!("{}={}", key.path, written(before.kind, before.value));
                changes.extend(self.shared.iter().filter(of_it).map(same));
            }
        }
        let mut picture = |name: &str, value: &Value| {
            let kind = KEYS.iter().find(|key| key.name == name).map(|key| key.kind);
            changes.extend(kind.map(|kind| format!("picture.{name}={}", written(kind, value))));
        };
        let looks = self.pictures.looks();
        for (name, value) in looks.0.iter().filter(|(name, _)| !PLACE.contains(name)) {
            // A word that was chosen changes the defaults of other keys, which are given for that reason.
            let chosen = |key: &&Key| self.looks.0.get(key.name) != looks.0.get(key.name);
            let under = |key: &Key| key.presets.iter().any(|of| of.defaults.iter().any(|(under, _)| under == name));
            if self.looks.0.get(name) != Some(value) || KEYS.iter().filter(chosen).any(under) {
                picture(name, value);
            }
        }
        let frame = &self.picture().frame;
        let camera = &frame.camera;
        if self.moved() || self.aimed() {
            picture("eye", &camera.back.into());
            picture("up", &camera.up.into());
            picture("projection", &camera.projection().into());
            picture("auto_frame", &(!self.moved()).into());
        }
        if self.moved() {
            picture("width", &frame.width.into());
            picture("height", &frame.height.into());
            picture("center", &camera.center.into());
            picture("extent", &camera.extent.into());
        }
        changes
    }
}
