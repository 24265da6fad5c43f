//! Lockstep: every kernel of a plan against its f64 reference, each given the device's own inputs, so that errors
//! do not accumulate and one tolerance serves all.

mod nudge;
mod truncation;

use nudge::{Nudged, nudged};
pub use truncation::{Truncation, truncation};

use std::collections::BTreeMap;

use glam::{DVec3, DVec4};

use crate::error::Error;
use crate::gpu::Gpu;
use crate::kernel::{
    ACCELERATION, Access, Array, Backend, Host, Kernel, LIFE, Name, Next, POSITION, Plan, Side, VELOCITY, World,
    high_words, joined,
};

/// The tolerated error of a kernel, relative to the change: a sum of n terms of one magnitude has a rounding error of about √n ulp, and
/// blocks keep √n below 100; with 6e-8 for an ulp that is 6e-6. The worst seen on lavapipe is 2e-6.
pub const TOLERANCE: f64 = 1e-5;
/// An additional tolerance, in units of the last place of the result, for the last addition and for a product before it.
const LAST_PLACES: f64 = 2.0;
/// What is tolerated: a part of the change, and a part of the result.
#[derive(Clone, Copy)]
struct Tolerance {
    change: f64,
    result: f64,
}

/// Of a number of single precision.
const SINGLE: Tolerance = Tolerance { change: TOLERANCE, result: LAST_PLACES * EPSILON };
/// Of the sum of two words: the rounding of a step and of its product with a rate, each half a last place of the change, and that of dt; and
/// the last places of a low word, which is half a last place of the result at most. Worst seen: half of it.
const TWO_WORDS: Tolerance = Tolerance { change: 2.0 * EPSILON, result: EPSILON * EPSILON };
/// From 1 to the next number of single precision.
const EPSILON: f64 = f32::EPSILON as f64;
/// The contents after the last element of a field, and of all of a scratch field: a small f32, different in every field, so that a kernel
/// which copies between these regions is detected.
fn sentinel(place: usize) -> [u8; 4] {
    [0xA5, u8::try_from(place % 251).unwrap_or(0), 0xC3, 0x3C]
}

/// One field that one kernel wrote.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// The kernel.
    pub kernel: String,
    /// The field.
    pub field: String,
    /// The largest error, as a part of what is allowed: above 1 is wrong.
    pub worst: f64,
    /// The same, where what rounding of the inputs does to the reference is allowed as well, fourfold. A stiff spring near its
    /// length at rest is the small difference of large numbers: no arithmetic knows it better. Where the reference jumps, as at the touch of
    /// a solid, it is enough to agree with what it says on either side of the positions. As `worst`, where that is good.
    pub conditioned: f64,
    /// The element where that is.
    pub element: usize,
    /// The median, 99th percentile and maximum of |device − reference| / |change|, over elements that changed.
    pub relative: [f64; 3],
    /// Whether anything changed at all. A kernel that changes nothing proves nothing.
    pub changed: bool,
    /// Whether a kernel has written after the last element.
    pub spilled: bool,
}

impl Verdict {
    /// Whether the device agrees with the reference.
    #[must_use]
    pub fn good(&self) -> bool {
        self.worst <= 1.0 && !self.spilled
    }
    /// Whether the device agrees with the reference as far as the inputs, which are rounded, say anything.
    #[must_use]
    pub fn sound(&self) -> bool {
        self.conditioned <= 1.0 && !self.spilled
    }
}

/// Runs a plan once, kernel by kernel, and compares each with its reference. Kernels without a reference run, and are left out.
///
/// # Errors
/// Errors of the device.
pub async fn compare(gpu: &mut Gpu, plan: &Plan, count: u32) -> Result<Vec<Verdict>, Error> {
    compared(gpu, plan, count, |_| true, None).await
}

/// What goes into the first kernel of a plan, and what its reference makes of it: the same each time that the plan runs from one state.
#[derive(Default)]
pub struct Known(Option<Answer>);

/// Arrays and parameters before a kernel, and all that a reference made of them.
struct Answer {
    before: BTreeMap<String, Array>,
    world: World,
    after: Host,
}

/// The same from one state again and again, up to the first kernel with a verdict that does not let it continue. `known` belongs to the plan
/// and to the state; other shaders may stand in the plan, of the same fields. [`Verdict::conditioned`] is not evaluated: it is as `worst`.
///
/// # Errors
/// As [`compare`].
pub async fn compare_again(
    gpu: &mut Gpu,
    plan: &Plan,
    count: u32,
    goes_on: impl Fn(&Verdict) -> bool,
    known: &mut Known,
) -> Result<Vec<Verdict>, Error> {
    compared(gpu, plan, count, goes_on, Some(known)).await
}

async fn compared(
    gpu: &mut Gpu,
    plan: &Plan,
    count: u32,
    goes_on: impl Fn(&Verdict) -> bool,
    mut known: Option<&mut Known>,
) -> Result<Vec<Verdict>, Error> {
    gpu.compile(plan)?;
    let mut verdicts = Vec::new();
    let mut runs = 0;
    let mut walk = plan.walk();
    while let Some(next) = walk.next().filter(|_| verdicts.iter().all(&goes_on)) {
        let kernel = match next {
            Next::Run(kernel) => kernel,
            Next::Ask(flag) => {
                if gpu.is_set(flag).await? {
                    walk.leave();
                }
                continue;
            }
        };
        runs += 1;
        let single = Plan::of([kernel.clone()]);
        let program = gpu.compile(&single)?;
        let Some(reference) = &kernel.reference else {
            gpu.run(&program, 1)?;
            continue;
        };
        let mut fields = fields(kernel, count);
        // A reference may read more of a particle than its shader does.
        for always in [POSITION.name, VELOCITY.name] {
            if fields.iter().all(|(name, ..)| name != always) && gpu.size(always) >= 16 * u64::from(count) {
                fields.push((always.to_owned(), 16 * u64::from(count), Array::Vec4(Vec::new()), 1));
            }
        }
        if fields.iter().all(|(name, ..)| name != LIFE.name) && gpu.size(LIFE.name) >= 4 * u64::from(count) {
            fields.push((LIFE.name.to_owned(), 4 * u64::from(count), Array::Uint(Vec::new()), 1));
        }
        for (place, (name, bytes, ..)) in fields.iter().enumerate() {
            behind(gpu, name, *bytes, sentinel(place))?;
        }
        // Contents left by an earlier run must not matter.
        let scratch = |name: &&Name| gpu.size(name) > 0;
        let scratch: Vec<_> = kernel.scratch.iter().filter(scratch).collect();
        for name in &scratch {
            behind(gpu, name, 0, sentinel(fields.len()))?;
        }
        let answer = known.as_mut().filter(|_| runs == 1).and_then(|known| known.0.take());
        let answer = if let Some(answer) = answer {
            gpu.run(&program, 1)?;
            answer
        } else {
            let mut after = Host::default();
            for (name, bytes, kind, _) in &fields {
                after.insert(name, kind.like(&gpu.bytes(name, 0, *bytes).await?));
            }
            // A reference may read tables that the device has no use for.
            for (name, words) in kernel.tables.iter().filter(|(name, _)| fields.iter().all(|(other, ..)| name != other))
            {
                after.insert(name, Array::Uint(words.to_vec()));
            }
            let world = gpu.world().await?;
            after.set_world(world);
            gpu.run(&program, 1)?;
            let before = fields.iter().filter_map(|(name, ..)| after.get(name).map(|array| (name.clone(), array)));
            let before = before.collect();
            reference(&after)?;
            Answer { before, world, after }
        };
        let (before, world, host) = (&answer.before, answer.world, &answer.after);
        if kernel.writes().iter().any(|name| name == "world") {
            let (got, periods) = (gpu.world().await?, gpu.periods().await?.map(glam::Vec3::as_dvec3));
            verdicts.push(worlds(&kernel.name, world, (got, periods), host.world()));
        }
        for name in &scratch {
            let used = used(kernel, name, count);
            let tail = gpu.bytes(name, used, gpu.size(name).saturating_sub(used)).await?;
            let spilled = tail.chunks_exact(4).any(|word| word != sentinel(fields.len()));
            if spilled {
                let field = (*name).to_string();
                verdicts.push(Verdict {
                    kernel: kernel.name.clone(),
                    field,
                    spilled,
                    changed: true,
                    ..Verdict::none()
                });
            }
        }
        let mut others: Option<Nudged> = None;
        for (place, (name, bytes, kind, parts)) in fields.iter().enumerate() {
            if !kernel.writes().contains(name) {
                continue;
            }
            let all = gpu.bytes(name, 0, gpu.size(name)).await?;
            let (data, tail) = all.split_at(usize::try_from(*bytes).unwrap_or(0).min(all.len()));
            let spilled = tail.chunks_exact(4).any(|word| word != sentinel(place));
            let (Some(start), Some(want)) = (before.get(name), host.get(name)) else { continue };
            // What has another length than particles have is made anew each time, whatever it was. Integers are exact.
            // So is the acceleration by the first law.
            let first =
                name == ACCELERATION.name && kernel.passes.iter().any(|p| p.constants.contains(&("FIRST", 1.0)));
            let anew = first || kernel.size(name).is_some() && !matches!(start, Array::Uint(_));
            let made = anew.then(|| start.like(&vec![0; usize::try_from(*bytes).unwrap_or(0)]));
            let start = made.as_ref().unwrap_or(start);
            let mut arrays = [start.clone(), want, kind.like(data)];
            let mut tolerance = SINGLE;
            // A low word says nothing alone: the sum of both is compared.
            if let Some(high) = high_words(name) {
                let device = kind.like(&gpu.bytes(high, 0, *bytes).await?);
                let own = before.get(high).cloned();
                let highs =
                    [own.unwrap_or_else(|| device.clone()), host.get(high).unwrap_or_else(|| device.clone()), device];
                let [a, b, c] = arrays;
                let [x, y, z] = highs;
                arrays = [joined(x, &a), joined(y, &b), joined(z, &c)];
                tolerance = TWO_WORDS;
            }
            let [start, want, got] = &arrays;
            let mut verdict = judge((start, want, got), *parts, tolerance, None, &[]);
            verdict.conditioned = verdict.worst;
            if known.is_none() && !verdict.good() {
                if others.is_none() {
                    let inputs = fields.iter().map(|(name, ..)| (name.as_str(), before.get(name)));
                    others = Some(nudged(reference, &inputs.collect::<Vec<_>>(), world)?);
                }
                let (sway, aside) = others.as_ref().map(|others| others.of(name)).unwrap_or_default();
                verdict.conditioned = judge((start, want, got), *parts, tolerance, sway.as_ref(), &aside).worst;
            }
            (verdict.kernel, verdict.field, verdict.spilled) = (kernel.name.clone(), name.clone(), spilled);
            verdicts.push(verdict);
        }
        if runs == 1
            && let Some(known) = &mut known
        {
            known.0 = Some(answer);
        }
    }
    Ok(verdicts)
}

/// Fills a field with a word, from an offset on.
fn behind(gpu: &mut Gpu, name: &str, from: u64, word: [u8; 4]) -> Result<(), Error> {
    let words = usize::try_from(gpu.size(name).saturating_sub(from) / 4).unwrap_or(0);
    gpu.write_bytes(name, from, &word.repeat(words))
}

/// The bytes of a field that a kernel has a use for.
fn used(kernel: &Kernel, name: &str, count: u32) -> u64 {
    let stride = kernel.bindings().filter(|(field, _)| *field == name).map(|(_, b)| b.stride).max().unwrap_or(0);
    stride * kernel.size(name).unwrap_or(u64::from(count))
}

/// The fields that a kernel names, their bytes, an empty array of their kind, and the parts of an element.
fn fields(kernel: &Kernel, count: u32) -> Vec<(String, u64, Array, usize)> {
    let mut list: Vec<(String, u64, Array, usize)> = Vec::new();
    for (field, binding) in kernel.bindings() {
        let known = list.iter().any(|(name, ..)| name == field);
        if binding.access == Access::Uniform || !binding.array || known || kernel.is_scratch(field) {
            continue;
        }
        list.push((field.to_owned(), used(kernel, field, count), binding.zeros(0), binding.parts));
    }
    list
}

/// Compares the result of a kernel: the old values, those of the reference, and the new ones. The members of a struct are different
/// quantities, each with a typical change of its own. `aside` contains further acceptable results of the reference.
fn judge(
    (before, want, got): (&Array, &Array, &Array),
    members: usize,
    tolerance: Tolerance,
    sway: Option<&Array>,
    aside: &[Array],
) -> Verdict {
    let wide = |a: &Array| match a {
        Array::Float(a) => Array::Vec4(a.iter().map(|x| DVec4::X * *x).collect()),
        other => other.clone(),
    };
    let (Array::Vec4(before), Array::Vec4(want), Array::Vec4(got)) = (&wide(before), &wide(want), &wide(got)) else {
        let wrong = match (want, got) {
            (Array::Uint(want), Array::Uint(got)) => want.iter().zip(got).position(|(w, g)| w != g),
            _ => Some(0),
        };
        let worst = if wrong.is_some() { f64::INFINITY } else { 0.0 };
        return Verdict { worst, element: wrong.unwrap_or(0), changed: before != want, ..Verdict::none() };
    };
    // The vector and its fourth component are two things; sums cancel, so that errors go with the usual change, not the own.
    let changes: Vec<[f64; 2]> = before.iter().zip(want).map(|(b, w)| parts(*w - *b)).collect();
    let usual: Vec<[f64; 2]> = (0..members)
        .map(|member| {
            let its = || changes.iter().skip(member).step_by(members);
            [0, 1].map(|p| (its().map(|c| c[p] * c[p]).sum::<f64>() / its().count().max(1) as f64).sqrt())
        })
        .collect();
    let sway = match sway.map(wide) {
        Some(Array::Vec4(other)) => other.iter().zip(want).map(|(o, w)| parts(*o - *w)).collect(),
        _ => Vec::new(),
    };
    let mean = [0, 1].map(|p| (sway.iter().map(|s| s[p] * s[p]).sum::<f64>() / sway.len().max(1) as f64).sqrt());
    let aside: Vec<Array> = aside.iter().map(wide).collect();
    let other = |i: usize| aside.iter().filter_map(move |a| if let Array::Vec4(all) = a { all.get(i) } else { None });
    let mut verdict = Verdict { changed: changes.iter().any(|c| c[0] > 0.0 || c[1] > 0.0), ..Verdict::none() };
    let mut relative = Vec::new();
    for (i, ((want, got), change)) in want.iter().zip(got).zip(&changes).enumerate() {
        let error = parts(*got - *want);
        let size = parts(*want);
        for p in 0..2 {
            let allowed = tolerance.change * change[p].max(usual[i % members][p])
                + tolerance.result * size[p]
                + f64::from(f32::MIN_POSITIVE)
                + 4.0 * sway.get(i).map_or(0.0, |s| s[p].max(mean[p]));
            let off = other(i).map(|other| parts(*got - *other)[p]).fold(error[p], f64::min);
            let ratio = if error[p].is_finite() { off / allowed } else { f64::INFINITY };
            if ratio > verdict.worst {
                (verdict.worst, verdict.element) = (ratio, i);
            }
        }
        if change[0] > 0.0 {
            relative.push(error[0] / change[0]);
        }
    }
    relative.sort_by(f64::total_cmp);
    let at = |q: usize| {
        relative.get((relative.len() * q / 100).min(relative.len().saturating_sub(1))).copied().unwrap_or(0.0)
    };
    verdict.relative = [at(50), at(99), at(100)];
    verdict
}

fn parts(v: DVec4) -> [f64; 2] {
    [v.truncate().length(), v.w.abs()]
}

fn worlds(kernel: &str, before: World, (got, [period, frequency]): (World, [DVec3; 2]), want: World) -> Verdict {
    let allowed = 4.0 * f64::from(f32::EPSILON) * want.time.abs().max(want.dt);
    let same = got.step == want.step && got.count == want.count;
    // A dt by itself: it must be right however late it is.
    let length = (got.dt - want.dt).abs() / (4.0 * f64::from(f32::EPSILON) * want.dt).max(f64::MIN_POSITIVE);
    let side = |world: &World| world.bounds.high - world.bounds.low;
    let places = 4.0 * f64::from(f32::EPSILON) * want.bounds.high.abs().max_element().max(side(&want).max_element());
    let corner = (got.bounds.high - want.bounds.high).abs().max_element() / places.max(f64::MIN_POSITIVE);
    // What is derived from the corners, as a part of it too.
    let sides = (period - want.bounds.period()).abs().max_element() / places.max(f64::MIN_POSITIVE);
    let turns = (frequency * want.bounds.period() - want.bounds.frequency() * want.bounds.period()).abs();
    let turns = turns.max((frequency * (DVec3::ONE - want.bounds.axes(Side::Periodic))).abs()).max_element();
    let shortest = want.bounds.period().to_array().into_iter().filter(|side| *side > 0.0).fold(f64::INFINITY, f64::min);
    let turns = turns / (4.0 * f64::from(f32::EPSILON) + places / shortest);
    let worst = ((got.time - want.time).abs() / allowed).max(length).max(corner).max(sides).max(turns);
    let worst = if same && !worst.is_nan() { worst } else { f64::INFINITY };
    Verdict { kernel: kernel.to_owned(), field: "world".to_owned(), worst, changed: before != want, ..Verdict::none() }
}

impl Verdict {
    fn none() -> Self {
        Self {
            kernel: String::new(),
            field: String::new(),
            worst: 0.0,
            conditioned: 0.0,
            element: 0,
            relative: [0.0; 3],
            changed: false,
            spilled: false,
        }
    }
}
