// A node is opened where G M l² / d⁴ > α a, with a the least acceleration that any of the group felt last (Springel 2005), or
// where d ≤ l + s, which it holds; where one has felt nothing yet, where d ≤ l / θ + s.
@group(2) @binding(6) var<storage, read> tree_demand: array<f32>; // G / (α a)

fn demand_of(group: u32) -> f32 { return tree_demand[group]; }

fn opens(node: u32, place: Place) -> bool {
    let center = tree_center[node];
    let length = tree_shape[node].w;
    let d = apart(place, center.xyz);
    let reach = center.w + select(0.0, tree.widened * length, place.demand == 0.0);
    // l² / d² is at most 1 here, so that nothing overflows.
    return d <= reach * reach || place.demand * tree_mass[node].w * (length * length / d) > d;
}
