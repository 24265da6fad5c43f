// Three normal numbers out of four random words (Box & Muller 1958); in the plane the third is 0.
fn normals(words: vec4u, dimensions: u32) -> vec3f {
    // Above 0, and 1 at most; a driver's logarithm may be above 0 there.
    let uniform_numbers = (vec2f(words.xz >> vec2u(8u)) + 0.5) / 16777216.0;
    let radius = sqrt(max(-2.0 * log(uniform_numbers), vec2f()));
    let across = circle(fraction(words.w)).x;
    return vec3f(radius.x * circle(fraction(words.y)), select(0.0, radius.y * across, dimensions == 3u));
}
