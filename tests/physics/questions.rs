//! Mutation of the self test: every operator and literal of its shaders is changed once, and a finding must change.

use motes::kernel::Source;
use motes::selftest::{Finding, Outcome, Questions, examine};
use motes::{Error, Gpu};

use crate::support::equivalents::{Equivalent, Ledger, same};
use crate::support::mutants::{Mutant, mutants};

const EQUIVALENT: &[Equivalent] = &[
    same(
        "arithmetic.wgsl",
        "fn broken(x: f32)",
        "0x7f800000u",
        "0x7f800001u",
        "the NaN that is asked about is above both",
    ),
    same("numbers.wgsl", "answer[1] =", ">", ">=", "twice a number is another number"),
];

fn asked(gpu: &mut Gpu, questions: &Questions) -> Result<Vec<Finding>, Error> {
    pollster::block_on(examine(gpu, questions))
}

/// Where a driver takes a plain sum or `x != x` for something else, a mutant of it is taken for something else, too.
fn telling(plain: &[Finding], mutant: &Mutant) -> bool {
    let passes = |name: &str| plain.iter().any(|f| f.name == name && f.outcome == Outcome::Pass);
    let line = |start: &[&str]| start.iter().any(|s| mutant.line.starts_with(s));
    let sums = line(&["let s =", "let t =", "answer[0]"]) && !passes("compensated sums");
    let nan = line(&["answer[4]"]) && !passes("NaN");
    // Half or three quarters of a number are both below what a driver flushes to 0.
    let flushed = plain.iter().any(|f| f.name == "denormals" && f.text.contains("flushed"));
    let small = line(&["answer[2] = bitcast<u32>(bitcast<f32>(probe[1])"]) && flushed;
    !sums && !nan && !small
}

#[test]
fn every_mutant_of_the_self_test_is_a_finding() {
    let shared = crate::support::device();
    let mut gpu = Gpu::new(&shared.found.device, &shared.found.queue, 1).expect("a GPU");
    let right = Questions::default();
    let plain = asked(&mut gpu, &right).expect("answers");
    assert!(plain.iter().all(|f| f.outcome != Outcome::Fail), "{plain:?}");
    let mut ledger = Ledger::new(EQUIVALENT, &[]);
    let wrong_loop = |long_loop| Questions { long_loop, ..right.clone() };
    let wrong_sum = |arithmetic| Questions { arithmetic, ..right.clone() };
    let wrong_number = |numbers| Questions { numbers, ..right.clone() };
    let files: [(&Source, &dyn Fn(Source) -> Questions); 3] =
        [(&right.long_loop, &wrong_loop), (&right.arithmetic, &wrong_sum), (&right.numbers, &wrong_number)];
    for (source, wrong) in files {
        for mutant in mutants(&source.text).iter().filter(|m| telling(&plain, m)) {
            let questions = wrong(Source::theirs(source.file.to_string(), mutant.text.clone()));
            // What does not compile is a finding, too.
            let noticed = asked(&mut gpu, &questions).map_or(true, |findings| findings != plain);
            ledger.enter(&source.file, mutant, noticed);
        }
    }
    assert_eq!(asked(&mut gpu, &right).expect("answers"), plain, "a mutant has broken the device");
    ledger.close(|_| true, 30);
}
