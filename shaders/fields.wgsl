// Fields that a law may read. A name that it does not use is not bound.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(3) var<storage, read> species: array<u32>;

// Whether any axis is periodic.
override PERIODIC: bool = false;

// The shortest way to any image of where r leads (the minimum image).
fn shortest(r: vec3f) -> vec3f {
    if PERIODIC { return r - world.period * round(r * world.frequency); }
    return r;
}
