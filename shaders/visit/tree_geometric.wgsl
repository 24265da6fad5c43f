// A node is opened within l / θ + s, a stored radius (Barnes & Hut 1986, Barnes 1994); d is squared.
fn demand_of(group: u32) -> f32 { return 0.0; }

struct Reach { radius: f32 }

fn reach_of(node: u32, radius: f32) -> Reach { return Reach(radius); }

fn reaches(reach: Reach, d: f32, demand: f32) -> bool { return d <= reach.radius * reach.radius; }
