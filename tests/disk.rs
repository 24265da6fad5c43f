//! The disk galaxy: its profiles, its balance in every direction, and that it stays a disk when it runs.

use glam::DVec3;
use motes::particles::{Particles, shape};
use motes::settings::{Settings, Value};
use rayon::prelude::*;

const SOFTENING: f64 = 0.05;

fn galaxy(values: &[(&'static str, f64)]) -> Particles {
    let disk = shape("disk").expect("the disk");
    let start = Settings::defaults(disk.keys).with("softening", Value::Number(SOFTENING));
    let settings = values.iter().fold(start, |all, (key, x)| all.with(key, Value::Number(*x)));
    (disk.build)(&settings).expect("good settings")
}

fn accelerations(p: &Particles) -> Vec<DVec3> {
    (0..p.len())
        .into_par_iter()
        .map(|i| {
            let mut a = DVec3::ZERO;
            for j in 0..p.len() {
                let r = p.position[j] - p.position[i];
                let inverse = 1.0 / (r.length_squared() + SOFTENING * SOFTENING).sqrt();
                a += r * (p.mass[j] * inverse * inverse * inverse);
            }
            a
        })
        .collect()
}

#[test]
fn probe() {
    let n = 8000;
    for (q, h) in [(1.2, 6.0)] {
    let p = galaxy(&[("count", f64::from(n)), ("toomre_q", q), ("halo_mass", h)]);
    let nd = if h > 0.0 {2000} else {8000};
    let a = accelerations(&p);
    for (name, range) in [("disk", 0..nd), ("halo", nd..8000)] {
        let (mut k, mut w) = (DVec3::ZERO, DVec3::ZERO);
        for i in range {
            k += p.velocity[i] * p.velocity[i];
            w -= p.position[i] * a[i];
        }
        eprintln!("h {h} {name}: 2K/W {}  R {}", k / w, (k.x + k.y) / (w.x + w.y));
    }
    for bin in 0..8 {
        let (lo, hi) = (f64::from(bin) * 0.5, f64::from(bin) * 0.5 + 0.5);
        let (mut s, mut c, mut vphi, mut vr2, mut vz2, mut z, mut wz) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0,0.0);
        for i in 0..nd {
            let r = p.position[i].truncate();
            if (lo..hi).contains(&r.length()) {
                c += 1.0;
                s -= a[i].truncate().dot(r);
                vphi += p.velocity[i].truncate().dot(r.perp().normalize());
                vr2 += p.velocity[i].truncate().dot(r.normalize()).powi(2);
                vz2 += p.velocity[i].z.powi(2);
                wz -= p.velocity[i].z * 0.0 + a[i].z * p.position[i].z;
                z += p.position[i].z.abs();
            }
        }
        eprintln!("R {:.2}: n {c} vc {:.4} vphi {:.4} sR {:.4} sz {:.4} wz {:.4} z {:.4}", lo + 0.25, (s / c).sqrt(), vphi / c, (vr2 / c).sqrt(), (vz2 / c).sqrt(), (wz/c).sqrt(), z / c);
    }
    let mut p = p;
    let dt = 0.05;
    let mut a = a;
    for step in 0..=600 {
        if step % 100 == 0 {
            let mut r: Vec<f64> = p.position[..nd].iter().map(|x| x.truncate().length()).collect();
            r.sort_by(f64::total_cmp);
            let mut rh: Vec<f64> = p.position[nd..].iter().map(|x| x.length()).collect();
            rh.sort_by(f64::total_cmp);
            let z = p.position[..nd].iter().map(|x| x.z.abs()).collect::<Vec<_>>();
            let mut zs = z.clone(); zs.sort_by(f64::total_cmp);
            let nh = rh.len();
            eprintln!("t {:.1} R25 {:.3} R50 {:.3} R75 {:.3} R90 {:.3} z50 {:.4} z90 {:.4} halo {:?}", f64::from(step) * dt, r[nd / 4], r[nd / 2], r[3 * nd / 4], r[nd * 9 / 10], zs[nd / 2], zs[nd*9/10],
               if nh > 0 { [rh[nh/10], rh[nh/4], rh[nh / 2], rh[3*nh/4], rh[nh*9/10]] } else {[0.0;5]});
        }
        for i in 0..p.len() { p.velocity[i] += a[i] * (0.5 * dt); p.position[i] += p.velocity[i] * dt; }
        a = accelerations(&p);
        for i in 0..p.len() { p.velocity[i] += a[i] * (0.5 * dt); }
    }
    }
}
