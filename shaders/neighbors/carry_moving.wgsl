// The cell list's data for a law that reads velocities.
@group(2) @binding(6) var<storage, read_write> sorted_position: array<vec4f>;
@group(2) @binding(7) var<storage, read_write> sorted_velocity: array<vec4f>;

fn carry(i: u32, slot: u32) {
    sorted_position[slot] = vec4f(wrapped(position[i].xyz), position[i].w);
    sorted_velocity[slot] = velocity[i];
}
