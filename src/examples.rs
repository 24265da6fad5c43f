//! The programs under `examples/`, whole. `cargo run --example NAME` runs one; a test runs all.
//!
//! # A small renderer: steps and drawing in one encoder, no copy
//!
//! `examples/renderer.rs`
#![doc = concat!("```ignore\n", include_str!("../examples/renderer.rs"), "```")]
//!
//! # A simulation as a resource of a schedule
//!
//! `examples/schedule.rs`
#![doc = concat!("```ignore\n", include_str!("../examples/schedule.rs"), "```")]
//!
//! # An obstacle that is moved in each frame
//!
//! `examples/moving_obstacle.rs`
#![doc = concat!("```ignore\n", include_str!("../examples/moving_obstacle.rs"), "```")]
//!
//! # A law of one's own with a parameter and a buffer of its own
//!
//! `examples/own_law.rs`
#![doc = concat!("```ignore\n", include_str!("../examples/own_law.rs"), "```")]
//!
//! # Spawn and remove particles
//!
//! `examples/spawn_and_remove.rs`
#![doc = concat!("```ignore\n", include_str!("../examples/spawn_and_remove.rs"), "```")]
//!
//! # Save, restore, and continue bit for bit
//!
//! `examples/save_and_restore.rs`
#![doc = concat!("```ignore\n", include_str!("../examples/save_and_restore.rs"), "```")]
//!
//! # Read-back without a stall
//!
//! `examples/read_back.rs`
#![doc = concat!("```ignore\n", include_str!("../examples/read_back.rs"), "```")]
