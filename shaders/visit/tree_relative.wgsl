// A node is opened where G M l² / d⁴ > α a, with a the least last acceleration of any of the group (Springel 2005),
// and within l + s, a stored radius; within l / θ + s if a target has no acceleration yet. Here d is squared.
@group(2) @binding(6) var<storage, read> tree_demand: array<f32>; // G / (α a)

fn demand_of(group: u32) -> f32 { return tree_demand[group]; }

fn reaches(node: u32, d: f32, demand: f32) -> bool {
    let length = tree_shape[node].w;
    let reach = tree_center[node].w + select(0.0, tree.widened * length, demand == 0.0);
    // l² / d² is at most 1 here, so that nothing overflows.
    return d <= reach * reach || demand * tree_mass[node].w * (length * length / d) > d;
}
