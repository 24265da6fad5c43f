//! A registered component, which keeps its settings, so that one of them can be changed.

use super::misnamed::misnamed;
use super::{Change, Component, Properties, Resolved, Setting, Stage, Tail};
use crate::error::Error;
use crate::floor_plan::FloorPlan;
use crate::grains::ContactForce;
use crate::kernel::{Bounds, Column, Plan, Problem};
use crate::settings::{Key, Settings, unknown};
use crate::state::State;
use crate::visit::Law;

/// A function that builds a component from checked settings.
type Make = fn(&Settings) -> Box<dyn Component>;

/// A component, and its settings.
#[derive(Clone)]
struct Registered {
    name: &'static str,
    keys: &'static [Key],
    settings: Settings,
    make: Make,
    made: Box<dyn Component>,
}

/// A component of that name, or one that is an error wherever a plan is written.
pub fn registered(name: &'static str, keys: &'static [Key], settings: &Settings, make: Make) -> Box<dyn Component> {
    match settings.fault(keys) {
        Some(fault) => misnamed(format!("the force `{name}` {fault}")),
        None => Box::new(Registered { name, keys, settings: settings.clone(), make, made: make(settings) }),
    }
}

/// All methods are delegated to the component that was built.
impl Component for Registered {
    fn name(&self) -> &str {
        self.name
    }
    fn settings(&self) -> Vec<Setting<'_>> {
        let one = |key: &'static Key| {
            let value = self.settings.0.get(key.name)?;
            let Key { name, kind, about, .. } = key;
            Some(Setting {
                table: None,
                name,
                kind: *kind,
                default: key.default.as_ref(),
                about,
                shared: key.shared,
                value,
            })
        };
        self.keys.iter().filter_map(one).collect()
    }
    fn changed(&self, name: &str, to: &Change) -> Result<Box<dyn Component>, Error> {
        let Some(key) = self.keys.iter().find(|key| key.name == name) else {
            let known = self.keys.iter().map(|key| key.name);
            return Err(Error::Scene(format!("the force `{}` {}", self.name, unknown(name, known))));
        };
        let Change::Value(value) = to else {
            return Err(Error::Setting {
                key: key.name,
                why: format!("`{name}` of `{}` is {}, and no table", self.name, key.kind.wanted()),
            });
        };
        if !key.presets.is_empty() {
            let why = format!(
                "`{name}` of `{}` chooses defaults where a scene is read: change the keys that it is about",
                self.name
            );
            return Err(Error::Setting { key: key.name, why });
        }
        let settings = self.settings.clone().with(key.name, value.clone());
        if let Some(fault) = settings.fault(self.keys) {
            return Err(Error::Setting { key: key.name, why: format!("the force `{}` {fault}", self.name) });
        }
        Ok(Box::new(Self { made: (self.make)(&settings), settings, ..self.clone() }))
    }
    fn columns(&self) -> Vec<Column> {
        self.made.columns()
    }
    fn own_columns(&self, earlier: usize) -> Vec<Column> {
        self.made.own_columns(earlier)
    }
    fn plan_columns(&self, plan: &FloorPlan) -> Vec<Column> {
        self.made.plan_columns(plan)
    }
    fn laws(&self) -> Vec<Law> {
        self.made.laws()
    }
    fn contacts(&self, state: &State, bounds: &Bounds, earlier: usize) -> Result<Vec<ContactForce>, Error> {
        self.made.contacts(state, bounds, earlier)
    }
    fn tails(&self) -> Vec<Tail> {
        self.made.tails()
    }
    fn properties(&self) -> Properties {
        self.made.properties()
    }
    fn check(&self, bounds: &Bounds) -> Result<(), Error> {
        self.made.check(bounds)
    }
    fn resolved(&self, problem: &Problem) -> Result<Resolved, Error> {
        self.made.resolved(problem)
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        self.made.stage(stage, plan, problem)
    }
}
