// A node is opened within l / θ + s, a stored radius (Barnes & Hut 1986, Barnes 1994); d is squared.
fn demand_of(group: u32) -> f32 { return 0.0; }

fn reaches(node: u32, d: f32, demand: f32) -> bool {
    let reach = tree_center[node].w;
    return d <= reach * reach;
}
