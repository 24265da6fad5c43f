// An id stays with its particle; rows are reused.
@group(1) @binding(9) var<storage, read> id: array<u32>;

fn id_of(index: u32) -> u32 { return id[index]; }
