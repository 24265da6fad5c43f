// Rows that are in use have leaves: so many nodes exist on a level, which is so many above that of the leaves.
override LEAF: u32;

fn nodes_of(above: u32) -> u32 { return ((world.count + LEAF - 1u) / LEAF + (1u << above) - 1u) >> above; }
