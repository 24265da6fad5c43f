// NaN and infinity have every bit of the exponent set. `x != x` will not do: compilers take it for false.
fn broken(v: vec4f) -> bool { return any((bitcast<vec4u>(v) & vec4u(0x7f800000u)) == vec4u(0x7f800000u)); }
