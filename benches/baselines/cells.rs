//! A counting sort by cell in plain Rust, as the baselines of searches have it.

/// Where each cell's particles begin, one more than there are cells; and their ids, cell by cell.
pub fn sorted(keys: &[u32], cells: usize) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0u32; cells + 1];
    for k in keys {
        starts[*k as usize + 1] += 1;
    }
    for c in 1..starts.len() {
        starts[c] += starts[c - 1];
    }
    let mut next = starts.clone();
    let mut ids = vec![0u32; keys.len()];
    for (i, k) in (0u32..).zip(keys) {
        ids[next[*k as usize] as usize] = i;
        next[*k as usize] += 1;
    }
    (starts, ids)
}
