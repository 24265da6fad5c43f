// FIRE (Bitzek et al. 2006), by semi-implicit steps (Guénolé et al. 2020). With s the length of a step in units of dt, and u = s v, by which
// positions drift over dt:
//   downhill, u · a > 0:  s grows after a while, and α decays;  uphill:  s is halved, u = 0, α is what it was
//   w = u s' / s + s'² a dt,  u ← (1 − α) w + α |w| a / |a|  as  keep u + push a,  with sums weighted by masses
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> minimize_total: array<vec4f>;   // m u², m u · a, m a²
@group(1) @binding(1) var<storage, read> minimize_largest: array<vec4f>; // w: F²
@group(1) @binding(2) var<storage, read_write> minimize_length: array<f32>;
@group(1) @binding(3) var<storage, read_write> minimize_mixing: array<f32>;
@group(1) @binding(4) var<storage, read_write> minimize_downhill: array<u32>;
@group(1) @binding(5) var<storage, read_write> minimize_force: array<f32>;
@group(1) @binding(6) var<storage, read_write> minimize_change: array<vec4f>; // keep, push

override TOLERANCE: f32 = 1.0;
override LONGEST: f32 = 1.0;
const SHORTEST: f32 = 0.02;
const MIXING: f32 = 0.1;
const PATIENCE: u32 = 5u;
// Beyond it sums are not finite: a start with overlaps.
const LARGEST: f32 = 1e37;

@compute @workgroup_size(1)
fn minimize() {
    let total = minimize_total[0];
    let force = sqrt(minimize_largest[0].w);
    var keep = 0.0;
    var push = 0.0;
    if force > TOLERANCE {
        let before = minimize_length[0];
        var now = before;
        var alpha = minimize_mixing[0];
        let downhill = total.y > 0.0 && total.z < LARGEST;
        if downhill {
            if minimize_downhill[0] >= PATIENCE {
                now = min(1.1 * now, LONGEST);
                alpha *= 0.99;
            }
            minimize_downhill[0] += 1u;
            keep = now / before;
        } else {
            now = max(0.5 * now, SHORTEST);
            alpha = MIXING;
            minimize_downhill[0] = 0u;
        }
        push = now * now * world.dt;
        if downhill {
            let square = keep * keep * total.x + 2.0 * keep * push * total.y + push * push * total.z;
            keep *= 1.0 - alpha;
            push = (1.0 - alpha) * push + alpha * sqrt(square / total.z);
        }
        minimize_length[0] = now;
        minimize_mixing[0] = alpha;
    }
    minimize_force[0] = force;
    minimize_change[0] = vec4f(keep, push, 0.0, 0.0);
}
