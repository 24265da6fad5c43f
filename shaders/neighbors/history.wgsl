// History of pairs: so many words for the n-th neighbour of row k, twice. One half holds what the step began with, and the other
// what it leaves; they change places with each step, so that an evaluation more or less changes nothing.
override SLOTS: u32 = 1u;

fn pair_at(k: u32, n: u32) -> u32 { return n * 2u * SLOTS * world.capacity + k; }
fn word_of(pair: u32, half: u32, word: u32) -> u32 { return pair + ((half & 1u) * SLOTS + word) * world.capacity; }
