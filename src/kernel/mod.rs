//! Plans as data, without a device: fields, reflected shaders, kernels with their references.

mod adaptive_step;
mod backend;
mod block_steps;
mod bounds;
mod column;
mod columns;
mod cost;
mod field;
mod fuse;
mod host;
mod list_shape;
mod merge;
mod message;
mod op;
mod own;
mod pack;
mod packing;
mod pair;
mod pass;
mod plan;
mod precision;
mod problem;
mod reflect;
pub mod repeat;
mod shader;
mod solver;
mod unused_word;
mod world;

pub use adaptive_step::{
    AdaptiveStep, LARGEST_CRITERION, LEAST_PART, Reason, STEP_CLOCK, STEP_CLOCK_WORDS, STEP_CRITERIA, STOP, TICKS,
    split, ticks, time,
};
pub use backend::{Arrival, Backend, Machine, Mobile};
pub use block_steps::{BLOCK_CLOCK, BLOCK_CLOCK_START, BLOCK_CLOCK_WORDS, BlockSteps, DUE, MOST_LEVELS, STEP_LEVEL};
pub use bounds::{Bounds, Side};
pub use column::{Advance, Column, Kind, Place, Role, Shape};
pub use columns::{Columns, base};
#[doc(hidden)]
pub use cost::Cost;
pub use field::{
    ACCELERATION, ALARM, ALARM_WORDS, Array, Element, Field, HOME, ID, LAW, LIFE, POSITION, QUIET, SPECIES, TARGET,
    VELOCITY,
};
pub use host::{Host, Reading, Writing};
pub use list_shape::ListShape;
pub use op::{Flag, Next, Op, Walk};
pub use own::claims;
#[cfg(feature = "panel")]
pub use own::over;
pub use pack::{Member, Packed, Scalar};
pub use packing::insert;
pub use pair::{Pair, Way};
pub use pass::{Indirect, Pass, Threads};
pub use plan::{Kernel, Name, Plan, Reference, Table, short};
pub use precision::{LOW_WORDS, POSITION_LOW, Precision, VELOCITY_LOW, high_words, joined, low_words, remainders};
pub use problem::{Elastic, Neighbors, Problem, extent};
pub use reflect::{Access, Binding, Reflection};
pub use shader::{Shader, Source};
pub use solver::{LEAST_TOLERANCE, MOST_ITERATIONS, MOST_SOLVES, Solver};
pub use world::World;
