//! What was written reads back to the same bits; what was damaged never panics.

use glam::DVec3;
use motes::State;
use motes::formats::{Input, Precision, tipsy};
use proptest::prelude::*;

use crate::formats::{bits, csv_bytes, folder, npz_bytes, put, read, some, tipsy_bytes, xyz_bytes};

/// The same, all numbers narrowed to f32.
fn narrow(p: &State) -> Vec<u32> {
    #[expect(clippy::cast_possible_truncation, reason = "on purpose")]
    bits(p).into_iter().map(|bits| (f64::from_bits(bits) as f32).to_bits()).collect()
}

prop_compose! {
    /// Finite f64 of every size and sign: subnormals, zeros, the largest.
    fn finite()(bits in any::<u64>(), special in 0..12_usize) -> f64 {
        let x = f64::from_bits(bits);
        let specials = [0.0, -0.0, f64::MIN_POSITIVE, 5e-324, -5e-324, f64::MAX, f64::MIN, 0.1];
        specials.get(special).copied().unwrap_or(if x.is_finite() { x } else { 1.0 })
    }
}

prop_compose! {
    /// The same for f32, widened.
    fn single()(bits in any::<u32>(), special in 0..12_usize) -> f64 {
        let x = f32::from_bits(bits);
        let specials = [0.0, -0.0, f32::MIN_POSITIVE, 1e-45, -1e-45, f32::MAX, f32::MIN, 0.1];
        f64::from(specials.get(special).copied().unwrap_or(if x.is_finite() { x } else { 1.0 }))
    }
}

fn of(numbers: &[f64]) -> State {
    let mut particles = State::default();
    for n in numbers.chunks_exact(7) {
        particles.push(DVec3::new(n[0], n[1], n[2]), DVec3::new(n[3], n[4], n[5]), n[6].abs(), 0.0);
    }
    particles
}

#[test]
fn a_single_survives_rounding_twice() {
    // The shortest decimal of this f32, read as f64 and narrowed, is its neighbour.
    let x = 7.038_531e-26_f32;
    #[expect(clippy::cast_possible_truncation, reason = "on purpose")]
    let twice = 7.038_531e-26_f64 as f32;
    assert_ne!(x.to_bits(), twice.to_bits(), "the example is none");
    let particles = of(&[f64::from(x), f64::from(-x), 0.0, 0.0, 0.0, 0.0, 1.0]);
    let folder = folder();
    let path = put(&folder, "a.csv", csv_bytes(&particles, Precision::Single));
    assert_eq!(narrow(&read(&path).expect("csv")), narrow(&particles));
}

#[test]
fn ids_that_are_not_places_stay_with_their_particles() {
    let mut particles = some(4);
    particles.set_ids(vec![2, 3, 7, 4_000_000_000]).expect("four ids");
    let folder = folder();
    let files = [
        ("a.csv", csv_bytes(&particles, Precision::Double)),
        ("a.npz", npz_bytes(&particles, Precision::Double)),
        ("a.xyz", xyz_bytes(&particles, Precision::Double)),
    ];
    for (name, bytes) in files {
        let back = read(&put(&folder, name, bytes)).expect(name);
        assert_eq!((bits(&back), back.ids()), (bits(&particles), particles.ids()), "{name}");
    }
    // Rows in another order are sorted.
    let text = "id,x,y,z\n9,3,0,0\n4,1,0,0\n7,2,0,0\n";
    let sorted = read(&put(&folder, "b.csv", text)).expect("three");
    assert_eq!((sorted.ids().to_vec(), sorted.position()[2].x), (vec![4, 7, 9], 3.0));
    // Those that are places are not kept.
    let plain = read(&put(&folder, "c.csv", csv_bytes(&some(3), Precision::Double))).expect("three");
    assert!(!plain.has_ids() && plain.ids().to_vec() == [0, 1, 2]);
}

/// The same, of some species.
fn kinds(mut particles: State, kinds: &[u32]) -> State {
    particles.species_mut().iter_mut().zip(kinds).for_each(|(species, kind)| *species = *kind);
    particles
}

proptest! {
    #[test]
    fn doubles_come_back_bit_for_bit(
        numbers in prop::collection::vec(finite(), 0..70), species in prop::collection::vec(any::<u32>(), 0..10),
    ) {
        let folder = folder();
        let particles = kinds(of(&numbers), &species);
        let text = put(&folder, "a.csv", csv_bytes(&particles, Precision::Double));
        prop_assert_eq!(bits(&read(&text).expect("csv")), bits(&particles));
        let archive = put(&folder, "a.npz", npz_bytes(&particles, Precision::Double));
        let back = read(&archive).expect("npz");
        prop_assert_eq!((bits(&back), back.time, back.step), (bits(&particles), 2.5, 77));
        // Species are elements there.
        let particles = kinds(of(&numbers), &species.iter().map(|kind| kind % 119).collect::<Vec<_>>());
        let back = read(&put(&folder, "a.xyz", xyz_bytes(&particles, Precision::Double))).expect("xyz");
        prop_assert_eq!((bits(&back), back.time, back.step), (bits(&particles), 2.5, 77));
    }

    #[test]
    fn singles_come_back_bit_for_bit(numbers in prop::collection::vec(single(), 0..70)) {
        let folder = folder();
        let particles = of(&numbers);
        // Decimal text is read as f64: the same f32 when narrowed again.
        let text = put(&folder, "a.csv", csv_bytes(&particles, Precision::Single));
        prop_assert_eq!(narrow(&read(&text).expect("csv")), narrow(&particles));
        let text = put(&folder, "a.xyz", xyz_bytes(&particles, Precision::Single));
        prop_assert_eq!(narrow(&read(&text).expect("xyz")), narrow(&particles));
        let archive = put(&folder, "a.npz", npz_bytes(&particles, Precision::Single));
        prop_assert_eq!(bits(&read(&archive).expect("npz")), bits(&particles));
        let binary = put(&folder, "a.tipsy", tipsy_bytes(&particles));
        let back = tipsy::read(&Input::disk(&binary), &motes::kernel::Columns::default()).expect("tipsy");
        prop_assert_eq!((bits(&back), back.time), (bits(&particles), 2.5));
    }

    #[test]
    fn noise_is_an_error_or_particles_but_never_a_panic(
        which in 0..4_usize, place in any::<prop::sample::Index>(), byte in any::<u8>(), twice in any::<prop::sample::Index>(),
    ) {
        let folder = folder();
        let (name, mut bytes) = [
            ("a.csv", csv_bytes(&some(9), Precision::Single)),
            ("a.npz", npz_bytes(&some(9), Precision::Single)),
            ("a.tipsy", tipsy_bytes(&some(9))),
            ("a.xyz", xyz_bytes(&some(9), Precision::Single)),
        ][which].clone();
        let length = bytes.len();
        bytes[place.index(length)] = byte;
        bytes[twice.index(length)] ^= 1 << (byte % 8);
        let _ = read(&put(&folder, name, bytes));
    }
}
