// Items are integers; sums wrap at 2³².
alias Item = u32;

fn neutral(bits: u32) -> Item { return bits; }
fn unless_broken(result: Item, a: Item, b: Item) -> Item { return result; }
