//! Shapes of linked particles: how many links of which lengths, which are held, and what is refused.

use std::borrow::Cow;
use std::collections::BTreeSet;

use glam::DVec3;
use motes::State;
use motes::error::Error;
use motes::links::Link;
use motes::motion::Hold;
use motes::settings::{Settings, Value};
use motes::shapes::shape;

pub(crate) const fn number(x: f64) -> Value {
    Value::Number(x)
}
pub(crate) const fn vector(x: f64, y: f64, z: f64) -> Value {
    Value::Vector(DVec3::new(x, y, z))
}
pub(crate) const fn word(text: &'static str) -> Value {
    Value::Text(Cow::Borrowed(text))
}

/// A shape of some settings.
fn build(name: &str, values: &[(&'static str, Value)]) -> Result<State, Error> {
    let shape = shape(name).expect("a shape");
    let settings = values.iter().fold(Settings::defaults(shape.keys), |all, (key, value)| all.with(key, value.clone()));
    (shape.build)(&settings)
}

/// The same with others besides.
#[track_caller]
pub(crate) fn made(name: &str, values: &[(&'static str, Value)], more: &[(&'static str, Value)]) -> State {
    let particles = build(name, &[values, more].concat()).expect("good settings");
    particles.links.check(particles.mass()).expect("good links");
    particles
}

/// The ids that are held, all where they are.
pub(crate) fn held(particles: &State) -> Vec<u32> {
    assert!(particles.held.iter().all(|one| one.by == Hold::Fixed));
    particles.held.iter().map(|one| one.id).collect()
}

pub(crate) fn distance(particles: &State, [a, b]: [u32; 2]) -> f64 {
    particles.position()[a as usize].distance(particles.position()[b as usize])
}

/// Springs rest at a part of their lengths; f64 rounds a few numbers of about 1.
#[track_caller]
pub(crate) fn assert_rest(particles: &State, part: f64) {
    for link in &particles.links.springs {
        let length = distance(particles, link.ends);
        assert!((link.rest - part * length).abs() < 1e-12, "{link:?} is {length} long");
    }
}

/// Twice the area of a triangle, along its normal, and its middle.
pub(crate) fn area(particles: &State, ids: [u32; 3]) -> (DVec3, DVec3) {
    let [a, b, c] = ids.map(|id| particles.position()[id as usize]);
    ((b - a).cross(c - a), (a + b + c) / 3.0)
}

/// Each shape refuses each of these, and says so.
pub(crate) fn assert_refused(name: &str, good: &[(&'static str, Value)], cases: &[(&'static str, Value, &str)]) {
    assert!(build(name, good).is_ok(), "{name}");
    for (key, value, words) in cases {
        let error = build(name, &[good, &[(key, value.clone())]].concat()).expect_err(key);
        let limit = words.contains("ids beyond");
        assert!(matches!(error, Error::Scene(_)) != limit && matches!(error, Error::Limit(_)) == limit, "{error:?}");
        let text = error.to_string();
        assert!(text.contains(words) && text.contains(name), "{name}.{key}: `{text}` does not say `{words}`");
    }
}

const CHAIN: &[(&str, Value)] = &[
    ("count", number(5.0)),
    ("from", vector(1.0, 2.0, 3.0)),
    ("to", vector(1.0, 8.0, 11.0)),
    ("stiffness", number(7.0)),
    ("damping", number(0.3)),
    ("rest", number(0.8)),
    ("bending", number(0.6)),
    ("velocity", vector(0.1, 0.2, 0.3)),
];

#[test]
fn chains() {
    let chain = made("chain", CHAIN, &[]);
    // A part of the way from the first to the last: 6 and 8 make 10, and a quarter of that is 2.5.
    let places: Vec<_> = (0..5).map(|i| DVec3::new(1.0, 2.0, 3.0) + DVec3::new(0.0, 1.5, 2.0) * f64::from(i)).collect();
    assert!(chain.position().iter().zip(&places).all(|(x, want)| x.distance(*want) < 1e-14), "{:?}", chain.position());
    assert!(chain.velocity().iter().all(|v| *v == DVec3::new(0.1, 0.2, 0.3)));
    let spring = |i, rope| Link { ends: [i, i + 1], rest: 2.0, stiffness: 7.0, damping: 0.3, rope };
    assert_eq!(chain.links.springs, [0, 1, 2, 3].map(|i| spring(i, false)));
    assert_eq!(chain.links.joints.iter().map(|joint| joint.ids).collect::<Vec<_>>(), [[0, 1, 2], [1, 2, 3], [2, 3, 4]]);
    assert!(chain.links.joints.iter().all(|joint| (joint.stiffness - 0.6).abs() < 1e-15));
    assert!(chain.links.rods.is_empty() && chain.links.triangles.is_empty());
    let ropes = made("chain", CHAIN, &[("tie", word("rope")), ("bending", number(0.0))]).links;
    assert_eq!((ropes.springs, ropes.joints.len()), ([0, 1, 2, 3].map(|i| spring(i, true)).to_vec(), 0));
    // Rods are as long as the places say, whatever springs would be at rest.
    let rods = made("chain", CHAIN, &[("tie", word("rod"))]).links;
    assert!(rods.springs.is_empty() && rods.rods.len() == 4);
    assert!(rods.rods.iter().zip(0..).all(|(rod, i)| rod.ends == [i, i + 1] && (rod.length - 2.5).abs() < 1e-14));
    for (pins, ids) in [("none", vec![]), ("first", vec![0]), ("ends", vec![0, 4])] {
        assert_eq!(held(&made("chain", CHAIN, &[("pins", word(pins))])), ids, "{pins}");
    }
    assert_refused(
        "chain",
        CHAIN,
        &[
            ("count", number(0.0), "count is 0"),
            ("count", number(1.0), "a chain has 2 particles or more"),
            ("count", number(1e10), "ids beyond"),
            ("to", vector(1.0, 2.0, 3.0), "from and to are the same position"),
            ("to", Value::Vector(DVec3::INFINITY), "to is"),
            ("from", Value::Vector(DVec3::NAN), "from is"),
            ("mass", number(0.0), "mass is 0; it must be above 0"),
            ("stiffness", number(-1.0), "stiffness is -1; it must be 0 or above"),
            ("damping", number(f64::NAN), "damping is NaN"),
            ("rest", number(-0.5), "rest is -0.5"),
            ("bending", number(f64::INFINITY), "bending is inf"),
        ],
    );
}

const CLOTH: &[(&str, Value)] = &[
    ("columns", number(6.0)),
    ("rows", number(5.0)),
    ("spacing", number(0.25)),
    ("right", vector(2.0, 0.5, 0.0)),
    ("down", vector(0.1, -1.0, 0.3)),
    ("stretch", number(40.0)),
    ("shear", number(20.0)),
    ("bend", number(5.0)),
    ("damping", number(0.8)),
    ("center", vector(1.0, -2.0, 3.0)),
];

#[test]
fn cloths() {
    let cloth = made("cloth", CLOTH, &[]);
    let (right, down) = (DVec3::new(2.0, 0.5, 0.0).normalize(), DVec3::new(0.1, -1.0, 0.3).normalize());
    assert_eq!(cloth.len(), 30);
    let apart = |a: usize, b: usize| cloth.position()[b] - cloth.position()[a];
    assert!(apart(0, 1).distance(0.25 * right) < 1e-15 && apart(0, 6).distance(0.25 * down) < 1e-15);
    let middle = cloth.position().iter().sum::<DVec3>() / 30.0;
    assert!(middle.distance(DVec3::new(1.0, -2.0, 3.0)) < 1e-14, "{middle}");
    // Along the threads 5 in each of 5 rows and 4 in each of 6 columns, two in each of 20 squares, over two 4 · 5 and 3 · 6.
    for (stiffness, count) in [(40.0, 49), (20.0, 40), (5.0, 38)] {
        let alike = cloth.links.springs.iter().filter(|link| (link.stiffness - stiffness).abs() < 1e-12);
        let alike: Vec<_> = alike.inspect(|l| assert!((l.damping - 0.02 * stiffness).abs() < 1e-12)).collect();
        assert_eq!(alike.len(), count, "{stiffness}");
    }
    assert_eq!(cloth.links.springs.len(), 49 + 40 + 38);
    assert_rest(&cloth, 1.0);
    assert_rest(&made("cloth", CLOTH, &[("rest", number(0.7))]), 0.7);
    let threads = made("cloth", CLOTH, &[("shear", number(0.0)), ("bend", number(0.0))]);
    assert_eq!(threads.links.springs.len(), 49);
    for (pins, ids) in [
        ("none", vec![]),
        ("corners", vec![0, 5]),
        ("row", (0..6).collect()),
        ("column", vec![0, 6, 12, 18, 24]),
        ("rim", vec![0, 1, 2, 3, 4, 5, 6, 11, 12, 17, 18, 23, 24, 25, 26, 27, 28, 29]),
    ] {
        assert_eq!(held(&made("cloth", CLOTH, &[("pins", word(pins))])), ids, "{pins}");
    }
}

/// A viewer that sees `right` to the right and `down` below sees the front of all triangles, which cover the sheet once.
#[test]
fn the_triangles_of_a_cloth_face_one_way() {
    let (right, down) = (DVec3::new(2.0, 0.5, 0.0).normalize(), DVec3::new(0.1, -1.0, 0.3).normalize());
    let front = down.cross(right);
    let flat = made("cloth", CLOTH, &[]);
    assert_eq!(flat.links.triangles.len(), 40);
    let sum: DVec3 = flat.links.triangles.iter().map(|ids| area(&flat, *ids).0).sum();
    assert!(sum.distance(2.0 * 20.0 * 0.0625 * front) < 1e-13, "{sum}");
    // Displaced by a fifth of a spacing at most, a triangle's normal turns by less than 2 · 2 · 0.2 in its tangent.
    let rough = made("cloth", CLOTH, &[("jitter", number(0.2))]);
    let aside: Vec<_> = rough.position().iter().zip(flat.position()).map(|(x, y)| *x - *y).collect();
    let most = aside.iter().map(|d| d.length()).fold(0.0, f64::max);
    assert!(most <= 0.05 && most > 0.04, "thirty displacements reach {most}");
    assert!(aside.iter().all(|d| d.dot(right).abs() < 1e-15 && d.dot(down).abs() < 1e-15));
    for particles in [&flat, &rough] {
        let all = particles.links.triangles.iter();
        assert!(all.clone().all(|ids| area(particles, *ids).0.normalize().dot(front.normalize()) > 0.7));
        // Each side of a triangle is run through once in each way, or is at the edge.
        let sides: Vec<_> = all.flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]).collect();
        let known: BTreeSet<_> = sides.iter().copied().collect();
        assert_eq!(known.len(), sides.len(), "a side twice in one way");
        assert_eq!(sides.iter().filter(|[a, b]| !known.contains(&[*b, *a])).count(), 2 * (5 + 4), "the rim");
    }
}

#[test]
fn cloths_that_are_none() {
    assert_refused(
        "cloth",
        CLOTH,
        &[
            ("columns", number(1.0), "columns and rows are 1 and 5; each must be 2 or above"),
            ("rows", number(0.0), "columns and rows are 6 and 0"),
            ("rows", number(4e9), "ids beyond"),
            ("right", vector(-0.2, 2.0, -0.6), "right and down are parallel"),
            ("down", Value::Vector(DVec3::ZERO), "a direction must not be zero"),
            ("spacing", number(0.0), "spacing is 0; it must be above 0"),
            ("stretch", number(0.0), "damping is set and stretch is 0"),
            ("shear", number(-1.0), "shear is -1"),
            ("bend", number(f64::NAN), "bend is NaN"),
            ("jitter", number(-0.1), "jitter is -0.1"),
            ("spacing", number(1e308), "too far apart"),
        ],
    );
}
