//! Tests of a device: what simulations rely on, and what its driver is known to get wrong.

use std::time::Instant;

use crate::error::Error;
use crate::gpu::Gpu;
use crate::kernel::{Array, Backend, Element, Field, Kernel, Pass, Plan, Shader, Source};

/// How a test ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// As it should be.
    Pass,
    /// Not as it should be, and motes works round it.
    Warn,
    /// Results of this device cannot be trusted.
    Fail,
}

/// A test and its end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// What was tested.
    pub name: &'static str,
    /// How it ended.
    pub outcome: Outcome,
    /// What was seen, and what it means.
    pub text: String,
}

const PROBE: &str = "probe";
const ANSWER: Field<u32> = Field::new("answer");
/// Words of the probe and of the answer.
const WORDS: usize = 8;

/// Tests a device.
///
/// # Errors
/// When the device is lost or does not answer; a wrong answer is a finding.
pub async fn run(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Vec<Finding>, Error> {
    let mut gpu = Gpu::new(device, queue, 1)?;
    let mut findings = examine(&mut gpu, &Questions::default()).await?;
    findings.push(timestamps(&mut gpu).await?);
    findings.extend(gpu.warning().map(|text| Finding { name: "driver", outcome: Outcome::Warn, text }));
    Ok(findings)
}

/// The shaders that ask. A test asks wrongly, to see that a wrong answer is found.
#[derive(Debug, Clone)]
pub struct Questions {
    /// `shaders/selftest/long_loop.wgsl`
    pub long_loop: Source,
    /// `shaders/selftest/arithmetic.wgsl`
    pub arithmetic: Source,
    /// `shaders/selftest/numbers.wgsl`
    pub numbers: Source,
}

impl Default for Questions {
    fn default() -> Self {
        Self {
            long_loop: crate::shader!("selftest/long_loop.wgsl"),
            arithmetic: crate::shader!("selftest/arithmetic.wgsl"),
            numbers: crate::shader!("selftest/numbers.wgsl"),
        }
    }
}

/// Tests what a device answers, and not how fast.
///
/// # Errors
/// When the device is lost or does not answer; a wrong answer is a finding.
pub async fn examine(gpu: &mut Gpu, questions: &Questions) -> Result<Vec<Finding>, Error> {
    let mut findings = vec![loops(gpu, &questions.long_loop).await?];
    findings.extend(arithmetic(gpu, &questions.arithmetic).await?);
    findings.extend(numbers(gpu, &questions.numbers).await?);
    Ok(findings)
}

/// Asks a shader a question.
async fn ask(gpu: &mut Gpu, source: Source, probe: &[u32]) -> Result<Vec<u32>, Error> {
    let program = gpu.compile(&question(source)?)?;
    let mut words = probe.to_vec();
    words.resize(WORDS, 0);
    gpu.write(PROBE, &Array::Uint(words))?;
    gpu.write(ANSWER.name, &Array::Uint(vec![0xDEAD_BEEF; WORDS]))?;
    gpu.run(&program, 1)?;
    let answer = gpu.read(ANSWER.name, &Array::Uint(Vec::new()), WORDS).await?;
    Ok(u32::view(&answer).cloned().unwrap_or_default())
}

fn question(source: Source) -> Result<Plan, Error> {
    let name = source.file.to_string();
    let shader = Shader::join(&[source])?;
    let sizes = vec![(PROBE.into(), WORDS as u64), (ANSWER.name.into(), WORDS as u64)];
    let kernel = Kernel {
        name,
        passes: vec![Pass::new(shader, 1)],
        reference: None,
        sizes,
        scratch: Vec::new(),
        tables: Vec::new(),
    };
    Ok(Plan::of([kernel]))
}

async fn loops(gpu: &mut Gpu, source: &Source) -> Result<Finding, Error> {
    let name = "loops";
    for turns in [60_000_u32, 70_000, 1_000_000] {
        let answer = ask(gpu, source.clone(), &[turns, 7]).await?;
        let step = |x: u32, _| x.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        if answer.first() != Some(&(0..turns).fold(7, step)) {
            return Ok(if turns <= 65_535 {
                Finding {
                    name,
                    outcome: Outcome::Fail,
                    text: format!("a loop of {turns} iterations is cut short: sums over particles are wrong"),
                }
            } else {
                let text = format!(
                    "a loop of {turns} iterations is silently cut short (Mesa before 25 does so after 65 535); motes keeps its loops shorter"
                );
                Finding { name, outcome: Outcome::Warn, text }
            });
        }
    }
    Ok(Finding { name, outcome: Outcome::Pass, text: "a loop of 1 000 000 iterations runs to its end".to_owned() })
}

async fn arithmetic(gpu: &mut Gpu, source: &Source) -> Result<Vec<Finding>, Error> {
    let (a, b, c) = (1.234_567_8_f32, 3.456_789e-4_f32, 1.000_123_4_f32);
    let probe =
        [a.to_bits(), b.to_bits(), c.to_bits(), 0, f32::NAN.to_bits(), f32::INFINITY.to_bits(), f32::NAN.to_bits()];
    let answer = ask(gpu, source.clone(), &probe).await?;
    let float = |i: usize| f32::from_bits(answer.get(i).copied().unwrap_or(u32::MAX));
    let word = |i: usize| answer.get(i).copied().unwrap_or(u32::MAX);
    let s = a + b;
    let want = (a - (s - (s - a))) + (b - (s - a));
    let finding = |name, outcome, text: &str| Finding { name, outcome, text: text.to_owned() };
    let sums = match (float(0).to_bits() == want.to_bits(), float(1).to_bits() == want.to_bits()) {
        (true, true) => {
            finding("compensated sums", Outcome::Pass, "a rounding error is found, plainly and with a guard")
        }
        (false, true) => finding(
            "compensated sums",
            Outcome::Warn,
            "the compiler folds (a + b) − a; with a guard the rounding error is found",
        ),
        (_, false) => finding("compensated sums", Outcome::Fail, "not even a guarded sum finds its rounding error"),
    };
    let nan = match (word(3), word(4)) {
        _ if word(7) != 0 => finding("NaN", Outcome::Fail, "infinity is taken for one"),
        (1, 1) => finding("NaN", Outcome::Pass, "found by its bits, and by x != x"),
        (1, _) => finding("NaN", Outcome::Warn, "found by its bits; x != x is taken for false"),
        _ => {
            finding("NaN", Outcome::Fail, "not found by its bits: particles that are not finite would not be detected")
        }
    };
    let (fused, twice) = (c.mul_add(c, c), c * c + c);
    let fma = match float(2) {
        x if x.to_bits() == fused.to_bits() => finding("fma", Outcome::Pass, "rounds once"),
        x if x.to_bits() == twice.to_bits() => finding("fma", Outcome::Pass, "rounds twice; motes does not rely on it"),
        _ => finding("fma", Outcome::Warn, "is wrong; motes does not rely on it"),
    };
    let ulp = |got: f32, want: f32| got.to_bits().abs_diff(want.to_bits());
    let (division, root) = (ulp(float(5), a / b), ulp(float(6), a.sqrt()));
    let outcome = if division > 3 || root > 4 { Outcome::Fail } else { Outcome::Pass };
    let text = format!(
        "a division is {division} units in the last place from the nearest, a square root {root} (WGSL allows 2.5 and about 4)"
    );
    Ok(vec![sums, nan, fma, Finding { name: "division, root", outcome, text }])
}

/// What a driver may do as it likes, and motes does not rely on.
async fn numbers(gpu: &mut Gpu, source: &Source) -> Result<Vec<Finding>, Error> {
    // The product is 1 + 2⁻¹⁰ + 3 · 2⁻²⁴: rounded first, its end becomes 4 · 2⁻²⁴.
    let (large, small, angle) = (3e38_f32, 1.5e-38_f32, 2.5_f32);
    let (a, b, c) = (1.0 + f32::exp2(-12.0), 1.0 + 3.0 * f32::exp2(-12.0), -(1.0 + f32::exp2(-10.0)));
    let answer = ask(gpu, source.clone(), &[large, small, a, b, c, angle].map(f32::to_bits)).await?;
    let word = |i: usize| answer.get(i).copied().unwrap_or(u32::MAX);
    let float = |i: usize| f32::from_bits(word(i));
    let finding = |name, outcome, text: &str| Finding { name, outcome, text: text.to_owned() };
    let infinity = if float(0) == f32::INFINITY && word(1) == 1 {
        finding("infinity", Outcome::Pass, "a sum beyond 3.4e38 is infinite, and greater than what is finite")
    } else {
        let text = format!("6e38 is {:e}, and greater than 3e38: {}; motes tests the bits", float(0), word(1) == 1);
        finding("infinity", Outcome::Warn, &text)
    };
    let denormals = match float(2) {
        x if x.to_bits() == (small * 0.5).to_bits() => finding("denormals", Outcome::Pass, "are kept"),
        0.0 => finding("denormals", Outcome::Pass, "are flushed to 0; motes does not rely on them"),
        _ => finding("denormals", Outcome::Warn, "half of 1.5e-38 is wrong; motes does not rely on it"),
    };
    let contraction = match float(3) {
        x if x.to_bits() == (a * b + c).to_bits() => {
            finding("contraction", Outcome::Pass, "a · b + c is rounded twice")
        }
        x if x.to_bits() == a.mul_add(b, c).to_bits() => {
            let text =
                "a · b + c is rounded once: results differ in their last places from those of drivers that round twice";
            finding("contraction", Outcome::Pass, text)
        }
        _ => finding("contraction", Outcome::Fail, "a · b + c is wrong"),
    };
    let error = (float(4) - angle.sin()).abs();
    let sine = format!("off by {error:.0e} at {angle} (WGSL allows 5e-4; motes has its own where it matters)");
    // NaN is an error, too.
    let outcome = if error <= f32::exp2(-11.0) { Outcome::Pass } else { Outcome::Fail };
    Ok(vec![infinity, denormals, contraction, Finding { name: "sine", outcome, text: sine }])
}

async fn timestamps(gpu: &mut Gpu) -> Result<Finding, Error> {
    let name = "timestamps";
    gpu.write(PROBE, &Array::Uint(vec![60_000, 7, 0, 0, 0, 0, 0, 0]))?;
    let program = gpu.compile(&question(crate::shader!("selftest/long_loop.wgsl"))?)?;
    gpu.run(&program, 1)?;
    gpu.wait()?;
    let start = Instant::now();
    let Some(device) = gpu.timed(&program, 100).await? else {
        let text = "not offered; times are taken on the processor".to_owned();
        return Ok(Finding { name, outcome: Outcome::Warn, text });
    };
    let wall = start.elapsed().as_secs_f64();
    let text = format!(
        "{:.2} ms on the device's clock, {:.2} ms on the processor's, with read-back",
        device * 1e3,
        wall * 1e3
    );
    let outcome = if device > 0.0 && device <= wall { Outcome::Pass } else { Outcome::Warn };
    Ok(Finding { name, outcome, text })
}
