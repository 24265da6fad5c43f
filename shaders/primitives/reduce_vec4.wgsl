// Items are vectors, reduced component by component.
alias Item = vec4f;

fn neutral(bits: u32) -> Item { return vec4f(bitcast<f32>(bits)); }

// NaN stays NaN: WGSL does not define min(NaN, x).
fn broken(item: Item) -> vec4<bool> { return (bitcast<vec4u>(item) & vec4u(0x7fffffffu)) > vec4u(0x7f800000u); }
fn unless_broken(result: Item, a: Item, b: Item) -> Item { return select(select(result, b, broken(b)), a, broken(a)); }
