//! Columns: one declaration of a quantity, from which its buffer, its reference array, its cells in files, its place in a
//! state and its line in the documentation follow.

use std::borrow::Cow;

use super::{Array, Name};

/// One quantity of every particle, of every slot of a particle, or of the whole system.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name in Rust, in WGSL, in scenes and in files.
    pub name: Name,
    /// The type of a value.
    pub kind: Kind,
    /// The number of values.
    pub shape: Shape,
    /// Its unit, such as `length / time`; empty for a plain number.
    pub unit: Cow<'static, str>,
    /// A description in one line.
    pub about: Cow<'static, str>,
    /// Its role: what writes it.
    pub role: Role,
    /// The column that is its rate of change, if integrators advance it.
    pub rate: Option<Name>,
    /// The way in which integrators advance it.
    pub advance: Advance,
    /// The default value; `None`: every particle must be given one.
    pub initial: Option<[f64; 4]>,
    /// Its buffer, and its components there.
    pub place: Place,
}

/// The kind of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A real number: `f32` on the device, f64 on the host.
    Scalar,
    /// Three real numbers: `vec4f` on the device, whose `w` is free.
    Vector,
    /// Four real numbers: a unit quaternion (x, y, z | w), `vec4f` on the device.
    Quaternion,
    /// An integer from 0 on: `u32`.
    Whole,
}

/// The number of values of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// One for each particle.
    Particle,
    /// A number of values for each particle.
    Slots(u32),
    /// A number of values for the whole system.
    System(u32),
}

/// The role of a column: what writes it, and whether a state keeps it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// It is advanced by the steps: saved, restored and given back.
    State,
    /// One law recomputes it in each evaluation.
    Derived,
    /// It is zero at the start of each evaluation, and laws add to it.
    Sum,
}

/// The way in which integrators advance a column y by its rate y'.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Advance {
    /// y ← y + c y' dt: with velocities (at a kick) where evaluations compute the rate, with positions (at a drift) where the
    /// rate is a state.
    #[default]
    Linear,
    /// The same as `Linear`, and on fixed particles too: what happens to them though they do not move, such as heat.
    Everywhere,
    /// The same with positions, by a rate that follows from velocities and is computed in the middle of each drift, as that of
    /// a density is (see [`Column::carried`]).
    Carried,
    /// A unit quaternion that turns a body by its angular velocity, see [`rotation`](crate::rotation).
    Rotation {
        /// The column of its principal moments of inertia.
        inertia: Name,
    },
}

/// The location of a column: a buffer and the first component of its elements.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The buffer, by its name in WGSL.
    pub buffer: Name,
    /// The component of each element at which it begins.
    pub component: u8,
}

impl Kind {
    /// The number of components of a value.
    #[must_use]
    pub fn components(self) -> usize {
        match self {
            Self::Scalar | Self::Whole => 1,
            Self::Vector => 3,
            Self::Quaternion => 4,
        }
    }
    /// The suffixes for the components, appended to the name of a column in files.
    #[must_use]
    pub fn suffixes(self) -> &'static [&'static str] {
        match self {
            Self::Scalar | Self::Whole => &[""],
            Self::Vector => &["_x", "_y", "_z"],
            Self::Quaternion => &["_x", "_y", "_z", "_w"],
        }
    }
    /// An array of `count` equal values of this kind on the host.
    #[must_use]
    pub fn filled(self, value: [f64; 4], count: usize) -> Array {
        let [x, y, z, w] = value;
        match self {
            Self::Scalar => Array::Float(vec![x; count]),
            Self::Vector => Array::Vec3(vec![glam::DVec3::new(x, y, z); count]),
            Self::Quaternion => Array::Vec4(vec![glam::DVec4::new(x, y, z, w); count]),
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "declared as a whole number")]
            Self::Whole => Array::Uint(vec![x as u32; count]),
        }
    }
    /// The kind of an array on the host.
    #[must_use]
    pub fn of(values: &Array) -> Self {
        match values {
            Array::Float(_) => Self::Scalar,
            Array::Vec3(_) => Self::Vector,
            Array::Vec4(_) => Self::Quaternion,
            Array::Uint(_) => Self::Whole,
        }
    }
    /// Its name in scenes and messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Scalar => "scalar",
            Self::Vector => "vector",
            Self::Quaternion => "quaternion",
            Self::Whole => "whole",
        }
    }
    /// The element of its buffer in WGSL, where it has one of its own.
    #[must_use]
    pub fn wgsl(self) -> &'static str {
        match self {
            Self::Scalar => "f32",
            Self::Vector | Self::Quaternion => "vec4f",
            Self::Whole => "u32",
        }
    }
    /// Every kind.
    pub const ALL: [Self; 4] = [Self::Scalar, Self::Vector, Self::Quaternion, Self::Whole];
}

impl Shape {
    /// The number of values for `particles` particles.
    #[must_use]
    pub fn len(self, particles: usize) -> usize {
        match self {
            Self::Particle => particles,
            Self::Slots(k) => particles.saturating_mul(k as usize),
            Self::System(k) => k as usize,
        }
    }
}

impl Column {
    /// A text with its unit behind it, if it has one.
    #[must_use]
    pub fn with_unit(&self, text: &str) -> String {
        if self.unit.is_empty() { text.to_owned() } else { format!("{text} [{}]", self.unit) }
    }
    /// Its kind and its unit, as messages state them.
    pub(crate) fn described(&self) -> String {
        let kind = self.kind.name();
        if self.unit.is_empty() { kind.to_owned() } else { format!("{kind} [{}]", self.unit) }
    }
    /// A column of its own buffer, one value for each particle, kept as state, 0 where nothing is given.
    #[must_use]
    pub fn new(name: impl Into<Name>, kind: Kind, unit: &'static str, about: &'static str) -> Self {
        let name = name.into();
        let place = Place { buffer: name.clone(), component: 0 };
        let initial = Some(if kind == Kind::Quaternion { [0.0, 0.0, 0.0, 1.0] } else { [0.0; 4] });
        let (unit, about, shape, role) = (unit.into(), about.into(), Shape::Particle, Role::State);
        Self { name, kind, shape, unit, about, role, rate: None, advance: Advance::Linear, initial, place }
    }
    /// The same, recomputed in each evaluation by one law.
    #[must_use]
    pub fn derived(self) -> Self {
        Self { role: Role::Derived, ..self }
    }
    /// The same, zero at the start of each evaluation, to which laws add.
    #[must_use]
    pub fn summed(self) -> Self {
        Self { role: Role::Sum, ..self }
    }
    /// The same, advanced by integrators with this rate.
    #[must_use]
    pub fn with_rate(self, rate: impl Into<Name>) -> Self {
        Self { rate: Some(rate.into()), ..self }
    }
    /// The same, advanced by integrators with this rate on fixed particles too, though they do not move: of what counts, such as heat.
    #[must_use]
    pub fn counting(self, rate: impl Into<Name>) -> Self {
        Self { advance: Advance::Everywhere, ..self.with_rate(rate) }
    }
    /// The same, advanced with positions by this rate, which follows from velocities: dρ/dt = −ρ ∇·v. If the rate were taken at the end of
    /// a drift, it would include the second-order term of a straight path, which makes a rotating fluid seem to expand; in the middle it
    /// does not: a drift goes half of its way, the rate is computed there, and the drift continues. This is of order 2; where the rate
    /// depends on the column itself, which then has its value at the start, of order 1.
    #[must_use]
    pub fn carried(self, rate: impl Into<Name>) -> Self {
        Self { advance: Advance::Carried, ..self.with_rate(rate) }
    }
    /// The same, an orientation that turns by this angular velocity, of a body with these principal moments of inertia.
    #[must_use]
    pub fn turning(self, rate: impl Into<Name>, inertia: impl Into<Name>) -> Self {
        Self { advance: Advance::Rotation { inertia: inertia.into() }, ..self.with_rate(rate) }
    }
    /// The same, of the whole system or of slots.
    #[must_use]
    pub fn shaped(self, shape: Shape) -> Self {
        Self { shape, ..self }
    }
    /// The same with this value for particles without a given one.
    #[must_use]
    pub fn starting(self, value: [f64; 4]) -> Self {
        Self { initial: Some(value), ..self }
    }
    /// The same, without an initial value: every particle must be given one.
    #[must_use]
    pub fn required(self) -> Self {
        Self { initial: None, ..self }
    }
    /// The same, stored in the elements of another column's buffer.
    #[must_use]
    pub fn within(self, buffer: impl Into<Name>, component: u8) -> Self {
        Self { place: Place { buffer: buffer.into(), component }, ..self }
    }
    /// Whether integrators advance it beside positions and velocities.
    #[must_use]
    pub fn is_advanced(&self) -> bool {
        self.rate.is_some() && !["position", "velocity"].contains(&self.name.as_ref())
    }
    /// Whether it shares the elements of a buffer with another column.
    #[must_use]
    pub fn is_packed(&self) -> bool {
        self.place.buffer != self.name
    }
    /// An array of initial values for `particles` particles.
    #[must_use]
    pub fn array(&self, particles: usize) -> Array {
        self.kind.filled(self.initial.unwrap_or_default(), self.shape.len(particles))
    }
}
