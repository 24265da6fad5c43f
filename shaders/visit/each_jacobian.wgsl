// The contribution of a law of single particles to its row: −(h² K + h D), its symmetric part, and h² K v at the start of the step.
// The law defines: fn jvp(me: Particle, dx: vec3f, dv: vec3f) -> vec3f, the change of acceleration when I move by dx and my
// velocity changes by dv.
@group(1) @binding(4) var<storage, read_write> rows: array<Row>;

override FACTOR: f32 = 1.0;
override START: bool = true;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn each_jacobian(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let me = particle(i);
        let h = FACTOR * world.dt;
        let square = h * h;
        let weight = rows[i].across.w;
        let x = weight * jvp(me, vec3f(square, 0.0, 0.0), vec3f(h, 0.0, 0.0));
        let y = weight * jvp(me, vec3f(0.0, square, 0.0), vec3f(0.0, h, 0.0));
        let z = weight * jvp(me, vec3f(0.0, 0.0, square), vec3f(0.0, 0.0, h));
        rows[i].diagonal -= vec4f(x.x, y.y, z.z, 0.0);
        rows[i].across -= vec4f(0.5 * (x.y + y.x), 0.5 * (y.z + z.y), 0.5 * (z.x + x.z), 0.0);
        if START { rows[i].image += vec4f(weight * jvp(me, square * velocity[i].xyz, vec3f()), 0.0); }
    }
}
