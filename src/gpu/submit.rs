//! Submissions, divided so that each is short. The division changes no bit: all state is in buffers.

use std::collections::VecDeque;
#[cfg(not(target_arch = "wasm32"))]
use std::future::poll_fn;
#[cfg(not(target_arch = "wasm32"))]
use std::task::Poll;
use std::time::Duration;

use web_time::Instant;

use super::done::Done;
use super::fault;
use super::program::{Cut, Dispatch, Program};
#[cfg(not(target_arch = "wasm32"))]
use super::read::{LOOK, request};
use crate::error::Error;

/// The maximum number of submissions in flight: one that runs, one that waits.
const IN_FLIGHT: usize = 2;
/// The cost of a dispatch in addition to its work, in pair evaluations: about 10 µs on a small device.
const LAUNCH: u64 = 20_000;
/// The work of the first submission to a device of unknown speed, in pair evaluations: 0.1 s on a slow one.
const FIRST: u64 = 50_000_000;

/// In loops, a flag is read after so much of the declared work of a submission: few iterations are encoded that are not needed, which dispatch
/// nothing but take their time in a submission.
const LOOKS: u64 = 4;

/// How much more than submissions without loops have shown to be right a submission with loops may have to do, if it declares no more than it does.
const SPARE: u64 = 8;

/// Dispatches of the next submission, and their work.
#[derive(Default)]
struct Batch<'a> {
    dispatches: Vec<&'a Dispatch>,
    work: u64,
    /// Whether some are of loops.
    loops: bool,
}

/// A submission in flight, and its work in pair evaluations.
struct Flying {
    done: Done,
    work: u64,
    /// Whether it has dispatches of loops.
    loops: bool,
}

/// A queue with an estimate of the speed of its device.
pub struct Queue {
    device: wgpu::Device,
    inner: wgpu::Queue,
    flying: VecDeque<Flying>,
    last_done: Instant,
    budget: u64,
    /// The budget as submissions without loops have found it: the work of iterations may be less than they declare.
    sure: u64,
    target: Duration,
    patience: Duration,
    submissions: u64,
}

impl Queue {
    pub fn new(device: wgpu::Device, queue: wgpu::Queue) -> Self {
        Self {
            device,
            inner: queue,
            flying: VecDeque::new(),
            last_done: Instant::now(),
            budget: FIRST,
            sure: FIRST,
            target: Duration::from_millis(80),
            patience: Duration::from_mins(2),
            submissions: 0,
        }
    }
    pub fn limit_submissions(&mut self, target: Duration, patience: Duration) {
        (self.target, self.patience) = (target, patience);
        (self.budget, self.sure) = (FIRST, FIRST);
    }
    pub fn wgpu(&self) -> wgpu::Queue {
        self.inner.clone()
    }
    /// Copies the estimate of the device's speed.
    pub fn like(&mut self, other: &Self) {
        (self.target, self.patience) = (other.target, other.patience);
        (self.budget, self.sure) = (other.budget, other.sure);
    }
    pub fn submissions(&self) -> u64 {
        self.submissions
    }

    /// Runs a program a number of times, in as many submissions as necessary.
    pub fn run(&mut self, program: &Program, times: u32) -> Result<(), Error> {
        let mut batch = Batch::default();
        for _ in 0..times {
            // The work since the last look at a flag.
            let (mut at, mut unseen, mut cuts) = (0, 0, program.cuts.iter().peekable());
            while let Some(next) = program.dispatches.get(at) {
                while cuts.next_if(|cut| cut.at < at).is_some() {}
                if let Some(cut) = cuts.next_if(|cut| cut.at == at)
                    && unseen > self.budget / LOOKS
                {
                    self.flush(program, &mut batch)?;
                    unseen = 0;
                    if self.is_set(cut)? {
                        at = cut.end;
                        continue;
                    }
                }
                let work = next.work + LAUNCH;
                if !batch.dispatches.is_empty() && batch.work + work > self.budget {
                    self.flush(program, &mut batch)?;
                }
                batch.dispatches.push(next);
                batch.loops |= next.loops;
                batch.work += work;
                unseen += work;
                at += 1;
            }
        }
        self.flush(program, &mut batch)
    }
    /// Submits what has been gathered.
    fn flush(&mut self, program: &Program, batch: &mut Batch<'_>) -> Result<(), Error> {
        if batch.dispatches.is_empty() {
            return Ok(());
        }
        let batch = std::mem::take(batch);
        self.submit(program, &batch)
    }
    /// Whether a loop has ended: reads its flag, after all that was submitted.
    #[cfg(not(target_arch = "wasm32"))]
    fn is_set(&mut self, cut: &Cut) -> Result<bool, Error> {
        self.wait()?;
        let device = self.device.clone();
        let mut request = request(&device, self, &cut.flag, cut.byte, 4)?;
        let bytes = request.look(Some(self.patience)).ok_or_else(|| self.timeout("the flag of a loop"))??;
        self.last_done = Instant::now();
        Ok(bytes.iter().any(|byte| *byte != 0))
    }
    /// A browser is not waited for: iterations that are not needed dispatch nothing.
    #[cfg(target_arch = "wasm32")]
    #[expect(clippy::unused_self, clippy::unnecessary_wraps, reason = "other devices are read")]
    fn is_set(&mut self, _: &Cut) -> Result<bool, Error> {
        Ok(false)
    }

    fn submit(&mut self, program: &Program, batch: &Batch<'_>) -> Result<(), Error> {
        while self.flying.len() >= IN_FLIGHT {
            self.land()?;
        }
        if self.flying.is_empty() {
            self.last_done = Instant::now();
        }
        let index = fault::scoped(&self.device, || {
            let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            {
                let descriptor = wgpu::ComputePassDescriptor { label: Some("motes"), timestamp_writes: None };
                let mut pass = encoder.begin_compute_pass(&descriptor);
                program.encode_some(batch.dispatches.iter().copied(), &mut pass);
            }
            self.inner.submit([encoder.finish()])
        })?;
        self.submissions += 1;
        self.flying.push_back(Flying { done: Done::of(&self.inner, index), work: batch.work, loops: batch.loops });
        Ok(())
    }

    /// Waits for the oldest submission, and updates the estimate with its duration.
    #[cfg(not(target_arch = "wasm32"))]
    fn land(&mut self) -> Result<(), Error> {
        let Some(oldest) = self.flying.front() else {
            return Ok(());
        };
        if !oldest.done.within(&self.device, self.patience)? {
            return Err(self.timeout("a batch of steps; choose another adapter, or fewer particles"));
        }
        self.landed();
        Ok(())
    }
    /// A browser is not waited for, and queues what it is given: only awaited submissions are a measure of speed.
    #[cfg(target_arch = "wasm32")]
    #[expect(clippy::unnecessary_wraps, reason = "other devices are waited for, and may be lost")]
    fn land(&mut self) -> Result<(), Error> {
        self.flying.pop_front();
        self.last_done = Instant::now();
        Ok(())
    }
    /// The oldest submission is complete: updates the estimate with its duration.
    fn landed(&mut self) {
        let Some(Flying { work, loops, .. }) = self.flying.pop_front() else { return };
        let took = self.last_done.elapsed();
        self.last_done = Instant::now();
        // Short submissions are no measure of speed, and one slow submission should not reduce the next by much.
        if work * 2 > self.budget || took > self.target {
            let factor = (self.target.as_secs_f64() / took.as_secs_f64().max(1e-6)).clamp(0.25, 2.0);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                clippy::cast_precision_loss,
                reason = "a budget, not a count"
            )]
            let budget = (work as f64 * factor) as u64;
            let most = if loops { self.sure.saturating_mul(SPARE) } else { 1 << 44 };
            self.budget = budget.clamp(LAUNCH, most.max(LAUNCH));
            if !loops {
                self.sure = self.budget;
            }
        }
    }

    pub fn wait(&mut self) -> Result<(), Error> {
        while !self.flying.is_empty() {
            self.land()?;
        }
        Ok(())
    }

    /// Waits for all submissions in flight, and lets the executor continue meanwhile.
    #[cfg(not(target_arch = "wasm32"))]
    pub async fn idle(&mut self) -> Result<(), Error> {
        let mut deadline = Instant::now() + self.patience;
        poll_fn(|context| {
            while let Some(next) = self.flying.front() {
                if !next.done.within(&self.device, LOOK)? {
                    if Instant::now() > deadline {
                        return Poll::Ready(Err(
                            self.timeout("a batch of steps; choose another adapter, or fewer particles")
                        ));
                    }
                    context.waker().wake_by_ref();
                    return Poll::Pending;
                }
                self.landed();
                deadline = Instant::now() + self.patience;
            }
            Poll::Ready(Ok(()))
        })
        .await
    }
    /// A browser reports when a submission is complete.
    #[cfg(target_arch = "wasm32")]
    pub async fn idle(&mut self) -> Result<(), Error> {
        while let Some(next) = self.flying.front() {
            next.done.awaited().await;
            self.landed();
        }
        Ok(())
    }

    #[cfg(not(target_arch = "wasm32"))]
    pub fn timeout(&self, what: &str) -> Error {
        Error::Timeout { what: what.to_owned(), seconds: self.patience.as_secs() }
    }
    /// Nanoseconds of a tick of the device's clock.
    pub fn period(&self) -> f32 {
        self.inner.get_timestamp_period()
    }
    pub fn patience(&self) -> Duration {
        self.patience
    }

    /// Submits a caller's commands after all submissions in flight.
    pub fn submit_commands(&mut self, commands: wgpu::CommandBuffer) -> Result<wgpu::SubmissionIndex, Error> {
        fault::scoped(&self.device, || self.inner.submit([commands]))
    }
    /// The device of the queue.
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }
    /// Creates a uniform block. It is not mapped at its creation: on a lost device that would panic.
    pub fn uniform(&mut self, name: &str, bytes: &[u8]) -> Result<wgpu::Buffer, Error> {
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let size = (bytes.len() as u64).next_multiple_of(16);
        let descriptor = wgpu::BufferDescriptor { label: Some(name), size, usage, mapped_at_creation: false };
        fault::scoped(&self.device, || {
            let buffer = self.device.create_buffer(&descriptor);
            self.inner.write_buffer(&buffer, 0, bytes);
            buffer
        })
    }
    /// Writes into a buffer, after all submitted work.
    pub fn write(&mut self, buffer: &wgpu::Buffer, from: u64, bytes: &[u8]) -> Result<(), Error> {
        fault::scoped(&self.device, || {
            self.inner.write_buffer(buffer, from, bytes);
            self.inner.submit([]);
        })
    }
}
