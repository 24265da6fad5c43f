// Colours by heading, in Oklab (Ottosson 2020): with u = v / |v|  the point (L + D u_z, C u_x, C u_y), a ball inside of sRGB.
// The hue is the azimuth atan2(u_y, u_x), evenly all the way round; the lightness is the climb along z. At rest it is grey.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> velocity: array<vec4f>;        // xyz, radius
@group(1) @binding(1) var<storage, read_write> color: array<u32>;       // red, green, blue from the lowest byte on

const WORKGROUP: u32 = 64u;
const LIGHTNESS: f32 = 0.74;
const CLIMB: f32 = 0.13;
const CHROMA: f32 = 0.12;
// What is slower is at rest, and dims towards it.
const SLOWEST: f32 = 1e-30;

// By the largest component first: the squares of what is very fast or very slow do not fit.
fn heading(v: vec3f) -> vec3f {
    let w = v / max(max(abs(v.x), abs(v.y)), max(abs(v.z), SLOWEST));
    return w / sqrt(max(dot(w, w), 1.0));
}

fn srgb(x: f32) -> f32 { return 1.055 * pow(x, 1.0 / 2.4) - 0.055; }

fn oklab(l: f32, a: f32, b: f32) -> vec3f {
    let root = vec3f(
        l + 0.3963377774 * a + 0.2158037573 * b,
        l - 0.1055613458 * a - 0.0638541728 * b,
        l - 0.0894841775 * a - 1.2914855480 * b,
    );
    let lms = root * root * root;
    let red = 4.0767416621 * lms.x - 3.3077115913 * lms.y + 0.2309699292 * lms.z;
    let green = 2.6097574011 * lms.y - 1.2684380046 * lms.x - 0.3413193965 * lms.z;
    let blue = 1.7076147010 * lms.z - 0.0041960863 * lms.x - 0.7034186147 * lms.y;
    return vec3f(srgb(red), srgb(green), srgb(blue));
}

@compute @workgroup_size(WORKGROUP)
fn heading_color(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let v = velocity[i];
        var u = vec3f();
        if !broken(v) { u = heading(v.xyz); }
        color[i] = pack4x8unorm(vec4f(oklab(LIGHTNESS + CLIMB * u.z, CHROMA * u.x, CHROMA * u.y), 1.0));
    }
}
