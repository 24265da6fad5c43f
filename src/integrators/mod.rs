//! Integrators (a stand-in until the real register lands).

/// An integrator.
pub trait Integrator {}

/// An integrator of the register.
pub struct Entry {
    /// The scene's word for it.
    pub name: &'static str,
    /// One line.
    pub about: &'static str,
    /// Makes it.
    pub build: fn() -> Box<dyn Integrator>,
}

struct Stub;
impl Integrator for Stub {}

macro_rules! stubs {
    ($($name:literal),*) => { &[$(Entry { name: $name, about: "", build: || Box::new(Stub) }),*] };
}

/// All integrators.
pub const INTEGRATORS: &[Entry] =
    stubs!["forward_euler", "symplectic_euler", "leapfrog", "midpoint", "heun", "rk4", "forest_ruth", "pefrl"];
