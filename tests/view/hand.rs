//! A hand at the viewer: what a window would send, frame by frame.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, TouchPhase, Vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, Node};
use glam::DVec3;
use motes::scene::{Options, Scene, Source};
use motes::settings::Value;
use motes::view::View;
use motes::{Gpu, POSITION, Simulation, gpu};
use pollster::block_on;

/// A view of 820 by 1200 points, with a panel at its right.
pub struct Hand {
    harness: Harness<'static, View<Gpu>>,
    /// The device lives as long as the view.
    _found: gpu::Found,
}

impl Hand {
    /// A view of a scene, with a step in each frame. A missing adapter is a failure.
    pub fn on(scene: &str, overrides: &[&str]) -> Self {
        let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
        let source = Source::find(scene).unwrap_or_else(|faults| panic!("{faults}"));
        let mut scene =
            Scene::load(&source, &overrides, &Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
        let setup = scene.setup();
        let found = block_on(gpu::best()).expect("an adapter");
        let (device, queue) = (found.device.clone(), found.queue.clone());
        let make = Box::new(move |setup: &_| Simulation::new(&device, &queue, setup));
        let mut view = block_on(View::new(&scene, setup, make)).expect("a view");
        view.each_frame(1);
        // What is queried has no screen: nothing is painted.
        let harness = Harness::builder().with_size(Vec2::new(820.0, 1200.0)).with_step_dt(1.0 / 60.0);
        let harness = harness.build_ui_state(|ui, view: &mut View<Gpu>| view.controls(ui), view);
        let mut hand = Self { harness, _found: found };
        // The panel takes its place before anything runs.
        hand.view().pause(true);
        hand.frames(3);
        hand.view().pause(false);
        hand
    }
    fn frame(&mut self, events: Vec<Event>) {
        let modifiers = events.iter().find_map(|event| match event {
            Event::Key { modifiers, .. } => Some(*modifiers),
            _ => None,
        });
        let held = Event::ModifiersChanged(modifiers.unwrap_or_default());
        let input = self.harness.input_mut();
        input.events.extend(std::iter::once(held).chain(events));
        self.harness.step();
        block_on(self.view().advance()).expect("a frame");
    }
    fn view(&mut self) -> &mut View<Gpu> {
        self.harness.state_mut()
    }
    pub fn frames(&mut self, count: u32) {
        (0..count).for_each(|_| self.frame(Vec::new()));
    }
    /// Frames until so many steps are done.
    pub fn until(&mut self, steps: u64) {
        while self.steps() < steps {
            self.frame(Vec::new());
        }
        assert_eq!(self.steps(), steps);
    }
    pub fn rests(&self) -> bool {
        self.harness.state().rests()
    }
    pub fn steps(&mut self) -> u64 {
        self.view().simulation().steps()
    }
    pub fn taken(&mut self) -> Option<motes::view::Taken> {
        self.view().take()
    }
    pub fn end(&mut self) -> Option<motes::view::Taken> {
        self.view().end().expect("a film");
        self.taken()
    }
    /// A contact sheet, as a window has one.
    pub fn contact(&mut self) {
        self.view().contact(egui::TextureId::default());
    }
    pub fn wanted(&mut self) -> Option<String> {
        self.view().wanted()
    }
    /// Whether something with this label is shown.
    pub fn shows(&self, label: &str) -> bool {
        self.harness.query_all_by_label(label).next().is_some()
    }
    /// What was changed by hand, as `--set` takes it.
    pub fn changes(&self) -> Vec<String> {
        self.harness.state().changes()
    }
    /// Whether the panel's font has all letters of a text.
    pub fn can_write(&self, text: &str) -> bool {
        let font = egui::FontId::proportional(12.0);
        self.harness.ctx.fonts_mut(|fonts| text.chars().all(|c| c.is_whitespace() || fonts.has_glyph(&font, c)))
    }
    pub fn message(&self) -> &str {
        self.harness.state().message()
    }
    pub fn size(&self) -> [u32; 2] {
        self.harness.state().size()
    }
    /// Presses a key, and releases it.
    pub fn key(&mut self, key: Key, modifiers: Modifiers) {
        self.press(&[key], modifiers);
    }
    /// Presses keys in one frame, and releases them in the next.
    pub fn keys(&mut self, keys: &[Key]) {
        self.press(keys, Modifiers::NONE);
    }
    fn press(&mut self, keys: &[Key], modifiers: Modifiers) {
        [true, false].into_iter().for_each(|pressed| self.keyed(keys, modifiers, pressed));
    }
    /// One frame, in which keys are pressed or released.
    pub fn keyed(&mut self, keys: &[Key], modifiers: Modifiers, pressed: bool) {
        let one = |key: &Key| Event::Key { key: *key, physical_key: None, pressed, repeat: false, modifiers };
        self.frame(keys.iter().map(one).collect());
    }
    fn button(&mut self, pos: Pos2, button: PointerButton, pressed: bool) {
        self.frame(vec![Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }]);
    }
    /// Types a text into what has the focus, in the place of what is there, letter by letter.
    pub fn write(&mut self, text: &str) {
        self.key(Key::A, Modifiers::COMMAND);
        self.key(Key::Backspace, Modifiers::NONE);
        for letter in text.chars().map(String::from) {
            let key = |pressed| {
                let key = Key::from_name(&letter.to_uppercase())?;
                Some(Event::Key { key, physical_key: None, pressed, repeat: false, modifiers: Modifiers::NONE })
            };
            self.frame(key(true).into_iter().chain([Event::Text(letter.clone())]).collect());
            self.frame(key(false).into_iter().collect());
        }
        self.key(Key::Enter, Modifiers::NONE);
    }
    pub fn click(&mut self, pos: Pos2) {
        self.frame(vec![Event::PointerMoved(pos)]);
        self.button(pos, PointerButton::Primary, true);
        self.button(pos, PointerButton::Primary, false);
    }
    /// Drags from a place.
    pub fn drag(&mut self, from: Pos2, by: Vec2, button: PointerButton) {
        self.frame(vec![Event::PointerMoved(from)]);
        self.button(from, button, true);
        for part in [0.5, 1.0] {
            self.frame(vec![Event::PointerMoved(from + part * by)]);
        }
        self.button(from + by, button, false);
        self.frames(1);
    }
    /// Holds the left button down at a place, for so many frames after it has moved there; then lets go.
    pub fn hold(&mut self, from: Pos2, to: Pos2, frames: u32) {
        self.hold_and(from, to, |hand| hand.frames(frames));
    }
    /// The same, and does something before it lets go.
    pub fn hold_and(&mut self, from: Pos2, to: Pos2, mut meanwhile: impl FnMut(&mut Self)) {
        self.frame(vec![Event::PointerMoved(from)]);
        self.button(from, PointerButton::Primary, true);
        self.frame(vec![Event::PointerMoved(from.lerp(to, 0.5))]);
        self.frame(vec![Event::PointerMoved(to)]);
        meanwhile(self);
        self.button(to, PointerButton::Primary, false);
        self.frames(1);
    }
    /// Chooses a word of a list that has a label.
    pub fn choose(&mut self, label: &str, word: &str) {
        let place = self.place_beside(label);
        self.click(place);
        self.frames(20);
        let place = self.place(word);
        self.click(place);
        self.frames(3);
    }
    /// Holds a key down for so many frames.
    pub fn hold_key(&mut self, key: Key, frames: u32) {
        let event =
            |pressed| Event::Key { key, physical_key: None, pressed, repeat: false, modifiers: Modifiers::NONE };
        self.frame(vec![event(true)]);
        self.frames(frames);
        self.frame(vec![event(false)]);
    }
    /// The names of the forces.
    pub fn forces(&mut self) -> Vec<String> {
        self.view().simulation().settings().into_iter().map(|(name, _)| name).collect()
    }
    pub fn masses(&mut self) -> Vec<f32> {
        let positions = block_on(self.view().simulation().read(POSITION)).expect("positions");
        positions.iter().map(|x| x.w).collect()
    }
    pub fn places(&mut self) -> Vec<DVec3> {
        let positions = block_on(self.view().simulation().read(POSITION)).expect("positions");
        positions.iter().map(|x| x.truncate().as_dvec3()).collect()
    }
    /// Turns the wheel at a place, and waits until it has come to rest.
    pub fn wheel(&mut self, at: Pos2, points: f32) {
        self.frame(vec![Event::PointerMoved(at)]);
        let (unit, delta, modifiers) = (MouseWheelUnit::Point, Vec2::new(0.0, points), Modifiers::NONE);
        self.frame(vec![Event::MouseWheel {
            unit,
            delta,
            phase: TouchPhase::Move,
            source: MouseWheelSource::Unknown,
            modifiers,
        }]);
        self.frames(20);
    }
    /// The middle of what has a label.
    pub fn place(&self, label: &str) -> Pos2 {
        let node = self.harness.query_all_by_label(label).next();
        node.unwrap_or_else(|| panic!("no `{label}` in {:?}", self.harness)).rect().center()
    }
    /// The control that a label belongs to.
    fn beside<'a>(&'a self, label: &'a str) -> Node<'a> {
        let mut nodes = self.harness.query_all_by_label(label);
        let node = nodes.find(|node| node.accesskit_node().role() != Role::Label);
        node.unwrap_or_else(|| panic!("no control of `{label}` in {:?}", self.harness))
    }
    pub fn place_beside(&self, label: &str) -> Pos2 {
        self.beside(label).rect().center()
    }
    /// The number of a slider, in its units.
    pub fn number_beside(&self, label: &str) -> f64 {
        self.beside(label).accesskit_node().numeric_value().unwrap_or(f64::NAN)
    }
    pub fn value_beside(&self, label: &str) -> String {
        self.beside(label).value().unwrap_or_default()
    }
    /// A setting of a force, as it is.
    pub fn setting(&mut self, force: &str, name: &str) -> Value {
        let settings = self.view().simulation().settings();
        let (_, settings) = settings.iter().find(|(known, _)| known == force).expect("a force");
        settings.iter().find(|setting| setting.name == name).expect("a setting").value.clone()
    }
    /// The id of the chosen particle, and where it is.
    pub fn chosen(&self) -> Option<(u32, DVec3)> {
        self.harness.state().chosen().map(|(id, x)| (id, x.expect("a place")))
    }
    pub fn positions(&mut self) -> Vec<[u32; 4]> {
        let positions = block_on(self.view().simulation().read(POSITION)).expect("positions");
        positions.iter().map(|x| x.to_array().map(f32::to_bits)).collect()
    }
    /// The picture: red, green, blue and alpha of each pixel.
    pub fn picture(&mut self) -> Vec<u8> {
        block_on(self.view().pixels()).expect("a picture")
    }
}
