// Air on a triangle of cloth that moves through it with w = v − wind, by its face normal n, area A and cos α = ŵ · n:
// drag  −½ ρ |w| A C_D |cos α| w,  lift  −½ ρ |w|² A C_L cos α ( n − cos α ŵ ),  a third on each corner.
struct Params { unused_word: u32, wind: vec3f, density: f32, drag: f32, lift: f32, gust: f32, period: f32, wavelength: f32 }
struct Sum { force: vec3f }

@group(3) @binding(0) var<uniform> params: Params;

fn gather(me: Particle, corner: Corner, sum: ptr<function, Sum>) {
    let a = particle(corner.first);
    let b = particle(corner.second);
    let c = particle(corner.third);
    let ab = shortest(b.position - a.position);
    let ac = shortest(c.position - a.position);
    let twice = cross(ab, ac);
    let double = length(twice);
    let blows = length(params.wind);
    // Gusts travel downwind.
    var along = 0.0;
    if blows > 0.0 { along = dot(a.position, params.wind) / blows; }
    let phase = world.time / params.period - along / params.wavelength;
    let air = params.wind * (1.0 + params.gust * circle(phase).y);
    let w = (velocity_of(a) + velocity_of(b) + velocity_of(c)) / 3.0 - air;
    let speed = length(w);
    if !(double > 0.0 && speed > 0.0) { return; }
    let n = twice / double;
    let heading = w / speed;
    let cosine = dot(heading, n);
    let pressure = 0.5 * params.density * speed * speed * (0.5 * double);
    let drag = -params.drag * abs(cosine) * heading;
    let lift = -params.lift * cosine * (n - cosine * heading);
    (*sum).force += pressure * (drag + lift) / 3.0;
}

fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.force / me.mass, 0.0); }
