//! motes
fn main() {}
