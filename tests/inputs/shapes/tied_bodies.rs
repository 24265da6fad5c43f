//! Jelly and hair: how many links of which lengths, which way they look, and what is refused.

use glam::DVec3;
use motes::settings::Value;

use crate::shapes::tied::{area, assert_refused, assert_rest, distance, held, made, number, vector};

const JELLY: &[(&str, Value)] = &[
    ("size", vector(3.0, 4.0, 5.0)),
    ("spacing", number(0.2)),
    ("mass", number(0.5)),
    ("stiffness", number(30.0)),
    ("damping", number(0.6)),
    ("center", vector(1.0, -2.0, 3.0)),
    ("velocity", vector(0.1, 0.2, 0.3)),
];

#[test]
fn jellies() {
    let jelly = made("jelly", JELLY, &[]);
    let (middle, springs) = (DVec3::new(1.0, -2.0, 3.0), &jelly.links.springs);
    assert_eq!(jelly.len(), 60);
    let low = jelly.position()[0];
    assert!(
        low.distance(middle - DVec3::new(0.2, 0.3, 0.4)) < 1e-15
            && (low + jelly.position()[59]).distance(2.0 * middle) < 1e-14
    );
    // x runs fastest.
    assert!((jelly.position()[1] - low).distance(0.2 * DVec3::X) < 1e-15);
    assert!((jelly.position()[3] - low).distance(0.2 * DVec3::Y) < 1e-15);
    // 2 · 4 · 5 + 3 · 3 · 5 + 3 · 4 · 4 edges, and two diagonals of each of 6 · 5 + 8 · 4 + 12 · 3 squares.
    let long = springs.iter().filter(|link| link.rest > 0.25).count();
    assert_eq!((springs.len(), long), (133 + 196, 196));
    assert_rest(&jelly, 1.0);
    // Of each of 24 cells: a mass, three edges (twelve quarters) and six diagonals (twelve halves).
    let sum = |of: fn(&motes::links::Link) -> f64| springs.iter().map(of).sum::<f64>();
    assert!((jelly.mass().iter().sum::<f64>() - 24.0 * 0.5).abs() < 1e-12);
    assert!(
        (sum(|l| l.stiffness) - 24.0 * 9.0 * 30.0).abs() < 1e-9 && (sum(|l| l.damping) - 24.0 * 9.0 * 0.6).abs() < 1e-9
    );
    let shares = |want: f64| springs.iter().filter(|l| (l.stiffness - want).abs() < 1e-12).count();
    // A quarter: four edges of the block in each direction, of 2, 3 and 4 pieces.
    assert_eq!(shares(7.5), 4 * (2 + 3 + 4));
    assert_eq!(shares(7.5) + shares(15.0) + shares(30.0), springs.len());
    assert!(jelly.velocity().iter().all(|v| *v == DVec3::new(0.1, 0.2, 0.3)) && held(&jelly).is_empty());
    // The skin looks outwards all around: two triangles on each square of six sides.
    assert_eq!(jelly.links.triangles.len(), 4 * (2 * 3 + 3 * 4 + 4 * 2));
    let (mut total, mut volume) = (0.0, 0.0);
    for ids in &jelly.links.triangles {
        let (normal, place) = area(&jelly, *ids);
        assert!(normal.dot(place - middle) > 0.0, "{ids:?} looks inwards");
        total += 0.5 * normal.length();
        volume += normal.dot(place - middle) / 6.0;
    }
    assert!((total - 0.04 * 52.0).abs() < 1e-12 && (volume - 0.008 * 24.0).abs() < 1e-12, "{total} {volume}");
    assert_refused(
        "jelly",
        JELLY,
        &[
            ("size", vector(3.0, 1.0, 5.0), "three whole numbers, 2 or above"),
            ("size", vector(3.0, 2.5, 5.0), "three whole numbers, 2 or above"),
            ("size", Value::Vector(DVec3::NAN), "size is"),
            ("size", Value::Vector(DVec3::splat(1e4)), "ids beyond"),
            ("stiffness", number(0.0), "stiffness is 0; it must be above 0"),
            ("damping", number(-1.0), "damping is -1"),
            ("mass", number(0.0), "mass is 0"),
            ("spacing", number(f64::INFINITY), "spacing is inf"),
        ],
    );
}

const HAIR: &[(&str, Value)] = &[
    ("strands", number(40.0)),
    ("points", number(5.0)),
    ("length", number(0.4)),
    ("spread", number(0.25)),
    ("head", number(0.2)),
    ("cap", number(60.0)),
    ("bending", number(0.03)),
    ("up", vector(1.0, 2.0, 2.0)),
    ("center", vector(1.0, -2.0, 3.0)),
];

#[test]
fn hairs() {
    let hair = made("hair", HAIR, &[]);
    let (up, middle) = (DVec3::new(1.0, 2.0, 2.0) / 3.0, DVec3::new(1.0, -2.0, 3.0));
    assert_eq!((hair.len(), hair.links.rods.len(), hair.links.joints.len()), (200, 120, 120));
    let (mut lengths, mut heights) = (Vec::new(), Vec::new());
    for strand in 0..40u32 {
        let first = 5 * strand;
        let way = hair.position()[first as usize] - middle;
        assert!((way.length() - 0.2).abs() < 1e-14, "roots are on the head");
        heights.push(way.dot(up) / 0.2);
        let length = distance(&hair, [first, first + 4]);
        lengths.push(length);
        for point in 0..5u32 {
            let off = hair.position()[(first + point) as usize]
                - middle
                - way * (1.0 + length / 0.2 * f64::from(point) / 4.0);
            assert!(off.length() < 1e-14, "strands stand off straight, in pieces of one length");
        }
        let rods = &hair.links.rods[3 * strand as usize..][..3];
        for (rod, id) in rods.iter().zip(first + 1..) {
            assert!(rod.ends == [id, id + 1] && (rod.length - length / 4.0).abs() < 1e-14, "{rod:?}");
        }
        let joints = &hair.links.joints[3 * strand as usize..][..3];
        for ((joint, id), share) in joints.iter().zip(first..).zip([2.0, 1.0, 1.0]) {
            let want = share * 0.03 / (length / 4.0);
            assert!(joint.ids == [id, id + 1, id + 2] && (joint.stiffness / want - 1.0).abs() < 1e-12, "{joint:?}");
        }
    }
    // Lengths fill their range: of forty, one is in the last tenth at either end but for a chance of 0.9⁴⁰ = 0.015 (with this seed they are).
    assert!(lengths.iter().all(|l| (0.3..=0.5).contains(l)), "{lengths:?}");
    assert!(lengths.iter().any(|l| *l < 0.32) && lengths.iter().any(|l| *l > 0.48), "{lengths:?}");
    let even = made("hair", HAIR, &[("spread", number(0.0))]);
    assert!((0..40).all(|strand| (distance(&even, [5 * strand, 5 * strand + 4]) - 0.4).abs() < 1e-14));
    // Forty belts of the cap have one root each; cos 60° is its edge.
    for (n, height) in heights.iter().enumerate() {
        assert!((height - (1.0 - 0.5 * (n as f64 + 0.5) / 40.0)).abs() < 1e-14, "{n}: {height}");
    }
    assert_eq!(held(&hair), (0..40).flat_map(|strand| [5 * strand, 5 * strand + 1]).collect::<Vec<_>>());
    assert!(made("hair", HAIR, &[("bending", number(0.0))]).links.joints.is_empty());
    assert_refused(
        "hair",
        HAIR,
        &[
            ("strands", number(0.0), "strands and points are 0 and 5; they must be 1 and 3, or above"),
            ("points", number(2.0), "strands and points are 40 and 2"),
            ("strands", number(1e9), "ids beyond"),
            ("spread", number(1.0), "spread is 1; it must be 0 or above, and below 1"),
            ("cap", number(0.0), "cap is 0; it must be above 0, and up to 180"),
            ("cap", number(181.0), "cap is 181"),
            ("length", number(0.0), "length is 0"),
            ("head", number(-0.1), "head is -0.1"),
            ("bending", number(-1.0), "bending is -1"),
            ("up", Value::Vector(DVec3::ZERO), "a direction must not be zero"),
        ],
    );
}
