// What this step leaves of a pair is held in registers, and stored once: a law of few words. A particle is no pair with itself.
var<private> history_words: array<f32, 8>;

fn remember(you: Particle, word: u32, value: f32) {
    if word >= SLOTS { beyond(word); } else if you.pair != NONE { history_words[word] = value; }
}

// This step leaves nothing, until the law does.
fn forget(pair: u32) {
    for (var word = 0u; word < SLOTS; word += 1u) { history_words[word] = 0.0; }
}

fn store_history(pair: u32) {
    for (var word = 0u; word < SLOTS; word += 1u) { history[word_of(pair, world.step + 1u, word)] = history_words[word]; }
}
