// The vertices of facets: their projected positions, and the surface normal there,  n = Σ (b − a) × (c − a)  over the triangles
// around it (Gouraud 1971); along a line its direction,  Σ (b − a).  In the picture's axes: right, up, towards the eye.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;      // xyz, mass
@group(1) @binding(4) var<storage, read> facet: array<u32>;           // three ids; of a line the third is NONE
@group(1) @binding(7) var<storage, read> broken_facet: array<u32>;
@group(1) @binding(8) var<storage, read> around_start: array<u32>;    // one for each particle, and the end
@group(1) @binding(9) var<storage, read> around: array<u32>;          // facets
@group(3) @binding(11) var<storage, read_write> vertex: array<vec4f>; // pixels right and down, flat depth, 1 if seen; normal, 0

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn vertices(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        var place = vec4f();
        let seen = see(position[i].xyz);
        if seen.visible && !broken(position[i]) { place = vec4f(seen.place, flat_depth(seen.depth), 1.0); }
        var sum = vec3f();
        let end = around_start[i + 1u];
        for (var k = around_start[i]; k < end; k += 1u) {
            let t = around[k];
            let a = position[facet[3u * t]].xyz;
            var part = position[facet[3u * t + 1u]].xyz - a;
            let third = facet[3u * t + 2u];
            if third != NONE { part = cross(part, position[third].xyz - a); }
            if broken_facet[t] == 0u && !broken(vec4f(part, 1.0)) { sum += part; }
        }
        let turned = vec3f(dot(sum, frame.right), dot(sum, frame.up), dot(sum, frame.back));
        vertex[2u * i] = place;
        vertex[2u * i + 1u] = vec4f(turned / max(length(turned), 1e-30), 0.0);
    }
}
