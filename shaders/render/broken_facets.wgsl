// Which facets are broken: those with a side whose spring has neither stiffness nor damping left.
struct Link { partner: u32, rest: f32, stiffness: f32, damping: f32 }

@group(1) @binding(5) var<storage, read> slot: array<u32>; // of each of a facet's three sides: its place among the links
@group(1) @binding(6) var<storage, read> link: array<Link>;
@group(1) @binding(7) var<storage, read_write> broken_facet: array<u32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn broken_facets(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < frame.facets {
        var result = 0u;
        for (var side = 3u * i; side < 3u * i + 3u; side += 1u) {
            if slot[side] != NONE {
                let one = link[slot[side]];
                if one.stiffness == 0.0 && one.damping == 0.0 { result = 1u; }
            }
        }
        broken_facet[i] = result;
    }
}
