//! Desired directions: what drives pedestrians, and what models that set velocities follow.

use glam::{DVec3, DVec4, Vec4};

use super::desired_speed_of;
use crate::kernel::{ACCELERATION, Column, Field, Kind as Element, Problem, Scalar, Source, Table, World};
use crate::visit::{Law, Outcome, Particle};

/// The direction in which each pedestrian desires to go, a unit vector; 0 where it desires none.
pub(crate) const DIRECTION: Field<Vec4> = Field::new("desired_direction");

/// The column of that, which those declare that read it.
pub(crate) fn desired_direction() -> Column {
    let about = "where the pedestrian desires to go, a unit vector; 0: nowhere";
    Column::new(DIRECTION.name, Element::Vector, "", about).derived()
}

/// Whether something in a problem reads desired directions.
pub(crate) fn is_followed(problem: &Problem) -> bool {
    problem.columns.get(DIRECTION.name).is_some()
}

/// A drive: its shader with the values of its parameters and its tables.
pub(crate) struct Drive {
    pub name: &'static str,
    pub wgsl: Source,
    pub values: Vec<(String, Scalar)>,
    pub tables: Vec<Table>,
    /// The relaxation time τ \[time\].
    pub time: f64,
    /// The species that it drives, if not all.
    pub species: Option<u32>,
}

impl Drive {
    /// The law a = (v₀ e − v) / τ, with e by the rule; where directions are followed it gives them too.
    pub fn law(self, is_followed: bool, rule: impl Fn(&Particle, &World) -> DVec3 + Send + Sync + 'static) -> Law {
        let Self { time, species, .. } = self;
        let rule = move |me: &Particle, world: &World, outcome: &mut Outcome| {
            if species.is_some_and(|own| own != me.species()) {
                outcome.accelerate(DVec4::ZERO);
                return;
            }
            let way = rule(me, world);
            outcome.accelerate(((desired_speed_of(me) * way - me.velocity) / time).extend(0.0));
            if is_followed {
                outcome.set(DIRECTION.name, way);
            }
        };
        let into: &[&'static str] = &[ACCELERATION.name, DIRECTION.name];
        let into = if is_followed { into } else { &into[..1] };
        let heading =
            if is_followed { crate::shader!("crowds/heading.wgsl") } else { crate::shader!("crowds/no_heading.wgsl") };
        let law = Law::updating(self.name, self.wgsl, self.values, into, rule);
        Law { tables: self.tables, beside: vec![heading], ..law }
    }
}
