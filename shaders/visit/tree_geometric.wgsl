// A node is opened where the group may be nearer to it than l / θ + s, which it holds (Barnes & Hut 1986, Barnes 1994).
fn demand_of(group: u32) -> f32 { return 0.0; }

fn opens(node: u32, place: Place) -> bool {
    let center = tree_center[node];
    return apart(place, center.xyz) <= center.w * center.w;
}
