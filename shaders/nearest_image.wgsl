// The displacement to the nearest image (minimum image convention), for kernels that do not bind what `fields.wgsl` does; an open axis has period 0.
fn nearest_image(r: vec3f) -> vec3f { return r - world.period * round(r * world.frequency); }
