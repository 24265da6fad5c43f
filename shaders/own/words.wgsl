// A law that computes which words of a pair's history it names: it says where one lies beyond its slots.
// word 11 of the alarm: the complement of the highest such word
fn beyond(word: u32) -> f32 {
    atomicMin(&alarm[11], ~word);
    return 0.0;
}
