//! What runs, as data only: fields, shaders as naga sees them, kernels with their twins, plans. No device here.

mod backend;
mod clock;
mod field;
mod host;
mod message;
mod pack;
mod plan;
mod reflect;
mod shader;

pub use backend::{Backend, Machine};
pub use clock::Clock;
pub use field::{ACCELERATION, ALARM, Array, Element, Field, POSITION, VELOCITY};
pub use host::Host;
pub use pack::{Member, Packed, Scalar};
pub use plan::{Kernel, Pass, Plan, Threads, Twin};
pub use reflect::{Access, Binding, Reflection};
pub use shader::{Shader, Source};
