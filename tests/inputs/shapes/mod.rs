//! The generators: same bits forever, the totals they promise, and the models' published numbers within sampling error.

mod clustered;
mod copies;
mod disk;
mod melts;
mod models;
mod tied;
mod tied_bodies;
mod waves;

use std::borrow::Cow;

use glam::DVec3;
use motes::State;
use motes::error::Error;
use motes::links::Links;
use motes::settings::{Kind, Settings, Value};
use motes::shapes::{SHAPES, shape};

/// Settings of a shape: of these values and some that are usual here, those that it has a key for.
fn settings(name: &str, values: &[(&'static str, f64)]) -> Settings {
    let keys = shape(name).expect("a shape").keys;
    let known = |name: &str| keys.iter().find(|key| key.name == name);
    let vectors = ["size", "cells"].map(|key| (key, Value::Vector(DVec3::new(3.0, 4.0, 5.0))));
    let numbers = [("columns", 6.0), ("rows", 5.0), ("strands", 4.0), ("beads", 4.0), ("hubble", 1.5)];
    // What has no spacing or density by itself.
    let lacks = |(name, _): &(&str, f64)| known(name).is_some_and(|key| key.default.is_none());
    let given = [
        ("spacing", 0.5),
        ("density", 0.8),
        ("radius", 0.25),
        ("count_per_side", 6.0),
        ("side", 40.0),
        ("megaparsec", 1.0),
    ]
    .into_iter()
    .filter(lacks);
    let numbers = numbers.into_iter().chain(given).chain(values.iter().copied());
    let all = vectors.into_iter().chain(numbers.map(|(key, x)| (key, Value::Number(x))));
    let fits = all.filter(|(key, _)| known(key).is_some());
    fits.fold(Settings::defaults(keys), |all, (key, value)| all.with(key, value))
}

fn made(name: &str, settings: &Settings) -> State {
    (shape(name).expect("a shape").build)(settings).expect("good settings")
}

fn make(name: &str, values: &[(&'static str, f64)]) -> State {
    made(name, &settings(name, values))
}

/// All numbers of links and fixed particles.
fn ties(particles: &State) -> impl Iterator<Item = f64> {
    let Links { springs, rods, joints, dihedrals: _, triangles } = &particles.links;
    let ids = |ids: &[u32]| ids.iter().map(|id| f64::from(*id)).collect::<Vec<_>>();
    let springs = springs
        .iter()
        .flat_map(move |l| [ids(&l.ends), vec![l.rest, l.stiffness, l.damping, f64::from(u8::from(l.rope))]].concat());
    let rods = rods.iter().flat_map(move |rod| [ids(&rod.ends), vec![rod.length]].concat());
    let joints = joints.iter().flat_map(move |joint| [ids(&joint.ids), vec![joint.stiffness]].concat());
    let held = particles.held.iter().map(|one| f64::from(one.id));
    springs.chain(rods).chain(joints).chain(triangles.iter().flat_map(move |corners| ids(corners))).chain(held)
}

/// FNV-1a over the bits of all numbers.
fn hash(particles: &State) -> u64 {
    let vectors = particles.position().iter().chain(particles.velocity()).flat_map(DVec3::to_array);
    let numbers = vectors.chain(particles.mass().iter().copied()).chain(particles.size().iter().copied());
    numbers
        .chain(ties(particles))
        .flat_map(|x| x.to_bits().to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// Sum of mass, centre of mass, its velocity.
fn totals(p: &State) -> (f64, DVec3, DVec3) {
    let mass: f64 = p.mass().iter().sum();
    let x: DVec3 = p.position().iter().zip(p.mass()).map(|(x, m)| *x * *m).sum();
    let v: DVec3 = p.velocity().iter().zip(p.mass()).map(|(v, m)| *v * *m).sum();
    (mass, x / mass, v / mass)
}

#[test]
fn the_bits_never_change() {
    let stored = [
        ("plummer", 0xe3b5_8a2c_371b_8eec),
        ("hernquist", 0x6fb8_bfc8_a05d_861f),
        ("sphere", 0x85a1_99b2_52d8_1b88),
        ("disk", 0x6c6c_7862_37bc_89f1),
        ("clusters", 0x8f8b_9f69_a873_c01d),
        ("lattice", 0x138f_3cc1_8be2_c72b),
        ("cosmological", 0xc762_e704_9080_2f02),
        ("crystal", 0x5f54_3f93_4702_0947),
        ("block", 0x189e_3f26_e44a_3f45),
        ("drop", 0x52f4_acbd_0571_4f25),
        ("tank", 0x3fcc_e639_3c8f_6850),
        ("wall", 0x1480_9eeb_19f6_fc90),
        ("box", 0x7947_fcef_4d33_1765),
        ("spray", 0x75af_c8eb_4624_d16b),
        ("grains", 0x409e_763b_a3e1_bf71),
        ("crowd", 0x331f_475d_b979_e6bf),
        ("chain", 0x3d71_07f6_cae9_b2ac),
        ("chains", 0x9bd7_6ec2_23ce_049c),
        ("cloth", 0xb078_4cef_395b_0d7a),
        ("jelly", 0x2265_3ad0_bdde_76e3),
        ("hair", 0x584b_147e_22f6_7f9b),
    ];
    assert_eq!(stored.map(|(name, _)| name).as_slice(), SHAPES.iter().map(|s| s.name).collect::<Vec<_>>());
    // The size that all have by default holds few pedestrians.
    let numbers = |name: &str, seed: f64| {
        let count = if name == "crowd" { 12.0 } else { 100.0 };
        [("count", count), ("seed", seed), ("virial", 0.3), ("jitter", 0.2), ("speed", 0.5), ("temperature", 0.7)]
    };
    let made = stored.map(|(name, _)| (name, hash(&make(name, &numbers(name, 7.0)))));
    assert_eq!(made, stored, "a platform or a generator has changed");
    let random = |name: &str| shape(name).is_some_and(|shape| shape.keys.iter().any(|key| key.name == "seed"));
    for (name, _) in stored.into_iter().filter(|(name, _)| random(name)) {
        let [one, other] = [7.0, 8.0].map(|seed| make(name, &numbers(name, seed)));
        assert_ne!(one, other, "{name} does not look at its seed");
    }
}

#[test]
fn every_key_matters() {
    for shape in SHAPES {
        let numbers = [("count", 40.0), ("virial", 0.2), ("jitter", 0.1), ("speed", 0.1)];
        let more = [("temperature", 0.7), ("bulge_mass", 0.3), ("displacement", 0.2), ("growth", 0.4)];
        let base = settings(shape.name, &[&numbers[..], &more].concat());
        // A crowd is flat and needs room, so many that some meet, and speeds that reach their limits.
        let crowd = shape.name == "crowd";
        let wide = |base: Settings| base.with("size", Value::Vector(DVec3::new(12.0, 12.0, 0.0)));
        let many = |base: Settings| base.with("count", Value::Number(120.0)).with("speed_spread", Value::Number(1.0));
        let base = if crowd { many(wide(base)) } else { base };
        // A wall has several surfaces, and keys of each.
        let mesh = |text: &str| Value::Text(text.to_owned().into());
        let triangle =
            base.clone().with("surface", mesh("mesh")).with("mesh", mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3"));
        let bases = if shape.name == "wall" { vec![base, triangle] } else { vec![base] };
        // Colours are for pictures.
        for key in shape.keys.iter().filter(|key| key.kind != Kind::Color) {
            let base = &bases[0];
            let other = match key.kind {
                _ if key.name == "surface" => mesh("box"),
                _ if key.name == "support" => Value::Number(3.0),
                _ if key.name == "beads" => Value::Number(6.0),
                Kind::Flag => Value::Flag(!base.flag(key.name)),
                Kind::Sides => mesh("+x"),
                Kind::File => mesh("v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3"),
                Kind::Vector if crowd => Value::Vector(DVec3::new(14.0, 13.0, 0.0)),
                Kind::Vector | Kind::Direction => Value::Vector(DVec3::new(2.0, 3.0, 4.0)),
                Kind::Count | Kind::Whole => Value::Number(37.0),
                Kind::Choice(words) => Value::Text(Cow::Borrowed(words[words.len() - 1])),
                _ => Value::Number(base.number(key.name) * 0.7 + 0.05),
            };
            let changes = |base: &Settings| {
                let after = made(shape.name, &base.clone().with(key.name, other.clone()));
                made(shape.name, base) != after
            };
            assert!(bases.iter().any(changes), "{}: {} changes nothing", shape.name, key.name);
        }
    }
}

#[test]
fn totals_are_exact() {
    let (center, velocity) = (DVec3::new(3.0, -2.0, 1.0), DVec3::new(-0.5, 0.25, 4.0));
    for (name, mass) in
        [("plummer", 2.5), ("hernquist", 2.5), ("sphere", 2.5), ("disk", 7.0), ("clusters", 2.5), ("box", 500.0 * 2.5)]
    {
        let p = made(
            name,
            &settings(
                name,
                &[
                    ("count", 500.0),
                    ("mass", 2.5),
                    ("virial", 0.4),
                    ("speed", 1.0),
                    ("dispersion", 1.0),
                    ("particle_size", 0.1),
                ],
            )
            .with("center", Value::Vector(center))
            .with("velocity", Value::Vector(velocity)),
        );
        let (total, x, v) = totals(&p);
        assert_eq!((p.len(), p.size()), (500, [0.1; 500].as_slice()), "{name}");
        // 500 roundings of 1e-16.
        assert!((total / mass - 1.0).abs() < 1e-13, "{name}: mass {total}");
        assert!((v - velocity).length() < 1e-13, "{name}: velocity {v}");
        // A box is placed, not balanced: a side of 5 has the standard error 5 / √(12 · 500).
        let room = if name == "box" { 0.3 } else { 1e-13 };
        assert!((x - center).length() < room, "{name}: centre {x}");
    }
}

#[test]
fn bad_settings_are_errors() {
    for (name, key, value, words) in [
        ("plummer", "count", Value::Number(0.0), "count is 0"),
        ("plummer", "scale", Value::Number(-1.0), "scale is -1; it must be above 0"),
        ("plummer", "mass", Value::Number(f64::NAN), "mass is NaN"),
        ("plummer", "cutoff", Value::Number(1.5), "cutoff is 1.5; it must be above 0 and at most 1"),
        ("plummer", "scale", Value::Number(1e-320), "too far apart"),
        ("plummer", "center", Value::Vector(DVec3::INFINITY), "center"),
        ("plummer", "count", Value::Number(1e10), "10000000000 particles need ids beyond"),
        ("hernquist", "cutoff", Value::Number(1.0), "cutoff is 1; it must be above 0 and below 1"),
        ("clusters", "children", Value::Number(1.0), "children is 1; it must be 2 or above"),
        ("clusters", "dimension", Value::Number(3.1), "dimension is 3.1; it must be above 0 and at most 3"),
        ("sphere", "virial", Value::Number(-0.1), "virial is -0.1; it must be 0 or above"),
        ("sphere", "radius", Value::Text(Cow::Borrowed("big")), "has a key `radius` of another kind"),
        ("disk", "halo_fraction", Value::Number(1.0), "halo_fraction is 1; it must be 0 or above and below 1"),
        ("disk", "halo_fraction", Value::Number(0.0), "no particle is left for the halo"),
        ("disk", "halo_fraction", Value::Number(0.999), "no particle is left for the disk"),
        ("disk", "bulge_fraction", Value::Number(-0.5), "bulge_fraction is -0.5; it must be 0 or above and below 1"),
        ("disk", "bulge_mass", Value::Number(-1.0), "bulge_mass is -1; it must be 0 or above"),
        ("disk", "normal", Value::Vector(DVec3::ZERO), "a direction must not be zero"),
        ("disk", "disk_scale", Value::Number(0.0), "disk_scale is 0"),
        ("lattice", "size", Value::Vector(DVec3::new(2.0, 2.5, 2.0)), "three whole numbers"),
        ("lattice", "size", Value::Vector(DVec3::splat(1e6)), "particles need ids beyond the 4294967295"),
        ("crystal", "cells", Value::Vector(DVec3::new(2.0, 0.0, 2.0)), "three whole numbers"),
        ("crystal", "cells", Value::Vector(DVec3::splat(1e4)), "particles need ids beyond the 4294967295"),
        ("crystal", "density", Value::Number(0.0), "density is 0; it must be above 0"),
        ("box", "size", Value::Vector(DVec3::NEG_X), "a side must be 0 or above"),
    ] {
        let bad = settings(name, &[("count", 50.0)]).with(key, value);
        let error = (shape(name).expect("a shape").build)(&bad).expect_err(key);
        let limit = words.contains("ids");
        assert!(matches!(error, Error::Scene(_)) != limit && matches!(error, Error::Limit(_)) == limit, "{error:?}");
        assert!(error.to_string().contains(words), "{name}.{key}: `{error}` does not say `{words}`");
        assert!(error.to_string().contains(name));
    }
}
