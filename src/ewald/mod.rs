//! Sums over all images of a periodic box (Ewald 1921): a law between two that ends at some distance, and a smooth rest that is a sum over the
//! Fourier modes of the box. Masses in a cube, and charges in any box.

mod charges;
mod masses;
mod split;
mod waves;

pub use charges::Charges;
pub use masses::{fits, group, growing, grown, kernels, pair};
pub use split::{FITTED, LEAST, Split};
pub use waves::{CHARGE_WAVE, NUMBER};
