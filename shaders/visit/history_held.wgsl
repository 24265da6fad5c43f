// What this step leaves of a pair is held in registers, and stored once: a law of few words. A particle is no pair with itself.
var<private> words_left: array<f32, 8>;

fn remember(you: Particle, word: u32, value: f32) {
    if word >= SLOTS { beyond(word); } else if you.pair != NONE { words_left[word] = value; }
}

// This step leaves nothing, until the law does.
fn forget(pair: u32) {
    for (var word = 0u; word < SLOTS; word += 1u) { words_left[word] = 0.0; }
}

fn keep(pair: u32) {
    for (var word = 0u; word < SLOTS; word += 1u) { history[word_of(pair, world.step + 1u, word)] = words_left[word]; }
}
