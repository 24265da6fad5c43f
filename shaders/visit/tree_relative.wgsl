// A node is opened where G M l² / d⁴ > α a, with a the least last acceleration of any of the group (Springel 2005),
// and within l + s, a stored radius; within l / θ + s if a target has no acceleration yet. Here d is squared.
@group(2) @binding(6) var<storage, read> tree_demand: array<f32>; // G / (α a)

fn demand_of(group: u32) -> f32 { return tree_demand[group]; }

struct Reach { radius: f32, length: f32, mass: f32 }

fn reach_of(node: u32, radius: f32) -> Reach { return Reach(radius, tree_shape[node].w, tree_mass[node].w); }

fn reaches(reach: Reach, d: f32, demand: f32) -> bool {
    let radius = reach.radius + select(0.0, tree.widened * reach.length, demand == 0.0);
    // l² / d² is at most 1 here, so that nothing overflows.
    return d <= radius * radius || demand * reach.mass * (reach.length * reach.length / d) > d;
}
