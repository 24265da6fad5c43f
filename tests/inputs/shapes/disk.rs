//! The disk galaxy: its profiles, its balance in every direction, and that it stays a disk when it runs.

use glam::DVec3;
use motes::State;
use motes::settings::{Settings, Value};
use motes::shapes::shape;
use rayon::prelude::*;

const SOFTENING: f64 = 0.05;

fn galaxy(values: &[(&'static str, Value)]) -> State {
    let disk = shape("disk").expect("the disk");
    let start = Settings::defaults(disk.keys).with("softening", Value::Number(SOFTENING));
    let settings = values.iter().fold(start, |all, (key, value)| all.with(key, value.clone()));
    (disk.build)(&settings).expect("good settings")
}

/// Direct sum, G = 1, Plummer softening.
fn accelerations(p: &State) -> Vec<DVec3> {
    (0..p.len())
        .into_par_iter()
        .map(|i| {
            let mut a = DVec3::ZERO;
            for (x, m) in p.position().iter().zip(p.mass()) {
                let r = *x - p.position()[i];
                let inverse = 1.0 / (r.length_squared() + SOFTENING * SOFTENING).sqrt();
                a += r * (m * inverse * inverse * inverse);
            }
            a
        })
        .collect()
}

fn quantile(values: impl Iterator<Item = f64>, share: f64) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a few thousand"
    )]
    sorted[(share * sorted.len() as f64) as usize]
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (n, sum) = values.fold((0.0, 0.0), |(n, sum), x| (n + 1.0, sum + x));
    sum / n
}

#[track_caller]
fn close(what: &str, got: f64, wanted: f64, relative: f64) {
    assert!((got / wanted - 1.0).abs() < relative, "{what}: {got} is not {wanted} within {relative}");
}

#[test]
fn the_profiles_are_exponential_sech_and_hernquist() {
    let p = galaxy(&[("count", Value::Number(40_000.0)), ("halo_fraction", Value::Number(0.5))]);
    let (disk, halo) = p.position().split_at(20_000);
    // Quantiles of R e^-R, and of |z| under sech²(z / 0.2). The standard error of a quantile is √(q(1 - q) / n) / density,
    // below 0.7 % of each of these; four of them.
    for (share, radius) in [(0.1, 0.531_812), (0.5, 1.678_347), (0.9, 3.889_720)] {
        close("R", quantile(disk.iter().map(|x| x.truncate().length()), share), radius, 0.03);
    }
    for (share, height) in [(0.5, 0.109_861), (0.9, 0.294_444)] {
        close("z", quantile(disk.iter().map(|x| x.z.abs()), share), height, 0.03);
    }
    // r = a √u / (1 - √u) with √u up to 10/11, a = 3.
    for (share, radius) in [(0.1, 1.210_407), (0.5, 5.399_229), (0.9, 18.808_564)] {
        close("r", quantile(halo.iter().map(|x| x.length()), share), radius, 0.05);
    }
    assert_eq!((p.mass()[0], p.mass()[20_000]), (1.0 / 20_000.0, 6.0 / 20_000.0));
}

#[test]
fn it_turns_and_is_as_warm_as_the_textbook_says() {
    let p = galaxy(&[
        ("count", Value::Number(60_000.0)),
        ("halo_fraction", Value::Number(0.2)),
        ("softening", Value::Number(0.0)),
    ]);
    // Freeman's disk less 2π G Σ z₀ R / R_d for its thickness, a cut Hernquist halo, κ from their slope, σ_R from Q = 1.2 and
    // the rotation from the radial Jeans equation: computed apart, with another Bessel library.
    for (radius, rotation, dispersion) in
        [(1.0, 0.788_251, 0.177_712), (2.0, 0.928_203, 0.121_883), (3.0, 0.950_411, 0.072_173)]
    {
        let ring: Vec<(f64, f64)> = (0..48_000)
            .filter(|i| (p.position()[*i].truncate().length() - radius).abs() < 0.1)
            .map(|i| {
                let out = p.position()[i].truncate().normalize();
                (p.velocity()[i].truncate().dot(out.perp()), p.velocity()[i].truncate().dot(out))
            })
            .collect();
        // Some 2 000 stars each: 0.2 σ / √n of the rotation, and 1 / √2n = 1.6 % of the dispersion; and thickness to second
        // order, (0.2 / R)² of the disk's part.
        close("rotation", mean(ring.iter().map(|(v, _)| *v)), rotation, 0.02);
        close("dispersion", mean(ring.iter().map(|(_, v)| v * v)).sqrt(), dispersion, 0.06);
    }
}

#[test]
fn each_part_is_balanced_in_each_direction() {
    let p = galaxy(&[("count", Value::Number(8000.0)), ("halo_fraction", Value::Number(0.5))]);
    let a = accelerations(&p);
    // The virial theorem of a part in the pull of the whole, ⟨v²⟩ = -⟨x · a⟩, by direction.
    let balance = |ids: std::ops::Range<usize>, axes: DVec3| {
        let kinetic = mean(ids.clone().map(|i| (p.velocity()[i] * p.velocity()[i]).dot(axes)));
        kinetic / mean(ids.map(|i| -(p.position()[i] * a[i]).dot(axes)))
    };
    // 4000 particles each: 1.6 % for a Gaussian's variance, and the grain of a halo of 4000; three of them.
    close("disk, in its plane", balance(0..4000, DVec3::new(1.0, 1.0, 0.0)), 1.0, 0.05);
    close("disk, across", balance(0..4000, DVec3::Z), 1.0, 0.10);
    close("halo", balance(4000..8000, DVec3::ONE), 1.0, 0.05);
    // All of it: K / |W| = 1/2, for W = Σ m x · a of a self-gravitating whole.
    let all = |f: &dyn Fn(usize) -> f64| (0..8000).map(|i| p.mass()[i] * f(i)).sum::<f64>();
    let virial = all(&|i| 0.5 * p.velocity()[i].length_squared()) / -all(&|i| p.position()[i].dot(a[i]));
    close("virial ratio", virial, 0.5, 0.03);
}

#[test]
fn a_bulge_is_balanced_and_holds_its_disk() {
    let bulge = [("bulge_mass", 0.7), ("bulge_fraction", 0.25), ("halo_fraction", 0.375), ("bulge_scale", 0.5)];
    let mut settings = vec![("count", Value::Number(16_000.0))];
    settings.extend(bulge.map(|(key, x)| (key, Value::Number(x))));
    let p = galaxy(&settings);
    let ids = [0..6000, 6000..12_000, 12_000..16_000];
    let masses = ids.clone().map(|ids| p.mass()[ids].iter().sum::<f64>());
    for (mass, wanted) in masses.iter().zip([1.0, 6.0, 0.7]) {
        close("mass", *mass, wanted, 1e-12);
    }
    // r = a √u / (1 - √u) with √u up to 10/11, a = 0.5; errors as for the halo's profile.
    for (share, radius) in [(0.1, 0.201_735), (0.5, 0.899_872), (0.9, 3.134_761)] {
        close("r", quantile(p.position()[ids[2].clone()].iter().map(|x| x.length()), share), radius, 0.1);
    }
    let a = accelerations(&p);
    // ⟨v²⟩ = -⟨x · a⟩ of each part. Were the bulge left out of the pull, these would be 0.73, 0.82 and 0.68.
    for (what, ids) in ["disk", "halo", "bulge"].iter().zip(ids) {
        let kinetic = mean(ids.clone().map(|i| p.velocity()[i].length_squared()));
        close(what, kinetic / mean(ids.map(|i| -p.position()[i].dot(a[i]))), 1.0, 0.05);
    }
}

#[test]
fn a_disk_without_a_halo_is_balanced_too() {
    // Its centre cannot be as warm as Q asks and be held: the cap takes over there.
    for q in [1.2, 3.0] {
        let p = galaxy(&[
            ("count", Value::Number(6000.0)),
            ("halo_mass", Value::Number(0.0)),
            ("toomre_q", Value::Number(q)),
        ]);
        let a = accelerations(&p);
        let kinetic = mean(p.velocity().iter().map(|v| v.length_squared()));
        let virial = kinetic / -mean((0..6000).map(|i| p.position()[i].dot(a[i])));
        close("virial ratio", 0.5 * virial, 0.5, 0.03);
    }
}

#[test]
fn a_thin_disk_alone_is_thin_and_turns_as_freeman_says() {
    let p = galaxy(&[
        ("count", Value::Number(40_000.0)),
        ("halo_mass", Value::Number(0.0)),
        ("disk_height", Value::Number(0.05)),
        ("toomre_q", Value::Number(0.3)),
        ("softening", Value::Number(0.0)),
    ]);
    assert_eq!((p.len(), p.mass()[39_999]), (40_000, 1.0 / 40_000.0));
    // Quantiles of R e^-R, and of |z| under sech²(z / 0.05), as above.
    close("R", quantile(p.position().iter().map(|x| x.truncate().length()), 0.5), 1.678_347, 0.03);
    close("z", quantile(p.position().iter().map(|x| x.z.abs()), 0.9), 0.073_611, 0.03);
    // Freeman (1970) at 2.2 R_d, less z₀ R e^-R for the thickness; cold, so that asymmetric drift takes some σ² alone,
    // which is (3.36 · 0.3 Σ / κ)², a hundredth of v².
    let ring = (0..p.len()).filter(|i| (p.position()[*i].truncate().length() - 2.2).abs() < 0.05);
    let around = |i: usize| p.velocity()[i].truncate().dot(p.position()[i].truncate().normalize().perp());
    close("v", mean(ring.map(around)), (0.386_912_f64 - 0.05 * 2.2 * (-2.2_f64).exp()).sqrt(), 0.02);
}

#[test]
fn it_turns_about_its_normal_and_its_parts_share_a_centre() {
    let normal = DVec3::new(1.0, -2.0, 3.0);
    let center = DVec3::new(5.0, 6.0, 7.0);
    let p = galaxy(&[
        ("count", Value::Number(4000.0)),
        ("normal", Value::Vector(normal)),
        ("center", Value::Vector(center)),
    ]);
    let disk = 0..1000;
    let spin: DVec3 = disk.clone().map(|i| (p.position()[i] - center).cross(p.velocity()[i])).sum();
    assert!(spin.normalize().dot(normal.normalize()) > 0.999, "{spin}");
    for part in [disk, 1000..4000] {
        let x: DVec3 = part.clone().map(|i| p.position()[i] - center).sum();
        let v: DVec3 = part.map(|i| p.velocity()[i]).sum();
        assert!(x.length() < 1e-9 && v.length() < 1e-9, "{x} {v}");
    }
}

#[test]
fn it_stays_a_disk() {
    let mut p = galaxy(&[("count", Value::Number(2000.0)), ("halo_fraction", Value::Number(0.7))]);
    let disk = 0..600;
    let state = |p: &State| {
        [
            quantile(p.position()[disk.clone()].iter().map(|x| x.truncate().length()), 0.5),
            quantile(p.position()[disk.clone()].iter().map(|x| x.z.abs()), 0.5),
            mean(disk.clone().map(|i| p.position()[i].cross(p.velocity()[i]).z)),
            quantile(p.position()[600..].iter().map(|x| x.length()), 0.5),
        ]
    };
    let before = state(&p);
    let dt = 0.05;
    let mut a = accelerations(&p);
    for _ in 0..240 {
        let (positions, velocities) = p.phase_mut();
        for ((x, v), a) in positions.iter_mut().zip(velocities).zip(&a) {
            *v += *a * (0.5 * dt);
            *x += *v * dt;
        }
        a = accelerations(&p);
        for (v, a) in p.velocity_mut().iter_mut().zip(&a) {
            *v += *a * (0.5 * dt);
        }
    }
    // One turn at R = 2, half of one at R = 4. 2000 particles stir each other, so the disk thickens; it does not fall apart.
    let after = state(&p);
    close("half-mass radius of the disk", after[0], before[0], 0.12);
    assert!(after[1] < 2.0 * before[1], "thickness {} to {}", before[1], after[1]);
    close("spin", after[2], before[2], 0.05);
    close("half-mass radius of the halo", after[3], before[3], 0.06);
}
