// One sweep over springs that are longer than (1 + s) L: both ends move towards each other, weighted by inverse mass, so that
// the centre of mass is fixed:  Δxᵢ = Σ wᵢ / (wᵢ + wⱼ) (l − (1 + s) L) u / n,  w = 1 / m, n the larger number of springs of the two.
@group(1) @binding(2) var<storage, read_write> limited: array<vec4f>; // xyz where to, mass

override STRAIN: f32 = 0.1;
const WORKGROUP: u32 = 64u;

fn lightness(particle: Particle) -> f32 { return select(1.0 / particle.mass, 0.0, is_held(particle.index)); }

fn springs_of(id: u32) -> f32 {
    let links = links_of(id);
    return f32(links.end - links.first);
}

@compute @workgroup_size(WORKGROUP)
fn strain_limit(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count { return; }
    let me = particle(i);
    let mine = lightness(me);
    let springs = springs_of(i);
    var change = vec3f();
    let links = links_of(i);
    for (var k = links.first; k < links.end; k += 1u) {
        let one = link_at(links, k);
        let you = particle(one.partner);
        let r = shortest(you.position - me.position);
        let l = length(r);
        let rest = abs(one.rest);
        let excess = l - (1.0 + STRAIN) * rest;
        // Springs of rest length 0 have no strain, and broken springs do not act.
        let tied = rest > 0.0 && (one.stiffness > 0.0 || one.damping > 0.0);
        let strained = excess > 0.0;
        if tied && strained && mine > 0.0 {
            let part = mine / (mine + lightness(you));
            change += (part * excess / (l * max(springs, springs_of(one.partner)))) * r;
        }
    }
    limited[i] = vec4f(me.position + change, me.mass);
}
