// The rows of the system, linearized about the current positions: mass, links, and h² K v at the start of the step.
// Laws of each particle alone add to its block afterwards.
@group(1) @binding(4) var<storage, read_write> rows: array<Row>;

override FACTOR: f32 = 1.0;
override START: bool = true;
const WORKGROUP: u32 = 64u;

fn direction(i: u32) -> vec3f { return velocity[i].xyz; }

@compute @workgroup_size(WORKGROUP)
fn solve_rows(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let me = particle(i);
        let weight = select(1.0, me.mass, me.mass > 0.0);
        let ties = expansion(me, FACTOR * world.dt);
        let way = select(select(ALONE, TIED, is_tied(i)), HELD, is_held(i));
        rows[i] = Row(
            vec4f(vec3f(weight), way),
            vec4f(vec3f(), weight),
            vec4f(ties.own, 0.0),
            vec4f(select(vec3f(), ties.pull, START), length(me.position)),
        );
    }
}
