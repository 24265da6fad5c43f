// The demand of a group of targets, by the criterion or where it is not due.
@group(2) @binding(6) var<storage, read> tree_demand: array<f32>;
