// The state of the list of neighbours: whether it must be built again, how often it has been, the most neighbours that any
// particle had, and the complement of the lowest id that had more than there is room for.
struct ListState { moved: atomic<u32>, builds: atomic<u32>, longest: atomic<u32>, full: atomic<u32> }

@group(2) @binding(10) var<storage, read_write> list_state: array<ListState>;
