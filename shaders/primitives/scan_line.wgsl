// One workgroup scans all items, tile by tile: items[i] = sum of items[j] over j < i.
@compute @workgroup_size(WORKGROUP)
fn scan_line(@builtin(local_invocation_index) lane: u32) {
    var before = 0u;
    for (var start = 0u; start < extent.elements; start += TILE) {
        before = scan_tile(start, lane, before);
    }
}
