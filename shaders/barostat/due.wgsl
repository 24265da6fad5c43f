// Indirect arguments of the dispatches that measure the pressure: all their workgroups at the end of every so many steps, or none.
@group(0) @binding(0) var<uniform> world: World;
@group(2) @binding(0) var<storage, read_write> pressure_go: array<u32>;
@group(2) @binding(1) var<storage, read> pressure_all: array<u32>;

override EVERY: u32 = 1u;
override WORDS: u32 = 0u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn due(@builtin(local_invocation_index) lane: u32) {
    let now = (world.step + 1u) % EVERY == 0u;
    for (var n = lane; n < WORDS; n += WORKGROUP) { pressure_go[n] = select(0u, pressure_all[n], now); }
}
