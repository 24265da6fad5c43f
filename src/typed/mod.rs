//! Forces and shapes with their settings as fields: a misspelt setting does not compile.
//!
//! ```
//! use motes::typed::{Gravity, Plummer, default, plummer};
//!
//! let stars = Plummer { scale: 2.0, ..plummer(1000) }.build()?;
//! let forces = vec![Gravity { softening: 0.05, ..default() }.into()];
//! # let _: (motes::State, Vec<Box<dyn motes::forces::Component>>) = (stars, forces);
//! # Ok::<(), motes::Error>(())
//! ```
//!
//! Fields are the keys that scenes have, with the same defaults and the same checks: a value out of its range is an error where a
//! simulation or a state is made of it. The lists are written from the registers, by a test that compares them.

mod constraints;
mod interactions;
mod shapes;
mod updaters;

pub use constraints::*;
pub use interactions::*;
pub use shapes::*;
pub use updaters::*;

use std::borrow::Cow;

use glam::DVec3;

use crate::settings::{LARGEST_WHOLE, Pair, Settings, Value};

/// The defaults of whatever is asked for, as in `Gravity { softening: 0.05, ..default() }`.
#[must_use]
pub fn default<T: Default>() -> T {
    T::default()
}

impl Fluid {
    /// A fluid with the defaults of the regime `viscous`: for flows between walls, without a surface.
    #[must_use]
    pub fn viscous(spacing: f64) -> Self {
        let keys = crate::forces::entry("fluid").map_or(&[][..], |entry| entry.keys);
        Self { spacing, ..Self::of(&Settings::defaults(keys).under(keys, "regime", "viscous")) }
    }
}

/// The value of a setting as a field has it.
trait Field: Sized {
    fn of(settings: &Settings, key: &str) -> Self;
    fn value(&self) -> Value;
}

impl Field for f64 {
    fn of(settings: &Settings, key: &str) -> Self {
        settings.number(key)
    }
    fn value(&self) -> Value {
        Value::Number(*self)
    }
}
impl Field for u32 {
    fn of(settings: &Settings, key: &str) -> Self {
        Self::try_from(settings.whole(key)).unwrap_or(Self::MAX)
    }
    fn value(&self) -> Value {
        Value::Number(f64::from(*self))
    }
}
impl Field for u64 {
    fn of(settings: &Settings, key: &str) -> Self {
        settings.whole(key)
    }
    fn value(&self) -> Value {
        // A number holds whole ones up to 2⁵³. What is above is refused, and must not be rounded to that.
        let exact = *self <= 1 << 53;
        Value::Number(if exact { *self as f64 } else { (*self as f64).max(LARGEST_WHOLE.next_up()) })
    }
}
/// A species; none stands for all.
impl Field for Option<u32> {
    fn of(settings: &Settings, key: &str) -> Self {
        settings.species(key)
    }
    fn value(&self) -> Value {
        self.map_or(Value::Text(Cow::Borrowed("all")), |species| Value::Number(f64::from(species)))
    }
}
impl Field for DVec3 {
    fn of(settings: &Settings, key: &str) -> Self {
        settings.vector(key)
    }
    fn value(&self) -> Value {
        Value::Vector(*self)
    }
}
impl Field for bool {
    fn of(settings: &Settings, key: &str) -> Self {
        settings.flag(key)
    }
    fn value(&self) -> Value {
        Value::Flag(*self)
    }
}
impl Field for Cow<'static, str> {
    fn of(settings: &Settings, key: &str) -> Self {
        match settings.0.get(key) {
            Some(Value::Text(text)) => text.clone(),
            _ => Cow::Borrowed(""),
        }
    }
    fn value(&self) -> Value {
        Value::Text(self.clone())
    }
}
impl Field for Vec<Pair> {
    fn of(settings: &Settings, key: &str) -> Self {
        settings.pairs(key).to_vec()
    }
    fn value(&self) -> Value {
        Value::Pairs(self.clone())
    }
}

/// A struct of the settings of each entry of a register, and a function that takes those that have no default.
macro_rules! typed {
    ($register:ident; $($(#[$doc:meta])* $type:ident $name:literal $make:ident($($given:ident: $kind:ty),*) {
        $($(#[$about:meta])* $key:ident: $value:ty,)*
    })*) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $type {
            $($(#[$about])* pub $key: $value,)*
        }
        impl $type {
            #[allow(unused_variables, reason = "some have no settings")]
            pub(super) fn of(settings: &Settings) -> Self {
                Self { $($key: Field::of(settings, stringify!($key)),)* }
            }
            /// The same by the names of its keys.
            #[must_use]
            pub fn settings(&self) -> Settings {
                Settings::default()$(.with(stringify!($key), Field::value(&self.$key)))*
            }
        }
        super::begun!($register $type $name $make($($given: $kind),*));
        super::$register::builder!($type $name);
    )*};
}
use typed;

/// What one begins with: defaults, where all settings have one, or a function of the others.
macro_rules! begun {
    ($register:ident $type:ident $name:literal $make:ident()) => {
        impl Default for $type {
            fn default() -> Self {
                Self::of(&super::$register::defaults($name))
            }
        }
    };
    ($register:ident $type:ident $name:literal $make:ident($($given:ident: $kind:ty),+)) => {
        #[doc = concat!("[`", stringify!($type), "`] with the defaults of all other settings.")]
        #[must_use]
        pub fn $make($($given: $kind),+) -> $type {
            $type::of(&super::$register::defaults($name)$(.with(stringify!($given), Field::value(&$given)))+)
        }
    };
}
use begun;

/// What is made of the settings of forces.
mod force {
    use crate::component::{Component, misnamed};
    use crate::forces::entry;
    use crate::settings::Settings;

    pub fn defaults(name: &str) -> Settings {
        entry(name).map_or_else(Settings::default, |entry| Settings::defaults(entry.keys))
    }
    pub fn made(name: &str, settings: &Settings) -> Box<dyn Component> {
        let unknown = || misnamed(format!("no force is called `{name}`"));
        entry(name).map_or_else(unknown, |entry| (entry.build)(settings))
    }
    macro_rules! builder {
        ($type:ident $name:literal) => {
            impl From<$type> for Box<dyn crate::component::Component> {
                fn from(typed: $type) -> Self {
                    super::force::made($name, &typed.settings())
                }
            }
        };
    }
    pub(super) use builder;
}

/// What is made of the settings of shapes.
mod shape {
    use crate::error::Error;
    use crate::settings::Settings;
    use crate::shapes::shape;
    use crate::state::State;

    pub fn defaults(name: &str) -> Settings {
        shape(name).map_or_else(Settings::default, |shape| Settings::defaults(shape.keys))
    }
    pub fn made(name: &str, settings: &Settings) -> Result<State, Error> {
        let shape = shape(name).ok_or_else(|| Error::Scene(format!("no shape is called `{name}`")))?;
        (shape.build)(settings)
    }
    macro_rules! builder {
        ($type:ident $name:literal) => {
            impl $type {
                /// The state.
                ///
                /// # Errors
                /// [`Error::Scene`](crate::Error::Scene) when the settings make no sense.
                pub fn build(&self) -> Result<crate::State, crate::Error> {
                    super::shape::made($name, &self.settings())
                }
            }
        };
    }
    pub(super) use builder;
}
