// The number of nodes on a level, by its height above the leaves: only rows in use have leaves.
override LEAF: u32;

fn nodes_of(above: u32) -> u32 { return ((world.count + LEAF - 1u) / LEAF + (1u << above) - 1u) >> above; }
