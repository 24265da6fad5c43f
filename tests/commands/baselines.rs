//! The plain Rust that `benches/baselines` holds motes against: its own tests run here, because a bench has none.
#![allow(dead_code, reason = "tests use a part of it")]

#[path = "../../benches/baselines/agents.rs"]
mod agents;
#[path = "../../benches/baselines/bodies.rs"]
mod bodies;
#[path = "../../benches/baselines/cells.rs"]
mod cells;
#[path = "../../benches/baselines/direct.rs"]
mod direct;
#[path = "../../benches/baselines/scaling.rs"]
mod scaling;
#[path = "../../benches/baselines/sheet.rs"]
mod sheet;
#[path = "../../benches/baselines/water.rs"]
mod water;
