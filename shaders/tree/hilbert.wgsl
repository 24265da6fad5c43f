// The position of a cell along the Hilbert curve through 2²¹ cells along each axis (J. Skilling, Programming the Hilbert curve, AIP
// Conf. Proc. 707, 381, 2004): 63 bits, the upper 32 and the lower 31.

const BITS: u32 = 21u;
const CELLS: u32 = 1u << BITS;

// Turns the first axis and another at one level: where the other's bit is set, the first runs backwards below it;
// elsewhere the two are exchanged.
fn turned(first: u32, other: u32, bit: u32) -> vec2u {
    let below = bit - 1u;
    let exchange = (first ^ other) & below;
    return select(vec2u(first ^ exchange, other ^ exchange), vec2u(first ^ below, other), (other & bit) != 0u);
}

// Ten bits of each, each to every third place.
fn spread(x: vec3u) -> vec3u {
    var y = x & vec3u(0x3ffu);
    y = (y | (y << vec3u(16u))) & vec3u(0x30000ffu);
    y = (y | (y << vec3u(8u))) & vec3u(0x300f00fu);
    y = (y | (y << vec3u(4u))) & vec3u(0x30c30c3u);
    return (y | (y << vec3u(2u))) & vec3u(0x9249249u);
}

// Thirty bits, those of x first.
fn woven(x: vec3u) -> u32 {
    let y = spread(x);
    return (y.x << 2u) | (y.y << 1u) | y.z;
}

fn hilbert(cell: vec3u) -> vec2u {
    var x = cell;
    for (var bit = 1u << (BITS - 1u); bit > 1u; bit >>= 1u) {
        x.x = select(x.x, x.x ^ (bit - 1u), (x.x & bit) != 0u);
        let y = turned(x.x, x.y, bit);
        let z = turned(y.x, x.z, bit);
        x = vec3u(z.x, y.y, z.y);
    }
    // Gray's code; of each bit, whether the last axis has an odd number of bits above it.
    x.y ^= x.x;
    x.z ^= x.y;
    var odd = x.z >> 1u;
    odd ^= odd >> 1u;
    odd ^= odd >> 2u;
    odd ^= odd >> 4u;
    odd ^= odd >> 8u;
    odd ^= odd >> 16u;
    x ^= vec3u(odd);
    // Bit 10 of the last axis is the 31st.
    let middle = (x >> vec3u(10u)) & vec3u(1u);
    let upper = (woven(x >> vec3u(11u)) << 2u) | (middle.x << 1u) | middle.y;
    return vec2u(upper, (middle.z << 30u) | woven(x));
}
