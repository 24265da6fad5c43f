// The clock of a step's parts, in parts of dt / 2^LEVELS: where the present part begins and ends, whether that is the end of the step, and the
// largest level of any particle. Then the first step in which a particle required a larger level than there is, the lowest id of such a
// particle, and the level. Then the number of parts so far, and of evaluations of a particle, each in two words, the lower one first.
struct BlockClock {
    start: u32, now: u32, done: u32, finest: u32,
    step: u32, particle: u32, level: u32,
    parts: u32, more_parts: u32, evaluations: u32, more_evaluations: u32,
}
