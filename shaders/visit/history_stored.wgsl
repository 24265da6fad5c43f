// What this step leaves of a pair is stored as the law says it: a law of more words than registers should hold. A particle is no pair with itself.
fn remember(you: Particle, word: u32, value: f32) {
    if word >= SLOTS { beyond(word); } else if you.pair != NONE { history[word_of(you.pair, world.step + 1u, word)] = value; }
}

// This step stores nothing, until the law does.
fn forget(pair: u32) {
    for (var word = 0u; word < SLOTS; word += 1u) { history[word_of(pair, world.step + 1u, word)] = 0.0; }
}

fn store_history(pair: u32) {}
