// The sum.
fn combine(a: Item, b: Item) -> Item { return a + b; }
