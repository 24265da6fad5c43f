// Active particles are in slots of the cell list; later slots are empty.
override CELLS: u32 = 1u;

fn present() -> u32 { return starts[CELLS]; }
