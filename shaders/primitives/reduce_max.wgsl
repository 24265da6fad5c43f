// The maximum.
fn combine(a: Item, b: Item) -> Item { return unless_broken(max(a, b), a, b); }
