// Three normal numbers out of four random words (Box & Muller 1958); in the plane the third is 0.
fn normals(words: vec4u, dimensions: u32) -> vec3f {
    const TAU: f32 = 6.283185307;
    // Above 0, below 1.
    let uniform_numbers = (vec2f(words.xz >> vec2u(8u)) + 0.5) / 16777216.0;
    let radius = sqrt(-2.0 * log(uniform_numbers));
    let angle = TAU * (vec2f(fraction(words.y), fraction(words.w)) - 0.5);
    return vec3f(radius.x * cos(angle.x), radius.x * sin(angle.x), select(0.0, radius.y * cos(angle.y), dimensions == 3u));
}
