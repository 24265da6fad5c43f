//! Completion of a submission. The device is polled without waiting: if two threads wait for a time on one device, wgpu can panic in one of
//! them when its time is over while the other clears the queue.

use std::sync::Arc;
use std::time::Duration;

use futures_intrusive::sync::ManualResetEvent;
#[cfg(not(target_arch = "wasm32"))]
use web_time::Instant;

use crate::error::Error;

/// The shortest pause between two polls of a device. Later ones are a sixteenth of the time waited so far.
#[cfg(not(target_arch = "wasm32"))]
const SHORTEST: Duration = Duration::from_micros(20);
/// The longest pause.
#[cfg(not(target_arch = "wasm32"))]
const LONGEST: Duration = Duration::from_micros(500);

/// A flag that is set once all work submitted before its creation is complete.
pub struct Done {
    event: Arc<ManualResetEvent>,
    #[cfg(not(target_arch = "wasm32"))]
    index: wgpu::SubmissionIndex,
}

impl Done {
    /// For all work submitted to a queue so far, of which `index` is the last submission.
    #[cfg_attr(
        target_arch = "wasm32",
        expect(unused_variables, clippy::needless_pass_by_value, reason = "a browser knows when it is complete")
    )]
    pub fn of(queue: &wgpu::Queue, index: wgpu::SubmissionIndex) -> Self {
        let event = Arc::new(ManualResetEvent::new(false));
        let set = event.clone();
        queue.on_submitted_work_done(move || set.set());
        Self {
            event,
            #[cfg(not(target_arch = "wasm32"))]
            index,
        }
    }
    /// Polls for at most `time`.
    ///
    /// # Errors
    /// [`Error::Lost`] when the submission is unknown to the device: it is lost.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn within(&self, device: &wgpu::Device, time: Duration) -> Result<bool, Error> {
        if !wait_until(device, time, || self.event.is_set())? {
            return Ok(false);
        }
        // A lost device accepts submissions silently, reports them as complete, and does not recognise them afterwards. A complete one is
        // not waited for.
        let known = wgpu::PollType::Wait { submission_index: Some(self.index.clone()), timeout: Some(Duration::ZERO) };
        polled(device, known).map(|()| true)
    }
    /// Waits until the flag is set. Only a browser wakes the task by itself.
    #[cfg(target_arch = "wasm32")]
    pub async fn awaited(&self) {
        self.event.wait().await;
    }
}

/// Polls a device. wgpu panics when a driver reports that its device is lost: here that is an error.
///
/// # Errors
/// [`Error::Lost`] when the device is.
#[cfg(not(target_arch = "wasm32"))]
pub fn polled(device: &wgpu::Device, how: wgpu::PollType) -> Result<(), Error> {
    let poll = std::panic::AssertUnwindSafe(|| device.poll(how));
    match std::panic::catch_unwind(poll) {
        Ok(Ok(_)) => Ok(()),
        Ok(Err(why)) => Err(Error::Lost(why.to_string())),
        Err(_) => Err(Error::Lost("its driver lost it".to_owned())),
    }
}

/// Polls a device until a condition holds, for at most `time`; returns whether it holds.
///
/// # Errors
/// [`Error::Lost`] when the device is.
#[cfg(not(target_arch = "wasm32"))]
pub fn wait_until(device: &wgpu::Device, time: Duration, mut so: impl FnMut() -> bool) -> Result<bool, Error> {
    let start = Instant::now();
    loop {
        polled(device, wgpu::PollType::Poll)?;
        if so() {
            return Ok(true);
        }
        let waited = start.elapsed();
        if waited >= time {
            return Ok(false);
        }
        std::thread::sleep((waited / 16).clamp(SHORTEST, LONGEST).min(time.saturating_sub(waited)));
    }
}

/// A browser answers in its own event loop.
#[cfg(target_arch = "wasm32")]
#[expect(clippy::unnecessary_wraps, reason = "other devices may be lost")]
pub fn wait_until(_: &wgpu::Device, _: Duration, mut so: impl FnMut() -> bool) -> Result<bool, Error> {
    Ok(so())
}
