// Who lives stands in a slot of the grid; slots behind them hold nobody.
override CELLS: u32 = 1u;

fn present() -> u32 { return starts[CELLS]; }
