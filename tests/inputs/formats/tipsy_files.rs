//! Tipsy: byte orders, headers, kinds of records, and headers that lie.

use glam::DVec3;
use motes::State;
use motes::formats::{Input, tipsy};
use motes::kernel::{Array, Column, Columns, Kind};

use crate::formats::{folder, put, read, refused, some};

/// A Tipsy file of one byte order, with or without padding, of the kinds' own records; and what it holds.
fn tipsy_file(little: bool, padded: bool, counts: [u32; 3]) -> (Vec<u8>, State) {
    let mut bytes = Vec::new();
    let swap = |mut word: Vec<u8>| {
        if little {
            word.reverse();
        }
        word
    };
    bytes.extend(swap(1.5_f64.to_be_bytes().to_vec()));
    for word in [counts.iter().sum(), 3, counts[0], counts[1], counts[2]] {
        bytes.extend(swap(word.to_be_bytes().to_vec()));
    }
    if padded {
        bytes.extend([0xde, 0xad, 0xbe, 0xef]);
    }
    let mut particles = State::default();
    for (count, width) in counts.into_iter().zip([12, 9, 11]) {
        for _ in 0..count {
            #[expect(clippy::cast_precision_loss, reason = "a few")]
            let first = (particles.len() * 20) as f32 + 0.1;
            let record: Vec<f32> = (0..width).map(|k: u16| first + f32::from(k)).collect();
            bytes.extend(record.iter().flat_map(|x| swap(x.to_be_bytes().to_vec())));
            let wide: Vec<f64> = record.iter().copied().map(f64::from).collect();
            particles.push(DVec3::from_slice(&wide[1..4]), DVec3::from_slice(&wide[4..7]), wide[0], 0.0);
        }
    }
    particles.time = 1.5;
    (bytes, particles)
}

#[test]
fn tipsy_reads_both_orders_and_both_headers() {
    let folder = folder();
    for little in [false, true] {
        for padded in [false, true] {
            for counts in [[2, 3, 4], [0, 5, 0], [0, 0, 1], [3, 0, 0], [0, 0, 0]] {
                let (bytes, particles) = tipsy_file(little, padded, counts);
                let back =
                    tipsy::read(&Input::disk(&put(&folder, "a.tipsy", bytes)), &Columns::default()).expect("tipsy");
                assert_eq!(back, particles, "{little} {padded} {counts:?}");
            }
        }
    }
    // By what it starts with, where the name says nothing.
    let (bytes, particles) = tipsy_file(true, true, [1, 1, 1]);
    assert_eq!(read(&put(&folder, "galaxy", bytes)).expect("tipsy"), particles);
}

/// Softenings are read where they are asked for: of a spline that ends at 2 of the file's, and at 2.8 of those of a state.
#[test]
#[expect(clippy::cast_possible_truncation, reason = "the records are single precision")]
fn tipsy_has_softenings() {
    let folder = folder();
    let softening =
        |kind| Column::new("softening_length", kind, "length", "its own gravitational softening").required();
    let columns = Columns::with([softening(Kind::Scalar)]).expect("a column");
    for little in [false, true] {
        let (bytes, plain) = tipsy_file(little, true, [2, 3, 4]);
        let path = put(&folder, "a.tipsy", bytes);
        let back = tipsy::read(&Input::disk(&path), &columns).expect("tipsy");
        // The words of a record count from its first; the softening is that of the smoothing length of gas.
        let words = [9.0, 9.0, 7.0, 7.0, 7.0, 9.0, 9.0, 9.0, 9.0];
        let want: Vec<f64> =
            words.iter().zip(plain.mass()).map(|(word, first)| f64::from((*first as f32) + word) / 1.4).collect();
        assert_eq!(back.scalar("softening_length").expect("softenings").len(), want.len());
        for (got, want) in back.scalar("softening_length").expect("softenings").iter().zip(&want) {
            assert!((got - want).abs() < 1e-14 * want, "{got} is not {want}");
        }
        assert_eq!((back.position(), back.mass()), (plain.position(), plain.mass()));
        // A column of that name and another kind is another quantity.
        let other = Columns::with([softening(Kind::Vector)]).expect("a column");
        assert!(tipsy::read(&Input::disk(&path), &other).expect("tipsy").get("softening_length").is_none());
    }
    // A round trip makes none larger in single precision, and smaller by two last places at most; nothing is said to be lost.
    let mut state = some(2000);
    state.declare(&softening(Kind::Scalar)).expect("a column");
    let own: Vec<f64> = (0..2000_u16).map(|i| 0.001 * f64::from(i)).collect();
    state.set("softening_length", Array::Float(own.clone())).expect("softenings");
    let mut bytes = Vec::new();
    assert_eq!(tipsy::write_tipsy(&mut bytes, &state, 0.0).expect("memory"), Vec::<String>::new());
    let back = tipsy::read(&Input::disk(&put(&folder, "b.tipsy", bytes)), &columns).expect("tipsy");
    for (got, want) in back.scalar("softening_length").expect("softenings").iter().zip(&own) {
        let [got, want] = [*got as f32, *want as f32];
        assert!(
            (want.next_down().next_down()..=want).contains(&got) || want == 0.0 && got == 0.0,
            "{got} is not {want}"
        );
    }
    // A fault is where it says.
    let (mut bytes, _) = tipsy_file(false, true, [0, 3, 0]);
    bytes[32 + 36 + 28..32 + 36 + 32].copy_from_slice(&(-0.25_f32).to_be_bytes());
    let error = tipsy::read(&Input::disk(&put(&folder, "c.tipsy", bytes)), &columns).expect_err("below 0").to_string();
    assert!(error.contains("byte 96: dark particle 1 has the softening -0.25, below 0"), "{error}");
}

#[test]
fn a_tipsy_that_lies_is_refused() {
    let (good, _) = tipsy_file(false, true, [0, 4, 0]);
    let with = |at: usize, word: i32| {
        let mut bytes = good.clone();
        bytes[at..at + 4].copy_from_slice(&word.to_be_bytes());
        bytes
    };
    let huge = {
        let mut bytes = with(8, i32::MAX);
        bytes[20..24].copy_from_slice(&i32::MAX.to_be_bytes());
        bytes
    };
    refused("a.tipsy", huge, &["byte 8", "0 gas, 2147483647 dark and 0 star", "77309411320 bytes", "the file has 176"]);
    refused("a.tipsy", with(8, 5), &["byte 8", "announces 5 particles", "sum to 4"]);
    refused("a.tipsy", with(20, -4), &["byte 20", "-4 dark"]);
    refused("a.tipsy", with(12, 0), &["byte 12: no Tipsy file", "is 0 in little-endian and 0 in big"]);
    refused("a.tipsy", with(32, -1), &["byte 32: dark particle 0 holds NaN"]);
    refused("a.tipsy", with(32 + 36, i32::MIN | 0x3f80_0000), &["byte 68: dark particle 1 has the mass -1, below 0"]);
    refused("a.tipsy", &good[..20], &["20 bytes; a Tipsy header alone has 28"]);
    refused(
        "a.tipsy",
        [good.as_slice(), &[0]].concat(),
        &["take 172 bytes (or 176 with a padded header), but the file has 177"],
    );

    let mut wide = some(3);
    wide.velocity_mut()[2].y = 1e39;
    let error = tipsy::write_tipsy(std::io::sink(), &wide, 0.0).expect_err("too wide");
    assert!(error.to_string().contains("particle 2 holds 1"), "{error}");
}
