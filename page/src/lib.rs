//! The viewer of motes in a browser. The page's script opens it on a canvas, gives it scenes, and shows what it says.

#[cfg(target_arch = "wasm32")]
mod exports;
#[cfg(target_arch = "wasm32")]
mod shell;
#[cfg(target_arch = "wasm32")]
mod viewer;
