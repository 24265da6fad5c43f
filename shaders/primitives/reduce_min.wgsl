// The minimum.
fn combine(a: Item, b: Item) -> Item { return unless_broken(min(a, b), a, b); }
