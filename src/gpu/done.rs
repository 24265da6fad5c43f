//! Completion of a submission. The device is polled without waiting: of two threads that wait for a time on one device, wgpu
//! lets one panic when its time is over while the other clears the queue.

use std::sync::Arc;
use std::time::Duration;

use futures_intrusive::sync::ManualResetEvent;
use web_time::Instant;

use crate::error::Error;

/// The shortest pause between two looks at a device. Later ones are a sixteenth of what was waited already.
#[cfg(not(target_arch = "wasm32"))]
const SHORTEST: Duration = Duration::from_micros(20);
/// The longest pause.
#[cfg(not(target_arch = "wasm32"))]
const LONGEST: Duration = Duration::from_micros(500);

/// Is set once all is done that was submitted before it was made.
pub struct Done {
    event: Arc<ManualResetEvent>,
    index: wgpu::SubmissionIndex,
}

impl Done {
    /// Of what a queue has taken so far, the last of it this submission.
    pub fn of(queue: &wgpu::Queue, index: wgpu::SubmissionIndex) -> Self {
        let event = Arc::new(ManualResetEvent::new(false));
        let set = event.clone();
        queue.on_submitted_work_done(move || set.set());
        Self { event, index }
    }
    /// Looks for so long at most. A browser answers while its own loop runs, and is not waited for.
    ///
    /// # Errors
    /// [`Error::Lost`] when the device does not know the submission: it is lost.
    pub fn within(&self, device: &wgpu::Device, time: Duration) -> Result<bool, Error> {
        if !wait_until(device, time, || self.event.is_set())? {
            return Ok(false);
        }
        // A device that is lost takes submissions silently, says that they are done, and does not know them afterwards. One that is
        // done is not waited for.
        let known = wgpu::PollType::Wait { submission_index: Some(self.index.clone()), timeout: Some(Duration::ZERO) };
        polled(device, known).map(|()| true)
    }
    /// Wakes the task that asks when it is set. Only a browser does so by itself.
    #[cfg(target_arch = "wasm32")]
    pub async fn awaited(&self) {
        self.event.wait().await;
    }
}

/// Polls a device. wgpu ends in a panic where a driver says that its device is lost: here that is an error.
///
/// # Errors
/// [`Error::Lost`] when the device is.
pub fn polled(device: &wgpu::Device, how: wgpu::PollType) -> Result<(), Error> {
    let poll = std::panic::AssertUnwindSafe(|| device.poll(how));
    match std::panic::catch_unwind(poll) {
        Ok(Ok(_)) => Ok(()),
        Ok(Err(why)) => Err(Error::Lost(why.to_string())),
        Err(_) => Err(Error::Lost("its driver lost it".to_owned())),
    }
}

/// Looks at a device until something is so, for so long at most: whether it is.
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

/// A browser answers while its own loop runs.
#[cfg(target_arch = "wasm32")]
pub fn wait_until(_: &wgpu::Device, _: Duration, mut so: impl FnMut() -> bool) -> Result<bool, Error> {
    Ok(so())
}
