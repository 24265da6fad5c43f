//! Visits: which pairs are evaluated. A law defines the interaction; a visit defines the pairs, and joins the law's WGSL with its own.

mod alone;
mod due;
mod each;
mod files;
mod jacobian;
mod law;
mod links;
mod list;
mod near;
mod over;
mod overlong;
mod pair_table;
mod pairs;
mod particle;
pub mod random;
mod reference;
mod result;
mod search;
mod tables;
mod tied;
mod tree;
mod turns;
mod two_words;
mod virial;
mod walk;

#[cfg(test)]
pub(crate) use alone::looks_at_own;
pub use due::rows as due_rows;
pub use jacobian::{Jacobian, ROW, ROWS};
pub use law::{Distant, Law, numbered};
pub use links::{LINK, LINK_START, bind};
pub use list::{Memory, UNCOUNTED, build as list_kernel, is_list, shared as shared_list};
pub use near::Candidate;
pub use over::{Loads, Over, few_neighbors};
pub use pair_table::{MOST_SPECIES, PAIR_TABLE, PairRow, PairTable};
pub use particle::{Particle, View};
pub use reference::{ByTables, Sample};
pub use result::{Cell, Outcome};
pub use search::{Outlined, Search, placed};
pub use tied::Tables;
pub(crate) use tied::Tied;
pub use tree::crossing;
pub use virial::{VIRIAL, clear as clear_virial, no_virial};
pub use walk::Group;
