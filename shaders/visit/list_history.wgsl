// A law with history of pairs: words that it saves for the next step, in slots that outlive the list.
@group(2) @binding(9) var<storage, read_write> history: array<f32>;

const REMEMBERS: bool = true;

// The value stored by the last step; 0 where the pair was not in range then, or nothing was stored.
fn recall(you: Particle, word: u32) -> f32 {
    if word >= SLOTS { return beyond(word); }
    if you.pair == NONE { return 0.0; }
    return history[word_of(you.pair, world.step, word)];
}
