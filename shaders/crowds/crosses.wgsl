// Whether a wall lies between two points.
struct Wall { a: vec2f, b: vec2f, ends: u32 }

fn side(along: vec2f, x: vec2f) -> f32 { return along.x * x.y - along.y * x.x; }

// A way that ends on a wall crosses it; one that begins on it does not.
fn crosses(wall: Wall, start: vec2f, end: vec2f) -> bool {
    let along = wall.b - wall.a;
    let before = side(along, start - wall.a);
    let after = side(along, end - wall.a);
    let one = side(end - start, wall.a - start);
    let other = side(end - start, wall.b - start);
    let leaves = (before > 0.0 && after <= 0.0) || (before < 0.0 && after >= 0.0);
    return leaves && ((one <= 0.0 && other >= 0.0) || (one >= 0.0 && other <= 0.0));
}
