// A linear solve begins at Δv = 0, with the residual b = h M a + h² K v₀ where the step begins (Baraff & Witkin 1998), and
// b = M (v₀ − v) + h M a at the later iterates of Newton's method. Particles without links are solved at once.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>;
@group(1) @binding(2) var<storage, read> acceleration: array<vec4f>;
@group(1) @binding(3) var<storage, read> start_velocity: array<vec4f>;
@group(1) @binding(4) var<storage, read_write> rows: array<Row>;
@group(2) @binding(2) var<storage, read_write> residuals: array<Residual>;
@group(2) @binding(3) var<storage, read_write> directions: array<Direction>;
@group(2) @binding(5) var<storage, read> solve_state: array<State>;
@group(2) @binding(6) var<storage, read_write> solve_next: array<State>;

override FACTOR: f32 = 1.0;
override START: bool = true;
const RESOLUTION: f32 = 2e-8;
const WORKGROUP: u32 = 64u;

// Solves a symmetric system of three by L D Lᵀ.
fn solved(row: Row, b: vec3f) -> vec3f {
    let xx = row.diagonal.x;
    let l = row.across.xz / xx;
    let yy = row.diagonal.y - l.x * row.across.x;
    let yz = row.across.y - l.x * row.across.z;
    let zz = row.diagonal.z - l.y * row.across.z - yz * yz / yy;
    let y = b.y - l.x * b.x;
    let z = (b.z - l.y * b.x - yz / yy * y) / zz;
    let v = (y - yz * z) / yy;
    return vec3f(b.x / xx - l.x * v - l.y * z, v, z);
}

@compute @workgroup_size(WORKGROUP)
fn solve_begin(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    let before = solve_state[0];
    let settled = !START && before.settled > 0.0;
    if i == 0u {
        var after = State();
        if !START {
            after.first = before.first;
            after.total = before.total;
            after.broken = before.broken;
        }
        if settled { after = before; }
        solve_next[0] = after;
    }
    if i < world.count && !settled {
        let row = rows[i];
        let way = row.diagonal.w;
        let weight = row.across.w;
        let push = (FACTOR * world.dt * weight) * acceleration[i].xyz;
        var due = row.image.xyz;
        if !START { due = weight * (start_velocity[i].xyz - velocity[i].xyz); }
        let whole = row.diagonal.xyz + row.inverse.xyz;
        // A change that moves no particle by a part of the last place of its position is rounding, which no iterate removes.
        let noise = length(whole) * row.image.w * RESOLUTION;
        let lost = !START && length(push + due) * FACTOR * world.dt <= noise;
        let b = select(push + due, vec3f(), way == HELD || lost);
        let inverse = select(vec3f(), 1.0 / whole, way == TIED);
        rows[i].inverse = vec4f(inverse, 0.0);
        residuals[i] = Residual(vec4f(inverse * b, 0.0), vec4f(b, 0.0));
        directions[i] = Direction(vec4f(), vec4f(), vec4f(select(vec3f(), solved(row, b), way == ALONE), 0.0));
    }
}
