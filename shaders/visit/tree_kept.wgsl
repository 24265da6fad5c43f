// Some adapters end the loops of an invocation after so many iterations. A walk stops before that, saves the sums of its targets
// and its position in the tree, and continues in a later dispatch.
struct Kept { sum: Sum, at: u32 }

// For each target of a dispatch. Where all is done, `at` says 0 for the node that comes next.
@group(2) @binding(7) var<storage, read_write> tree_kept: array<Kept>;

// Turns that all loops of an invocation may take in a dispatch.
override MOST: u32;
