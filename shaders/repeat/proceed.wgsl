// Starts the next iteration of a loop: it gets the workgroups of all its dispatches, unless the flag is set. They are its indirect
// arguments, also for this very kernel: an iteration that is not needed dispatches nothing, and neither do those after it.
@group(0) @binding(0) var<storage, read> flag: array<u32>;
@group(0) @binding(1) var<storage, read> workgroups: array<u32>;
@group(0) @binding(2) var<storage, read_write> arguments: array<u32>;
@group(0) @binding(3) var<storage, read_write> iterations: array<u32>;

// The word of the flag, and the words of the arguments of an iteration.
override WORD: u32;
override WORDS: u32;

@compute @workgroup_size(1)
fn proceed() {
    // Iterations alternate between two argument buffers: none writes the one from which it is dispatched.
    let first = iterations[0] / 2u * WORDS;
    iterations[0] += 1u;
    if flag[WORD] == 0u {
        for (var k = 0u; k < WORDS; k += 1u) { arguments[first + k] = workgroups[k]; }
    }
}
