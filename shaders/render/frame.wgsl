// A picture's frame. A pinhole camera at distance d from the centre:  X = s x d / (d − z);  with d = 0 a parallel one:  X = s x
struct Frame {
    unused_word: u32,
    center: vec3f,
    distance: f32, // of the eye from the centre; 0 for parallel rays
    right: vec3f,
    scale: f32,    // pixels per length, at the centre
    up: vec3f,
    heaviest: f32, // the largest mass
    mean: f32,     // the mean mass
    back: vec3f,   // towards the eye
    marker: f32,   // radius at which the heaviest is drawn at least [pixels]
    width: u32,
    height: u32,
    largest: f32,  // radius at which a ball is drawn at most [pixels]
    solid: f32,    // radius from which on a particle is a ball, and below it a light [pixels]
    glow: f32,     // radius of a light [pixels]
    magnified: f32, // how much larger balls are drawn than they are
    unit: f32,     // the centre of a white light, on the canvas
    slow: f32,     // speeds at the ends of the colours
    fast: f32,
    points: u32,   // of all trails together
    sky: f32,      // brightness of a night; else the number of a background
    line: f32,     // half the width of a trail [pixels]
    bloom: f32,    // brightness of the bloom
    reach: u32,    // of the bloom [pixels of it]
    tail: f32,     // how long ago a stroke of light begins [time]
    bleach: f32,   // how white the brightest lights become
    ink: f32,      // how far particles darken a bright sky; 0 for lights in a dark one
    tint: f32,     // brightness of ink
    fine: u32,     // samples of a pixel each way, where surfaces, lines and solids are drawn
    thread: f32,   // half the width of a line [pixels]
    triangles: u32,
    facets: u32,   // triangles, and lines after them
    solids: u32,
    lamp: f32,     // half the height of what the lamp sees [length]
    map: u32,      // pixels of what the lamp sees, each way
    slab: f32,     // what is farther from the centre, towards the eye or away from it, is not drawn [length]
    drop: f32,     // radius at which a particle is drawn at least; of a fluid that of its drops [length]
    oblate: f32,   // depth of a drop's rim behind its front [drop]
    grain: f32,    // parts in which the thickness of a drop is counted
    layer: f32,    // thickness that one of those stands for [length]
    absorption: f32,     // how much a fluid absorbs [1 / length]
    stain: f32,    // how much less of its own colour
    foam: f32,     // the speed from which on it is white
    range: f32,    // how much farther and nearer the same surface may be, and how wide it is made smooth [drop]
    calm: f32,
    farthest: u32, // of the latter at most [pixels]
    gloss: f32,    // how bright a sky it mirrors
    soft: u32,     // how wide its outline is made smooth, and that of many drops in space [pixels]
    softer: u32,
    turn: f32,     // how far normals turn outwards at an outline: 1, or 0 in a plane
    left: f32,     // the box of a fluid in a plane [pixels]
    right_end: f32,
    top: f32,
    bottom: f32,
    wrap_across: u32, // where it is periodic, how wide and high it is; else 0 [pixels]
    wrap_down: u32,
    wire: f32,     // half the width of a tank's edge [pixels]
    edges: u32,
}
@group(3) @binding(0) var<uniform> frame: Frame;

const NONE: u32 = 0xffffffffu;
// Nearer to the eye than this part of its distance nothing is seen.
const NEAR: f32 = 0.05;
// What is so many pixels away is out of the picture; further on integers would end.
const FAR_OUT: f32 = 1e6;

struct Seen { place: vec2f, depth: f32, scale: f32, visible: bool }

// The position of a point in the picture; `depth` grows away from the eye, `scale` is in pixels per length there.
fn see(p: vec3f) -> Seen {
    let r = p - frame.center;
    let z = dot(frame.back, r);
    let depth = frame.distance - z;
    var scale = frame.scale;
    var visible = true;
    if frame.distance > 0.0 {
        visible = depth > NEAR * frame.distance;
        scale *= frame.distance / max(depth, NEAR * frame.distance);
    }
    let half = 0.5 * vec2f(f32(frame.width), f32(frame.height));
    let place = half + scale * vec2f(dot(frame.right, r), -dot(frame.up, r));
    visible = visible && abs(z) <= frame.slab;
    visible = visible && abs(place.x) < FAR_OUT && abs(place.y) < FAR_OUT;
    return Seen(place, depth, scale, visible);
}

// Pixels that something may touch, those at `high` not included.
struct Box { low: vec2i, high: vec2i }

fn box(place: vec2f, reach: f32) -> Box {
    let size = vec2i(i32(frame.width), i32(frame.height));
    let low = clamp(vec2i(floor(place - reach)), vec2i(0), size);
    return Box(low, clamp(vec2i(ceil(place + reach)), low, size));
}

fn pixel(x: i32, y: i32) -> u32 { return u32(y) * frame.width + u32(x); }

// The middle of a pixel.
fn middle(x: i32, y: i32) -> vec2f { return vec2f(f32(x), f32(y)) + 0.5; }

// Integers in the order of depths, those below 0 too.
fn key(depth: f32) -> u32 {
    let bits = bitcast<u32>(depth);
    let negative = bits >= 0x80000000u;
    return select(bits | 0x80000000u, ~bits, negative);
}

// NaN and infinity have every bit of the exponent set. `x != x` will not do: compilers take it for false.
fn broken(v: vec4f) -> bool { return any((bitcast<vec4u>(v) & vec4u(0x7f800000u)) == vec4u(0x7f800000u)); }
