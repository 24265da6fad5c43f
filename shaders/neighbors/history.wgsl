// History of pairs: a number of words for the n-th neighbour of row k, twice. One half holds the values at the start of the step, and the other
// those it writes; they are swapped in each step, so that an additional evaluation changes nothing.
override SLOTS: u32 = 1u;

fn pair_at(k: u32, n: u32) -> u32 { return n * 2u * SLOTS * world.capacity + k; }
fn word_of(pair: u32, half: u32, word: u32) -> u32 { return pair + ((half & 1u) * SLOTS + word) * world.capacity; }
